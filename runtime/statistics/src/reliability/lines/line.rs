//! A direction to sample along, and a line in it.

/// A direction in which failure is expected. A wrong one costs evaluations, and does the result no harm.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Direction {
    /// The direction, of any length and either sign.
    pub along: Vec<f64>,
    /// Distance from the origin beyond which failure is expected, in standard deviations; negative if the origin fails.
    pub distance: f64,
}

/// A line: what it contributes to each probability.
#[derive(Clone, Debug, Default)]
pub(super) struct Line {
    /// To that of failure.
    pub(super) fails: f64,
    /// To that of having no value.
    pub(super) without_value: f64,
    /// To that of everything, then to those beyond each plane across an expected direction at its distance; less what is
    /// known of them: their means are zero.
    pub(super) known: Vec<f64>,
    /// The group of directions that it belongs to.
    pub(super) group: usize,
    /// Number of evaluations of the limit state.
    pub(super) evaluations: u64,
}
