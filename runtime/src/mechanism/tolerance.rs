//! Declared tolerances: limits about a value, and how values are distributed between them.

use super::List;

/// How a design variable or an input varies about its value.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ToleranceInfo {
    /// Lower limit less the value, SI or a fraction of the value.
    pub lower: f64,
    /// Upper limit less the value, SI or a fraction of the value; not below the lower one.
    pub upper: f64,
    /// The limits are fractions of the value, and follow it; otherwise they are SI.
    pub relative: bool,
    /// The distribution between the limits.
    pub law: Law,
}

impl ToleranceInfo {
    /// A value that does not vary.
    pub const NONE: Self = Self::half_width(0.0);

    /// Normally distributed, the same limit on either side, SI.
    #[must_use]
    pub const fn half_width(half_width: f64) -> Self {
        Self {
            lower: -half_width,
            upper: half_width,
            relative: false,
            law: Law::Normal,
        }
    }

    /// The half-width, SI, of a normal variable about this value; `None` of limits that differ, and of other laws.
    #[must_use]
    pub fn normal_half_width(&self, value: f64) -> Option<f64> {
        if self.law != Law::Normal || self.lower != -self.upper {
            return None;
        }
        let size = if self.relative { value.abs() } else { 1.0 };
        Some(self.upper * size)
    }
}

/// How values are distributed between the limits of a tolerance.
///
/// Limits of the first three hold a number of standard deviations on either side of their middle, the sigma level of the analysis,
/// three unless set: a few values lie beyond them. The others never leave them.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Law {
    /// Normal: the mean midway between the limits.
    Normal,
    /// Lognormal, for values that are positive: the mean midway between the limits.
    Lognormal,
    /// Weibull in two parameters, for values that are positive: the mean midway between the limits.
    Weibull,
    /// Normal as above, what lies beyond the limits sorted out.
    TruncatedNormal,
    /// Every value between the limits as probable as any other.
    Uniform,
    /// Density falling in straight lines from the middle to the limits.
    Triangular,
    /// Beta between the limits, with density `x^(alpha - 1) (1 - x)^(beta - 1)` over them.
    Beta {
        /// First shape, positive.
        alpha: f64,
        /// Second shape, positive.
        beta: f64,
    },
    /// One of some values, as of parts that come in classes or have been measured: for each how far it is from the lower to the upper
    /// limit, from 0 to 1, and a weight, which is not negative.
    OneOf(List<(f64, f64)>),
}
