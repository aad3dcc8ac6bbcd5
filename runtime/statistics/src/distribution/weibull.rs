//! Moments of the Weibull distribution with unit scale.

use statrs::function::gamma::ln_gamma;

use crate::Error;

const SHAPES: std::ops::RangeInclusive<f64> = 0.05..=1e8;

/// Mean and standard deviation.
pub(super) fn unit_moments(shape: f64) -> Result<(f64, f64), Error> {
    if !SHAPES.contains(&shape) {
        return Err(Error::setting(
            "shape of a Weibull variable",
            format!("{shape} must lie between {} and {:e}", SHAPES.start(), SHAPES.end()),
        ));
    }
    let mean = ln_gamma(1.0 + 1.0 / shape).exp();
    Ok((mean, mean * log_ratio(shape).exp_m1().sqrt()))
}

/// The shape for which the standard deviation is this fraction of the mean.
pub(super) fn shape(variation: f64) -> Result<f64, Error> {
    let target = (variation * variation).ln_1p();
    let (mut low, mut high) = (SHAPES.start().ln(), SHAPES.end().ln());
    let beyond = |from: f64, to: f64| {
        Error::setting(
            "standard deviation of a Weibull variable",
            format!("{variation} of the mean must lie between {from:.1e} and {to:.1e} of it"),
        )
    };
    let ratio = |log_shape: f64| log_ratio(log_shape.exp());
    if !(ratio(high)..=ratio(low)).contains(&target) {
        let of = |log_shape| f64::exp_m1(ratio(log_shape)).sqrt();
        return Err(beyond(of(high), of(low)));
    }
    // The ratio decreases as the shape grows.
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            break;
        }
        if ratio(middle) > target {
            low = middle;
        } else {
            high = middle;
        }
    }
    Ok((0.5 * (low + high)).exp())
}

/// `ln (E X^2 / (E X)^2) = ln Gamma(1 + 2 e) - 2 ln Gamma(1 + e)` with `e = 1 / shape`, from the series of `ln Gamma`
/// where the two nearly cancel: `sum zeta(n) (-e)^n (2^n - 2) / n`, `n` from 2.
fn log_ratio(shape: f64) -> f64 {
    let e = 1.0 / shape;
    if e > 0.1 {
        return ln_gamma(1.0 + 2.0 * e) - 2.0 * ln_gamma(1.0 + e);
    }
    let mut sum = 0.0;
    let mut power = -e;
    for n in 2..40_u32 {
        power *= -e;
        sum += zeta(n) * power * (2.0_f64.powi(n as i32) - 2.0) / f64::from(n);
    }
    sum
}

/// Riemann's zeta function for an integer of at least 2: a partial sum with an Euler-Maclaurin tail.
fn zeta(n: u32) -> f64 {
    const FIRST: i32 = 40;
    let s = f64::from(n);
    let head: f64 = (1..FIRST).map(|k| f64::from(k).powf(-s)).sum();
    let last = f64::from(FIRST);
    let end = last.powf(-s);
    let corrections = s / (12.0 * last) - s * (s + 1.0) * (s + 2.0) / (720.0 * last.powi(3))
        + s * (s + 1.0) * (s + 2.0) * (s + 3.0) * (s + 4.0) / (30240.0 * last.powi(5));
    head + end * (last / (s - 1.0) + 0.5 + corrections)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn zeta_of_integers() {
        let exact = [
            (2, std::f64::consts::PI.powi(2) / 6.0),
            (3, 1.202_056_903_159_594_2),
            (4, std::f64::consts::PI.powi(4) / 90.0),
            (10, 1.000_994_575_127_818_1),
        ];
        for (n, value) in exact {
            assert!((zeta(n) - value).abs() < 1e-14, "{n}");
        }
    }

    #[test]
    fn both_forms_of_the_ratio_agree() {
        for shape in [10.1, 12.0, 20.0] {
            let e = 1.0 / shape;
            let direct = ln_gamma(1.0 + 2.0 * e) - 2.0 * ln_gamma(1.0 + e);
            assert!((log_ratio(shape) / direct - 1.0).abs() < 1e-11);
        }
    }
}
