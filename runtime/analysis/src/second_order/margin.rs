//! Safety margin against forbidden bands: the probability that tolerances bring a quantity into them, and its
//! derivatives.

use super::probability::{Probability, check_interval};
use super::quadratic::Quadratic;
use crate::Error;
use crate::algebra::{Vector, all_finite, dot};
use crate::second_order::distribution::normal_cdf::density;
use crate::tolerance::Tolerances;

/// Margin of a quantity against forbidden bands that do not overlap, in units of the quantity.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Margin {
    /// Nominal value.
    #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
    pub value: f64,
    /// First-order standard deviation.
    #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
    pub sigma: f64,
    /// Distance of the first-order mean from the nearest end of a band, in standard deviations: negative inside,
    /// infinite if nothing varies.
    #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
    pub distance: f64,
    /// First-order probability of the bands; for normal variables, that of a normal distribution.
    pub first_order: f64,
    /// Probability of the bands from the second-order model ([`Quadratic::probability`]), with the error of that model
    /// in a `requirement::SecondOrderFailure`.
    pub corrected: Probability,
    /// Derivatives of the first-order probability. `None` if nothing varies, if variables are not normal, or if a
    /// derivative exceeds the range of a double.
    pub derivatives: Option<MarginDerivatives>,
}

/// Derivatives of the first-order probability of bands.
///
/// The derivatives with respect to mean, sigma and band ends are exact for a normal distribution, those with respect to
/// half-widths for the first-order model. Those with respect to design variables are exact for the first-order
/// probability as a function of the nominal design, because slopes and curvature are total derivatives and half-widths
/// are held fixed; for a half-width that follows its nominal value (a tolerance in percent), add `by_half_width` times
/// the derivative of the half-width.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct MarginDerivatives {
    /// With respect to the mean.
    pub by_mean: f64,
    /// With respect to the standard deviation.
    pub by_sigma: f64,
    /// With respect to low ends that move together; an infinite one does not.
    pub by_low: f64,
    /// With respect to high ends that move together.
    pub by_high: f64,
    /// With respect to the nominal value of each design variable, with half-widths and bands fixed:
    /// `dP/dmean S + dP/dsigma H Sigma S / sigma`.
    pub by_design: Vector,
    /// With respect to each half-width, with correlation and sigma level fixed.
    pub by_half_width: Vector,
}

impl MarginDerivatives {
    /// Derivative along anything that moves mean, standard deviation, low end and high end at these rates.
    ///
    /// For the running speed `u` and the band `[0.9 u, 1.1 u]` the rates are `dmean/du`, `dsigma/du`, `0.9` and `1.1`.
    #[must_use]
    pub fn along(&self, mean: f64, sigma: f64, low: f64, high: f64) -> f64 {
        self.by_mean * mean + self.by_sigma * sigma + self.by_low * low + self.by_high * high
    }
}

/// Margin of `quadratic` against forbidden `bands` (low and high end; either may be infinite), which must not overlap.
///
/// # Errors
/// [`Error::NotFinite`] for a model that is not finite, [`Error::WrongLength`] if the model and the tolerances differ
/// in the number of design variables, [`Error::Setting`] for a band whose ends are NaN or in the wrong order, or a
/// spread beyond the range of a double.
pub fn margin(quadratic: &Quadratic, tolerances: &Tolerances, bands: &[(f64, f64)]) -> Result<Margin, Error> {
    bands.iter().copied().try_for_each(check_interval)?;
    let sigma = quadratic.sigma(tolerances)?;
    let value = quadratic.value;
    let mean = value + tolerances.mean_shift(&quadratic.slopes);
    let mut first_order = 0.0;
    let mut corrected = Probability::default();
    for band in bands {
        first_order += quadratic.probability_first_order(tolerances, *band)?;
        corrected = corrected + quadratic.probability(tolerances, *band)?;
    }
    let distances = bands.iter().map(|band| distance(mean, sigma, *band));
    Ok(Margin {
        value,
        sigma,
        distance: distances.fold(f64::INFINITY, f64::min),
        first_order,
        corrected,
        derivatives: (tolerances.is_normal())
            .then(|| derivatives(quadratic, tolerances, (mean, sigma), bands))
            .flatten(),
    })
}

fn distance(value: f64, sigma: f64, (low, high): (f64, f64)) -> f64 {
    let outside = (low - value).max(value - high);
    if outside == 0.0 { 0.0 } else { outside / sigma }
}

fn derivatives(
    quadratic: &Quadratic,
    tolerances: &Tolerances,
    (mean, sigma): (f64, f64),
    bands: &[(f64, f64)],
) -> Option<MarginDerivatives> {
    if sigma == 0.0 {
        return None;
    }
    // The density and its moment.
    let at = |end: f64| {
        let z = (end - mean) / sigma;
        let height = density(z);
        // z density(z) vanishes at infinity.
        let moment = if height > 0.0 { z * height } else { 0.0 };
        (height / sigma, moment / sigma)
    };
    let sum = |(a, b): (f64, f64), (c, d): (f64, f64)| (a + c, b + d);
    let at_low = bands.iter().map(|band| at(band.0)).fold((0.0, 0.0), sum);
    let at_high = bands.iter().map(|band| at(band.1)).fold((0.0, 0.0), sum);
    let by_mean = at_low.0 - at_high.0;
    let by_sigma = at_low.1 - at_high.1;
    let (sigma_by_design, sigma_by_half_width) = sigma_derivatives(quadratic, tolerances, sigma);
    let margin_derivatives = MarginDerivatives {
        by_mean,
        by_sigma,
        by_low: -at_low.0,
        by_high: at_high.0,
        by_design: (quadratic.slopes.iter().zip(&sigma_by_design))
            .map(|(mean, sigma)| by_mean * mean + by_sigma * sigma)
            .collect(),
        by_half_width: sigma_by_half_width.map(|slope| by_sigma * slope),
    };
    let finite = all_finite(&[by_mean, by_sigma, margin_derivatives.by_low, margin_derivatives.by_high])
        && all_finite(&margin_derivatives.by_design)
        && all_finite(&margin_derivatives.by_half_width);
    finite.then_some(margin_derivatives)
}

/// Derivatives of `sigma = sqrt(S Sigma S^T)` with respect to the nominal design, `H Sigma S / sigma`, and to the
/// half-widths.
fn sigma_derivatives(quadratic: &Quadratic, tolerances: &Tolerances, sigma: f64) -> (Vector, Vector) {
    let Quadratic { slopes, curvature, .. } = quadratic;
    let sigmas = tolerances.sigmas();
    let n = sigmas.len();
    let parts = Vector::from_fn(n, |k| (slopes[k] / sigma) * sigmas[k]);
    let weighted = tolerances.correlated(&parts);
    let covariances = Vector::from_fn(n, |k| sigmas[k] * weighted[k]);
    let by_design = Vector::from_fn(n, |k| {
        let row = Vector::from_fn(n, |j| 0.5 * curvature[k][j] + 0.5 * curvature[j][k]);
        dot(&row, &covariances)
    });
    let by_half_width = Vector::from_fn(n, |k| slopes[k] * weighted[k] / tolerances.sigma_level());
    (by_design, by_half_width)
}
