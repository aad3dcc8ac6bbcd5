//! The standard normal distribution, with full relative accuracy in the tails.

use std::f64::consts::{FRAC_1_SQRT_2, PI, SQRT_2};

use libm::erfc;
use statrs::function::erf::erfc_inv;

/// Probability density at `z`.
#[must_use]
pub fn density(z: f64) -> f64 {
    (-0.5 * z * z).exp() / (2.0 * PI).sqrt()
}

/// `P(Z < z)`.
#[must_use]
pub fn cdf(z: f64) -> f64 {
    0.5 * erfc(-z * FRAC_1_SQRT_2)
}

/// `ln P(Z > z)`.
#[must_use]
pub fn ln_upper(z: f64) -> f64 {
    if z < 0.0 {
        (-cdf(z)).ln_1p()
    } else if z < FAR {
        cdf(-z).ln()
    } else {
        -0.5 * z * z - 0.5 * (2.0 * PI).ln() - hazard(z).ln()
    }
}

/// Hazard function: density divided by `P(Z > z)`.
#[must_use]
pub fn hazard(z: f64) -> f64 {
    if z < FAR {
        density(z) / cdf(-z)
    } else {
        // Laplace's continued fraction.
        z + 1.0 / (z + 2.0 / (z + 3.0 / (z + 4.0 / z)))
    }
}

/// Shortly beyond this, probabilities are not normal floating-point numbers.
const FAR: f64 = 37.0;

/// The `z` below which the given probability lies; infinite for 0 and 1, NaN outside [0, 1].
///
/// For full accuracy at a probability near one, negate the quantile of its complement.
///
/// ```
/// use eigentol_statistics::normal::{cdf, quantile};
///
/// assert!((quantile(0.975) - 1.959_963_984_540_054).abs() < 1e-15);
/// assert!((quantile(cdf(-37.0)) + 37.0).abs() < 1e-13);
/// ```
#[must_use]
pub fn quantile(probability: f64) -> f64 {
    if !(0.0..=1.0).contains(&probability) {
        return f64::NAN;
    }
    if probability > 0.5 {
        // Exact: the complement of a double above one half.
        return -quantile(1.0 - probability);
    }
    if probability == 0.0 {
        return f64::NEG_INFINITY;
    }
    let mut z = -SQRT_2 * erfc_inv(2.0 * probability);
    // Halley's method on the logarithm, whose slope is the hazard.
    for _ in 0..2 {
        let below = cdf(z);
        if below > 0.0 {
            let hazard = density(z) / below;
            let step = (below / probability).ln() / hazard;
            z -= step / (1.0 + 0.5 * step * (z + hazard));
        }
    }
    z
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_of_fifty_digits() {
        for (p, z) in [
            (0.5, 0.0),
            (0.1, -1.281_551_565_544_600_5),
            (1e-3, -3.090_232_306_167_813_5),
            (1e-9, -5.997_807_015_007_687),
            (1e-100, -21.273_453_560_965_324),
            (1e-300, -37.047_096_299_361_2),
        ] {
            assert!((quantile(p) - z).abs() <= 4e-15 * z.abs(), "{p:e}: {:.17}", quantile(p));
        }
        assert_eq!(quantile(0.0), f64::NEG_INFINITY);
        assert_eq!(quantile(1.0), f64::INFINITY);
        assert!(quantile(1.5).is_nan() && quantile(f64::NAN).is_nan());
    }

    /// Checked on both sides of the point where the formula changes: to its left by the derivative of the logarithm,
    /// the negative hazard.
    #[test]
    fn far_tails_continue() {
        let (below, above) = (FAR - 1e-3, FAR + 1e-3);
        let slope = (ln_upper(above) - ln_upper(below)) / 2e-3;
        assert!((slope + hazard(FAR)).abs() < 1e-9);
        assert!((hazard(above) - hazard(below) - 2e-3).abs() < 1e-5);
        assert!((ln_upper(1e3) + 500_007.826_694).abs() < 1e-5);
    }

    #[test]
    fn quantile_inverts_cdf() {
        for k in -370..=80 {
            let z = 0.1 * f64::from(k);
            // Near one, a probability has no digits left for z.
            let lost = 1e-15 + f64::EPSILON / density(z.max(0.0)) * cdf(z);
            assert!((quantile(cdf(z)) - z).abs() <= lost + 4e-15 * z.abs(), "{z}");
        }
    }
}
