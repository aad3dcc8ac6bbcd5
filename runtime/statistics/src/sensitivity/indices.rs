//! Variance-based indices with bootstrap confidence intervals.

use super::estimator::{Estimator, Sums};
use crate::Error;
use crate::random::RandomNumbers;

/// Settings of the bootstrap: confidence intervals are percentiles of estimates from rows drawn with replacement (Efron
/// 1979; Archer, Saltelli and Sobol', J. Stat. Comput. Simul. 58, 1997). For quasi-random rows the intervals are too
/// wide.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Bootstrap {
    /// Number of resamples.
    pub resamples: usize,
    /// Probability that an interval contains its index, between 0 and 1.
    pub confidence: f64,
    /// Seed of the random numbers.
    pub seed: u64,
}

impl Default for Bootstrap {
    /// 200 resamples, 95 per cent.
    fn default() -> Self {
        Self { resamples: 200, confidence: 0.95, seed: 0 }
    }
}

/// An index and its confidence interval.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Estimate {
    /// The estimate; errors may move it outside 0 to 1.
    pub value: f64,
    /// Lower end of the confidence interval.
    pub lower: f64,
    /// Upper end of the confidence interval.
    pub upper: f64,
}

/// How the variance of a model is apportioned to its inputs (Sobol' 1993; Homma and Saltelli 1996).
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SobolIndices {
    /// First-order index of each input: the fraction of the variance that vanishes if this input is known.
    pub first: Vec<Estimate>,
    /// Total index of each input: the fraction of the variance that remains if all other inputs are known.
    pub total: Vec<Estimate>,
    /// Mean of the values of both samples, in their unit.
    pub mean: f64,
    /// Variance of the values of both samples, in the square of their unit.
    pub variance: f64,
    /// Number of rows used.
    pub rows: usize,
    /// Number of rows omitted because a value is missing. Unless they are few, the indices describe only part of the
    /// input space.
    pub dropped: usize,
}

/// First-order and total indices of independent inputs from the values of a [`SaltelliDesign`](super::SaltelliDesign)
/// in its order, with `None` where the model has no value.
///
/// # Errors
/// - [`Error::WrongLength`] if there are not `inputs + 2` values per row;
/// - [`Error::NotFinite`] if a value is not finite;
/// - [`Error::TooFew`] if fewer than two rows are complete, or for zero inputs or resamples;
/// - [`Error::Constant`] if the values do not vary;
/// - [`Error::Setting`] if the confidence is not between 0 and 1.
pub fn sobol_indices(
    inputs: usize,
    values: &[Option<f64>],
    estimator: Estimator,
    bootstrap: Bootstrap,
) -> Result<SobolIndices, Error> {
    at_least("inputs", inputs, 1)?;
    at_least("resamples", bootstrap.resamples, 1)?;
    if !(bootstrap.confidence > 0.0 && bootstrap.confidence < 1.0) {
        return Err(Error::setting("confidence", format!("{}, not between 0 and 1", bootstrap.confidence)));
    }
    let rows = Rows::complete(inputs, values)?;
    let number = rows.number();
    at_least("complete rows", number, 2)?;
    let all = vec![1.0; number];
    let estimates = rows.indices(&all, estimator).ok_or(Error::Constant { what: "the values".into() })?;
    let resampled: Vec<Vec<[f64; 2]>> = (0..bootstrap.resamples as u64)
        .filter_map(|stream| rows.indices(&drawn(number, bootstrap.seed, stream), estimator))
        .collect();
    at_least("resamples that vary", resampled.len(), 1)?;

    let estimate = |kind: usize| -> Vec<Estimate> {
        (estimates.iter().enumerate())
            .map(|(i, value)| {
                let mut others: Vec<f64> = resampled.iter().map(|r| r[i][kind]).collect();
                others.sort_by(f64::total_cmp);
                let tail = 0.5 * (1.0 - bootstrap.confidence);
                Estimate { value: value[kind], lower: quantile(&others, tail), upper: quantile(&others, 1.0 - tail) }
            })
            .collect()
    };
    let (mean, variance) = rows.sums(&all, 0).moments();
    Ok(SobolIndices {
        first: estimate(0),
        total: estimate(1),
        mean: rows.centre + mean,
        variance,
        rows: number,
        dropped: values.len() / (inputs + 2) - number,
    })
}

/// The values of the complete rows minus approximately their mean, which keeps sums of squares accurate.
struct Rows {
    inputs: usize,
    centre: f64,
    values: Vec<f64>,
}

impl Rows {
    fn complete(inputs: usize, values: &[Option<f64>]) -> Result<Self, Error> {
        let blocks = inputs + 2;
        if !values.len().is_multiple_of(blocks) {
            return Err(Error::WrongLength {
                kind: "values",
                found: values.len(),
                expected: values.len().div_ceil(blocks) * blocks,
            });
        }
        if values.iter().flatten().any(|value| !value.is_finite()) {
            return Err(Error::NotFinite { kind: "a value" });
        }
        let complete = values.chunks_exact(blocks).filter_map(|row| row.iter().copied().collect::<Option<Vec<f64>>>());
        let mut values: Vec<f64> = complete.flatten().collect();
        let centre = values.iter().sum::<f64>() / values.len().max(1) as f64;
        values.iter_mut().for_each(|value| *value -= centre);
        if values.iter().any(|value| !(value * value).is_finite()) {
            return Err(Error::NotFinite { kind: "the variance" });
        }
        Ok(Self { inputs, centre, values })
    }

    fn number(&self) -> usize {
        self.values.len() / (self.inputs + 2)
    }

    /// Sums over rows, each counted `times` times.
    fn sums(&self, times: &[f64], input: usize) -> Sums {
        let mut sums = Sums::default();
        for (row, times) in self.values.chunks_exact(self.inputs + 2).zip(times) {
            sums.add(*times, [row[0], row[1], row[2 + input]]);
        }
        sums
    }

    fn indices(&self, times: &[f64], estimator: Estimator) -> Option<Vec<[f64; 2]>> {
        (0..self.inputs).map(|input| self.sums(times, input).indices(estimator)).collect()
    }
}

/// How often each row occurs among as many rows drawn with replacement.
fn drawn(rows: usize, seed: u64, stream: u64) -> Vec<f64> {
    let mut random = RandomNumbers::new(seed, stream);
    let mut times = vec![0.0; rows];
    for _ in 0..rows {
        let row = (u128::from(random.bits()) * rows as u128) >> 64;
        times[row as usize] += 1.0;
    }
    times
}

/// Quantile of sorted values, by linear interpolation.
fn quantile(sorted: &[f64], probability: f64) -> f64 {
    let rank = probability * (sorted.len() - 1) as f64;
    let (below, above) = (rank.floor(), rank.ceil());
    let (low, high) = (sorted[below as usize], sorted[above as usize]);
    low + (rank - below) * (high - low)
}

pub(super) fn at_least(kind: &'static str, found: usize, needed: usize) -> Result<(), Error> {
    if found < needed {
        return Err(Error::TooFew { kind, found, needed });
    }
    Ok(())
}
