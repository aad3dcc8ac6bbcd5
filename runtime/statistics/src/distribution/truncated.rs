//! The truncated standard normal distribution.

use crate::legendre;
use crate::{Error, normal};

/// An interval of standard normal values.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Interval {
    #[cfg_attr(feature = "serde", serde(with = "crate::serial::exact"))]
    low: f64,
    #[cfg_attr(feature = "serde", serde(with = "crate::serial::exact"))]
    high: f64,
    /// Whether the limits are mirrored, because most of the probability lies left of zero.
    mirrored: bool,
    /// `P(Z > low)` and `P(Z > high)`, with the limits after mirroring.
    above: (f64, f64),
}

impl Interval {
    pub(super) fn new(low: f64, high: f64) -> Result<Self, Error> {
        // In the right tail, differences of `P(Z > z)` keep their digits.
        let mirrored = low + high < 0.0;
        let (from, to) = if mirrored { (-high, -low) } else { (low, high) };
        let above = (normal::cdf(-from), normal::cdf(-to));
        if above.0 - above.1 < 1e-300 {
            return Err(Error::setting(
                "limits of a truncated normal variable",
                format!("between {low:e} and {high:e} standard deviations from the mean there is no probability left"),
            ));
        }
        Ok(Self { low, high, mirrored, above })
    }

    pub(super) fn ends(&self) -> (f64, f64) {
        (self.low, self.high)
    }

    /// The value with the same probability of being exceeded within the interval as `z` has without limits.
    pub(super) fn quantile(&self, z: f64) -> f64 {
        let (below, beyond) =
            if self.mirrored { (normal::cdf(-z), normal::cdf(z)) } else { (normal::cdf(z), normal::cdf(-z)) };
        let (most, least) = self.above;
        // A weighted mean of both ends, so that neither loses its digits to the other.
        let above = most * beyond + least * below;
        let value = -normal::quantile(above);
        let value = if self.mirrored { -value } else { value };
        value.clamp(self.low, self.high)
    }

    /// Derivative of [`Self::quantile`].
    pub(super) fn slope(&self, z: f64) -> f64 {
        let value = self.quantile(z);
        let share = self.above.0 - self.above.1;
        share * (0.5 * (value * value - z * z)).exp()
    }

    /// Mean and standard deviation, by quadrature: closed forms suffer cancellation if the limits are close together.
    pub(super) fn moments(&self) -> (f64, f64) {
        // Values farther than this from the nearest possible value have less than a part in 10^18.
        const REACH: f64 = 9.5;
        let nearest = 0.0_f64.clamp(self.low, self.high);
        let (low, high) = (self.low.max(nearest - REACH), self.high.min(nearest + REACH));
        let density = |z: f64| (0.5 * (nearest - z) * (nearest + z)).exp();
        let panels = (2.0 * (high - low) * (1.0 + nearest.abs())).ceil().clamp(1.0, 4000.0) as usize;
        let integral = |f: &dyn Fn(f64) -> f64| legendre::composite((low, high), panels, |z| f(z) * density(z));
        let mass = integral(&|_| 1.0);
        let shift = integral(&|z| z - nearest) / mass;
        let variance = integral(&|z| (z - nearest - shift).powi(2)) / mass;
        (nearest + shift, variance.sqrt())
    }
}
