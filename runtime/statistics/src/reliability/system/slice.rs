//! A slice of the standard normal distribution.

use crate::normal::{cdf, quantile};

/// A slice of the standard normal distribution, computed in the tail where it is small.
pub(super) struct Slice {
    mirrored: bool,
    below: f64,
    pub(super) probability: f64,
}

impl Slice {
    pub(super) fn between(lower: f64, upper: f64) -> Self {
        let mirrored = lower > 0.0;
        let (lower, upper) = if mirrored { (-upper, -lower) } else { (lower, upper) };
        let below = cdf(lower);
        Self { mirrored, below, probability: (cdf(upper) - below).max(0.0) }
    }

    /// The value below which the fraction `part` of the slice lies.
    pub(super) fn quantile(&self, part: f64) -> f64 {
        let below = self.below + part * self.probability;
        let value = quantile(below.clamp(f64::MIN_POSITIVE, 1.0 - f64::EPSILON));
        if self.mirrored { -value } else { value }
    }
}
