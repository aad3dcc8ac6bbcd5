//! Random variables, the points to sample them at, and what is learnt from samples: all that tolerance analysis needs to
//! know of chance, apart from mechanisms.
//!
//! Functions take slices of numbers in any consistent units.

mod error;
pub mod reliability;

pub use error::Error;
