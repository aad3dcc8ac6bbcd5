//! Exact quantiles of stored values.

use super::binomial;
use super::checks::check_number;
use crate::Error;

/// Values in ascending order.
///
/// ```
/// # fn main() -> Result<(), eigentol_statistics::Error> {
/// use eigentol_statistics::summary::Sorted;
///
/// let values = Sorted::new((1..=10).map(f64::from).collect())?;
/// assert_eq!(values.quantile(0.25)?, 3.25);
/// let median = values.quantile_interval(0.5, 0.95)?.expect("enough values");
/// assert_eq!((median.lower, median.upper), (2.0, 9.0));
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Sorted(Vec<f64>);

/// A confidence interval of a quantile of the distribution.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Interval {
    /// Lower end, in the unit of the values.
    pub lower: f64,
    /// Upper end.
    pub upper: f64,
    /// Probability that the quantile lies between the ends, at least the confidence requested: exact for a continuous
    /// distribution, a lower bound for others.
    pub coverage: f64,
}

impl Sorted {
    /// Sorts the values; their original order does not matter.
    ///
    /// # Errors
    ///
    /// If one of them is NaN or above [`LARGEST`](super::LARGEST) in magnitude.
    pub fn new(mut values: Vec<f64>) -> Result<Self, Error> {
        for &value in &values {
            check_number("values to sort", value)?;
        }
        values.sort_unstable_by(f64::total_cmp);
        Ok(Self(values))
    }

    /// The values in ascending order.
    #[must_use]
    pub fn values(&self) -> &[f64] {
        &self.0
    }

    /// The quantile for the fraction `p`, between 0 and 1: linear interpolation between the values with ranks next to
    /// `(count - 1) p` (Hyndman and Fan 1996, definition 7, the default of R and NumPy).
    ///
    /// # Errors
    ///
    /// If `p` is not between 0 and 1, or if there are no values.
    pub fn quantile(&self, p: f64) -> Result<f64, Error> {
        let (rank, part) = place(self.0.len() as u64, p)?;
        let lower = self.0[rank as usize];
        let upper = self.0.get(rank as usize + 1).copied().unwrap_or(lower);
        Ok(lower + part * (upper - lower))
    }

    /// The fraction of the values that are at most `value`.
    ///
    /// # Errors
    ///
    /// If there are no values.
    pub fn cdf(&self, value: f64) -> Result<f64, Error> {
        if self.0.is_empty() {
            return Err(Error::NoValues);
        }
        let below = self.0.partition_point(|other| *other <= value);
        Ok(below as f64 / self.0.len() as f64)
    }

    /// A distribution-free confidence interval for the `p`-quantile of the distribution from which the values were
    /// drawn independently.
    ///
    /// Its ends are two of the values, chosen from the binomial distribution of the number of values below the quantile
    /// (David and Nagaraja, Order Statistics, 3rd edition, section 7.1). Each end fails with at most half of
    /// `1 - confidence`. `None` if there are too few values.
    ///
    /// # Errors
    ///
    /// If `p` or `confidence` is not strictly between 0 and 1.
    pub fn quantile_interval(&self, p: f64, confidence: f64) -> Result<Option<Interval>, Error> {
        let ranks = binomial::ranks(self.0.len() as u64, p, confidence)?;
        Ok(ranks.map(|ranks| Interval {
            lower: self.0[ranks.lower as usize],
            upper: self.0[ranks.upper as usize],
            coverage: ranks.coverage,
        }))
    }
}

/// The integer part of `(count - 1) p`, a rank from 0, and the fraction.
pub(super) fn place(count: u64, p: f64) -> Result<(u64, f64), Error> {
    if !(0.0..=1.0).contains(&p) {
        let reason = format!("{p} is not between 0 and 1");
        return Err(Error::setting("p", reason));
    }
    let last = count.checked_sub(1).ok_or(Error::NoValues)?;
    let position = last as f64 * p;
    let rank = (position as u64).min(last);
    Ok((rank, (position - rank as f64).clamp(0.0, 1.0)))
}
