//! Equilibria, modes and sensitivities as text.

mod equilibrium;
mod modes;
mod sensitivity;
mod undamped;

pub use undamped::undamped;
