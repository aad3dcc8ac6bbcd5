//! A quantity known to second order in the design variables, and its moments.

use std::borrow::Cow;

use crate::algebra::{Matrix, Vector, dot};
use crate::tolerance::Tolerances;
use crate::{Error, Text};

/// Second-order model `f(b0 + x) = value + S x + x^T H x / 2` of a quantity, with `x` distributed according to the
/// tolerances.
///
/// Slopes and curvature are total derivatives: they include the motion of the equilibrium. All in SI units.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Quadratic {
    /// Nominal value.
    pub value: f64,
    /// Derivatives `S` with respect to the design variables.
    pub slopes: Vector,
    /// Second derivatives `H`; only the symmetric part matters.
    pub curvature: Matrix,
}

/// Moments of a second-order model.
///
/// They are exact for the model if the variables are jointly normal. Mean and first-order standard deviation are exact
/// for any distribution; otherwise the remaining moments are those of 32,768 quasi-random points, with standard
/// deviations accurate to about four digits.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ModelMoments {
    /// Mean `f(b0 + d) + tr(H Sigma) / 2`, where `d` is the deviation of the variables' means from `b0`.
    #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
    pub mean: f64,
    /// Shift of the mean due to spread, `tr(H Sigma) / 2`, without rounding against the value.
    #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
    pub mean_shift: f64,
    /// First-order standard deviation `sqrt(S Sigma S^T)`, with `S` at the means of the variables.
    #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
    pub first_order_sigma: f64,
    /// Contribution of curvature alone, `sqrt(tr((H Sigma)^2) / 2)`. For variables that are not normal, where curvature
    /// also interacts with their skewness, it is the root of the difference between the variances with and without
    /// curvature.
    #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
    pub curvature_sigma: f64,
    /// Standard deviation; for normal variables `sqrt(S Sigma S^T + tr((H Sigma)^2) / 2)`, with `S` at their means.
    #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
    pub sigma: f64,
    /// Third central moment over `sigma^3`; zero if nothing varies.
    #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
    pub skewness: f64,
    /// Fourth central moment over `sigma^4`, minus the 3 of a normal distribution; zero if nothing varies.
    #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
    pub excess_kurtosis: f64,
}

impl Quadratic {
    /// Change of the value for a change `x` of the variables.
    #[doc(hidden)]
    pub fn change(&self, x: &[f64]) -> f64 {
        let bent = self.curvature.iter().map(|row| dot(row, x));
        x.iter().zip(&self.slopes).zip(bent).fold(0.0, |sum, ((x, slope), bent)| sum + x * (slope + 0.5 * bent))
    }

    /// The same model expanded about the means of the variables.
    pub(super) fn about_means(&self, tolerances: &Tolerances) -> Cow<'_, Self> {
        let shifts = tolerances.shifts();
        if shifts.iter().all(|shift| *shift == 0.0) {
            return Cow::Borrowed(self);
        }
        let n = self.slopes.len();
        let steeper = |i: usize| {
            let symmetric = |j: usize| 0.5 * self.curvature[i][j] + 0.5 * self.curvature[j][i];
            (0..n).fold(self.slopes[i], |sum, j| sum + symmetric(j) * shifts[j])
        };
        Cow::Owned(Self {
            value: self.value + self.change(shifts),
            slopes: Vector::from_fn(n, steeper),
            curvature: self.curvature.clone(),
        })
    }

    /// Rejects a model that is not finite or does not match the tolerances.
    pub(super) fn check(&self, tolerances: &Tolerances) -> Result<(), Error> {
        for count in [self.slopes.len(), self.curvature.row_count(), self.curvature.column_count()] {
            tolerances.check_count(count)?;
        }
        let parts = [
            ("value", core::slice::from_ref(&self.value)),
            ("slopes", &self.slopes),
            ("curvature", self.curvature.as_flattened()),
        ];
        for (name, numbers) in parts {
            if let Some(&value) = numbers.iter().find(|number| !number.is_finite()) {
                return Err(Error::NotFinite { kind: "second-order model", name: Text::Static(name), value });
            }
        }
        Ok(())
    }
}

pub(super) fn beyond_range() -> Error {
    Error::setting("tolerance", "it spreads the quantity beyond the range of a double")
}
