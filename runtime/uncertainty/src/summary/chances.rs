//! Outcomes of samples, with their uncertainty.

use eigentol_statistics::reliability::sampling::wilson;

use crate::Error;
use crate::tolerance::{Counts, Outcome};

/// Confidence of the intervals.
const CONFIDENCE: f64 = 0.95;

/// A probability estimated from samples.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Chance {
    /// Number of samples with the event.
    pub count: usize,
    /// Number of samples examined.
    pub samples: usize,
    /// Lower end of the 95 % Wilson confidence interval of the probability.
    pub lower: f64,
    /// Upper end of the interval.
    pub upper: f64,
}

impl Chance {
    /// The probability of an event that occurred in `count` of `samples` samples.
    pub(super) fn new(count: usize, samples: usize) -> Result<Self, Error> {
        let interval = wilson(count as u64, samples as u64, CONFIDENCE)?;
        Ok(Self { count, samples, lower: interval.lower, upper: interval.upper })
    }

    /// Fraction of the samples with the event.
    #[must_use]
    pub fn value(&self) -> f64 {
        self.count as f64 / self.samples as f64
    }
}

/// The outcomes of the samples.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Sampled {
    /// Number of samples drawn.
    pub samples: usize,
    /// Probability of each outcome.
    pub outcomes: Vec<(Outcome, Chance)>,
    /// Stable samples on a branch of equilibria other than the nominal one: beyond a branch point, or in another
    /// valley. `None` if the nominal state is not stable, so that there is no branch to stay on.
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

    /// Probability of an outcome.
    #[must_use]
    pub fn chance(&self, outcome: Outcome) -> Option<Chance> {
        self.outcomes.iter().find(|(x, _)| *x == outcome).map(|(_, chance)| *chance)
    }
}

/// Whether samples were drawn.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Sampling {
    /// Samples were drawn.
    Done(Sampled),
    /// Samples would exceed the budget: verdicts are based on distances and the second-order model.
    TooDear {
        /// Operations of the smallest decisive number of samples.
        #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
        operations: f64,
        /// Operations allowed.
        #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
        budget: f64,
    },
    /// No quantity varies, or samples could check none.
    NotNeeded,
}
