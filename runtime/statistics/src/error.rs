//! Everything that can go wrong.

use crate::reliability::Closest;

/// A constant of the program. By this name serde does not look for it in what is read.
type Word = &'static str;

/// Why there is no answer.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Error {
    /// An argument or a setting makes no sense.
    #[error("{setting}: {reason}")]
    Setting {
        /// Which one.
        #[cfg_attr(feature = "serde", serde(with = "crate::serial::word"))]
        setting: Word,
        /// What is wrong with it.
        reason: String,
    },
    /// Two lists that belong together differ in length.
    #[error("{found} {kind}, expected {expected}")]
    WrongLength {
        /// What they are.
        #[cfg_attr(feature = "serde", serde(with = "crate::serial::word"))]
        kind: Word,
        /// How many there are.
        found: usize,
        /// How many there should be.
        expected: usize,
    },
    /// There is no element of this number.
    #[error("there is no {kind} {index}: they are numbered from 0, and there are {number}")]
    BeyondLast {
        /// What is counted.
        #[cfg_attr(feature = "serde", serde(with = "crate::serial::word"))]
        kind: Word,
        /// The number that was asked for.
        index: u64,
        /// How many there are.
        number: u64,
    },
    /// A number is not finite, or has become so.
    #[error("{kind} is not finite")]
    NotFinite {
        /// What it is.
        #[cfg_attr(feature = "serde", serde(with = "crate::serial::word"))]
        kind: Word,
    },
    /// There are not enough of something.
    #[error("{found} {kind}, at least {needed} are needed")]
    TooFew {
        /// Of what.
        #[cfg_attr(feature = "serde", serde(with = "crate::serial::word"))]
        kind: Word,
        /// How many there are.
        found: usize,
        /// How many are needed.
        needed: usize,
    },
    /// Something that should vary does not.
    #[error("{what} never varies: leave it out, or sample it over a range")]
    Constant {
        /// What it is.
        what: String,
    },
    /// An input is a linear function of those before it.
    #[error("input {input} is a linear function of those before it: leave one of them out")]
    Dependent {
        /// Which one.
        input: usize,
    },
    /// Samples were to be added twice.
    #[error(
        "samples {start} to below {end} have been added already; split the samples into ranges that do not overlap"
    )]
    Overlap {
        /// The first that is there twice.
        start: u64,
        /// The first after it that is not.
        end: u64,
    },
    /// Partial results were gathered by different plans.
    #[error(
        "these samples were gathered by different plans; use clones of the same plan for all of them"
    )]
    OtherPlan,
    /// A quantity of a sample is not a number, or too large to compute with.
    #[error(
        "quantity {quantity} of sample {sample} is {value}; leave it out (`None`) where a sample does not have it"
    )]
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
    /// A limit state has no value where it must have one.
    #[error("the limit state has no value {place}: {reason}")]
    NoLimitValue {
        /// Where.
        #[cfg_attr(feature = "serde", serde(with = "crate::serial::word"))]
        place: Word,
        /// What the limit state said.
        reason: String,
    },
    /// No start of the search led to a point on the limit that is nearest to the origin. Either nothing fails within reach,
    /// or the limit state is not smooth enough; then a looser tolerance or more restarts may help, or sampling.
    #[error("no design point within {radius} standard deviations: {closest}")]
    NoDesignPoint {
        /// How far from the origin the search went.
        radius: f64,
        /// The best point that was found.
        closest: Box<Closest>,
    },
    /// A formula of second order does not hold because the limit curves around the origin too much: `1 + hazard * curvature`
    /// is not positive. Use importance sampling, or look for further design points.
    #[error("{formula}: no value for curvature {curvature} at beta = {beta}")]
    Curvature {
        /// Whose formula.
        #[cfg_attr(feature = "serde", serde(with = "crate::serial::word"))]
        formula: Word,
        /// The principal curvature at fault, in 1.
        #[cfg_attr(feature = "serde", serde(with = "crate::serial::exact"))]
        curvature: f64,
        /// The reliability index.
        #[cfg_attr(feature = "serde", serde(with = "crate::serial::exact"))]
        beta: f64,
    },
}
