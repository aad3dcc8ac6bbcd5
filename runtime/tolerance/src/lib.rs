//! How tolerances spread frequencies and outputs: first order, samples, and states side by side in vectors.
//!
//! An internal part of `eigentol`, which re-exports what its users need. It promises nothing to others.

pub mod batched;
pub mod report;
pub mod tolerance;

use eigentol_contract::{mechanism, scalar};
use eigentol_contract::{Any, Array, Coordinate, CoordinateInfo, DampingKind, Description, DesignInfo, DesignVariable, Gradient, Input, InputInfo, Law, Linear, LinearPartials, List, Mechanism, Output, OutputInfo, PoseMargin, Real, RestParts, Role, Shared, Text, ToleranceInfo, Unit, Violation};
use eigentol_numerics::algebra::{Matrix, Vector};
use eigentol_numerics::{Complex, algebra, eigenproblem};
use eigentol_results::setters;
use eigentol_solve::{arguments, constraints, equilibrium, error, free, kernels, modes, rounding, sensitivity, state, watch};
use eigentol_solve::{Behaviour, Equilibrium, Error, Family, Kernels, Mode, Modes, Policy, Quantity, Sensitivities, Stability, Watch};

pub use tolerance::{FirstOrder, MonteCarlo, Tolerances};
