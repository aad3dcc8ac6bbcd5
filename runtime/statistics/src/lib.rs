//! Random variables, points at which to sample them, and statistics of samples: everything stochastic that tolerance
//! analysis needs, independent of mechanisms.
//!
//! Functions take slices of numbers in any consistent units.

mod distribution;
mod error;
mod joint;
mod legendre;
pub mod normal;
pub mod random;
pub mod random_phases;
pub mod reliability;
#[cfg(feature = "analysis")]
pub mod sensitivity;
pub mod sequence;
#[cfg(feature = "serde")]
pub mod serial;
pub mod summary;

pub use distribution::Distribution;
pub use error::Error;
pub use joint::{Joint, semidefinite_factor};
