//! Several states side by side with vector instructions: neighbouring values in a sweep along an input, or samples of a
//! design. Every lane is checked; lanes that fail a check are passed to the solvers for one state.
//!
//! # Sweeps side by side
//!
//! Where the path shows the way, the next eight values of a sweep are solved in vectors (`batched`, `sweep/driver.rs`):
//! Newton's method from the polynomial through the last five states (behind the first one, from its tangent), modes in the
//! basis of the last ones, derivatives as for one state. A lane counts when it is at rest to rounding, a clear minimum, near the parabola
//! through the three states before it, each mode recognised and apart from the others. States are accepted up to the
//! first lane that fails; the scalar solver continues from there. Points are shown to a function and overwritten,
//! because allocating results of this size costs more than computing them.
#![allow(clippy::needless_range_loop, reason = "rows and columns of several matrices")]

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
