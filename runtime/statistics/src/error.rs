//! Everything that can go wrong.

/// Why there is no answer.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// An argument or a setting makes no sense.
    #[error("{setting}: {reason}")]
    Setting {
        /// Which one.
        setting: &'static str,
        /// What is wrong with it.
        reason: String,
    },
    /// Two lists that belong together differ in length.
    #[error("{found} {kind}, expected {expected}")]
    WrongLength {
        /// What they are.
        kind: &'static str,
        /// How many there are.
        found: usize,
        /// How many there should be.
        expected: usize,
    },
    /// There is no element of this number.
    #[error("there is no {kind} {index}: they are numbered from 0, and there are {number}")]
    BeyondLast {
        /// What is counted.
        kind: &'static str,
        /// The number that was asked for.
        index: u64,
        /// How many there are.
        number: u64,
    },
    /// A number is not finite, or has become so.
    #[error("{kind} is not finite")]
    NotFinite {
        /// What it is.
        kind: &'static str,
    },
    /// There are not enough of something.
    #[error("{found} {kind}, at least {needed} are needed")]
    TooFew {
        /// Of what.
        kind: &'static str,
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
}
