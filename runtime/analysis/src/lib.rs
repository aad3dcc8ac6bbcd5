//! What goes beyond the main job: sweeps, events and branches, forced vibration, clusters, second order, pictures.
//!
//! An internal part of `eigentol`, which re-exports what its users need. It promises nothing to others.

#[doc(hidden)]
pub mod along;
pub mod branches;
pub mod campbell;
pub mod clusters;
pub mod convergence;
pub mod event_map;
pub mod forced;
pub mod mistuning;
pub mod motion;
pub mod peaks;
pub mod picture;
#[doc(hidden)]
pub mod quadratic;
pub mod response;
pub mod second_order;
pub mod shapes;
pub mod sweep;
mod variables;

use eigentol_contract::scalar;
use eigentol_contract::{
    Any, DampingKind, Description, DesignVariable, Excitation, Input, Output, PictureInfo, Role, Shared, SolidInfo,
    SolidKind, Text, Unit,
};
use eigentol_numerics::algebra::Vector;
use eigentol_numerics::{Complex, algebra, eigenproblem};
use eigentol_results::setters;
use eigentol_solve::{Behaviour, Equilibrium, Error, Kernels, Mode, Modes, Quantity, Sensitivities, Stability, Watch};
use eigentol_solve::{arguments, constraints, equilibrium, error, free, kernels, modes, rounding, sensitivity, shafts};
use eigentol_tolerance::{batched, tolerance};

pub use campbell::Campbell;
pub use event_map::EventMap;
