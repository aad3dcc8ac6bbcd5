//! What goes beyond the main job: sweeps, events and branches, second order, propagation, requirements, summaries.
//!
//! An internal part of `eigentol`, which re-exports what its users need. It promises nothing to others.

pub mod allocation;
pub mod branches;
pub mod campbell;
pub mod clusters;
pub mod judge;
pub mod limits;
pub mod motion;
pub mod picture;
pub mod propagation;
pub mod report;
pub mod requirement;
pub mod response;
pub mod second_order;
pub mod shapes;
pub mod summary;
pub mod sweep;

use eigentol_contract::{mechanism, scalar};
use eigentol_contract::{Any, Array, Coordinate, CoordinateInfo, DampingKind, Description, DesignInfo, DesignVariable, Gradient, Input, InputInfo, Law, Linear, LinearPartials, List, Mechanism, Output, OutputInfo, PictureInfo, PoseMargin, Real, RestParts, Role, Shared, SolidInfo, SolidKind, Text, ToleranceInfo, Unit, Violation};
use eigentol_numerics::algebra::{Matrix, Vector};
use eigentol_numerics::{Complex, algebra, eigenproblem};
use eigentol_results::setters;
use eigentol_solve::{arguments, constraints, equilibrium, error, free, kernels, modes, rounding, sensitivity, state, watch};
use eigentol_solve::{Behaviour, Equilibrium, Error, Family, Kernels, Mode, Modes, Policy, Quantity, Sensitivities, Stability, Watch};
use eigentol_tolerance::{batched, tolerance};
use eigentol_tolerance::{FirstOrder, MonteCarlo, Tolerances};

pub use campbell::Campbell;
