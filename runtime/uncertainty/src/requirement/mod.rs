//! Requirements on a design and the probability of failing them under tolerances. [`Requirements::probabilities`] finds
//! it with nothing to choose, in one of three ways:
//!
//! | way | cost | error | refuses |
//! | --- | --- | --- | --- |
//! | design points ([`Requirements::reliability`]) | some designs for each limit | of the tangent planes, by the lines | stability, discrete variables |
//! | lines of designs solved anew ([`judge`](crate::judge)) | some thousand designs | standard error | discrete variables |
//! | plain samples ([`Requirements::chances`]) | samples | confidence interval | nothing |
//!
//! The number is that of the lines or of the samples, whichever is sharper; design points say what changes it.
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
mod reliability;
mod requirements;

pub use chances::{Chances, Tally};
pub use design_point::DesignPoint;
pub use eigentol_statistics::reliability::sampling::{Estimate, Interval};
pub use eigentol_statistics::reliability::{FormSensitivity, FormSettings};
pub use kinds::Requirement;
pub use probability::{EstimatedBy, FailureProbability, Probabilities};
pub use reliability::{LimitReliability, Reliability};
pub use requirements::Requirements;

pub(crate) use chances::chances_of;
pub(crate) use design_point::slopes_at;
pub(crate) use limit_at::LimitAt;
pub(crate) use reliability::{check, judge, out_of_reach, reliability_of};
pub(crate) use requirements::Limit;
