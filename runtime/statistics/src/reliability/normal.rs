//! The standard normal distribution, accurate in both tails.

use core::f64::consts::{FRAC_1_SQRT_2, PI, SQRT_2};

/// `phi(x)`.
pub(super) fn density(x: f64) -> f64 {
    ln_density(x).exp()
}

/// `ln phi(x)`.
pub(super) fn ln_density(x: f64) -> f64 {
    -0.5 * (x * x + (2.0 * PI).ln())
}

/// `Phi(x)`, with the relative accuracy of `erfc` in the lower tail.
pub(super) fn probability_below(x: f64) -> f64 {
    0.5 * libm::erfc(-x * FRAC_1_SQRT_2)
}

/// `ln Phi(x)`, also where `Phi(x)` is below the least number.
pub(super) fn ln_probability_below(x: f64) -> f64 {
    if x > -30.0 {
        return probability_below(x).ln();
    }
    // Abramowitz and Stegun 26.2.12; the first term left out is below 1e-11 of the sum.
    let r = 1.0 / (x * x);
    let series = 1.0 - r * (1.0 - 3.0 * r * (1.0 - 5.0 * r * (1.0 - 7.0 * r)));
    ln_density(x) - (-x).ln() + series.ln()
}

/// `phi(x) / Phi(-x)`, the hazard rate; it approaches `x` for great `x`.
pub(super) fn hazard(x: f64) -> f64 {
    (ln_density(x) - ln_probability_below(-x)).exp()
}

/// `x` with `Phi(x) = probability`, which lies strictly inside (0, 1).
pub(super) fn quantile(probability: f64) -> f64 {
    -SQRT_2 * statrs::function::erf::erfc_inv(2.0 * probability)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Abramowitz and Stegun, tables 26.1 and 26.2; the last from the continued fraction 26.2.14 in multiple precision.
    #[test]
    fn published_values() {
        let close = |a: f64, b: f64| assert!((a / b - 1.0).abs() < 1e-9, "{a} {b}");
        close(probability_below(1.0), 0.841344746068543);
        close(probability_below(-5.0), 2.866515718791939e-7);
        close(density(1.0), 0.241970724519143);
        close(quantile(0.975), 1.959963984540054);
        close(ln_probability_below(-40.0), -804.608442013754);
    }

    #[test]
    fn tails_meet() {
        let (above, below) = (
            ln_probability_below(-30.0 + 1e-9),
            ln_probability_below(-30.0),
        );
        assert!((above - below).abs() < 1e-7, "{above} {below}");
        for x in [-37.0, -20.0, -8.0, -1.0, 0.5, 3.0] {
            assert!((quantile(probability_below(x)) - x).abs() < 1e-11, "{x}");
            assert!((hazard(-x) * probability_below(x) / density(x) - 1.0).abs() < 1e-9);
        }
    }
}
