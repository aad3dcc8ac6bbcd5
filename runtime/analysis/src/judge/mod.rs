//! The judge of every number of chance: what distances allow, and what re-solved designs show.
//!
//! A number from a model, such as a first-order standard deviation or the probability beyond a tangent plane, is right
//! where the model is. Two kinds of evidence tell whether it is. *Distances*, in standard deviations, to states where
//! models fail: critical states, beyond which the equilibrium changes branch, the onset of growth, critical damping,
//! other modes. They cost nothing, raise doubts and never prove a number wrong. *Designs solved anew* decide: standard
//! deviations by paired samples ([`summary`](crate::summary)), probabilities by lines of designs ([`Judged`]).

mod cost;
mod distances;
mod event;
mod judged;

pub use crate::tolerance::{Doubt, Measured};
pub use distances::TRUSTED_SIGMA_ERROR;
pub use judged::{Judged, Judgement, TRUSTED_PROBABILITY_ERROR, Unjudged};

pub use cost::BUDGET;
pub(crate) use cost::{operations, together};
pub(crate) use distances::{distances, doubts_of_models};
pub(crate) use event::{Event, Lines};
