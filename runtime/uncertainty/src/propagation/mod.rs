//! Propagation of tolerances to any responses, several at once with their covariance: quantities of modes, outputs,
//! critical values of an input.
//!
//! | method | cost | result |
//! | --- | --- | --- |
//! | [`sampled`] | a few thousand designs, for any distribution and response | everything, including failure counts |
//! | [`vibrations`] | samples of a model of forced vibration that stays right at a resonance | everything, for the model |
//! | [`first_order`], [`second_order`] | derivatives at the nominal design | everything, for the model; an estimate of its error |
//! | [`worst_case`] | some corners of the box of limits | smallest and largest value |
//!
//! [`propagate`] chooses a method by the number of solutions allowed; [`influence`] attributes the scatter to the
//! variables.

mod answers;
mod choice;
mod expansion;
mod gather;
mod influence;
mod limits;
mod model;
mod moments;
mod result;
mod sampled;
mod space;
mod taylor;
mod vibrations;
mod worst_case;

pub use choice::{SOLUTIONS, propagate};
/// An index of influence and its confidence interval, from [`eigentol_statistics`].
pub use eigentol_statistics::sensitivity::Estimate;
pub use influence::{Influence, ResponseInfluence, VariableInfluence, influence};
pub use result::{Estimated, Method, Propagation, QUANTILES, Quantile, ResponseSpread};
pub use sampled::{Samples, sampled};
pub use taylor::{first_order, second_order};
pub use vibrations::{VibrationCheck, vibrations};
pub use worst_case::{Extreme, MissingCorner, ResponseLimits, WorstCase, worst_case};
