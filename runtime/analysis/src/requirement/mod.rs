//! Requirements on a design and the probability of failing them under tolerances. [`Requirements::probabilities`] finds
//! it with nothing to choose. Behind it stand samples, design points in standard normal space, samples about these
//! points where failure is rare, and the judge of them all: lines of designs solved anew ([`judge`](crate::judge)).
//!
//! First-order reliability (A. M. Hasofer and N. C. Lind, *Exact and invariant second-moment code format*, J. Eng.
//! Mech. 1974) finds the most probable design that just fails, with exact total derivatives of the responses
//! ([`Responses`](crate::response::Responses)). The methods themselves are those of
//! [`eigentol_statistics::reliability`].

mod answers;
mod chances;
mod design_point;
mod kinds;
mod probability;
mod rare;
mod reliability;
mod requirements;

pub use chances::{Chances, Tally};
pub use design_point::DesignPoint;
pub use eigentol_statistics::reliability::sampling::{
    Estimate, Interval, SampledProbability, SamplingSettings,
};
pub use eigentol_statistics::reliability::{FormSensitivity, FormSettings};
pub use kinds::Requirement;
pub use probability::{FailureProbability, Found, Probabilities};
pub use rare::RareFailure;
pub use reliability::{LimitReliability, Reliability, SystemFailure};
pub use requirements::{Limit, Requirements};

pub use crate::limits::Edge;

pub(crate) use chances::chances_of;
pub(crate) use design_point::slopes_at;
pub(crate) use reliability::{check, judge, out_of_reach, reliability_of};
