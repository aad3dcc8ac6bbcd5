//! Half-widths, the number of standard deviations they stand for, and how variables vary together.

use std::borrow::Cow;

use crate::algebra::{Matrix, Vector, dot, largest, times};
use crate::{Description, Error};

/// Tolerances of the design variables.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Tolerances {
    half_widths: Vector,
    sigma_level: f64,
    sigmas: Vector,
    correlation: Option<Matrix>,
    /// Lower factor of the covariance matrix.
    factor: Matrix,
}

impl Tolerances {
    /// The declared half-widths, three standard deviations each, independent of each other.
    ///
    /// # Errors
    /// [`Error::Setting`] when a declared half-width is negative or not finite.
    pub fn declared(description: &Description) -> Result<Self, Error> {
        let infos = description.design.iter();
        let half_widths: Vector = infos.map(|info| info.tolerance).collect();
        Self::new(half_widths, 3.0, None)
    }

    /// Half-widths, SI, of `sigma_level` standard deviations each; `None` for `correlation` leaves the variables independent.
    ///
    /// # Errors
    /// [`Error::Setting`] for a negative or infinite half-width, a level that is not positive or too small, or a correlation matrix
    /// that has not a row and a column for each half-width or is not symmetric and positive semidefinite with ones on its
    /// diagonal.
    pub fn new(
        half_widths: impl Into<Vector>,
        sigma_level: f64,
        correlation: Option<Matrix>,
    ) -> Result<Self, Error> {
        let half_widths = half_widths.into();
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
        let sigmas = half_widths.map(|value| value / sigma_level);
        let count = half_widths.len();
        let factor = match &correlation {
            Some(matrix) => {
                let mut factor = semidefinite_factor(matrix, count)?;
                for (row, half_width) in factor.iter_mut().zip(&half_widths) {
                    for value in row {
                        *value = *value * half_width / sigma_level;
                    }
                }
                factor
            }
            None => Matrix::from_fn(count, count, |i, j| if i == j { sigmas[i] } else { 0.0 }),
        };
        Ok(Self {
            half_widths,
            sigma_level,
            sigmas,
            correlation,
            factor,
        })
    }

    /// Half-widths, SI.
    #[must_use]
    pub fn half_widths(&self) -> &[f64] {
        &self.half_widths
    }

    /// How many standard deviations a half-width stands for.
    #[must_use]
    pub fn sigma_level(&self) -> f64 {
        self.sigma_level
    }

    /// The correlation matrix, when variables are not independent.
    #[must_use]
    pub fn correlation(&self) -> Option<&Matrix> {
        self.correlation.as_ref()
    }

    /// Standard deviations, SI.
    #[must_use]
    pub fn sigmas(&self) -> &[f64] {
        &self.sigmas
    }

    /// Refuses tolerances that are not those of `count` design variables.
    pub(crate) fn check_count(&self, count: usize) -> Result<(), Error> {
        let found = self.half_widths.len();
        if found == count {
            return Ok(());
        }
        Err(Error::WrongLength {
            kind: "tolerances",
            found,
            expected: count,
        })
    }

    /// Lower triangular `L` with covariance `Sigma = L L^T`.
    pub(crate) fn factor(&self) -> &Matrix {
        &self.factor
    }

    /// Standard deviation of a quantity whose derivatives by the design variables are `slopes`, correlation included:
    /// `sqrt(S Sigma S^T)` (eq. 27 for several variables), in the unit of the quantity when the slopes are by SI units.
    ///
    /// Infinite where it exceeds the range of a double, NaN where a slope is not finite or there is not one for each variable.
    #[must_use]
    #[inline]
    pub fn sigma(&self, slopes: &[f64]) -> f64 {
        let variance = self.variance(slopes, &mut Vector::default());
        if ORDINARY.contains(&variance) {
            variance.sqrt()
        } else {
            self.spread_of_any_size(slopes).0
        }
    }

    /// Covariance of two quantities from their derivatives by the design variables, `A Sigma B^T`; NaN as [`Self::sigma`].
    #[must_use]
    pub fn covariance(&self, a: &[f64], b: &[f64]) -> f64 {
        let (a, b) = (self.parts(a, 1.0), self.parts(b, 1.0));
        dot(&a, &self.correlated(&b))
    }

    /// The standard deviation; writes the share of each variable in the variance.
    #[inline]
    pub(crate) fn spread(&self, slopes: &[f64], shares: &mut Vector) -> f64 {
        let variance = self.variance(slopes, shares);
        if ORDINARY.contains(&variance) {
            shares.iter_mut().for_each(|share| *share /= variance);
            return variance.sqrt();
        }
        let sigma;
        (sigma, *shares) = self.spread_of_any_size(slopes);
        sigma
    }

    /// The variance; writes what each variable adds to it.
    #[inline]
    fn variance(&self, slopes: &[f64], contributions: &mut Vector) -> f64 {
        if self.correlation.is_some() || slopes.len() != self.sigmas.len() {
            *contributions = self.contributions(&self.parts(slopes, 1.0));
        } else {
            let places = contributions.make_room(slopes.len()).iter_mut();
            for ((own, slope), sigma) in places.zip(slopes).zip(&self.sigmas) {
                *own = (slope * sigma) * (slope * sigma);
            }
        }
        sum(contributions)
    }

    /// What a standard deviation of each variable changes, in units of `1 / unit^2`.
    #[inline]
    fn parts(&self, slopes: &[f64], unit: f64) -> Vector {
        if slopes.len() != self.sigmas.len() {
            return Vector::filled(self.sigmas.len(), f64::NAN);
        }
        let each = slopes.iter().zip(&self.sigmas);
        each.map(|(slope, sigma)| (unit * slope) * (unit * sigma))
            .collect()
    }

    /// The correlation matrix times a vector.
    #[inline]
    pub(crate) fn correlated<'a>(&self, x: &'a [f64]) -> Cow<'a, [f64]> {
        match &self.correlation {
            None => Cow::Borrowed(x),
            Some(matrix) => Cow::Owned(times(matrix, x).into()),
        }
    }

    /// What each variable adds to the variance.
    #[inline]
    fn contributions(&self, parts: &[f64]) -> Vector {
        let weighted = self.correlated(parts);
        parts.iter().zip(&*weighted).map(|(a, b)| a * b).collect()
    }

    /// As [`Self::spread`]. Formed from numbers about 1, so that a variance beyond the range of a double does no harm.
    #[cold]
    fn spread_of_any_size(&self, slopes: &[f64]) -> (f64, Vector) {
        // 2^-513: a product of two numbers scaled by it does not overflow.
        const SMALL: f64 = f64::from_bits(0x1fe0_0000_0000_0000);
        let (mut parts, mut unit) = (self.parts(slopes, 1.0), 1.0);
        if largest(&parts).is_infinite() {
            (parts, unit) = (self.parts(slopes, SMALL), SMALL);
        }
        let size = largest(&parts);
        if size == 0.0 && !parts.iter().any(|part| part.is_nan()) {
            return (0.0, Vector::zeros(self.sigmas.len()));
        }
        let contributions = self.contributions(&parts.map(|part| part / size));
        let variance = sum(&contributions);
        let shares = contributions.map(|own| if variance > 0.0 { own / variance } else { 0.0 });
        // A fully compensated variance may come out below zero by rounding; NaN stays NaN.
        let variance = if variance < 0.0 { 0.0 } else { variance };
        (size * variance.sqrt() / unit / unit, shares)
    }
}

/// The sum, as a product of vectors forms it.
fn sum(values: &[f64]) -> f64 {
    values.iter().fold(-0.0, |sum, value| sum + value)
}

/// Variances whose parts neither overflow nor lose digits: what is far below the greatest part does not matter.
const ORDINARY: core::ops::Range<f64> = 1e-200..1e200;

fn refuse(setting: &'static str, reason: String) -> Error {
    Error::Setting { setting, reason }
}

/// Cholesky factor of a correlation matrix of this size; a pivot that is zero to rounding gives a zero column.
fn semidefinite_factor(matrix: &Matrix, size: usize) -> Result<Matrix, Error> {
    const ROUNDING: f64 = 1e-10;
    let wrong = |reason: String| refuse("correlation matrix", reason);
    let found = (matrix.row_count(), matrix.column_count());
    if found != (size, size) {
        let (rows, columns) = found;
        return Err(wrong(format!(
            "it is {rows} by {columns} and must be {size} by {size}"
        )));
    }
    let mut lower = Matrix::zeros(size, size);
    for i in 0..size {
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
