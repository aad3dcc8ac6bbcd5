//! Loads due to force elements and constraints.

mod applied;
mod closure;
mod constraints;
mod distributed;
mod force_context;
mod forces;
mod pair;
mod perpendiculars;
mod rolling;
mod slip_axes;
mod strain;
mod strained_at;
mod transmitted;

pub(super) use constraints::{constraint_rows, held};
pub(super) use force_context::ForceContext;
pub(super) use forces::exerted;
pub(super) use strain::{bent_at, elastic_energy, strain_power, strained};
pub(super) use strained_at::strained_at;
pub(super) use transmitted::transmitted;
