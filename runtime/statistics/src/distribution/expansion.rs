//! Expansions of variables in Hermite polynomials of a standard normal one, for covariances under a Gaussian copula.

use super::{Distribution, Kind};
use crate::legendre;
use crate::normal;

/// Number of terms.
const TERMS: usize = 120;

/// `x(Z) = mean + sum_k a_k he_k(Z)`, `k` from 1, with Hermite polynomials of unit variance. If the normal variables
/// behind two variables have correlation `r`, the covariance of the variables is `sum_k a_k b_k r^k` (Mehler 1866).
#[derive(Clone, Debug)]
pub(crate) struct Expansion {
    coefficients: Vec<f64>,
    /// Square root of the variance not covered by the terms.
    rest: f64,
}

impl Expansion {
    pub(crate) fn of(variable: &Distribution) -> Self {
        let coefficients = match &variable.kind {
            _ if variable.is_normal() => vec![variable.sigma],
            // Integration by parts: a_k = E[x'(Z) he_(k-1)(Z)] / sqrt(k).
            Kind::Discrete(discrete) => {
                let mut sums = vec![0.0; TERMS];
                for (step, size) in discrete.jumps() {
                    add(&mut sums, step, size * normal::density(step));
                }
                sums
            }
            _ => {
                let mut sums = vec![0.0; TERMS];
                legendre::points((-27.0, 27.0), 216, |z, weight| {
                    let slope = variable.slope_from_normal(z);
                    add(&mut sums, z, weight * slope * normal::density(z));
                });
                sums
            }
        };
        let explained: f64 = coefficients.iter().map(|a| a * a).sum();
        let rest = (variable.sigma * variable.sigma - explained).max(0.0);
        Self { coefficients, rest: rest.sqrt() }
    }

    /// Covariance of two variables whose normal variables have correlation `r`. The remainder of the series is treated
    /// as a term of the next order; the result is then exact for variables of the same distribution at `r = 1`.
    pub(crate) fn covariance(&self, other: &Self, r: f64) -> f64 {
        let mut power = 1.0;
        let mut sum = 0.0;
        for (a, b) in self.coefficients.iter().zip(&other.coefficients) {
            power *= r;
            sum += a * b * power;
        }
        sum + self.rest * other.rest * power * r
    }
}

/// Adds `weight he_(k-1)(z) / sqrt(k)` to each coefficient.
fn add(sums: &mut [f64], z: f64, weight: f64) {
    let (mut last, mut here) = (0.0, 1.0);
    for (k, sum) in sums.iter_mut().enumerate() {
        let k = k as f64;
        *sum += weight * here / (k + 1.0).sqrt();
        let next = (z * here - k.sqrt() * last) / (k + 1.0).sqrt();
        (last, here) = (here, next);
    }
}
