//! The generated functions.

mod adjoint;
mod conditions;
mod contract;
mod held_values;
mod parameters;
mod picture;
mod whirl;

pub(super) use conditions::{pose_margin, violation};
pub(super) use contract::kernels;
pub(super) use held_values::held_values;
pub(super) use picture::picture;
pub(super) use whirl::whirl;
