//! Half-widths, the number of standard deviations they hold, and how variables vary together.

use crate::array::{dot, largest, times};
use crate::{Description, Error};

/// Tolerances of the `P` design variables.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerances<const P: usize> {
    half_widths: [f64; P],
    sigma_level: f64,
    deviations: [f64; P],
    correlation: Option<[[f64; P]; P]>,
    /// Lower factor of the covariance matrix.
    factor: [[f64; P]; P],
}

impl<const P: usize> Tolerances<P> {
    /// The declared half-widths, three standard deviations each, independent of each other.
    ///
    /// # Errors
    /// [`Error::Setting`] when a declared half-width is negative or not finite.
    pub fn declared(description: &Description) -> Result<Self, Error> {
        let half_widths =
            core::array::from_fn(|j| description.design.get(j).map_or(0.0, |info| info.tolerance));
        Self::new(half_widths, 3.0, None)
    }

    /// Half-widths in SI units that hold `sigma_level` standard deviations; `correlation` couples the variables,
    /// `None` leaves them independent.
    ///
    /// # Errors
    /// [`Error::Setting`] for a negative or infinite half-width, a level that is not positive or too small, or a correlation matrix
    /// that is not symmetric and positive semidefinite with ones on its diagonal.
    #[inline]
    pub fn new(
        half_widths: [f64; P],
        sigma_level: f64,
        correlation: Option<[[f64; P]; P]>,
    ) -> Result<Self, Error> {
        if let Some(&value) = half_widths
            .iter()
            .find(|&&value| !(0.0..=f64::MAX).contains(&value))
        {
            return Err(refuse(
                "tolerance",
                format!("half-width {value} must be zero or positive"),
            ));
        }
        if !(sigma_level > 0.0 && sigma_level.is_finite()) {
            return Err(refuse(
                "sigma level",
                format!("{sigma_level} must be positive"),
            ));
        }
        if let Some(&value) = half_widths
            .iter()
            .find(|&&value| !(value / sigma_level).is_finite())
        {
            return Err(refuse(
                "sigma level",
                format!(
                    "{sigma_level} makes the standard deviation of half-width {value} infinite"
                ),
            ));
        }
        let deviations = half_widths.map(|value| value / sigma_level);
        let mut factor = [[0.0; P]; P];
        match &correlation {
            Some(matrix) => {
                factor = semidefinite_factor(matrix)?;
                for (row, half_width) in factor.iter_mut().zip(half_widths) {
                    *row = row.map(|value| value * half_width / sigma_level);
                }
            }
            None => (0..P).for_each(|j| factor[j][j] = deviations[j]),
        }
        Ok(Self {
            half_widths,
            sigma_level,
            deviations,
            correlation,
            factor,
        })
    }

    /// Half-widths, SI.
    pub fn half_widths(&self) -> &[f64; P] {
        &self.half_widths
    }

    /// How many standard deviations a half-width holds.
    pub fn sigma_level(&self) -> f64 {
        self.sigma_level
    }

    /// The correlation matrix, when variables are not independent.
    pub fn correlation(&self) -> Option<&[[f64; P]; P]> {
        self.correlation.as_ref()
    }

    /// Standard deviations, SI.
    pub fn standard_deviations(&self) -> [f64; P] {
        self.deviations
    }

    /// Lower triangular `L` with covariance `Sigma = L L^T`.
    pub(crate) fn factor(&self) -> &[[f64; P]; P] {
        &self.factor
    }

    /// Standard deviation of a quantity whose derivatives by the design variables are `slopes`, correlation included:
    /// `sqrt(S Sigma S^T)` (eq. 27 for several variables), in the unit of the quantity when the slopes are by SI units.
    ///
    /// Infinite where it exceeds the range of a double, NaN where a slope is not finite.
    #[inline]
    pub fn sigma(&self, slopes: &[f64; P]) -> f64 {
        let (parts, weighted) = self.parts(slopes, 1.0);
        let variance = dot(&parts, &weighted);
        if ORDINARY.contains(&variance) {
            variance.sqrt()
        } else {
            self.spread_of_any_size(slopes).0
        }
    }

    /// Covariance of two quantities from their derivatives by the design variables, `A Sigma B^T`.
    pub fn covariance(&self, a: &[f64; P], b: &[f64; P]) -> f64 {
        let deviations = self.standard_deviations();
        let scaled =
            |slopes: &[f64; P]| -> [f64; P] { core::array::from_fn(|j| slopes[j] * deviations[j]) };
        let (a, b) = (scaled(a), scaled(b));
        match &self.correlation {
            None => dot(&a, &b),
            Some(matrix) => dot(&a, &times(matrix, &b)),
        }
    }

    /// The standard deviation, and the share of each variable in the variance.
    #[inline]
    pub(crate) fn spread(&self, slopes: &[f64; P]) -> (f64, [f64; P]) {
        let (parts, weighted) = self.parts(slopes, 1.0);
        let variance = dot(&parts, &weighted);
        if !ORDINARY.contains(&variance) {
            return self.spread_of_any_size(slopes);
        }
        let shares = core::array::from_fn(|j| parts[j] * weighted[j] / variance);
        (variance.sqrt(), shares)
    }

    /// What each variable adds, `unit^2` times the slope times the standard deviation, and the same weighted with the
    /// correlation.
    #[inline]
    fn parts(&self, slopes: &[f64; P], unit: f64) -> ([f64; P], [f64; P]) {
        let parts = core::array::from_fn(|j| (unit * slopes[j]) * (unit * self.deviations[j]));
        let weighted = match &self.correlation {
            None => parts,
            Some(matrix) => times(matrix, &parts),
        };
        (parts, weighted)
    }

    /// As [`Self::spread`]. Formed from numbers about 1, so that a variance beyond the range of a double does no harm.
    #[cold]
    fn spread_of_any_size(&self, slopes: &[f64; P]) -> (f64, [f64; P]) {
        // 2^-513: a product of two numbers scaled by it does not overflow.
        const SMALL: f64 = f64::from_bits(0x1fe0_0000_0000_0000);
        let (mut parts, mut unit) = (self.parts(slopes, 1.0).0, 1.0);
        if largest(&parts).is_infinite() {
            (parts, unit) = (self.parts(slopes, SMALL).0, SMALL);
        }
        let size = largest(&parts);
        if size == 0.0 && !parts.iter().any(|part| part.is_nan()) {
            return (0.0, [0.0; P]);
        }
        let parts = parts.map(|part| part / size);
        let weighted = match &self.correlation {
            None => parts,
            Some(matrix) => times(matrix, &parts),
        };
        let variance = dot(&parts, &weighted);
        let shares = core::array::from_fn(|j| {
            if variance > 0.0 {
                parts[j] * weighted[j] / variance
            } else {
                0.0
            }
        });
        // A fully compensated variance may come out below zero by rounding; NaN stays NaN.
        let variance = if variance < 0.0 { 0.0 } else { variance };
        (size * variance.sqrt() / unit / unit, shares)
    }
}

/// Variances whose parts neither overflow nor lose digits: what is far below the greatest part does not matter.
const ORDINARY: core::ops::Range<f64> = 1e-200..1e200;

fn refuse(setting: &'static str, reason: String) -> Error {
    Error::Setting { setting, reason }
}

/// Cholesky factor of a correlation matrix; a pivot that is zero to rounding gives a zero column.
fn semidefinite_factor<const P: usize>(matrix: &[[f64; P]; P]) -> Result<[[f64; P]; P], Error> {
    const ROUNDING: f64 = 1e-10;
    let wrong = |reason: String| refuse("correlation matrix", reason);
    let mut lower = [[0.0; P]; P];
    for i in 0..P {
        if (matrix[i][i] - 1.0).abs() > ROUNDING || matrix[i][i].is_nan() {
            return Err(wrong(format!(
                "element ({i}, {i}) is {} and must be 1",
                matrix[i][i]
            )));
        }
        for j in 0..=i {
            let (here, mirrored) = (matrix[i][j], matrix[j][i]);
            if here.is_nan() || (here - mirrored).abs() > ROUNDING || mirrored.is_nan() {
                return Err(wrong(format!("elements ({i}, {j}) and ({j}, {i}) differ")));
            }
            let rest = (0..j).fold(here, |sum, k| sum - lower[i][k] * lower[j][k]);
            if i == j {
                if rest < -ROUNDING {
                    return Err(wrong("it is not positive semidefinite".to_owned()));
                }
                lower[i][i] = if rest > ROUNDING { rest.sqrt() } else { 0.0 };
            } else if lower[j][j] > 0.0 {
                lower[i][j] = rest / lower[j][j];
            } else if rest.abs() > ROUNDING.sqrt() {
                return Err(wrong("it is not positive semidefinite".to_owned()));
            }
        }
    }
    Ok(lower)
}
