//! Natural frequencies of mechanisms in steady motion, and how manufacturing tolerances move them.
#![cfg_attr(not(feature = "std"), no_std)]

mod mechanism;
mod real;

pub use eigentol_macros::mechanism;
pub use mechanism::{Coordinate, DesignVariable, Input, Output};
pub use mechanism::{
    CoordinateInfo, DampingKind, Description, DesignInfo, Gradient, InputInfo, KernelInfo, Linear,
    LinearPartials, Mechanism, OutputInfo, RestParts, Unit, Violation,
};
pub use real::Real;
