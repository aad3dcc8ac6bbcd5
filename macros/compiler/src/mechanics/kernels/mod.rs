//! The generated functions.
//!
//! # Explicit partials are written out only for small mechanisms
//!
//! Their number grows with the cube of the size. Beyond `Limits::explicit_partials` entries or
//! `Limits::partial_operations` the trait's own method takes them one direction at a time from `linear_along`; large
//! mechanisms run on the adjoint anyway. `motion_linear` grows only with the square, and slowly for trees of many
//! branches; its limit is an operation count, so a walking robot of 32 joints has it.

mod adjoint;
mod conditions;
mod contract;
mod forced;
mod held_values;
mod parameters;
mod picture;
mod spans;
mod whirl;

pub(super) use conditions::{pose_margin, violation};
pub(super) use contract::kernels;
pub(super) use forced::{Excitations, forced};
pub(super) use held_values::held_values;
pub(super) use picture::picture;
pub(super) use spans::spans;
pub(super) use whirl::whirl;
