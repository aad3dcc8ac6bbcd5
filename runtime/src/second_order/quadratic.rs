//! A quantity known to second order in the design variables, and its moments.

use std::borrow::Cow;

use crate::algebra::{Matrix, Vector, dot};
use crate::tolerance::Tolerances;
use crate::{Error, Text};

/// Second-order model `f(b0 + x) = value + S x + x^T H x / 2` of a quantity, `x` distributed as the tolerances say.
///
/// Slopes and curvature are total derivatives: they follow the equilibrium. All in SI units.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Quadratic {
    /// Nominal value.
    pub value: f64,
    /// Derivatives `S` by the design variables.
    pub slopes: Vector,
    /// Second derivatives `H`; only the symmetric part counts.
    pub curvature: Matrix,
}

/// Moments of a second-order model. Exact for the model where the variables are jointly normal. Mean and first-order standard deviation are
/// exact whatever their distribution; the others then are those of 32,768 quasi-random points, standard deviations to about four
/// digits.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ModelMoments {
    /// Mean `f(b0 + d) + tr(H Sigma) / 2`, `d` what the means of the variables differ from `b0` by.
    #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
    pub mean: f64,
    /// What spread adds to the mean, `tr(H Sigma) / 2`, not rounded against the value.
    #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
    pub mean_shift: f64,
    /// First-order standard deviation `sqrt(S Sigma S^T)`.
    #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
    pub first_order_sigma: f64,
    /// What curvature alone adds, `sqrt(tr((H Sigma)^2) / 2)`; of variables that are not normal, in which curvature also acts with
    /// their skewness, the root of how much the variances with and without it differ.
    #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
    pub curvature_sigma: f64,
    /// Standard deviation; of normal variables `sqrt(S Sigma S^T + tr((H Sigma)^2) / 2)`, `S` at their means.
    #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
    pub sigma: f64,
    /// Third central moment over `sigma^3`; zero when nothing varies.
    #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
    pub skewness: f64,
    /// Fourth central moment over `sigma^4`, less the 3 of a normal distribution; zero when nothing varies.
    #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
    pub excess_kurtosis: f64,
}

impl Quadratic {
    /// What a change of the variables adds to the value.
    pub(crate) fn change(&self, x: &[f64]) -> f64 {
        let bent = self.curvature.iter().map(|row| dot(row, x));
        let parts = x.iter().zip(&self.slopes).zip(bent);
        parts.fold(0.0, |sum, ((x, slope), bent)| {
            sum + x * (slope + 0.5 * bent)
        })
    }

    /// The same model about the means of the variables.
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
