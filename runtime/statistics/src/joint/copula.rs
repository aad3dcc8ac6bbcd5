//! Correlations of the normal variables underlying others.

use crate::distribution::Expansion;
use crate::{Distribution, Error};

/// Correlations of the underlying normal variables for which the variables have the given linear correlations.
pub(super) fn normal_correlation(variables: &[Distribution], correlation: &[f64]) -> Result<Vec<f64>, Error> {
    let count = variables.len();
    let mut values = correlation.to_vec();
    let mut series: Vec<Option<Expansion>> = vec![None; count];
    for i in 0..count {
        for j in 0..i {
            let wanted = correlation[i * count + j];
            let (a, b) = (&variables[i], &variables[j]);
            if wanted == 0.0 || (a.is_normal() && b.is_normal()) {
                continue;
            }
            if a.sigma() == 0.0 || b.sigma() == 0.0 {
                values[i * count + j] = 0.0;
                values[j * count + i] = 0.0;
                continue;
            }
            for k in [i, j] {
                series[k].get_or_insert_with(|| Expansion::of(&variables[k]));
            }
            let (Some(first), Some(second)) = (&series[i], &series[j]) else {
                continue;
            };
            let scale = a.sigma() * b.sigma();
            let of = |r: f64| first.covariance(second, r) / scale;
            let r = bracketed_root(of, wanted).map_err(|(least, most)| Error::setting("correlation matrix", format!(
                    "variables {j} and {i} with these distributions can have correlations from {least:.4} to {most:.4}, not {wanted}"
                )))?;
            values[i * count + j] = r;
            values[j * count + i] = r;
        }
    }
    Ok(values)
}

/// The argument in [-1, 1] at which an increasing function takes a value; otherwise the values at both ends.
fn bracketed_root(of: impl Fn(f64) -> f64, wanted: f64) -> Result<f64, (f64, f64)> {
    const ROUNDING: f64 = 1e-9;
    let ends = (of(-1.0), of(1.0));
    if wanted < ends.0 - ROUNDING || wanted > ends.1 + ROUNDING {
        return Err(ends);
    }
    let (mut low, mut high) = (-1.0, 1.0);
    if wanted >= ends.1 - ROUNDING {
        return Ok(high);
    }
    if wanted <= ends.0 + ROUNDING {
        return Ok(low);
    }
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if of(middle) < wanted {
            low = middle;
        } else {
            high = middle;
        }
    }
    Ok(0.5 * (low + high))
}
