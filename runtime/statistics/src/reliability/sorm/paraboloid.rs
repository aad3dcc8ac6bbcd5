//! The exact probability beyond a paraboloid.

use core::f64::consts::PI;

use num_complex::Complex64;

/// Maximum number of intervals of the trapezoidal rule.
const INTERVALS: usize = 1_000_000;

/// `P(Z > beta + sum kappa_i Y_i^2 / 2)` for independent standard normal variables and positive `beta`, by inversion of
/// the moment generating function (Tvedt 1990, *Distribution of quadratic forms in normal space*, J. Eng. Mech. 116):
///
/// `Q = beta - Z + sum kappa_i Y_i^2 / 2` has `E exp(s Q) = exp(beta s + s^2/2) prod (1 - s kappa_i)^(-1/2)`, and
/// `P(Q < 0) = -1/(2 pi i) integral of E exp(s Q) / s` along a vertical line between the pole at 0 and the first branch
/// point to the left of it. Through the saddle point the integrand does not oscillate where it is significant, and the
/// trapezoidal rule converges exponentially. `None` if there is no room for the line.
pub(super) fn probability_beyond(beta: f64, curvatures: &[f64]) -> Option<f64> {
    let branch =
        curvatures.iter().filter(|&&kappa| kappa < 0.0).map(|kappa| 1.0 / kappa).fold(f64::NEG_INFINITY, f64::max);
    let saddle = saddle_point(beta, curvatures, branch);
    let ln_integrand = |t: f64| {
        let s = Complex64::new(saddle, t);
        let factors = curvatures.iter().map(|kappa| (1.0 - s * kappa).ln());
        s * beta + s * s * 0.5 - factors.sum::<Complex64>() * 0.5 - (-s).ln()
    };
    let at_saddle = ln_integrand(0.0).re;
    let room = saddle.abs().min(saddle - branch).min(1.0);
    let step = room / 8.0;
    let mut sum = 0.5;
    for k in 1..INTERVALS {
        let t = k as f64 * step;
        let value = (ln_integrand(t) - at_saddle).exp();
        sum += value.re;
        // The rest of the integrand decays at least as fast as exp(-t^2/2).
        if value.norm() < 1e-18 {
            let probability = (at_saddle + (sum * step / PI).ln()).exp();
            return probability.is_finite().then_some(probability);
        }
    }
    None
}

/// The place of the minimum of `K(s) - ln(-s)`, which is convex, between the branch point and 0; `K` is the cumulant
/// generating function.
fn saddle_point(beta: f64, curvatures: &[f64], branch: f64) -> f64 {
    let derivative = |s: f64| {
        let factors = curvatures.iter().map(|kappa| 0.5 * kappa / (1.0 - s * kappa));
        beta + s + factors.sum::<f64>() - 1.0 / s
    };
    let mut left = branch;
    if !left.is_finite() {
        left = -1.0;
        while derivative(left) > 0.0 {
            left *= 2.0;
        }
    }
    let mut right = 0.0;
    for _ in 0..200 {
        let middle = 0.5 * (left + right);
        if derivative(middle) > 0.0 {
            right = middle;
        } else {
            left = middle;
        }
    }
    0.5 * (left + right)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::legendre::composite;
    use crate::normal;

    /// The same probability by conditioning on one curved variable.
    fn by_conditioning(beta: f64, kappa: f64) -> f64 {
        composite((-10.0, 10.0), 40, |y| normal::density(y) * normal::cdf(-beta - 0.5 * kappa * y * y))
    }

    #[test]
    fn flat_and_curved() {
        for beta in [1e-3, 0.5, 2.0, 5.0, 9.0] {
            let flat = probability_beyond(beta, &[0.0; 3]).unwrap();
            assert!((flat / normal::cdf(-beta) - 1.0).abs() < 1e-10, "{beta}");
            for kappa in [-0.5, -0.08, 0.02, 0.4, 3.0] {
                let exact = by_conditioning(beta, kappa);
                let value = probability_beyond(beta, &[kappa]).unwrap();
                assert!((value / exact - 1.0).abs() < 1e-9, "{beta} {kappa}: {value} {exact}");
            }
        }
    }
}
