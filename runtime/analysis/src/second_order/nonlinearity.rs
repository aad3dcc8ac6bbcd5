//! Whether first order can be trusted: its error, estimated by the second-order model.

use super::quadratic::{ModelMoments, Quadratic};
use crate::Error;
use crate::tolerance::Tolerances;

/// Second-order terms in units of the first-order standard deviation; both are small where first order holds.
///
/// They measure the curvature at the nominal design, not the terms beyond second order. Near a critical state the
/// series does not converge; there, use the distance to it in standard deviations.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Nonlinearity {
    /// Shift of the mean, `|tr(H Sigma) / 2| / sigma`.
    #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
    pub mean_shift: f64,
    /// Standard deviation added by curvature, `sqrt(tr((H Sigma)^2) / 2) / sigma`.
    #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
    pub spread: f64,
}

impl Nonlinearity {
    /// Relative error of the first-order standard deviation with respect to the second-order model,
    /// `1 - 1 / sqrt(1 + spread^2)`.
    #[must_use]
    pub fn sigma_error(&self) -> f64 {
        let ratio = 1.0_f64.hypot(self.spread);
        // 1 - 1 / ratio without cancellation.
        if ratio.is_finite() { self.spread / ratio * (self.spread / (1.0 + ratio)) } else { 1.0 }
    }

    /// The larger of the two ratios.
    #[must_use]
    pub fn largest(&self) -> f64 {
        self.mean_shift.max(self.spread)
    }
}

impl Quadratic {
    /// Second-order terms relative to first order: infinite if only second order has a spread, zero if nothing varies.
    ///
    /// # Errors
    /// As [`moments`](Self::moments).
    pub fn nonlinearity(&self, tolerances: &Tolerances) -> Result<Nonlinearity, Error> {
        Ok(self.moments(tolerances)?.nonlinearity())
    }
}

impl ModelMoments {
    /// Second-order terms relative to first order ([`Quadratic::nonlinearity`]).
    #[must_use]
    pub fn nonlinearity(&self) -> Nonlinearity {
        let ratio = |part: f64| {
            if part == 0.0 { 0.0 } else { part.abs() / self.first_order_sigma }
        };
        Nonlinearity { mean_shift: ratio(self.mean_shift), spread: ratio(self.curvature_sigma) }
    }
}
