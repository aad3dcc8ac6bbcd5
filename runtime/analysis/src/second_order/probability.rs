//! The probability that a quantity lies in an interval: to first order, and exactly for the second-order model.

use core::ops::Add;

use super::distribution::{Sampled, Standard, Terms};
use super::quadratic::Quadratic;
use crate::Error;
use crate::second_order::distribution::normal_cdf;
use crate::tolerance::Tolerances;

/// A probability and its error.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Probability {
    /// In [0, 1].
    pub value: f64,
    /// Bound or estimate of the error of `value`: of the integration, and of the model where that is known.
    pub error: f64,
    /// The part of it that is due to the model, from designs solved anew; `None` if these were not asked, as for the
    /// model alone.
    pub model_error: Option<f64>,
}

impl Probability {
    fn of_model(value: f64, error: f64) -> Self {
        Self { value, error, model_error: None }
    }

    /// The same with the error of the model.
    #[doc(hidden)]
    pub fn with_model_error(self, error: f64) -> Self {
        Self { error: self.error + error, model_error: Some(error), ..self }
    }
}

/// The probability of one of two events that exclude each other, from one model.
impl Add for Probability {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self::of_model(self.value + other.value, self.error + other.error)
    }
}

impl Quadratic {
    /// First-order probability that the quantity lies between `low` and `high` (either may be infinite).
    ///
    /// For normal variables it is that of a normal quantity with standard deviation `sqrt(S Sigma S^T)`, with relative
    /// accuracy in the tails; for others it is the fraction of 32,768 quasi-random points. If nothing varies it is zero
    /// or one, the ends of the interval included.
    ///
    /// # Errors
    /// [`Error::NotFinite`] for a model that is not finite, [`Error::WrongLength`] if the model and the tolerances
    /// differ in the number of design variables, [`Error::Setting`] for ends that are NaN or in the wrong order or a
    /// spread beyond the range of a double.
    pub fn probability_first_order(&self, tolerances: &Tolerances, (low, high): (f64, f64)) -> Result<f64, Error> {
        check_interval((low, high))?;
        let sigma = self.sigma(tolerances)?;
        if let Some((joint, about)) = tolerances.joint() {
            let linear = Self { curvature: self.curvature.map(|_| 0.0), ..self.clone() };
            let sampled = Sampled::new(&linear, joint, about)?;
            let estimate = sampled.between(low - self.value, high - self.value);
            return Ok(estimate.value);
        }
        let mean = self.value + tolerances.mean_shift(&self.slopes);
        Ok(normal_probability(mean, sigma, (low, high)))
    }

    /// Probability that the quantity lies between `low` and `high` (either may be infinite), exact for the second-order
    /// model in normal variables. For other variables it is the fraction of 32,768 quasi-random points, with an
    /// estimate of its error.
    ///
    /// With `L^T H L = Q diag(nu) Q^T`, `Sigma = L L^T` and `c = Q^T L^T S`, the quantity is
    /// `f0 + sum_j (c_j z_j + nu_j z_j^2 / 2)` with independent standard normal `z_j`; its characteristic function is
    /// `e^(i t f0) prod_j (1 - i t nu_j)^(-1/2) exp(-t^2 c_j^2 / (2 (1 - i t nu_j)))` (Imhof 1961). Closed forms with
    /// accurate tails exist without curvature and for a single variable. Otherwise it is inverted numerically
    /// (Gil-Pelaez 1951, Davies 1980, or on a tilted contour), with an absolute error below about `1e-11`, which is
    /// returned with the value. The error of the model itself is not known here.
    ///
    /// # Errors
    /// As [`probability_first_order`](Self::probability_first_order).
    pub fn probability(&self, tolerances: &Tolerances, (low, high): (f64, f64)) -> Result<Probability, Error> {
        check_interval((low, high))?;
        self.check(tolerances)?;
        if let Some((joint, about)) = tolerances.joint() {
            let sampled = Sampled::new(self, joint, about)?;
            let estimate = sampled.between(low - self.value, high - self.value);
            return Ok(Probability::of_model(estimate.value, estimate.error));
        }
        let central = self.about_means(tolerances);
        let Some(terms) = Terms::new(Standard::new(&central, tolerances)?) else {
            let value = normal_probability(central.value, 0.0, (low, high));
            return Ok(Probability::of_model(value, 0.0));
        };
        let scaled = |end: f64| (end - central.value) / terms.unit;
        let estimate = terms.between(scaled(low), scaled(high));
        Ok(Probability::of_model(estimate.value, estimate.error))
    }

    /// First-order standard deviation.
    pub(super) fn sigma(&self, tolerances: &Tolerances) -> Result<f64, Error> {
        self.check(tolerances)?;
        let sigma = tolerances.sigma(&self.slopes);
        if sigma.is_finite() { Ok(sigma) } else { Err(super::quadratic::beyond_range()) }
    }
}

/// `P(low < X < high)` of a normal `X`; without spread, one if the mean lies there and zero otherwise.
pub(super) fn normal_probability(mean: f64, sigma: f64, (low, high): (f64, f64)) -> f64 {
    if sigma > 0.0 {
        let value = normal_cdf::between((low - mean) / sigma, (high - mean) / sigma);
        value.clamp(0.0, 1.0)
    } else {
        f64::from(u8::from(low <= mean && mean <= high))
    }
}

/// Rejects ends that are NaN or in the wrong order.
pub(super) fn check_interval((low, high): (f64, f64)) -> Result<(), Error> {
    if low <= high {
        return Ok(());
    }
    Err(Error::Setting {
        setting: "interval",
        reason: format!("its low end {low} must not lie above its high end {high}"),
    })
}
