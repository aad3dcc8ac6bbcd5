//! Monte Carlo with vector instructions: several samples go through the same arithmetic side by side, and several
//! batches of them go through each stage together.
//!
//! Every sample is checked: that Newton's method came to rest; that the equilibrium continues the nominal one, and is a
//! minimum with a margin if there is a potential; that damped modes decay; and that each mode is clearly the nominal
//! one. A sample that fails a check is passed to the solvers for one state, which decide its outcome. Accepted samples
//! have the equilibrium and eigenvalues of those solvers up to rounding, and do not depend on the processor or on the
//! samples beside them.
#![allow(
    clippy::needless_range_loop,
    reason = "rows and columns of several matrices"
)]

mod equilibrium;
mod modes;
mod nominal;
mod prepared;
mod samples;
mod solve;
mod stages;
mod statics;
mod taylor_model;

pub(super) use prepared::Prepared;
#[doc(hidden)]
pub use prepared::possible;
pub(super) use samples::{Memory, Size, Solved};
pub(super) use solve::TOGETHER;
use taylor_model::TaylorModel;
