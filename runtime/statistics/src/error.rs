//! Errors.

use crate::reliability::Closest;

/// A constant of the program. The alias keeps serde from borrowing it from the input.
type Word = &'static str;

/// The reason why there is no result.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Error {
    /// An argument or setting is invalid.
    #[error("{setting}: {reason}")]
    Setting {
        /// The setting.
        #[cfg_attr(feature = "serde", serde(with = "crate::serial::word"))]
        setting: Word,
        /// The reason.
        reason: String,
    },
    /// Two lists that belong together differ in length.
    #[error("{found} {kind}, expected {expected}")]
    WrongLength {
        /// The kind of list.
        #[cfg_attr(feature = "serde", serde(with = "crate::serial::word"))]
        kind: Word,
        /// Its length.
        found: usize,
        /// The expected length.
        expected: usize,
    },
    /// There is no element with this index.
    #[error("there is no {kind} {index}: they are numbered from 0, and there are {number}")]
    BeyondLast {
        /// The kind of element.
        #[cfg_attr(feature = "serde", serde(with = "crate::serial::word"))]
        kind: Word,
        /// The index requested.
        index: u64,
        /// The number of elements.
        number: u64,
    },
    /// A number is not finite, or became so in the computation.
    #[error("{kind} is not finite")]
    NotFinite {
        /// The quantity.
        #[cfg_attr(feature = "serde", serde(with = "crate::serial::word"))]
        kind: Word,
    },
    /// There are too few of something.
    #[error("{found} {kind}, at least {needed} are needed")]
    TooFew {
        /// The kind of item.
        #[cfg_attr(feature = "serde", serde(with = "crate::serial::word"))]
        kind: Word,
        /// The number available.
        found: usize,
        /// The number needed.
        needed: usize,
    },
    /// A quantity that should vary is constant.
    #[error("{what} never varies: leave it out, or sample it over a range")]
    Constant {
        /// The quantity.
        what: String,
    },
    /// An input is a linear function of the preceding ones.
    #[error("input {input} is a linear function of those before it: leave one of them out")]
    Dependent {
        /// Index of the input.
        input: usize,
    },
    /// Samples were added twice.
    #[error(
        "samples {start} to below {end} have been added already; split the samples into ranges that do not overlap"
    )]
    Overlap {
        /// The first sample that is duplicated.
        start: u64,
        /// The first one after it that is not.
        end: u64,
    },
    /// Partial results were gathered by different plans.
    #[error("these samples were gathered by different plans; use clones of the same plan for all of them")]
    OtherPlan,
    /// A quantity of a sample is not a number, or too large to compute with.
    #[error("quantity {quantity} of sample {sample} is {value}; leave it out (`None`) where a sample does not have it")]
    Value {
        /// Index of the quantity.
        quantity: usize,
        /// Index of the sample.
        sample: u64,
        /// Its value, as text.
        value: String,
    },
    /// There are no values, so nothing can be said about them.
    #[error("no values: add samples first")]
    NoValues,
    /// A limit state has no value where one is needed.
    #[error("the limit state has no value {place}: {reason}")]
    NoLimitValue {
        /// The place.
        #[cfg_attr(feature = "serde", serde(with = "crate::serial::word"))]
        place: Word,
        /// The reason given by the limit state.
        reason: String,
    },
    /// No start of the search led to a point on the limit that is nearest to the origin. Either nothing fails within
    /// reach, or the limit state is not smooth enough; a looser tolerance, more restarts or sampling may then help.
    #[error("no design point within {radius} standard deviations: {closest}")]
    NoDesignPoint {
        /// Distance from the origin to which the search went.
        radius: f64,
        /// The best point found.
        closest: Box<Closest>,
    },
}

impl Error {
    /// An invalid setting.
    #[doc(hidden)]
    pub fn setting(setting: Word, reason: impl Into<String>) -> Self {
        Self::Setting { setting, reason: reason.into() }
    }
}
