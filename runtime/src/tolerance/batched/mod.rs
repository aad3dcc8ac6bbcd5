//! Monte Carlo in the vectors of the processor: several samples side by side through the same arithmetic, several batches of
//! them through one stage after the other.
//!
//! Every sample is checked: that Newton's method came to rest, that the equilibrium is the one that the nominal equilibrium
//! has become, a minimum with a margin where there is a potential, that damped modes decay, and that each mode is clearly the
//! nominal one. A sample that fails a check goes to the solvers for one state, so that what becomes of it is decided there.
//! Accepted samples have the equilibrium and eigenvalues of those solvers up to rounding, and do not depend on the processor
//! or on the samples beside them.
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
pub(crate) use prepared::possible;
pub(super) use samples::{Memory, Size, Solved};
pub(super) use solve::TOGETHER;
use taylor_model::TaylorModel;
