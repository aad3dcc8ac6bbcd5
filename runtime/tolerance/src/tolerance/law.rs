//! Declared tolerances as distributions.

use eigentol_statistics::Distribution;

use crate::Error;
use crate::mechanism::{Law, ToleranceInfo};

/// The distribution of a variable with this value and tolerance, SI.
///
/// # Errors
/// [`Error::Setting`] for limits that are not finite or in the wrong order, a sigma level that is not positive, and
/// parameters that the distribution refuses.
pub fn distribution(value: f64, tolerance: &ToleranceInfo, sigma_level: f64) -> Result<Distribution, Error> {
    let size = if tolerance.relative { value.abs() } else { 1.0 };
    let (lower, upper) = (tolerance.lower * size, tolerance.upper * size);
    if !(lower <= upper && (upper - lower).is_finite()) && lower != -upper {
        return Err(Error::setting(
            "tolerance",
            format!("limits {lower} and {upper} must be finite, the lower one first"),
        ));
    }
    let half_width = 0.5 * (upper - lower);
    let sigma = standard_deviation(half_width, sigma_level)?;
    let middle = value + 0.5 * (lower + upper);
    let (low, high) = (value + lower, value + upper);
    Ok(match &tolerance.law {
        _ if half_width == 0.0 => Distribution::constant(middle),
        Law::Normal => Distribution::normal(middle, sigma),
        Law::Lognormal => Distribution::lognormal(middle, sigma),
        Law::Weibull => Distribution::weibull_by_moments(middle, sigma),
        Law::TruncatedNormal => Distribution::truncated_normal(middle, sigma, (low, high)),
        Law::Uniform => Distribution::uniform(low, high),
        Law::Triangular => Distribution::triangular(low, middle, high),
        Law::Beta { alpha, beta } => Distribution::beta((*alpha, *beta), (low, high)),
        Law::OneOf(values) => {
            if let Some((fraction, _)) = values.iter().find(|(fraction, _)| !(0.0..=1.0).contains(fraction)) {
                return Err(Error::setting(
                    "place of a value",
                    format!("{fraction} is not between 0, the lower limit, and 1, the upper one"),
                ));
            }
            let value = |fraction: f64| {
                if fraction == 1.0 { high } else { low + fraction * (high - low) }
            };
            let values: Vec<(f64, f64)> = values.iter().map(|&(fraction, weight)| (value(fraction), weight)).collect();
            Distribution::discrete(&values)
        }
    }?)
}

/// The standard deviation, from a half-width that spans `sigma_level` of them.
pub(super) fn standard_deviation(half_width: f64, sigma_level: f64) -> Result<f64, Error> {
    let refuse = |setting, reason| Err(Error::setting(setting, reason));
    if !(0.0..=f64::MAX).contains(&half_width) {
        let reason = format!("half-width {half_width} must be zero or positive");
        return refuse("tolerance", reason);
    }
    if !(sigma_level > 0.0 && sigma_level.is_finite()) {
        return refuse("sigma level", format!("{sigma_level} must be positive"));
    }
    let sigma = half_width / sigma_level;
    if !sigma.is_finite() {
        let reason = format!("{sigma_level} makes the standard deviation of half-width {half_width} infinite");
        return refuse("sigma level", reason);
    }
    Ok(sigma)
}
