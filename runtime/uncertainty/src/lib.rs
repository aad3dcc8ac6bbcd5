//! What tolerances make of any response of a mechanism: how far it spreads, whether requirements are met, which tolerances
//! are the cheapest that meet them, and which of these numbers can be trusted.
//!
//! An internal part of `eigentol`, which re-exports what its users need. It promises nothing to others.

pub mod allocation;
pub mod bode;
mod deviations;
pub mod judge;
pub mod propagation;
pub mod requirement;
pub mod summary;

use eigentol_analysis::{along, clusters, forced, quadratic, response, second_order, sweep};
use eigentol_contract::{Description, Input, Shared, Text, Unit};
use eigentol_numerics::algebra::Vector;
use eigentol_numerics::{Complex, algebra};
use eigentol_solve::{Behaviour, Equilibrium, Error, Mode, Modes, Quantity, Watch};
use eigentol_solve::{arguments, equilibrium, kernels, modes, sensitivity};
use eigentol_tolerance::tolerance;
