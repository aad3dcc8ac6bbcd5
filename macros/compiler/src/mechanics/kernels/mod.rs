//! The generated functions.

mod adjoint;
mod conditions;
mod contract;
mod parameters;
mod picture;
mod whirl;

pub(super) use conditions::{pose_margin, violation};
pub(super) use contract::kernels;
pub(super) use picture::picture;
pub(super) use whirl::whirl;
