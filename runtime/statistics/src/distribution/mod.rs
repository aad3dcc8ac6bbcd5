//! Distributions of a single variable.

mod beta;
mod discrete;
mod expansion;
mod moments;
mod standard;
mod truncated;
mod weibull;

use crate::{Error, normal};
use discrete::Discrete;
use truncated::Interval;

pub(crate) use expansion::Expansion;

/// The distribution of one variable, in the unit of that variable.
///
/// ```
/// use eigentol_statistics::Distribution;
///
/// let length = Distribution::uniform(0.97, 1.03)?;
/// assert!((length.mean() - 1.0).abs() < 1e-15);
/// assert!((length.sigma() - 0.03 / 3.0_f64.sqrt()).abs() < 1e-15);
/// assert!((length.quantile(0.25) - 0.985).abs() < 1e-15);
/// # Ok::<(), eigentol_statistics::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Distribution {
    kind: Kind,
    mean: f64,
    sigma: f64,
}

#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
enum Kind {
    Normal,
    Lognormal { log_mean: f64, log_sigma: f64 },
    Weibull { shape: f64, scale: f64 },
    TruncatedNormal { centre: f64, scale: f64, within: Interval },
    Uniform { low: f64, high: f64 },
    Triangular { low: f64, peak: f64, high: f64 },
    Beta { shapes: (f64, f64), low: f64, high: f64 },
    Discrete(Discrete),
}

impl Distribution {
    /// A constant value.
    ///
    /// # Errors
    /// [`Error::Setting`] if it is not finite.
    pub fn constant(value: f64) -> Result<Self, Error> {
        Self::normal(value, 0.0)
    }

    /// Normal distribution.
    ///
    /// # Errors
    /// [`Error::Setting`] for a negative standard deviation or numbers that are not finite.
    pub fn normal(mean: f64, sigma: f64) -> Result<Self, Error> {
        finite(&[mean])?;
        not_negative(sigma)?;
        Ok(Self { kind: Kind::Normal, mean, sigma })
    }

    /// Lognormal distribution, given the mean and standard deviation of the variable itself.
    ///
    /// # Errors
    /// [`Error::Setting`] for a mean that is not positive, a negative standard deviation or numbers that are not
    /// finite.
    pub fn lognormal(mean: f64, sigma: f64) -> Result<Self, Error> {
        positive("mean of a lognormal variable", mean)?;
        not_negative(sigma)?;
        let log_variance = (sigma / mean).powi(2).ln_1p();
        Ok(Self {
            kind: Kind::Lognormal { log_mean: mean.ln() - 0.5 * log_variance, log_sigma: log_variance.sqrt() },
            mean,
            sigma,
        })
    }

    /// Two-parameter Weibull distribution, `P(X > x) = exp(-(x / scale)^shape)`.
    ///
    /// # Errors
    /// [`Error::Setting`] for a shape or scale that is not positive, and for shapes outside 0.05 to 1e8.
    pub fn weibull(shape: f64, scale: f64) -> Result<Self, Error> {
        positive("scale of a Weibull variable", scale)?;
        let (mean, sigma) = weibull::unit_moments(shape)?;
        Ok(Self { kind: Kind::Weibull { shape, scale }, mean: scale * mean, sigma: scale * sigma })
    }

    /// Two-parameter Weibull distribution, given mean and standard deviation.
    ///
    /// # Errors
    /// As [`Self::weibull`] for a mean that is not positive, or if no shape within its limits has this ratio of the
    /// two.
    pub fn weibull_by_moments(mean: f64, sigma: f64) -> Result<Self, Error> {
        positive("mean of a Weibull variable", mean)?;
        not_negative(sigma)?;
        if sigma == 0.0 {
            return Self::constant(mean);
        }
        let shape = weibull::shape(sigma / mean)?;
        Self::weibull(shape, mean / weibull::unit_moments(shape)?.0)
    }

    /// Normal distribution with this mean and standard deviation, truncated to the limits, either of which may be
    /// infinite.
    ///
    /// [`Self::mean`] and [`Self::sigma`] are those after truncation.
    ///
    /// # Errors
    /// [`Error::Setting`] if the limits are not in order or leave less than 1e-300 of the probability, or if the
    /// standard deviation is not positive.
    pub fn truncated_normal(mean: f64, sigma: f64, (low, high): (f64, f64)) -> Result<Self, Error> {
        finite(&[mean])?;
        ordered(low, high)?;
        positive("standard deviation of a truncated normal variable", sigma)?;
        let within = Interval::new((low - mean) / sigma, (high - mean) / sigma)?;
        let (shift, spread) = within.moments();
        Ok(Self {
            kind: Kind::TruncatedNormal { centre: mean, scale: sigma, within },
            mean: mean + sigma * shift,
            sigma: sigma * spread,
        })
    }

    /// Uniform distribution between the limits.
    ///
    /// # Errors
    /// [`Error::Setting`] for limits that are not finite or not in order.
    pub fn uniform(low: f64, high: f64) -> Result<Self, Error> {
        finite(&[low, high])?;
        ordered(low, high)?;
        Ok(Self {
            kind: Kind::Uniform { low, high },
            mean: low + 0.5 * (high - low),
            sigma: (high - low) / 12.0_f64.sqrt(),
        })
    }

    /// Triangular distribution, with the density falling linearly from the peak to both limits.
    ///
    /// # Errors
    /// [`Error::Setting`] for numbers that are not finite or not in order.
    pub fn triangular(low: f64, peak: f64, high: f64) -> Result<Self, Error> {
        finite(&[low, peak, high])?;
        ordered(low, high)?;
        if !(low..=high).contains(&peak) {
            return Err(Error::setting(
                "peak of a triangular distribution",
                format!("{peak} must lie between the limits {low} and {high}"),
            ));
        }
        let (below, above) = (peak - low, high - peak);
        Ok(Self {
            kind: Kind::Triangular { low, peak, high },
            mean: peak + (above - below) / 3.0,
            sigma: ((below * below + below * above + above * above) / 18.0).sqrt(),
        })
    }

    /// Beta distribution between limits, with density `x^(alpha - 1) (1 - x)^(beta - 1)` over them.
    ///
    /// # Errors
    /// [`Error::Setting`] for limits that are not finite or not in order, and for shapes outside 0.05 to 1000; beyond
    /// that, a normal distribution is as good.
    pub fn beta((alpha, beta): (f64, f64), (low, high): (f64, f64)) -> Result<Self, Error> {
        finite(&[low, high])?;
        ordered(low, high)?;
        beta::check(alpha)?;
        beta::check(beta)?;
        let sum = alpha + beta;
        Ok(Self {
            kind: Kind::Beta { shapes: (alpha, beta), low, high },
            mean: low + (high - low) * (alpha / sum),
            sigma: (high - low) / sum * (alpha * beta / (sum + 1.0)).sqrt(),
        })
    }

    /// Discrete distribution over values with probabilities or weights; these are divided by their sum.
    ///
    /// # Errors
    /// [`Error::Setting`] if there are no values, values that are not finite, or weights that are negative, not finite
    /// or all zero.
    pub fn discrete(values: &[(f64, f64)]) -> Result<Self, Error> {
        let discrete = Discrete::new(values)?;
        let (mean, sigma) = discrete.moments();
        Ok(Self { kind: Kind::Discrete(discrete), mean, sigma })
    }

    /// Empirical distribution: each of the measured values is equally probable.
    ///
    /// The standard deviation uses the number of values as divisor.
    ///
    /// # Errors
    /// [`Error::Setting`] if there are no values, or one is not finite.
    pub fn empirical(data: &[f64]) -> Result<Self, Error> {
        let values: Vec<(f64, f64)> = data.iter().map(|value| (*value, 1.0)).collect();
        Self::discrete(&values)
    }

    /// Name of the distribution: `normal`, `uniform`, ...; `constant` if nothing varies.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match &self.kind {
            _ if self.sigma == 0.0 => "constant",
            Kind::Normal => "normal",
            Kind::Lognormal { .. } => "lognormal",
            Kind::Weibull { .. } => "Weibull",
            Kind::TruncatedNormal { .. } => "truncated normal",
            Kind::Uniform { .. } => "uniform",
            Kind::Triangular { .. } => "triangular",
            Kind::Beta { .. } => "beta",
            Kind::Discrete(_) => "discrete",
        }
    }

    /// Mean.
    #[must_use]
    pub fn mean(&self) -> f64 {
        self.mean
    }

    /// Standard deviation.
    #[must_use]
    pub fn sigma(&self) -> f64 {
        self.sigma
    }

    /// Smallest and largest possible value; infinite if unbounded.
    #[must_use]
    pub fn support(&self) -> (f64, f64) {
        match &self.kind {
            _ if self.sigma == 0.0 => (self.mean, self.mean),
            Kind::Normal => (f64::NEG_INFINITY, f64::INFINITY),
            Kind::Lognormal { .. } | Kind::Weibull { .. } => (0.0, f64::INFINITY),
            Kind::TruncatedNormal { centre, scale, within } => {
                let (low, high) = within.ends();
                (centre + scale * low, centre + scale * high)
            }
            Kind::Uniform { low, high } | Kind::Triangular { low, high, .. } | Kind::Beta { low, high, .. } => {
                (*low, *high)
            }
            Kind::Discrete(discrete) => discrete.support(),
        }
    }

    /// Whether it is normal or a constant.
    #[must_use]
    pub fn is_normal(&self) -> bool {
        matches!(self.kind, Kind::Normal) || self.sigma == 0.0
    }

    /// Whether it has a density, so that its quantiles are a smooth function; false for discrete values.
    #[must_use]
    pub fn is_continuous(&self) -> bool {
        !matches!(self.kind, Kind::Discrete(_)) || self.sigma == 0.0
    }

    /// The value below which the given probability lies; NaN outside [0, 1].
    #[must_use]
    pub fn quantile(&self, probability: f64) -> f64 {
        let z = normal::quantile(probability);
        if z.is_infinite() {
            let (low, high) = self.support();
            return if z < 0.0 { low } else { high };
        }
        self.from_normal(z)
    }
}

fn finite(values: &[f64]) -> Result<(), Error> {
    match values.iter().find(|value| !value.is_finite()) {
        None => Ok(()),
        Some(value) => Err(Error::setting("distribution", format!("{value} must be finite"))),
    }
}

fn positive(setting: &'static str, value: f64) -> Result<(), Error> {
    if value > 0.0 && value.is_finite() {
        return Ok(());
    }
    Err(Error::setting(setting, format!("{value} must be positive and finite")))
}

fn not_negative(sigma: f64) -> Result<(), Error> {
    if (0.0..=f64::MAX).contains(&sigma) {
        return Ok(());
    }
    Err(Error::setting("standard deviation", format!("{sigma} must be zero or positive and finite")))
}

fn ordered(low: f64, high: f64) -> Result<(), Error> {
    if low <= high {
        return Ok(());
    }
    Err(Error::setting("limits", format!("the lower one {low} must not exceed the upper one {high}")))
}
