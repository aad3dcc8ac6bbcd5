//! The cheapest tolerances that meet requirements, and nominal values with them if these may move.
//!
//! Minimised is the sum of a cost of each half-width (K. W. Chase and W. H. Greenwood, *Design issues in mechanical tolerance
//! analysis*, Manufacturing Review 1988), so that each requirement fails with at most the allowed probability, to first order in
//! standard normal space ([`requirement`](crate::requirement)), by sequential quadratic programming on exact derivatives. What is
//! found is then sampled.

mod choices;
mod cost;
mod problem;
mod search;

pub use choices::{Choices, HalfWidth, Nominal};
pub use cost::Cost;
pub use search::{Allocation, allocate};
