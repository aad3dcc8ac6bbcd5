//! How design variables vary: distributions, half-widths in standard deviations, and correlation.
//!
//! # A tolerance is a distribution of values
//!
//! The language and a study say how each value varies (`mechanism/tolerance.rs` of the contract), and
//! `tolerance/tolerances.rs` derives covariance and means for first and second order and, where values are not jointly
//! normal, the values as increasing functions of jointly normal numbers (a Gaussian copula with the requested linear
//! correlations). Chance without mechanisms is in `runtime/statistics`, a crate that depends on none of the others.

use std::borrow::Cow;

use eigentol_statistics::{Distribution, Joint, semidefinite_factor};

use super::law::{distribution, standard_deviation};
use crate::algebra::{Matrix, Vector, dot, largest, times};
use crate::{Description, Error};

/// How the design variables vary about their nominal values.
///
/// ```
/// # use eigentol_tolerance as eigentol;
/// use eigentol::Tolerances;
/// use eigentol::tolerance::Distribution;
///
/// // Half-widths of three standard deviations, normally distributed about the nominal values.
/// let normal = Tolerances::new([0.03, 0.1], 3.0, None)?;
/// assert!((normal.sigma(&[2.0, 0.0]) - 0.02).abs() < 1e-15);
///
/// // Any distribution of the values; a bore may become only larger.
/// let bore = Distribution::uniform(20e-3, 20.1e-3)?;
/// let uniform = Tolerances::distributed(&[20e-3], vec![bore], 3.0, None)?;
/// assert!((uniform.shifts()[0] - 0.05e-3).abs() < 1e-15);
/// # Ok::<(), eigentol::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(remote = "Self", expecting = "tolerances"))]
pub struct Tolerances {
    pub(super) half_widths: Vector,
    pub(super) sigma_level: f64,
    pub(super) sigmas: Vector,
    /// Means minus nominal values.
    pub(super) shifts: Vector,
    pub(super) correlation: Option<Matrix>,
    /// Lower factor of the covariance matrix.
    pub(super) factor: Matrix,
    /// The distribution of values that are not jointly normal, and the nominal values it was made for.
    pub(super) joint: Option<(Joint, Vector)>,
}

impl Tolerances {
    /// The declared tolerances of the nominal design, independent of each other; the limits of normal variables lie
    /// three standard deviations on either side of their midpoint.
    ///
    /// # Errors
    /// [`Error::Setting`] if a declared tolerance makes no sense.
    pub fn declared(description: &Description) -> Result<Self, Error> {
        let infos = &description.design;
        let normal = infos.iter().map(|info| info.tolerance.normal_half_width(info.nominal));
        if let Some(half_widths) = normal.collect::<Option<Vector>>() {
            return Self::new(half_widths, 3.0, None);
        }
        let nominal: Vector = infos.iter().map(|info| info.nominal).collect();
        let laws = infos.iter().map(|info| distribution(info.nominal, &info.tolerance, 3.0));
        let distributions: Vec<Distribution> = laws.collect::<Result<_, _>>()?;
        Self::distributed(&nominal, distributions, 3.0, None)
    }

    /// Normal distributions about the nominal values, with half-widths, SI, of `sigma_level` standard deviations each.
    ///
    /// The variables are independent if `correlation` is `None`.
    ///
    /// # Errors
    /// [`Error::Setting`] for a negative or infinite half-width, a level that is not positive or too small, or a
    /// correlation matrix that does not have one row and column per half-width or is not symmetric and positive
    /// semidefinite with a unit diagonal.
    pub fn new(half_widths: impl Into<Vector>, sigma_level: f64, correlation: Option<Matrix>) -> Result<Self, Error> {
        let half_widths = half_widths.into();
        let mut sigmas = Vector::zeros(half_widths.len());
        for (sigma, half_width) in sigmas.iter_mut().zip(&half_widths) {
            *sigma = standard_deviation(*half_width, sigma_level)?;
        }
        Ok(Self {
            factor: covariance_factor(&sigmas, correlation.as_ref())?,
            shifts: Vector::zeros(sigmas.len()),
            half_widths,
            sigma_level,
            sigmas,
            correlation,
            joint: None,
        })
    }

    /// Distributions of the values, SI, in place of the nominal ones.
    ///
    /// `sigma_level` is the number of standard deviations that a half-width and a band span. A correlation matrix holds
    /// the linear correlations of the values, which are coupled by a Gaussian copula ([`Joint`]).
    ///
    /// # Errors
    /// [`Error::WrongLength`] unless there is one distribution for each nominal value; [`Error::Setting`] for a level
    /// that is not positive, and for a correlation matrix that is not symmetric and positive semidefinite with a unit
    /// diagonal or that such variables cannot have.
    pub fn distributed(
        nominal: &[f64],
        values: Vec<Distribution>,
        sigma_level: f64,
        correlation: Option<Matrix>,
    ) -> Result<Self, Error> {
        if values.len() != nominal.len() {
            return Err(Error::WrongLength { kind: "distributions", found: values.len(), expected: nominal.len() });
        }
        standard_deviation(0.0, sigma_level)?;
        let sigmas: Vector = values.iter().map(Distribution::sigma).collect();
        let means = values.iter().zip(nominal);
        let normal = values.iter().all(Distribution::is_normal);
        Ok(Self {
            factor: covariance_factor(&sigmas, correlation.as_ref())?,
            shifts: means.map(|(value, nominal)| value.mean() - nominal).collect(),
            half_widths: sigmas.map(|sigma| sigma_level * sigma),
            sigma_level,
            sigmas,
            joint: match &correlation {
                _ if normal => None,
                None => Some((Joint::independent(values), nominal.into())),
                Some(matrix) => {
                    let joint = Joint::correlated(values, matrix.as_flattened())?;
                    Some((joint, nominal.into()))
                }
            },
            correlation,
        })
    }

    /// Half-widths, SI: [`Self::sigma_level`] standard deviations each.
    #[must_use]
    pub fn half_widths(&self) -> &[f64] {
        &self.half_widths
    }

    /// Number of standard deviations that a half-width spans.
    #[must_use]
    pub fn sigma_level(&self) -> f64 {
        self.sigma_level
    }

    /// The correlation matrix, if variables are not independent.
    #[must_use]
    pub fn correlation(&self) -> Option<&Matrix> {
        self.correlation.as_ref()
    }

    /// Standard deviations, SI.
    #[must_use]
    pub fn sigmas(&self) -> &[f64] {
        &self.sigmas
    }

    /// Means of the values minus the nominal values, SI.
    #[must_use]
    pub fn shifts(&self) -> &[f64] {
        &self.shifts
    }

    /// Whether any variable has a tolerance.
    #[must_use]
    pub fn vary(&self) -> bool {
        self.sigmas.iter().any(|sigma| *sigma > 0.0)
    }

    /// Whether the values are jointly normal, about any mean.
    #[must_use]
    pub fn is_normal(&self) -> bool {
        self.joint.is_none()
    }

    /// The distribution of each variable about its nominal value, SI.
    ///
    /// # Errors
    /// [`Error::WrongLength`] unless there is one nominal value for each variable, [`Error::Setting`] for one that is
    /// not finite.
    ///
    /// ```
    /// # use eigentol_tolerance as eigentol;
    /// use eigentol::tolerance::Tolerances;
    ///
    /// let tolerances = Tolerances::new([0.03], 3.0, None)?;
    /// let [length] = &tolerances.distributions(&[1.0])?[..] else { unreachable!() };
    /// assert_eq!((length.name(), length.mean(), length.sigma()), ("normal", 1.0, 0.01));
    /// # Ok::<(), eigentol::Error>(())
    /// ```
    pub fn distributions(&self, nominal: &[f64]) -> Result<Vec<Distribution>, Error> {
        self.check_count(nominal.len())?;
        if let Some((joint, _)) = &self.joint {
            return Ok(joint.variables().to_vec());
        }
        let each = nominal.iter().zip(&self.shifts).zip(&self.sigmas);
        Ok(each
            .map(|((nominal, shift), sigma)| Distribution::normal(nominal + shift, *sigma))
            .collect::<Result<_, _>>()?)
    }

    /// The distribution of values that are not jointly normal, and the nominal values it was made for.
    #[doc(hidden)]
    pub fn joint(&self) -> Option<(&Joint, &[f64])> {
        self.joint.as_ref().map(|(joint, nominal)| (joint, &nominal[..]))
    }

    /// First-order effect of the means on a quantity with these slopes.
    #[doc(hidden)]
    pub fn mean_shift(&self, slopes: &[f64]) -> f64 {
        slopes.iter().zip(&self.shifts).filter(|(_, shift)| **shift != 0.0).map(|(slope, shift)| slope * shift).sum()
    }

    /// Refuses tolerances that do not belong to `count` design variables.
    #[doc(hidden)]
    pub fn check_count(&self, count: usize) -> Result<(), Error> {
        let found = self.half_widths.len();
        if found == count {
            return Ok(());
        }
        Err(Error::WrongLength { kind: "tolerances", found, expected: count })
    }

    /// Lower triangular `L` with covariance `Sigma = L L^T`.
    #[doc(hidden)]
    pub fn factor(&self) -> &Matrix {
        &self.factor
    }

    /// Standard deviation of a quantity with derivatives `slopes` with respect to the design variables, including
    /// correlation.
    ///
    /// This is `sqrt(S Sigma S^T)` (eq. 27 for several variables), in the unit of the quantity if the slopes are per SI
    /// unit. Infinite if it exceeds the range of a double, NaN if a slope is not finite or there is not one for each
    /// variable.
    #[must_use]
    #[inline]
    pub fn sigma(&self, slopes: &[f64]) -> f64 {
        let variance = self.variance(slopes, &mut Vector::default());
        if ORDINARY.contains(&variance) { variance.sqrt() } else { self.spread_of_any_size(slopes).0 }
    }

    /// Location and scale of the values expected of a quantity, SI: its nominal value and, if there are derivatives,
    /// its first-order standard deviation. The scale is reduced to a power of two, so that scaling causes no rounding.
    #[doc(hidden)]
    pub fn scale(&self, value: Option<f64>, slopes: Option<&[f64]>) -> (f64, f64) {
        let value = value.unwrap_or(0.0);
        let sigma = slopes.map_or(0.0, |slopes| self.sigma(slopes));
        let usable = [sigma, 1e-3 * value.abs()].map(|scale| f64::from_bits(scale.to_bits() & EXPONENT));
        (value, (usable.into_iter()).find(|scale| (1e-300..1e300).contains(scale)).unwrap_or(1.0))
    }

    /// Covariance of two quantities from their derivatives with respect to the design variables, `A Sigma B^T`; NaN in
    /// the cases of [`Self::sigma`].
    #[must_use]
    pub fn covariance(&self, a: &[f64], b: &[f64]) -> f64 {
        let (a, b) = (self.parts(a, 1.0), self.parts(b, 1.0));
        dot(&a, &self.correlated(&b))
    }

    /// Returns the standard deviation and writes the share of each variable in the variance.
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

    /// Returns the variance and writes the contribution of each variable.
    #[inline]
    fn variance(&self, slopes: &[f64], contributions: &mut Vector) -> f64 {
        if self.correlation.is_some() || slopes.len() != self.sigmas.len() {
            *contributions = self.contributions(&self.parts(slopes, 1.0));
        } else {
            let places = contributions.make_room(slopes.len()).iter_mut();
            for ((contribution, slope), sigma) in places.zip(slopes).zip(&self.sigmas) {
                *contribution = (slope * sigma) * (slope * sigma);
            }
        }
        sum(contributions)
    }

    /// Effect of one standard deviation of each variable, in units of `1 / unit^2`.
    #[inline]
    fn parts(&self, slopes: &[f64], unit: f64) -> Vector {
        if slopes.len() != self.sigmas.len() {
            return Vector::filled(self.sigmas.len(), f64::NAN);
        }
        slopes.iter().zip(&self.sigmas).map(|(slope, sigma)| (unit * slope) * (unit * sigma)).collect()
    }

    /// The correlation matrix times a vector.
    #[inline]
    #[doc(hidden)]
    pub fn correlated<'a>(&self, x: &'a [f64]) -> Cow<'a, [f64]> {
        match &self.correlation {
            None => Cow::Borrowed(x),
            Some(matrix) => Cow::Owned(times(matrix, x).into()),
        }
    }

    /// Contribution of each variable to the variance.
    #[inline]
    fn contributions(&self, parts: &[f64]) -> Vector {
        let weighted = self.correlated(parts);
        parts.iter().zip(&*weighted).map(|(a, b)| a * b).collect()
    }

    /// Like [`Self::spread`], but works with scaled numbers, so that a variance beyond the range of a double does no
    /// harm.
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
        let shares = contributions.map(|contribution| if variance > 0.0 { contribution / variance } else { 0.0 });
        // Rounding may make a fully compensated variance negative; NaN stays NaN.
        let variance = if variance < 0.0 { 0.0 } else { variance };
        (size * variance.sqrt() / unit / unit, shares)
    }
}

/// The sum, in the order of a scalar product.
fn sum(values: &[f64]) -> f64 {
    values.iter().fold(-0.0, |sum, value| sum + value)
}

/// The exponent bits of a positive number.
const EXPONENT: u64 = 0x7ff0_0000_0000_0000;

/// Variances whose terms neither overflow nor lose digits; terms far below the largest do not matter.
const ORDINARY: core::ops::Range<f64> = 1e-200..1e200;

/// Lower triangular `L` with covariance `L L^T`.
fn covariance_factor(sigmas: &[f64], correlation: Option<&Matrix>) -> Result<Matrix, Error> {
    let size = sigmas.len();
    let Some(matrix) = correlation else {
        let mut factor = Matrix::zeros(size, size);
        factor.iter_mut().zip(sigmas).enumerate().for_each(|(i, (row, sigma))| row[i] = *sigma);
        return Ok(factor);
    };
    let found = (matrix.row_count(), matrix.column_count());
    if found != (size, size) {
        let (rows, columns) = found;
        return Err(Error::setting(
            "correlation matrix",
            format!("it is {rows} by {columns} and must be {size} by {size}"),
        ));
    }
    let root = semidefinite_factor(matrix.as_flattened(), size)?;
    Ok(Matrix::from_fn(size, size, |i, j| root[i * size + j] * sigmas[i]))
}
