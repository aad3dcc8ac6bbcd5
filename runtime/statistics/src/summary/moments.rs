//! Mean and central moments of values, in mergeable form.

use super::lanes;
use super::mean::Mean;

/// Maximum magnitude of a value: sums and means of such values are finite.
pub const LARGEST: f64 = 1e300;

/// Count, mean, sums of the second to fourth powers of the deviations from it, and smallest and largest value.
///
/// Merging follows Pébay, "Formulas for robust, one-pass parallel computation of covariances and arbitrary-order
/// statistical moments", SAND2008-6212 (2008), equations 1.5 and 2.1 with `p` up to 4, and Chan, Golub and LeVeque
/// (1979).
///
/// ```
/// use eigentol_statistics::summary::Moments;
///
/// let mut moments = Moments::of(&[1.0, 2.0]);
/// moments.merge(&Moments::of(&[6.0]));
/// assert_eq!((moments.count(), moments.mean()), (3, Some(3.0)));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Moments {
    pub(super) count: u64,
    pub(super) mean: Mean,
    #[cfg_attr(feature = "serde", serde(with = "super::bits::one"))]
    pub(super) second: f64,
    #[cfg_attr(feature = "serde", serde(with = "super::bits::one"))]
    pub(super) third: f64,
    #[cfg_attr(feature = "serde", serde(with = "super::bits::one"))]
    pub(super) fourth: f64,
    /// Zero if there are no values.
    #[cfg_attr(feature = "serde", serde(with = "super::bits::one"))]
    pub(super) min: f64,
    #[cfg_attr(feature = "serde", serde(with = "super::bits::one"))]
    pub(super) max: f64,
}

impl Moments {
    /// Computes the moments of values in two passes: their mean, then their deviations from it.
    ///
    /// The values should be numbers of at most [`LARGEST`] in magnitude; others make the statistics unavailable.
    #[must_use]
    #[inline(always)]
    pub fn of(values: &[f64]) -> Self {
        let Some(&pivot) = values.first() else {
            return Self::default();
        };
        let n = values.len() as f64;
        let (sum, min, max) = lanes::sum_and_range(values, pivot);
        let centre = pivot + sum / n;
        let [s1, s2, s3, s4] = lanes::powers(values, centre);
        // Difference between centre and mean due to rounding.
        let r = s1 / n;
        Self {
            count: values.len() as u64,
            mean: Mean::new(centre, r),
            second: s2 - s1 * r,
            third: s3 - 3.0 * r * s2 + 2.0 * s1 * r * r,
            fourth: s4 - 4.0 * r * s3 + 6.0 * r * r * s2 - 3.0 * s1 * r * r * r,
            min,
            max,
        }
    }

    /// Moments of `count` equal values.
    #[must_use]
    pub fn of_equal(value: f64, count: u64) -> Self {
        let one = Self::of(&[value]);
        if count == 0 {
            return Self::default();
        }
        Self { count, ..one }
    }

    /// Adds the values of another instance.
    pub fn merge(&mut self, other: &Self) {
        if other.count == 0 {
            return;
        }
        if self.count == 0 {
            *self = *other;
            return;
        }
        let count = self.count + other.count;
        let n = self.count as f64;
        let (a, b) = (n / count as f64, other.count as f64 / count as f64);
        let d = other.mean.minus(self.mean);
        let square = d * d * n * b;
        self.fourth += other.fourth
            + square * d * d * (a * a - a * b + b * b)
            + 6.0 * d * d * (a * a * other.second + b * b * self.second)
            + 4.0 * d * (a * other.third - b * self.third);
        self.third += other.third + square * d * (a - b) + 3.0 * d * (a * other.second - b * self.second);
        self.second += other.second + square;
        self.mean = self.mean.moved(d * b);
        self.count = count;
        self.min = if other.min < self.min { other.min } else { self.min };
        self.max = if other.max > self.max { other.max } else { self.max };
    }

    /// Number of values.
    #[must_use]
    pub fn count(&self) -> u64 {
        self.count
    }

    /// Mean, in the unit of the values; `None` if there are no values.
    #[must_use]
    pub fn mean(&self) -> Option<f64> {
        (self.count > 0).then_some(self.mean.high)
    }

    /// Whether all values were numbers of at most [`LARGEST`] in magnitude.
    pub(super) fn are_numbers(&self) -> bool {
        self.mean.high.is_finite() && -LARGEST <= self.min && self.max <= LARGEST
    }
}
