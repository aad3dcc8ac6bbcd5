//! Multinormal probability of a box.

use super::factor::{Factor, factorise};
use super::slice::Slice;
use crate::Error;
use crate::random::RandomNumbers;
use crate::reliability::sampling::{Estimate, Interval};

/// Settings of the integration.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct QuadratureSettings {
    /// Number of points of the lattice rule, all of which are used for every shift.
    pub points: usize,
    /// Number of random shifts of the lattice; the standard error is that of their mean.
    pub shifts: usize,
    /// Seed of the shifts.
    pub seed: u64,
}

impl Default for QuadratureSettings {
    fn default() -> Self {
        Self { points: 2000, shifts: 12, seed: 1 }
    }
}

impl QuadratureSettings {
    pub(super) fn check(&self) -> Result<(), Error> {
        if self.points == 0 || self.shifts < 2 {
            return Err(Error::Setting { setting: "quadrature", reason: "it needs a point and two shifts".into() });
        }
        Ok(())
    }
}

/// `P(a_i < X_i < b_i for all i)` for standard normal variables with the given correlation matrix, by separation of
/// variables (Genz 1992, *Numerical computation of multivariate normal probabilities*), the most restrictive variable
/// first (Gibson, Glasbey and Elston 1994), on a randomly shifted lattice (Cranley and Patterson 1976). The matrix may
/// be singular.
///
/// Bounds are in standard deviations and may be infinite.
///
/// # Errors
///
/// If lengths differ, if a bound is NaN or a lower one exceeds its upper one, if the matrix is not a correlation
/// matrix, or if a setting is invalid.
///
/// # Examples
///
/// ```
/// use eigentol_statistics::reliability::sampling::Interval;
/// use eigentol_statistics::reliability::system::{QuadratureSettings, box_probability};
///
/// let positive = [Interval { lower: 0.0, upper: f64::INFINITY }; 3];
/// let correlation: Vec<Vec<f64>> = (0..3)
///     .map(|i| (0..3).map(|j| if i == j { 1.0 } else { 0.5 }).collect())
///     .collect();
/// let found = box_probability(&positive, &correlation, &QuadratureSettings::default())?;
/// assert!((found.value - 0.25).abs() < 1e-4);
/// # Ok::<(), eigentol_statistics::Error>(())
/// ```
pub fn box_probability(
    bounds: &[Interval],
    correlation: &[Vec<f64>],
    settings: &QuadratureSettings,
) -> Result<Estimate, Error> {
    settings.check()?;
    let factor = factorise(bounds, correlation)?;
    let dimension = factor.rows.len();
    let generators: Vec<f64> = primes().take(dimension).map(f64::sqrt).collect();
    let mut random = RandomNumbers::new(settings.seed, 0);
    let mut means = Vec::with_capacity(settings.shifts);
    let mut point = vec![0.0; dimension];
    for _ in 0..settings.shifts {
        let shift: Vec<f64> = (0..dimension).map(|_| random.fraction()).collect();
        let mut sum = 0.0;
        for k in 1..=settings.points {
            for ((x, generator), shift) in point.iter_mut().zip(&generators).zip(&shift) {
                // Folding makes the integrand periodic (baker's transformation).
                let fraction = (k as f64 * generator + shift).fract();
                *x = (2.0 * fraction - 1.0).abs();
            }
            sum += integrand(&factor, &point);
        }
        means.push(sum / settings.points as f64);
    }
    let number = means.len() as f64;
    let value = means.iter().sum::<f64>() / number;
    let squares: f64 = means.iter().map(|mean| (mean - value).powi(2)).sum();
    Ok(Estimate { value, standard_error: (squares / (number * (number - 1.0))).sqrt() })
}

/// Product of the conditional probabilities of each variable, given a choice of the preceding ones.
fn integrand(factor: &Factor, point: &[f64]) -> f64 {
    let mut chosen: Vec<f64> = Vec::with_capacity(point.len());
    let mut product = 1.0;
    for ((row, bounds), x) in factor.rows.iter().zip(&factor.bounds).zip(point) {
        let mean: f64 = row.iter().zip(&chosen).map(|(l, y)| l * y).sum();
        let sigma = row[chosen.len()];
        if sigma == 0.0 {
            // The variable is a combination of the preceding ones.
            let slack = factor.rounding;
            if mean < bounds.lower - slack || mean > bounds.upper + slack {
                return 0.0;
            }
            chosen.push(0.0);
            continue;
        }
        let slice = Slice::between((bounds.lower - mean) / sigma, (bounds.upper - mean) / sigma);
        product *= slice.probability;
        if product == 0.0 {
            return 0.0;
        }
        chosen.push(slice.quantile(*x));
    }
    product
}

fn primes() -> impl Iterator<Item = f64> {
    let is_prime = |n: &u32| (2..).take_while(|d| d * d <= *n).all(|d| !n.is_multiple_of(d));
    (2..).filter(is_prime).map(f64::from)
}
