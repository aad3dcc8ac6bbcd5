//! What goes beyond the main job: sweeps, events and branches, second order, propagation, requirements, summaries.
//!
//! An internal part of `eigentol`, which re-exports what its users need. It promises nothing to others.

pub mod allocation;
mod along;
pub mod bode;
pub mod branches;
pub mod campbell;
pub mod clusters;
pub mod convergence;
mod deviations;
pub mod forced;
pub mod judge;
pub mod motion;
pub mod peaks;
pub mod picture;
pub mod propagation;
pub mod requirement;
pub mod response;
pub mod second_order;
pub mod shapes;
pub mod summary;
pub mod sweep;
mod variables;

use eigentol_contract::scalar;
use eigentol_contract::{
    Any, DampingKind, Description, Excitation, Input, Output, PictureInfo, Role, Shared, SolidInfo,
    SolidKind, Text, Unit,
};
use eigentol_numerics::algebra::Vector;
use eigentol_numerics::{Complex, algebra, eigenproblem};
use eigentol_results::setters;
use eigentol_solve::{
    Behaviour, Equilibrium, Error, Kernels, Mode, Modes, Quantity, Sensitivities, Stability, Watch,
};
use eigentol_solve::{
    arguments, constraints, equilibrium, error, free, kernels, modes, rounding, sensitivity,
};
use eigentol_tolerance::{batched, tolerance};

pub use campbell::Campbell;
