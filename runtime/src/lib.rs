//! Natural frequencies of mechanisms in steady motion, and how manufacturing tolerances move them.
//!
//! Declare a mechanism with [`mechanism!`]; ask questions through `Study`, or call the functions of the modules
//! directly: each takes the mechanism, plain arrays and the results of the step before.
#![cfg_attr(not(feature = "std"), no_std)]

mod mechanism;
mod real;

#[cfg(feature = "std")]
mod array;
#[cfg(feature = "std")]
pub mod equilibrium;
#[cfg(feature = "std")]
mod error;
#[cfg(feature = "std")]
pub mod modes;
#[cfg(feature = "std")]
pub mod motion;
#[cfg(feature = "std")]
pub mod report;
#[cfg(feature = "std")]
pub mod sensitivity;
#[cfg(feature = "std")]
mod study;
#[cfg(feature = "std")]
pub mod tolerance;

pub use eigentol_macros::mechanism;
pub use mechanism::{Coordinate, DesignVariable, Input, Output};
pub use mechanism::{
    CoordinateInfo, DampingKind, Description, DesignInfo, Gradient, InputInfo, KernelInfo, Linear,
    LinearPartials, Mechanism, OutputInfo, RestParts, Unit, Violation,
};
pub use real::Real;

#[cfg(feature = "std")]
pub use equilibrium::{Equilibrium, Policy, Stability};
#[cfg(feature = "std")]
pub use error::Error;
#[cfg(feature = "std")]
pub use modes::{Behaviour, Mode, Modes};
#[cfg(feature = "std")]
pub use sensitivity::Sensitivities;
#[cfg(feature = "std")]
pub use study::Study;
#[cfg(feature = "std")]
pub use tolerance::{FirstOrder, MonteCarlo, Tolerances};
