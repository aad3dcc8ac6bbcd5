//! Monte Carlo with vector instructions: several samples go through the same arithmetic side by side, and several
//! batches of them go through each stage together.
//!
//! Every sample is checked: that Newton's method came to rest; that the equilibrium continues the nominal one, and is a
//! minimum with a margin if there is a potential; that damped modes decay; and that each mode is clearly the nominal
//! one. A sample that fails a check is passed to the solvers for one state, which decide its outcome. Accepted samples
//! have the equilibrium and eigenvalues of those solvers up to rounding, and do not depend on the processor or on the
//! other samples of the batch.
//!
//! # Monte Carlo side by side
//!
//! A sample (`tolerance/batched`) starts at the equilibrium that first and second derivatives predict and takes Newton
//! steps: with the curvature of the residual where forces have a potential, with the stiffness in units of the nominal
//! one where they have none or where constraints add reactions. Undamped modes of open mechanisms come from a pencil
//! that is nearly diagonal in the basis of the nominal modes; all others, including the bordered pencil of closed
//! loops, from inverse iteration that starts with the nominal pairs and reuses their order of pivots without a search
//! (`batched/general.rs`).
//!
//! Every sample is checked: the state is at rest, the stiffness is positive definite or near the nominal one, each
//! residual is within rounding, all eigenvalues are apart by more than their errors and decay where they are damped,
//! and every mode resembles its own nominal one more than any other. Samples that fail go to the solvers for one state,
//! so outcomes are decided in one place. Accepted samples equal the results of these solvers to 1e-9 or better: every
//! machine of the corpus and every loop is compared, and 800,000 random pencils. Where rounding in the pencil itself
//! may move an eigenvalue farther, they agree within the errors of both, at most 1e-6 for the sample in vectors:
//! 320,000 pencils in skew coordinates are compared, of which 60,000 are accepted with errors beyond 1e-9. Code is
//! compiled for 4, 8 and 16 unknowns, because unused room costs more than the arithmetic: the rotor takes 1.1 us a
//! sample with room for 4, 1.7 with 8, 5.2 with 16, and 9.2 one by one.
//!
//! # Several batches through one stage
//!
//! A Monte Carlo sample is a long chain of dependent operations. Several batches therefore pass each stage together
//! (design, prediction, steps, matrices, modes), one stage writing what the next reads: while one batch waits, the
//! processor works on its neighbours.
#![allow(clippy::needless_range_loop, reason = "rows and columns of several matrices")]

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
pub(super) use samples::{Memory, SampleBatch, Size};
pub(super) use solve::TOGETHER;
use taylor_model::TaylorModel;
