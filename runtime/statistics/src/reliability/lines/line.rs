//! A direction to sample along, and a line in it.

/// A direction in which failure is expected. A wrong one costs evaluations, and does the result no harm.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Direction {
    /// The direction, of any length and either sign.
    pub along: Vec<f64>,
    /// Distance from the origin at which failure is expected, in standard deviations.
    pub distance: f64,
}

/// A line: the probabilities along it within its region, given its position.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Line {
    /// Probability of failure.
    pub(super) fails: f64,
    /// Probability that the limit state has no value.
    pub(super) without_value: f64,
    /// Number of evaluations of the limit state.
    pub(super) evaluations: u64,
}
