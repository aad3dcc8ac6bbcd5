//! Declared tolerances: limits about a value, and the distribution of values between them.

use super::List;

/// How a design variable or an input varies about its value.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ToleranceInfo {
    /// Lower limit minus the value, SI or as a fraction of the value.
    pub lower: f64,
    /// Upper limit minus the value, SI or as a fraction of the value; not below the lower one.
    pub upper: f64,
    /// The limits are fractions of the value and follow it; otherwise they are SI.
    pub relative: bool,
    /// The distribution between the limits.
    pub law: Law,
}

impl ToleranceInfo {
    /// A value that does not vary.
    pub const NONE: Self = Self::half_width(0.0);

    /// Normally distributed, with the same limit on either side, SI.
    #[must_use]
    pub const fn half_width(half_width: f64) -> Self {
        Self { lower: -half_width, upper: half_width, relative: false, law: Law::Normal }
    }

    /// The half-width, SI, of a normal variable about this value; `None` for asymmetric limits and other distributions.
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
/// The limits of the first three span a number of standard deviations on either side of their midpoint, the sigma level
/// of the analysis (default three): a few values lie beyond them. The others never exceed their limits.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Law {
    /// Normal, with the mean midway between the limits.
    Normal,
    /// Lognormal, for positive values, with the mean midway between the limits.
    Lognormal,
    /// Two-parameter Weibull, for positive values, with the mean midway between the limits.
    Weibull,
    /// Normal as above; values beyond the limits are rejected.
    TruncatedNormal,
    /// Every value between the limits equally probable.
    Uniform,
    /// Density decreasing linearly from the midpoint to the limits.
    Triangular,
    /// Beta between the limits, with density `x^(alpha - 1) (1 - x)^(beta - 1)` over them.
    Beta {
        /// First shape parameter, positive.
        alpha: f64,
        /// Second shape parameter, positive.
        beta: f64,
    },
    /// One of several values, for parts that come in classes or have been measured. Each has a position between the
    /// lower and the upper limit, from 0 to 1, and a non-negative weight.
    OneOf(List<(f64, f64)>),
}
