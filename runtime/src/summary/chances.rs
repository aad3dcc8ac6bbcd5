//! What becomes of samples, with its uncertainty.

use eigentol_statistics::reliability::sampling::wilson;

use crate::Error;
use crate::tolerance::{Counts, Outcome};

/// Confidence of the intervals.
const CONFIDENCE: f64 = 0.95;

/// How probable something is, by samples.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Chance {
    /// Samples to which it happened.
    pub count: usize,
    /// Samples that were looked at.
    pub samples: usize,
    /// Lower end of the interval that holds the probability with a confidence of 95 % (Wilson's).
    pub lower: f64,
    /// Upper end.
    pub upper: f64,
}

impl Chance {
    /// Of something that happened to `count` of some samples.
    pub(super) fn new(count: usize, samples: usize) -> Result<Self, Error> {
        let interval = wilson(count as u64, samples as u64, CONFIDENCE)?;
        Ok(Self {
            count,
            samples,
            lower: interval.lower,
            upper: interval.upper,
        })
    }

    /// Share of the samples.
    #[must_use]
    pub fn value(&self) -> f64 {
        self.count as f64 / self.samples as f64
    }
}

/// What became of the samples.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Sampled {
    /// How many were drawn.
    pub samples: usize,
    /// Each outcome.
    pub outcomes: Vec<(Outcome, Chance)>,
    /// Stable ones on another branch of equilibria than the nominal one: beyond a branch point, or in another valley. Of the first
    /// few thousand samples; `None` where the nominal state is not stable, so that there is no branch to stay on.
    pub other_branch: Option<Chance>,
}

impl Sampled {
    pub(super) fn new(counts: &Counts, other_branch: Option<Chance>) -> Result<Self, Error> {
        let samples = counts.total();
        let chance = |outcome| Ok((outcome, Chance::new(counts.of(outcome), samples)?));
        Ok(Self {
            samples,
            outcomes: (Outcome::ALL.into_iter().map(chance)).collect::<Result<_, Error>>()?,
            other_branch,
        })
    }

    /// How probable an outcome is.
    #[must_use]
    pub fn chance(&self, outcome: Outcome) -> Option<Chance> {
        let found = self.outcomes.iter().find(|(own, _)| *own == outcome);
        found.map(|(_, chance)| *chance)
    }
}

/// Whether samples were asked.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Sampling {
    /// They were.
    Done(Sampled),
    /// They would cost more than they may: verdicts rest on distances and the second-order model.
    TooDear {
        /// Operations of the fewest samples that decide anything.
        #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
        operations: f64,
        /// Operations that they may cost.
        #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
        budget: f64,
    },
    /// There is no quantity that varies.
    NotNeeded,
}
