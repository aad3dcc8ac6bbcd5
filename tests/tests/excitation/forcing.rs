//! Harmonic excitations, against the nonlinear motion of machines in which nothing is harmonic: every running and every
//! shaken coordinate is free there, and an unbalance is a shape out of its place. Derivatives of the vibrations, by solving again.

mod compared;
mod declared;
mod derivatives;
mod gradients;
mod machines;
mod mistakes;
mod random;
