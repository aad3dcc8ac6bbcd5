//! Several states side by side with vector instructions: neighbouring values in a sweep along an input, or samples of a
//! design. Every lane is checked; lanes that fail a check are passed to the solvers for one state.
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

pub use advance::Workspace;
pub use block::{Block, KERNELS, POSITIVE, possible};
