//! A quantity known to second order in normally distributed design variables, and its moments.

use crate::algebra::{Matrix, Vector};
use crate::tolerance::Tolerances;
use crate::{Error, Text};

/// Second-order model `f(b0 + x) = value + S x + x^T H x / 2` of a quantity, `x ~ N(0, Sigma)`.
///
/// Slopes and curvature are total derivatives: they follow the equilibrium. All in SI units.
#[derive(Clone, Debug, PartialEq)]
pub struct Quadratic {
    /// Nominal value.
    pub value: f64,
    /// Derivatives `S` by the design variables.
    pub slopes: Vector,
    /// Second derivatives `H`; only the symmetric part counts.
    pub curvature: Matrix,
}

/// Moments of a second-order model; exact for the model.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct ModelMoments {
    /// Mean `f0 + tr(H Sigma) / 2`.
    pub mean: f64,
    /// Mean less nominal value, `tr(H Sigma) / 2`, not rounded against the value.
    pub mean_shift: f64,
    /// First-order standard deviation `sqrt(S Sigma S^T)`.
    pub first_order_sigma: f64,
    /// What curvature alone adds, `sqrt(tr((H Sigma)^2) / 2)`.
    pub curvature_sigma: f64,
    /// Standard deviation `sqrt(S Sigma S^T + tr((H Sigma)^2) / 2)`.
    pub sigma: f64,
    /// Third central moment over `sigma^3`; zero when nothing varies.
    pub skewness: f64,
    /// Fourth central moment over `sigma^4`, less the 3 of a normal distribution; zero when nothing varies.
    pub excess_kurtosis: f64,
}

impl Quadratic {
    /// Refuses what is NaN or infinite, or does not belong to these tolerances.
    pub(super) fn check(&self, tolerances: &Tolerances) -> Result<(), Error> {
        for count in [
            self.slopes.len(),
            self.curvature.row_count(),
            self.curvature.column_count(),
        ] {
            tolerances.check_count(count)?;
        }
        let parts = [
            ("value", core::slice::from_ref(&self.value)),
            ("slopes", &self.slopes),
            ("curvature", self.curvature.as_flattened()),
        ];
        for (name, numbers) in parts {
            if let Some(&value) = numbers.iter().find(|number| !number.is_finite()) {
                return Err(Error::NotFinite {
                    kind: "second-order model",
                    name: Text::Static(name),
                    value,
                });
            }
        }
        Ok(())
    }
}

pub(super) fn beyond_range() -> Error {
    Error::Setting {
        setting: "tolerance",
        reason: "it spreads the quantity beyond the range of a double".to_owned(),
    }
}
