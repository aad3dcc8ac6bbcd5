//! Outcomes of samples.

use eigentol_statistics::summary::Partial;

use crate::Stability;
use crate::equilibrium::Failure;

/// The outcome of one sample.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Outcome {
    /// A stable equilibrium, or one that is marginal, held by gyroscopic forces, or free in some directions.
    Stable,
    /// An equilibrium that is unstable without oscillation.
    Divergent,
    /// An equilibrium that is unstable in a growing oscillation.
    Flutter,
    /// An equilibrium whose stability could not be decided.
    Undecided,
    /// No equilibrium was found.
    NoEquilibrium,
    /// The constraints cannot be met: the loops do not close.
    NotAssembled,
    /// The design describes bodies that cannot exist, lies outside the domain of an expression, or bends a beam too far.
    Unphysical,
    /// The eigenproblem could not be solved.
    NoModes,
}

impl Outcome {
    /// All outcomes.
    pub const ALL: [Self; 8] = [
        Self::Stable,
        Self::Divergent,
        Self::Flutter,
        Self::Undecided,
        Self::NoEquilibrium,
        Self::NotAssembled,
        Self::Unphysical,
        Self::NoModes,
    ];

    /// The outcome in words, as tables name it.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Stable => "stable",
            Self::Divergent => "divergent",
            Self::Flutter => "flutter",
            Self::Undecided => "undecided",
            Self::NoEquilibrium => "no equilibrium",
            Self::NotAssembled => "not assembled",
            Self::Unphysical => "unphysical",
            Self::NoModes => "no modes",
        }
    }

    /// Whether the design certainly has no stable equilibrium, or none was found.
    #[doc(hidden)]
    pub fn lost(self) -> bool {
        matches!(self, Self::Divergent | Self::Flutter | Self::NoEquilibrium | Self::NotAssembled)
    }
}

impl From<&Failure> for Outcome {
    fn from(failure: &Failure) -> Self {
        match failure {
            Failure::NotFound { .. } | Failure::Unbalanced { .. } | Failure::Held { .. } => Self::NoEquilibrium,
            Failure::NotAssembled { .. } => Self::NotAssembled,
            Failure::OutsideDomain { .. } | Failure::SingularMass(_) | Failure::BentTooFar(_) => Self::Unphysical,
            Failure::Mode { .. } => Self::NoModes,
        }
    }
}

impl From<Stability> for Outcome {
    fn from(stability: Stability) -> Self {
        match stability {
            Stability::Divergent { .. } => Self::Divergent,
            Stability::Flutter { .. } => Self::Flutter,
            Stability::Undecided => Self::Undecided,
            _ => Self::Stable,
        }
    }
}

/// The number of samples with each outcome; they sum to the number of samples.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Counts {
    /// [`Outcome::Stable`].
    pub stable: usize,
    /// [`Outcome::Divergent`].
    pub divergent: usize,
    /// [`Outcome::Flutter`].
    pub flutter: usize,
    /// [`Outcome::Undecided`].
    pub undecided: usize,
    /// [`Outcome::NoEquilibrium`].
    pub no_equilibrium: usize,
    /// [`Outcome::NotAssembled`].
    pub not_assembled: usize,
    /// [`Outcome::Unphysical`].
    pub unphysical: usize,
    /// [`Outcome::NoModes`].
    pub no_modes: usize,
}

impl Counts {
    /// Sum over all outcomes.
    #[must_use]
    pub fn total(&self) -> usize {
        Outcome::ALL.map(|outcome| self.of(outcome)).iter().sum()
    }

    /// Counts from numbers in the order of [`Outcome::ALL`].
    fn of_all(numbers: &[u64]) -> Self {
        let mut counts = Self::default();
        for (outcome, number) in Outcome::ALL.into_iter().zip(numbers) {
            counts.add(outcome, *number as usize);
        }
        counts
    }

    /// The sum over parts that count outcomes in this order.
    #[doc(hidden)]
    pub fn of_parts(parts: &[Partial]) -> Self {
        let mut counts = Self::default();
        for part in parts {
            counts.merge(&Self::of_all(part.outcomes()));
        }
        counts
    }

    /// The number of samples with this outcome.
    #[must_use]
    pub fn of(mut self, outcome: Outcome) -> usize {
        *self.place(outcome)
    }

    #[doc(hidden)]
    pub fn add(&mut self, outcome: Outcome, number: usize) {
        *self.place(outcome) += number;
    }

    fn place(&mut self, outcome: Outcome) -> &mut usize {
        match outcome {
            Outcome::Stable => &mut self.stable,
            Outcome::Divergent => &mut self.divergent,
            Outcome::Flutter => &mut self.flutter,
            Outcome::Undecided => &mut self.undecided,
            Outcome::NoEquilibrium => &mut self.no_equilibrium,
            Outcome::NotAssembled => &mut self.not_assembled,
            Outcome::Unphysical => &mut self.unphysical,
            Outcome::NoModes => &mut self.no_modes,
        }
    }

    #[doc(hidden)]
    pub fn merge(&mut self, other: &Self) {
        for outcome in Outcome::ALL {
            self.add(outcome, other.of(outcome));
        }
    }
}
