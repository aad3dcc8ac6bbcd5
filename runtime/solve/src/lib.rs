//! Equilibria, modes and sensitivities of a mechanism.
//!
//! An internal part of `eigentol`, which re-exports what its users need. It promises nothing to others.

pub mod arguments;
pub mod constraints;
pub mod equilibrium;
pub mod error;
pub mod free;
pub mod kernels;
pub mod modes;
pub mod report;
pub mod rounding;
pub mod sensitivity;
pub mod state;
pub mod watch;

use eigentol_contract::{mechanism, scalar};
use eigentol_contract::{Any, Array, Coordinate, CoordinateInfo, DampingKind, Description, DesignInfo, DesignVariable, Gradient, Input, InputInfo, Law, Linear, LinearPartials, List, Mechanism, Output, OutputInfo, PoseMargin, Real, RestParts, Role, Shared, Text, ToleranceInfo, Unit, Violation};
use eigentol_numerics::{Complex, algebra, eigenproblem};
use eigentol_numerics::algebra::{Matrix, Vector};
use eigentol_results::setters;

pub use error::Error;
pub use kernels::Kernels;
pub use modes::{Behaviour, Family, Mode, Modes};
pub use sensitivity::{Quantity, Sensitivities};
pub use state::{Equilibrium, Stability};
pub use equilibrium::Policy;
pub use watch::Watch;
