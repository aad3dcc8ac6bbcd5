//! Equilibria, modes and sensitivities of a mechanism.
//!
//! An internal part of `eigentol`, which re-exports what its users need. It promises nothing to others.

// Mechanisms declared in unit tests refer to the door by its name.
#[cfg(test)]
extern crate eigentol_contract as eigentol;

#[doc(hidden)]
pub mod arguments;
#[doc(hidden)]
pub mod constraints;
pub mod equilibrium;
pub mod error;
#[doc(hidden)]
pub mod free;
pub mod kernels;
pub mod modes;
#[doc(hidden)]
pub mod rounding;
pub mod sensitivity;
#[doc(hidden)]
pub mod shafts;
#[doc(hidden)]
pub mod state;
#[doc(hidden)]
pub mod watch;

use eigentol_contract::{
    Coordinate, CoordinateInfo, DampingKind, Description, DesignVariable, Input, PoseMargin, Real, Role, Shared, Text,
    Unit,
};
use eigentol_contract::{mechanism, scalar};
use eigentol_numerics::{Complex, algebra, eigenproblem};
use eigentol_results::setters;

pub use equilibrium::Policy;
pub use error::Error;
pub use kernels::Kernels;
pub use modes::{Behaviour, Family, Mode, Modes};
pub use sensitivity::{Quantity, Sensitivities};
pub use state::{Equilibrium, Stability};
pub use watch::Watch;
