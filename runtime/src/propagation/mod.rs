//! How tolerances spread any responses, several at once with their covariance: quantities of modes, outputs, critical values of an
//! input.
//!
//! | method | what it takes | what it gives |
//! | --- | --- | --- |
//! | [`sampled`] | some thousand designs, whatever the distribution and the response | everything, failures counted |
//! | [`controlled`] | random samples beside the Taylor model | mean and sigma, worth many plain samples |
//! | [`quadrature`] | few designs while few variables vary | mean, sigma, skewness, covariance |
//! | [`first_order`], [`second_order`] | derivatives at the nominal design | everything, of the model; how far it holds |
//! | [`worst_case`] | some corners of the box of limits | least and greatest value |
//!
//! [`propagate`] chooses by what may be spent, [`influence`] tells which variables the scatter comes from.

mod choice;
mod control;
mod expansion;
mod gather;
mod influence;
mod limits;
mod model;
mod moments;
mod quadrature;
mod result;
mod sampled;
mod sampler;
mod space;
mod taylor;
mod worst_case;

pub use choice::{Effort, propagate};
pub use control::{Controlled, ControlledSpread, controlled};
/// An index of influence and its confidence interval, from [`eigentol_statistics`].
pub use eigentol_statistics::sensitivity::Estimate;
pub use influence::{Influence, ResponseInfluence, VariableInfluence, influence};
pub use quadrature::quadrature;
pub use result::{Estimated, Method, Propagation, QUANTILES, Quantile, ResponseSpread};
pub use sampled::{Samples, sampled};
pub use sampler::{Points, Sampler};
pub use taylor::{first_order, second_order};
pub use worst_case::{Extreme, MissingCorner, ResponseLimits, WorstCase, worst_case};
