//! Estimates of a probability, and confidence intervals from a number of samples.

use statrs::function::beta::checked_beta_reg;

use crate::Error;
use crate::normal::quantile;

/// An estimate with its standard error.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Estimate {
    /// The estimate.
    pub value: f64,
    /// Its estimated standard deviation over repetitions with other seeds.
    pub standard_error: f64,
}

/// An interval of probabilities.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Interval {
    /// Its lower end.
    pub lower: f64,
    /// Its upper end.
    pub upper: f64,
}

/// The score interval (Wilson 1927, *Probable inference, the law of succession, and statistical inference*): covers the
/// probability with approximately the given confidence.
///
/// # Errors
///
/// If there are no samples, more failures than samples, or if the confidence is not inside (0, 1).
pub fn wilson(failures: u64, samples: u64, confidence: f64) -> Result<Interval, Error> {
    check(failures, samples, confidence)?;
    let z = quantile(0.5 + 0.5 * confidence);
    let n = samples as f64;
    let p = failures as f64 / n;
    let centre = p + z * z / (2.0 * n);
    let half = z * (p * (1.0 - p) / n + z * z / (4.0 * n * n)).sqrt();
    let part = 1.0 + z * z / n;
    let lower = if failures == 0 { 0.0 } else { (centre - half) / part };
    let upper = if failures == samples { 1.0 } else { (centre + half) / part };
    Ok(Interval { lower, upper })
}

/// The exact interval (Clopper and Pearson 1934, *The use of confidence or fiducial limits*): covers the probability
/// with at least the given confidence, even if nothing failed.
///
/// # Errors
///
/// Those of [`wilson`].
///
/// # Examples
///
/// ```
/// use eigentol_statistics::reliability::sampling::clopper_pearson;
///
/// // The rule of three: nothing in a thousand failed.
/// let interval = clopper_pearson(0, 1000, 0.90)?;
/// assert!((interval.upper - 3.0 / 1000.0).abs() < 1e-5);
/// # Ok::<(), eigentol_statistics::Error>(())
/// ```
pub fn clopper_pearson(failures: u64, samples: u64, confidence: f64) -> Result<Interval, Error> {
    check(failures, samples, confidence)?;
    let tail = 0.5 * (1.0 - confidence);
    let (k, n) = (failures as f64, samples as f64);
    let lower = if failures == 0 { 0.0 } else { beta_quantile(k, n - k + 1.0, tail)? };
    let upper = if failures == samples { 1.0 } else { 1.0 - beta_quantile(n - k, k + 1.0, tail)? };
    Ok(Interval { lower, upper })
}

fn check(failures: u64, samples: u64, confidence: f64) -> Result<(), Error> {
    let (setting, reason) = if samples == 0 || failures > samples {
        ("failures", format!("{failures} of {samples} samples"))
    } else if !(confidence > 0.0 && confidence < 1.0) {
        ("confidence", format!("{confidence} is not inside (0, 1)"))
    } else {
        return Ok(());
    };
    Err(Error::setting(setting, reason))
}

/// Quantile of the beta distribution, by bisection of its distribution function.
fn beta_quantile(a: f64, b: f64, probability: f64) -> Result<f64, Error> {
    let (mut left, mut right) = (0.0_f64, 1.0_f64);
    loop {
        let middle = 0.5 * (left + right);
        if middle <= left || middle >= right {
            return Ok(middle);
        }
        let below = checked_beta_reg(a, b, middle).map_err(|error| Error::setting("failures", error.to_string()))?;
        if below < probability {
            left = middle;
        } else {
            right = middle;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Nothing failed: `(1 - upper)^n = tail`; everything failed: the mirror image.
    #[test]
    fn exact_ends() {
        for n in [1, 7, 1000, 10_000_000] {
            let none = clopper_pearson(0, n, 0.95).unwrap();
            let expected = -(0.025_f64.ln() / n as f64).exp_m1();
            assert_eq!(none.lower, 0.0);
            assert!((none.upper / expected - 1.0).abs() < 1e-8, "{n}: {none:?} {expected}");
            let all = clopper_pearson(n, n, 0.95).unwrap();
            assert_eq!(all.upper, 1.0);
            assert!((all.lower + none.upper - 1.0).abs() < 1e-12);
        }
    }

    /// The Clopper-Pearson interval of 10 in 100 by its definition: binomial tails of 2.5 %.
    #[test]
    fn binomial_tails() {
        let Interval { lower, upper } = clopper_pearson(10, 100, 0.95).unwrap();
        let mass = |p: f64, k: u64| {
            let choose: f64 = (0..k).map(|i| (100 - i) as f64 / (i + 1) as f64).product();
            choose * p.powf(k as f64) * (1.0 - p).powf((100 - k) as f64)
        };
        let at_least: f64 = 1.0 - (0..10).map(|k| mass(lower, k)).sum::<f64>();
        let at_most: f64 = (0..=10).map(|k| mass(upper, k)).sum();
        assert!((at_least - 0.025).abs() < 1e-9, "{at_least}");
        assert!((at_most - 0.025).abs() < 1e-9, "{at_most}");
    }

    /// Wilson's ends solve `(p - k/n)^2 = z^2 p (1 - p) / n`.
    #[test]
    fn wilson_solves_its_equation() {
        let z = 1.959963984540054_f64;
        for (k, n) in [(0, 10), (3, 10), (10, 10), (1, 100_000)] {
            let Interval { lower, upper } = wilson(k, n, 0.95).unwrap();
            assert!(lower < upper);
            for p in [lower, upper] {
                let (k, n) = (k as f64, n as f64);
                let off = (p - k / n).powi(2) - z * z * p * (1.0 - p) / n;
                assert!(off.abs() < 1e-14, "{p} {off}");
            }
        }
    }

    #[test]
    fn nonsense_is_refused() {
        assert!(wilson(1, 0, 0.9).is_err());
        assert!(clopper_pearson(3, 2, 0.9).is_err());
        assert!(wilson(1, 2, 1.0).is_err());
        assert!(wilson(1, 2, f64::NAN).is_err());
    }
}
