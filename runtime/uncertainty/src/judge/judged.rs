//! What re-solved designs say about a probability.

use eigentol_statistics::normal;
use eigentol_statistics::reliability::lines::LineProbability;
use eigentol_statistics::reliability::sampling::{Estimate, Interval};

/// A probability from a model is trusted if it is within this fraction of the true one.
pub const TRUSTED_PROBABILITY_ERROR: f64 = 0.1;

/// Tangent planes describe where failure is if they give no more than this many times its probability, and no less than
/// this part of it.
pub const DESCRIBED: f64 = 2.0;

/// Standard errors that cover the true value in 95 of 100 cases.
const COVERING: f64 = 1.96;

/// A probability found by solving designs anew: along lines through the space of designs, on which every change between
/// safety and failure is located ([line sampling](eigentol_statistics::reliability::lines)). It holds for any response,
/// across critical states and branches.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Judged {
    /// The probability; without scatter if a single variable matters.
    pub probability: Estimate,
    /// Probability that a design lacks the response needed to tell; such designs do not count for the probability.
    pub untold: Estimate,
    /// Probability of the designs beyond the ends of the lines.
    pub unseen: f64,
    /// Whether enough lines or samples contribute to the probability for its standard error to be meaningful.
    pub settled: bool,
    /// Number of lines; none if plain samples tell more.
    pub lines: u64,
    /// Number of designs solved.
    pub designs: u64,
}

impl Judged {
    /// From lines that reach this many standard deviations to either side.
    pub(super) fn new(line_probability: &LineProbability, reach: f64) -> Self {
        Self {
            probability: line_probability.probability,
            untold: line_probability.without_value,
            unseen: 2.0 * normal::cdf(-reach),
            settled: line_probability.settled,
            lines: line_probability.lines,
            designs: line_probability.evaluations,
        }
    }

    /// Of one of two events that exclude each other.
    pub(crate) fn or(&self, other: &Self) -> Self {
        let [a, b] = [self.probability, other.probability];
        let untold = if self.untold.value > other.untold.value { self.untold } else { other.untold };
        Self {
            probability: Estimate {
                value: (a.value + b.value).min(1.0),
                standard_error: a.standard_error + b.standard_error,
            },
            untold,
            unseen: self.unseen + other.unseen,
            settled: self.settled && other.settled,
            lines: self.lines + other.lines,
            designs: self.designs + other.designs,
        }
    }

    /// 95 % confidence interval of the probability.
    #[must_use]
    pub fn interval(&self) -> Interval {
        let Estimate { value, standard_error } = self.probability;
        let half = COVERING * standard_error;
        Interval { lower: (value - half).max(0.0), upper: (value + half + self.unseen).min(1.0) }
    }

    /// The largest error that a claimed probability may have, given the interval.
    #[must_use]
    pub fn error_of(&self, claimed: f64) -> f64 {
        let Interval { lower, upper } = self.interval();
        (claimed - lower).abs().max((claimed - upper).abs())
    }

    /// Whether the model behind a claimed probability looks where failure is: the claim is within a factor of
    /// [`DESCRIBED`] of a probability in the interval, so that at most its curvature is missing.
    #[must_use]
    pub fn agrees(&self, claimed: f64) -> bool {
        let Interval { lower, upper } = self.interval();
        self.settled && (lower / DESCRIBED..=upper * DESCRIBED).contains(&claimed)
    }

    /// Whether a claimed probability is within [`TRUSTED_PROBABILITY_ERROR`] of the true one.
    #[must_use]
    pub fn confirms(&self, claimed: f64) -> bool {
        self.settled && self.error_of(claimed) <= TRUSTED_PROBABILITY_ERROR * self.interval().lower
    }
}

/// Whether a probability was judged.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Judgement {
    /// Designs were solved anew.
    Judged(Judged),
    /// None were, for this reason: the error of the model is not known.
    Open(Unjudged),
}

/// Why a probability was not judged.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Unjudged {
    /// The designs of the fewest lines would exceed the budget.
    TooDear {
        /// Operations that they take.
        #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
        operations: f64,
        /// Operations allowed.
        #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
        budget: f64,
    },
    /// A variable takes discrete values, between which lines could miss some: sample plainly.
    Discrete,
    /// Nothing varies.
    Still,
    /// No judgement was asked for.
    NotAsked,
}

impl Judgement {
    /// The probability found, if any.
    #[must_use]
    pub fn judged(&self) -> Option<&Judged> {
        match self {
            Self::Judged(judged) => Some(judged),
            Self::Open(_) => None,
        }
    }

    /// Whether designs were solved anew and agree with a claimed probability ([`Judged::agrees`]).
    #[must_use]
    pub fn agrees(&self, claimed: f64) -> bool {
        self.judged().is_some_and(|x| x.agrees(claimed))
    }

    /// Whether a claimed probability was confirmed ([`Judged::confirms`]).
    #[must_use]
    pub fn confirms(&self, claimed: f64) -> bool {
        self.judged().is_some_and(|x| x.confirms(claimed))
    }
}
