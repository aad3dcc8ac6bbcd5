//! The judge of every number of chance: what distances allow, and what re-solved designs show.
//!
//! A number from a model, such as a first-order standard deviation or the probability beyond a tangent plane, is right
//! where the model is. Two kinds of evidence tell whether it is. *Distances*, in standard deviations, to states where
//! models fail: critical states, beyond which the equilibrium changes branch, the onset of growth, critical damping,
//! other modes. They cost nothing, raise doubts and never prove a number wrong. *Designs solved anew* decide: standard
//! deviations by paired samples ([`summary`](crate::summary)), probabilities by lines of designs ([`Judged`]).
//!
//! # One judge of chance
//!
//! A linear or quadratic model gives a number with an error of integration, never its own. `judge/` therefore has two
//! kinds of evidence, and every door uses them. Distances (`distances.rs`, in standard deviations, to the critical
//! state, the onset of instability, another mode, another branch) belong to the mode they are about and raise doubts;
//! they cannot tell the size of an error, so they never say "wrong". Designs solved anew (`event.rs`) can: a claimed
//! probability is verified if it is within a tenth of what they give, and the largest error that they leave is stated
//! beside it. They lie on lines through the space of designs, along the design points and the ways to instability, and
//! every change between safety and failure on a line is located (`eigentol_statistics::reliability::lines`). A line has
//! no scatter in its own direction: one line settles a single variable, and a thin layer of failure beside a critical
//! state costs what a plane costs. Exploring lines come first, farther out than samples lie and in all directions: they
//! find failures that no design point told of. Importance sampling cannot judge, because it looks where the model
//! points. For the single pendulum in 400 combinations of speed, tolerance and limit, 331 design points were called
//! verified before, of which 143 were wrong, by up to sixty orders of magnitude; now 194 are, all of them right, and
//! lines settle all 400 (`tests/runtime/chance/bar.rs`, against the closed form). It takes 5 ms a combination.

mod answer;
mod cost;
mod distances;
mod event;
mod judged;

pub use crate::tolerance::{Doubt, Measured};
pub use distances::TRUSTED_SIGMA_ERROR;
pub use judged::{DESCRIBED, Judged, Judgement, TRUSTED_PROBABILITY_ERROR, Unjudged};

pub(crate) use answer::{chance, judged, verdict};
pub use cost::{BUDGET, affordable};
pub(crate) use cost::{operations, together};
pub(crate) use distances::{distances, doubts_of_models};
pub(crate) use event::{Distance, Event, Lines};
