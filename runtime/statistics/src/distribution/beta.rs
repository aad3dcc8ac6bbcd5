//! The beta distribution on the unit interval.

use statrs::function::beta::{beta_reg, ln_beta};

use crate::{Error, normal};

/// Shapes for which the incomplete beta function of statrs is accurate to at least nine digits.
const SHAPES: std::ops::RangeInclusive<f64> = 0.05..=1000.0;

pub(super) fn check(shape: f64) -> Result<(), Error> {
    if SHAPES.contains(&shape) {
        return Ok(());
    }
    Err(Error::setting(
        "shape of a beta distribution",
        format!("{shape} must lie between {} and {}", SHAPES.start(), SHAPES.end()),
    ))
}

/// The `x` with the same probability below it as the standard normal `z`; if the flag is set, `1 - x` instead.
/// Whichever is known to more digits is returned.
pub(super) fn quantile((alpha, beta): (f64, f64), z: f64) -> (f64, bool) {
    let half = beta_reg(alpha, beta, 0.5);
    let probability = normal::cdf(z);
    if probability < half {
        (lower(alpha, beta, probability), false)
    } else {
        (lower(beta, alpha, normal::cdf(-z)), true)
    }
}

/// `dx/dz`.
pub(super) fn slope((alpha, beta): (f64, f64), z: f64) -> f64 {
    let (ln_x, ln_rest) = match quantile((alpha, beta), z) {
        (x, false) => (x.ln(), (-x).ln_1p()),
        (rest, true) => ((-rest).ln_1p(), rest.ln()),
    };
    let ln_density = (alpha - 1.0) * ln_x + (beta - 1.0) * ln_rest - ln_beta(alpha, beta);
    let ln_normal = normal::density(0.0).ln() - 0.5 * z * z;
    // Where the quantile underflows, it is constant.
    let slope = (ln_normal - ln_density).exp();
    if slope.is_finite() { slope } else { 0.0 }
}

/// The quantile in the lower half of the interval: Newton's method on the logarithms of both sides, whose graph is
/// nearly straight there, safeguarded by bisection.
fn lower(alpha: f64, beta: f64, probability: f64) -> f64 {
    if probability == 0.0 {
        return 0.0;
    }
    let scale = ln_beta(alpha, beta);
    let target = probability.ln();
    // The leading term of the series is exact in the tail.
    let start = (target + alpha.ln() + scale) / alpha;
    let (mut low, mut high) = (start.min(-745.0), 0.5_f64.ln());
    let mut log_x = start.min(high);
    for _ in 0..200 {
        let x = log_x.exp();
        let below = beta_reg(alpha, beta, x);
        if below <= 0.0 {
            // The distribution function underflows: use the series.
            return start.exp();
        }
        let gap = below.ln() - target;
        if gap > 0.0 {
            high = log_x;
        } else {
            low = log_x;
        }
        let log_density = alpha * log_x + (beta - 1.0) * (-x).ln_1p() - scale;
        let step = gap * (below.ln() - log_density).exp();
        let next = log_x - step;
        let next = if next > low && next < high { next } else { 0.5 * (low + high) };
        if (next - log_x).abs() <= 2e-16 * log_x.abs().max(1.0) {
            return next.exp();
        }
        log_x = next;
    }
    log_x.exp()
}
