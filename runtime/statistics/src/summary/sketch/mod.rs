//! The distribution of a quantity in counted buckets, whose widths are a fixed share of the deviation from a reference.

mod buckets;
mod estimates;

pub use estimates::{Estimate, Histogram};

use super::checks::check_number;
use super::mask::CHUNK;
use super::{Moments, lanes};
use crate::Error;
use buckets::{Buckets, Places};

/// Counts of values in buckets of their deviation from a reference. The buckets are `2^-8` of the deviation wide, from `2^-24` of
/// a scale on: near the reference they are narrow, far away they are wide. Values that scatter by one scale about the reference
/// are told apart to less than 0.004 of that scale.
///
/// Counts are integers, so the result does not depend on the order of the values or of merging. Memory: 2 KiB for each power of
/// two that has deviations, above or below; about 50 KiB for some thousand values that scatter about the reference, and never more
/// than 9 MiB.
///
/// The buckets are those of HDR histograms and of DDSketch (Masson, Rim and Lee, 2019), at powers of two divided in equal parts.
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
    /// Zero without values.
    #[cfg_attr(feature = "serde", serde(with = "super::bits::one"))]
    min: f64,
    #[cfg_attr(feature = "serde", serde(with = "super::bits::one"))]
    max: f64,
}

impl Sketch {
    /// Of no values yet, about `reference` and for deviations from it of the order of `scale`, both in the unit of the values.
    /// The result is as good for a `scale` that is some orders of magnitude off.
    ///
    /// # Errors
    ///
    /// `reference` is not a number, or `scale` is not a positive one.
    pub fn new(reference: f64, scale: f64) -> Result<Self, Error> {
        check_number("reference", reference)?;
        check_number("scale", scale)?;
        if scale <= 0.0 {
            let reason = format!("{scale} is not positive");
            return Err(Error::Setting {
                setting: "scale",
                reason,
            });
        }
        Ok(Self {
            reference,
            scale,
            buckets: Buckets::default(),
            count: 0,
            min: 0.0,
            max: 0.0,
        })
    }

    /// Adds values.
    ///
    /// # Errors
    ///
    /// One is not a number of at most [`LARGEST`](super::LARGEST) in magnitude. Nothing has been added then.
    pub fn add(&mut self, values: &[f64]) -> Result<(), Error> {
        for &value in values {
            check_number("values of a sketch", value)?;
        }
        let (_, min, max) = lanes::sum_and_range(values, 0.0);
        self.include(values.len() as u64, min, max);
        values
            .chunks(CHUNK)
            .for_each(|values| self.count_all(values));
        Ok(())
    }

    /// Adds the values of another.
    ///
    /// # Errors
    ///
    /// It has another reference or scale.
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

    /// Values of at most [`LARGEST`](super::LARGEST), and their moments.
    #[inline(always)]
    pub(in crate::summary) fn add_checked(&mut self, values: &[f64], moments: &Moments) {
        self.include(moments.count, moments.min, moments.max);
        self.count_all(values);
    }

    /// Values that are all the same, by their moments.
    pub(in crate::summary) fn add_equal(&mut self, moments: &Moments) {
        self.include(moments.count, moments.min, moments.max);
        let place = self.place(moments.min);
        self.buckets.count_equal(place, moments.count);
    }

    /// Another about the same reference.
    pub(in crate::summary) fn merge_checked(&mut self, other: &Self) {
        self.include(other.count, other.min, other.max);
        self.buckets.merge(&other.buckets);
    }

    fn include(&mut self, count: u64, min: f64, max: f64) {
        if count == 0 {
            return;
        }
        // Adding zero turns -0 into 0: which of them is met first depends on the order.
        let (min, max) = (min + 0.0, max + 0.0);
        self.min = if self.count == 0 || min < self.min {
            min
        } else {
            self.min
        };
        self.max = if self.count == 0 || max > self.max {
            max
        } else {
            self.max
        };
        self.count += count;
        self.buckets
            .reach(self.place(self.min), self.place(self.max));
    }

    /// At most [`CHUNK`] values, which `min` and `max` include.
    #[inline(always)]
    fn count_all(&mut self, values: &[f64]) {
        let all = self.places();
        // Apart from counting, so that it can be vectorised.
        let mut places = [0; CHUNK];
        for (place, value) in places.iter_mut().zip(values) {
            *place = all.of_deviation(value - self.reference);
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
    /// Whether it can have come about by adding values.
    pub(in crate::summary) fn is_consistent(&self) -> bool {
        let numbers = [self.reference, self.scale, self.min, self.max];
        numbers.iter().all(|number| number.abs() <= super::LARGEST)
            && self.scale > 0.0
            && self.min <= self.max
            && self
                .buckets
                .total(self.place(self.min), self.place(self.max))
                == Some(self.count)
    }

    /// Whether both count the same buckets.
    pub(in crate::summary) fn is_like(&self, other: &Self) -> bool {
        (self.reference, self.scale) == (other.reference, other.scale)
    }
}
