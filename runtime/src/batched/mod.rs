//! Several states side by side in the vectors of the processor: what follows an input does with neighbouring values, and
//! what samples a design with its samples. Every lane is checked; what fails a check goes to the solvers for one state.
#![allow(
    clippy::needless_range_loop,
    reason = "rows and columns of several matrices"
)]

mod advance;
pub(crate) mod algebra;
mod block;
pub(crate) mod closed;
mod complex;
mod continuity;
pub(crate) mod general;
mod newton;
mod reading;
pub(crate) mod room;
mod slopes;
mod state;

pub(crate) use advance::Workspace;
pub(crate) use block::{Block, KERNELS, POSITIVE, possible};
