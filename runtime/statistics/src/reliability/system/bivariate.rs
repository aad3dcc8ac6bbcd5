//! The bivariate normal probability.

use core::f64::consts::PI;

use crate::Error;
use crate::legendre::composite;
use crate::normal::{cdf, ln_upper};

/// Number of panels over the significant region.
const PANELS: usize = 16;
/// Values this far below the maximum of a logarithm are negligible.
const NEGLIGIBLE: f64 = 45.0;

/// `P(X > h and Y > k)` for two standard normal variables with the given `correlation` in [-1, 1], with relative
/// accuracy even far in the tail. It is the integral of `phi(x) Phi((r x - k) / sqrt(1 - r^2))` from `h` on, whose
/// integrand is log-concave. Thresholds are in standard deviations.
///
/// # Errors
///
/// If a threshold is not finite, or if the correlation is not in [-1, 1].
///
/// # Examples
///
/// ```
/// use eigentol_statistics::reliability::system::probability_above;
///
/// // Sheppard: 1/4 + asin(r) / (2 pi) for thresholds of zero.
/// assert!((probability_above(0.0, 0.0, 0.5)? - 1.0 / 3.0).abs() < 1e-14);
/// # Ok::<(), eigentol_statistics::Error>(())
/// ```
pub fn probability_above(h: f64, k: f64, correlation: f64) -> Result<f64, Error> {
    if !(h.is_finite() && k.is_finite() && correlation.abs() <= 1.0) {
        return Err(Error::Setting {
            setting: "correlation or thresholds",
            reason: format!("{correlation}, {h} and {k}"),
        });
    }
    Ok(both_above(h, k, correlation))
}

/// [`probability_above`] for valid arguments.
pub(super) fn both_above(h: f64, k: f64, correlation: f64) -> f64 {
    let (h, k) = if h >= k { (h, k) } else { (k, h) };
    let rest = (1.0 - correlation) * (1.0 + correlation);
    if rest <= 0.0 {
        return perfectly_correlated(h, k, correlation);
    }
    let sigma = rest.sqrt();
    let ln_integrand = |x: f64| -0.5 * (x * x + (2.0 * PI).ln()) + ln_upper((k - correlation * x) / sigma);
    let highest = maximum(&ln_integrand, h);
    let top = ln_integrand(highest);
    let counts = |x: f64| ln_integrand(x) > top - NEGLIGIBLE;
    let start = if counts(h) { h } else { boundary(&counts, highest, h) };
    let end = boundary(&counts, highest, highest + 40.0);
    // The second factor rises from 0 to 1 within a few sigma of this value.
    let rise = k / correlation;
    let width = 8.0 * sigma / correlation.abs();
    let mut breaks = vec![start, highest, end];
    breaks.extend([rise - width, rise, rise + width]);
    breaks.retain(|x| (start..=end).contains(x));
    breaks.sort_by(f64::total_cmp);
    let integral = |ends: &[f64]| composite((ends[0], ends[1]), PANELS, |x| (ln_integrand(x) - top).exp());
    let sum: f64 = breaks.windows(2).map(integral).sum();
    sum * top.exp()
}

fn perfectly_correlated(h: f64, k: f64, correlation: f64) -> f64 {
    if correlation > 0.0 {
        return cdf(-h);
    }
    // h < X < -k, on the side where both tails are small.
    if h >= -k {
        return 0.0;
    }
    if h > 0.0 { cdf(-h) - cdf(k) } else { cdf(-k) - cdf(h) }
}

/// The place of the maximum of a concave function on `x >= least`, by golden section.
fn maximum(f: &impl Fn(f64) -> f64, least: f64) -> f64 {
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    let (mut left, mut right) = (least, least.max(0.0) + 40.0);
    while right - left > 1e-3 {
        let (a, b) = (right - GOLDEN * (right - left), left + GOLDEN * (right - left));
        if f(a) >= f(b) {
            right = b;
        } else {
            left = a;
        }
    }
    if f(least) >= f(left) { least } else { left }
}

/// The boundary of the significant region between a point inside and one outside.
fn boundary(counts: &impl Fn(f64) -> bool, inside: f64, outside: f64) -> f64 {
    let (mut inside, mut outside) = (inside, outside);
    for _ in 0..40 {
        let middle = 0.5 * (inside + outside);
        if counts(middle) {
            inside = middle;
        } else {
            outside = middle;
        }
    }
    outside
}

#[cfg(test)]
mod tests {
    use super::*;

    fn close(a: f64, b: f64, tolerance: f64) {
        assert!((a / b - 1.0).abs() < tolerance, "{a} {b}");
    }

    #[test]
    fn closed_forms() {
        for r in [-0.999999, -0.7, -1e-3, 0.0, 0.3, 0.95, 0.9999999] {
            let sheppard = 0.25 + f64::asin(r) / (2.0 * PI);
            close(both_above(0.0, 0.0, r), sheppard, 1e-11);
            // Both ways of splitting P(X > h).
            for (h, k) in [(0.5, -1.0), (2.0, 1.0), (3.0, 3.0)] {
                let whole = both_above(h, k, r) + both_above(h, -k, -r);
                close(whole, cdf(-h), 1e-11);
            }
        }
        let tails = |h: f64, k: f64| cdf(-h) * cdf(-k);
        for (h, k) in [(1.0, 2.0), (6.0, 5.0), (20.0, 10.0)] {
            close(both_above(h, k, 0.0), tails(h, k), 1e-11);
        }
    }

    #[test]
    fn perfect_correlation() {
        close(both_above(3.0, 2.0, 1.0), cdf(-3.0), 1e-15);
        assert_eq!(both_above(1.0, 1.0, -1.0), 0.0);
        let between = cdf(-1.0) - cdf(-2.0);
        close(both_above(1.0, -2.0, -1.0), between, 1e-12);
        for h in [-2.0, 0.0, 4.0] {
            close(both_above(h, h - 1e-3, 1.0 - 1e-14), cdf(-h), 1e-7);
        }
    }

    /// The derivative of the probability with respect to the correlation is the bivariate density (Plackett 1954),
    /// integrated here from zero correlation.
    #[test]
    fn plackett() {
        for (h, k, r) in [(2.5, 1.5, 0.6), (4.0, 5.0, -0.4), (5.0, 5.0, 0.8_f64)] {
            let density = |r: f64| {
                let q = 1.0 - r * r;
                (-(h * h - 2.0 * r * h * k + k * k) / (2.0 * q)).exp() / (2.0 * PI * q.sqrt())
            };
            let from_independent = composite((0.0, r), 40, density);
            let expected = cdf(-h) * cdf(-k) + from_independent;
            close(both_above(h, k, r), expected, 1e-7);
        }
    }
}
