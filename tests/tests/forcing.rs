//! Harmonic excitations, against the nonlinear motion of machines in which nothing is harmonic: every running and every
//! shaken coordinate is free there, and an unbalance is a shape out of its place. Derivatives of the vibrations, by solving again.

#[path = "forcing/compared.rs"]
mod compared;
#[path = "forcing/declared.rs"]
mod declared;
#[path = "forcing/derivatives.rs"]
mod derivatives;
#[path = "forcing/gradients.rs"]
mod gradients;
#[path = "forcing/machines.rs"]
mod machines;
#[path = "forcing/mistakes.rs"]
mod mistakes;
#[path = "forcing/random.rs"]
mod random;
