//! Estimates of the distribution from a sketch.

use super::Sketch;
use crate::Error;
use crate::summary::binomial;
use crate::summary::sorted::{Interval, place};

/// An estimate with a bound on its error.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Estimate {
    /// The estimate.
    pub value: f64,
    /// The result computed from all values, sorted, differs from `value` by at most this.
    pub error: f64,
}

/// A distribution in bins of equal width from the smallest to the largest value.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Histogram {
    /// Edges of the bins, one more than there are bins, in the unit of the values.
    pub edges: Vec<f64>,
    /// Fraction of the values in each bin, including its upper edge; they sum to 1.
    pub shares: Vec<f64>,
}

/// Values that cannot be distinguished.
struct Bucket {
    place: i32,
    lower: f64,
    upper: f64,
    count: u64,
}

impl Sketch {
    /// The quantile for the fraction `p`, between 0 and 1, as defined by R (type 7) and NumPy: linear interpolation
    /// between the values with ranks next to `(count - 1) p`.
    ///
    /// Apart from rounding, the error is at most `2^-8` of the deviation from the reference, or `2^-23` of the scale if
    /// that is larger.
    ///
    /// # Errors
    ///
    /// If `p` is not between 0 and 1, or if there are no values.
    pub fn quantile(&self, p: f64) -> Result<Estimate, Error> {
        let (rank, part) = place(self.count, p)?;
        let [lower, upper] = [rank, rank + 1].map(|rank| self.at_rank(rank));
        let value = lower.value + part * (upper.value - lower.value);
        let error = (1.0 - part) * lower.error + part * upper.error;
        let rounding = 2.0 * f64::EPSILON * (lower.value.abs() + upper.value.abs());
        Ok(Estimate { value, error: if error > 0.0 { error + rounding } else { 0.0 } })
    }

    /// A confidence interval for the quantile of the distribution from which the values were drawn, with at least this
    /// confidence; see [`crate::summary::Sorted::quantile_interval`]. The buckets widen it slightly. `None` if there
    /// are too few values.
    ///
    /// # Errors
    ///
    /// If `p` or `confidence` is not strictly between 0 and 1.
    pub fn quantile_interval(&self, p: f64, confidence: f64) -> Result<Option<Interval>, Error> {
        let ranks = binomial::ranks(self.count, p, confidence)?;
        Ok(ranks.map(|ranks| {
            let [lower, upper] = [ranks.lower, ranks.upper].map(|rank| self.at_rank(rank));
            Interval { lower: lower.value - lower.error, upper: upper.value + upper.error, coverage: ranks.coverage }
        }))
    }

    /// The fraction of the values that are at most `value`.
    ///
    /// # Errors
    ///
    /// If there are no values, or if `value` is not a number.
    pub fn cdf(&self, value: f64) -> Result<Estimate, Error> {
        if value.is_nan() {
            let reason = "NaN is not a number".to_owned();
            return Err(Error::setting("value", reason));
        }
        if self.count == 0 {
            return Err(Error::NoValues);
        }
        let exact = |value| Ok(Estimate { value, error: 0.0 });
        if value < self.min {
            return exact(0.0);
        }
        if value >= self.max {
            return exact(1.0);
        }
        let bin = self.place(value);
        let (mut below, mut within, mut part) = (0, 0, 0.5);
        for bucket in self.buckets().take_while(|bucket| bucket.place <= bin) {
            if bucket.place < bin {
                below += bucket.count;
            } else {
                within = bucket.count;
                let width = bucket.upper - bucket.lower;
                if width > 0.0 {
                    part = ((value - bucket.lower) / width).clamp(0.0, 1.0);
                }
            }
        }
        let (within, count) = (within as f64, self.count as f64);
        Ok(Estimate { value: (below as f64 + part * within) / count, error: part.max(1.0 - part) * within / count })
    }

    /// The distribution in `bins` bins, or in a single one if all values are equal.
    ///
    /// # Errors
    ///
    /// If there are no values, or no bins.
    pub fn histogram(&self, bins: usize) -> Result<Histogram, Error> {
        if bins == 0 {
            let reason = "there must be at least one".to_owned();
            return Err(Error::setting("bins", reason));
        }
        let bins = if self.min == self.max { 1 } else { bins };
        let step = (self.max - self.min) / bins as f64;
        let inner = (1..bins).map(|k| (self.min + step * k as f64).min(self.max));
        let mut edges = vec![self.min];
        edges.extend(inner);
        edges.push(self.max);
        let mut shares = Vec::with_capacity(bins);
        let mut below = 0.0;
        for &edge in &edges[1..] {
            let share = self.cdf(edge)?.value;
            shares.push(share - below);
            below = share;
        }
        Ok(Histogram { edges, shares })
    }

    /// The value with this rank, from 0; larger ranks give the last value.
    fn at_rank(&self, rank: u64) -> Estimate {
        let exact = |value| Estimate { value, error: 0.0 };
        if rank == 0 {
            return exact(self.min);
        }
        let mut below = 0;
        let Some(bucket) = self
            .buckets()
            .find(|bucket| {
                below += bucket.count;
                rank < below
            })
            .filter(|_| rank + 1 < self.count)
        else {
            return exact(self.max);
        };
        let width = bucket.upper - bucket.lower;
        if width == 0.0 {
            return exact(bucket.lower);
        }
        let after = below - rank;
        let part = 1.0 - (after as f64 - 0.5) / bucket.count as f64;
        let value = bucket.lower + part * width;
        // Both the edges and the deviations were rounded.
        let rounding = 2.0 * f64::EPSILON * (self.reference.abs() + value.abs());
        Estimate { value, error: part.max(1.0 - part) * width + rounding }
    }

    /// The buckets in the order of their values.
    fn buckets(&self) -> impl Iterator<Item = Bucket> {
        let places = self.places();
        self.buckets.counted().map(move |(bin, count)| {
            let (lower, upper) = places.edges(bin);
            let within = |deviation: f64| (self.reference + deviation).clamp(self.min, self.max);
            Bucket { place: bin, lower: within(lower), upper: within(upper), count }
        })
    }
}
