//! The distribution of a quantity as counts in buckets, whose widths grow with the deviation from a reference.

mod buckets;
mod estimates;

pub use estimates::{Estimate, Histogram};

use super::checks::check_number;
use super::mask::CHUNK;
use super::{Moments, lanes};
use crate::Error;
use buckets::{Buckets, Places};

/// Counts of values in buckets by their deviation from a reference.
///
/// The width of a bucket is at most `2^-8` of the deviation, down to `2^-24` of a scale: narrow near the reference,
/// wide far away. Values that scatter by one scale about the reference are resolved to less than 0.004 of that scale.
///
/// Counts are integers, so the result does not depend on the order of the values or of merging. Memory use is 2 KiB for
/// each power of two with deviations, above or below the reference; about 50 KiB for a few thousand values scattered
/// about the reference, and never more than 9 MiB.
///
/// The buckets are those of HDR histograms and of DDSketch (Masson, Rim and Lee, 2019), with powers of two divided into
/// equal parts.
///
/// ```
/// # fn main() -> Result<(), eigentol_statistics::Error> {
/// use eigentol_statistics::summary::Sketch;
///
/// let values: Vec<f64> = (0..=1000).map(|k| 5.0 + 1e-3 * f64::from(k)).collect();
/// let mut sketch = Sketch::new(5.5, 0.3)?;
/// sketch.add(&values)?;
/// let quantile = sketch.quantile(0.9)?;
/// assert!((quantile.value - 5.9).abs() <= quantile.error && quantile.error < 2e-3);
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Sketch {
    #[cfg_attr(feature = "serde", serde(with = "super::bits::one"))]
    reference: f64,
    #[cfg_attr(feature = "serde", serde(with = "super::bits::one"))]
    scale: f64,
    buckets: Buckets,
    count: u64,
    /// Zero if there are no values.
    #[cfg_attr(feature = "serde", serde(with = "super::bits::one"))]
    min: f64,
    #[cfg_attr(feature = "serde", serde(with = "super::bits::one"))]
    max: f64,
}

impl Sketch {
    /// An empty sketch about `reference` for deviations of the order of `scale`, both in the unit of the values.
    ///
    /// The result is equally good if `scale` is wrong by a few orders of magnitude.
    ///
    /// # Errors
    ///
    /// If `reference` or `scale` is NaN or above [`LARGEST`](super::LARGEST) in magnitude, or if `scale` is not
    /// positive.
    pub fn new(reference: f64, scale: f64) -> Result<Self, Error> {
        check_number("reference", reference)?;
        check_number("scale", scale)?;
        if scale <= 0.0 {
            let reason = format!("{scale} is not positive");
            return Err(Error::setting("scale", reason));
        }
        Ok(Self { reference, scale, buckets: Buckets::default(), count: 0, min: 0.0, max: 0.0 })
    }

    /// Adds values.
    ///
    /// # Errors
    ///
    /// If one is NaN or above [`LARGEST`](super::LARGEST) in magnitude. In that case nothing is added.
    pub fn add(&mut self, values: &[f64]) -> Result<(), Error> {
        for &value in values {
            check_number("values of a sketch", value)?;
        }
        let (_, min, max) = lanes::sum_and_range(values, 0.0);
        self.include(values.len() as u64, min, max);
        values.chunks(CHUNK).for_each(|values| self.count_all(values));
        Ok(())
    }

    /// Adds the values of another sketch.
    ///
    /// # Errors
    ///
    /// If it has another reference or scale.
    pub fn merge(&mut self, other: &Self) -> Result<(), Error> {
        if (self.reference, self.scale) != (other.reference, other.scale) {
            return Err(Error::OtherPlan);
        }
        self.merge_checked(other);
        Ok(())
    }

    /// Number of values.
    #[must_use]
    pub fn count(&self) -> u64 {
        self.count
    }

    /// Adds values of at most [`LARGEST`](super::LARGEST) in magnitude, given their moments.
    #[inline(always)]
    pub(in crate::summary) fn add_checked(&mut self, values: &[f64], moments: &Moments) {
        self.include(moments.count, moments.min, moments.max);
        self.count_all(values);
    }

    /// Adds equal values, given their moments.
    pub(in crate::summary) fn add_equal(&mut self, moments: &Moments) {
        self.include(moments.count, moments.min, moments.max);
        let bin = self.place(moments.min);
        self.buckets.count_equal(bin, moments.count);
    }

    /// Adds another sketch about the same reference.
    pub(in crate::summary) fn merge_checked(&mut self, other: &Self) {
        self.include(other.count, other.min, other.max);
        self.buckets.merge(&other.buckets);
    }

    fn include(&mut self, count: u64, min: f64, max: f64) {
        if count == 0 {
            return;
        }
        // Adding zero turns -0 into 0: which of them comes first depends on the order.
        let (min, max) = (min + 0.0, max + 0.0);
        self.min = if self.count == 0 || min < self.min { min } else { self.min };
        self.max = if self.count == 0 || max > self.max { max } else { self.max };
        self.count += count;
        self.buckets.reach(self.place(self.min), self.place(self.max));
    }

    /// Counts at most [`CHUNK`] values, which lie between `min` and `max`.
    #[inline(always)]
    fn count_all(&mut self, values: &[f64]) {
        let all = self.places();
        // Separate from counting, so that it can be vectorised.
        let mut places = [0; CHUNK];
        for (slot, value) in places.iter_mut().zip(values) {
            *slot = all.of_deviation(value - self.reference);
        }
        self.buckets.count(&places[..values.len().min(CHUNK)]);
    }

    fn places(&self) -> Places {
        Places::of(self.scale)
    }

    fn place(&self, value: f64) -> i32 {
        self.places().of_deviation(value - self.reference)
    }
}

#[cfg(feature = "serde")]
impl Sketch {
    /// Whether it can result from adding values.
    pub(in crate::summary) fn is_consistent(&self) -> bool {
        [self.reference, self.scale, self.min, self.max].iter().all(|number| number.abs() <= super::LARGEST)
            && self.scale > 0.0
            && self.min <= self.max
            && self.buckets.total(self.place(self.min), self.place(self.max)) == Some(self.count)
    }

    /// Whether both count the same buckets.
    pub(in crate::summary) fn is_like(&self, other: &Self) -> bool {
        (self.reference, self.scale) == (other.reference, other.scale)
    }
}
