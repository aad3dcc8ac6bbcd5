//! The Cholesky factor of a correlation matrix, in an order that suits the integration over a box.

use super::slice::Slice;
use crate::Error;
use crate::normal::density;
use crate::reliability::sampling::Interval;

/// Rows of the factor, the bounds in the same order, and the magnitude up to which a deviation counts as rounding.
pub(super) struct Factor {
    pub(super) rows: Vec<Vec<f64>>,
    pub(super) bounds: Vec<Interval>,
    pub(super) rounding: f64,
}

/// Factorises such that each next variable is the one with the smallest conditional probability, given that the
/// preceding ones take their conditional means (Gibson, Glasbey and Elston 1994; Genz and Bretz 2009, section 4.1.3).
pub(super) fn factorise(bounds: &[Interval], correlation: &[Vec<f64>]) -> Result<Factor, Error> {
    check(bounds, correlation)?;
    let number = bounds.len();
    let rounding = 1e-7;
    let mut order: Vec<usize> = (0..number).collect();
    // One row per variable, filled column by column.
    let mut rows = vec![vec![0.0; number]; number];
    let mut means: Vec<f64> = Vec::new();
    for step in 0..number {
        let dot = |a: usize, b: usize| -> f64 { (0..step).map(|k| rows[a][k] * rows[b][k]).sum() };
        let variance = |i: usize| correlation[i][i] - dot(i, i);
        let probability = |i: usize| {
            let (mean, variance) = (centre(&rows[i], &means), variance(i));
            if variance <= rounding * rounding {
                return f64::INFINITY;
            }
            let sigma = variance.sqrt();
            Slice::between((bounds[i].lower - mean) / sigma, (bounds[i].upper - mean) / sigma).probability
        };
        let least =
            (step..number).min_by(|&a, &b| probability(order[a]).total_cmp(&probability(order[b]))).unwrap_or(step);
        order.swap(step, least);
        let pivot = order[step];
        let left = variance(pivot);
        if left < -rounding {
            return Err(not_a_correlation("it is not positive semidefinite"));
        }
        let sigma = if left <= rounding * rounding { 0.0 } else { left.sqrt() };
        let column: Vec<f64> = order[step + 1..]
            .iter()
            .map(|&i| match sigma {
                0.0 => 0.0,
                _ => (correlation[i][pivot] - dot(i, pivot)) / sigma,
            })
            .collect();
        let mean = centre(&rows[pivot], &means);
        means.push(match sigma {
            0.0 => 0.0,
            _ => truncated_mean((bounds[pivot].lower - mean) / sigma, (bounds[pivot].upper - mean) / sigma),
        });
        rows[pivot][step] = sigma;
        for (&i, entry) in order[step + 1..].iter().zip(column) {
            rows[i][step] = entry;
        }
    }
    Ok(Factor {
        rows: order.iter().map(|&i| rows[i].clone()).collect(),
        bounds: order.iter().map(|&i| bounds[i]).collect(),
        rounding,
    })
}

fn centre(row: &[f64], means: &[f64]) -> f64 {
    row.iter().zip(means).map(|(l, y)| l * y).sum()
}

/// `E[Z | lower < Z < upper]`.
fn truncated_mean(lower: f64, upper: f64) -> f64 {
    let probability = Slice::between(lower, upper).probability;
    let mean = (density(lower) - density(upper)) / probability;
    let inside = mean.clamp(lower.min(upper), upper.max(lower));
    if inside.is_finite() { inside } else { 0.0 }
}

fn check(bounds: &[Interval], correlation: &[Vec<f64>]) -> Result<(), Error> {
    let number = bounds.len();
    if number == 0 {
        return Err(Error::Setting { setting: "bounds", reason: "at least one variable is needed".into() });
    }
    let rows = correlation.iter().map(Vec::len);
    for found in [correlation.len()].into_iter().chain(rows) {
        if found != number {
            return Err(Error::WrongLength { kind: "rows or columns of correlations", found, expected: number });
        }
    }
    if let Some(wrong) = bounds.iter().find(|b| b.lower.is_nan() || b.upper.is_nan() || b.lower > b.upper) {
        return Err(Error::Setting {
            setting: "bounds",
            reason: format!("{} to {} is not an interval", wrong.lower, wrong.upper),
        });
    }
    for (i, row) in correlation.iter().enumerate() {
        if (row[i] - 1.0).abs() > 1e-9 {
            return Err(not_a_correlation("its diagonal is not 1"));
        }
        for (j, entry) in row.iter().enumerate() {
            let symmetric = (entry - correlation[j][i]).abs() <= 1e-9;
            if !symmetric || entry.abs() > 1.0 + 1e-9 {
                return Err(not_a_correlation("it is not symmetric with entries up to 1"));
            }
        }
    }
    Ok(())
}

fn not_a_correlation(reason: &str) -> Error {
    Error::Setting { setting: "correlation", reason: reason.into() }
}
