//! Requirements on a design and the probability of failing them under tolerances. [`Requirements::probabilities`] finds
//! it with nothing to choose. Behind it stand four methods, each with an error of its own and a refusal where it cannot
//! answer, and the judge of them all: lines of designs solved anew ([`judge`](crate::judge)).
//!
//! | method | cost | error | refuses |
//! | --- | --- | --- | --- |
//! | [`second_order_failure`] | derivatives at the nominal design | of the model, by the judge | stability, what has no second derivatives |
//! | [`Requirements::reliability`] | some designs for each limit | of the model, by the judge | stability, discrete variables |
//! | [`Requirements::rare_failure`] | samples about the design points | standard error | requirements without a design point |
//! | [`Requirements::chances`] | samples | confidence interval | nothing |
//!
//! First-order reliability (A. M. Hasofer and N. C. Lind, *Exact and invariant second-moment code format*, J. Eng.
//! Mech. 1974) finds the most probable design that just fails, with exact total derivatives of the responses
//! ([`Responses`](crate::response::Responses)). The methods themselves are those of
//! [`eigentol_statistics::reliability`].

mod answers;
mod chances;
mod design_point;
mod kinds;
mod limit_at;
mod probability;
mod rare;
mod reliability;
mod requirements;
mod second_order;

pub use chances::{Chances, Tally};
pub use design_point::DesignPoint;
pub use eigentol_statistics::reliability::sampling::{Estimate, Interval, SampledProbability};
pub use eigentol_statistics::reliability::{FormSensitivity, FormSettings};
pub use kinds::Requirement;
pub use probability::{EstimatedBy, FailureProbability, Probabilities};
pub use rare::RareFailure;
pub use reliability::{LimitReliability, Reliability, SystemFailure};
pub use requirements::Requirements;
pub use second_order::{SecondOrderFailure, second_order_failure};

pub(crate) use chances::chances_of;
pub(crate) use design_point::slopes_at;
pub(crate) use limit_at::LimitAt;
pub(crate) use reliability::{check, judge, out_of_reach, reliability_of};
pub(crate) use requirements::Limit;
