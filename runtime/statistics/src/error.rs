//! Everything that can go wrong.

use crate::reliability::Closest;

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
    /// A limit state has no value where it must have one.
    #[error("the limit state has no value {place}: {reason}")]
    NoLimitValue {
        /// Where.
        place: &'static str,
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
        formula: &'static str,
        /// The principal curvature at fault, in 1.
        curvature: f64,
        /// The reliability index.
        beta: f64,
    },
}
