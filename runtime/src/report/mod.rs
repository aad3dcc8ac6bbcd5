//! Results as text: every result type prints itself as an aligned table with names and units.

mod branches;
mod equilibrium;
mod modes;
mod sensitivity;
mod sweep;
mod table;
mod tolerance;

pub use sweep::SweepTable;
