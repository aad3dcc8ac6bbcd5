//! The cheapest tolerances that meet requirements, optionally with free nominal values.
//!
//! The sum of the costs of the half-widths is minimised (K. W. Chase and W. H. Greenwood, *Design issues in mechanical
//! tolerance analysis*, Manufacturing Review 1988), subject to a maximum failure probability of each requirement, to
//! first order in standard normal space ([`requirement`](crate::requirement)). The method is sequential quadratic
//! programming on exact derivatives. The result is then checked by sampling.

mod answer;
mod choices;
mod cost;
mod problem;
mod search;

pub use choices::{Choices, HalfWidth, Nominal};
pub use cost::Cost;
pub use search::{Allocation, allocate};
