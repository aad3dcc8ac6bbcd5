//! The probability that a quantity lies in an interval: first order, and exact for the second-order model.

use super::distribution::{Sampled, Standard, Terms};
use super::quadratic::Quadratic;
use crate::Error;
use crate::second_order::distribution::normal_cdf;
use crate::tolerance::Tolerances;

/// A probability and how far it may be wrong.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Probability {
    /// In [0, 1].
    pub value: f64,
    /// Bound or estimate of the numerical error of `value`, not of the model.
    pub error: f64,
}

impl Quadratic {
    /// Probability that the quantity lies between `low` and `high` (either may be infinite) at first order. Of normal variables that
    /// of a normal quantity with standard deviation `sqrt(S Sigma S^T)`, whose tails keep their relative accuracy; of others the
    /// share of 32,768 quasi-random points. Zero or one when nothing varies, the ends of the interval included.
    ///
    /// # Errors
    /// [`Error::NotFinite`] for a model that is not finite, [`Error::WrongLength`] for one of another number of design variables
    /// than the tolerances have, [`Error::Setting`] for ends that are NaN or in the wrong order or a spread beyond the range of
    /// a double.
    pub fn probability_first_order(
        &self,
        tolerances: &Tolerances,
        (low, high): (f64, f64),
    ) -> Result<f64, Error> {
        check_interval((low, high))?;
        let sigma = self.sigma(tolerances)?;
        if let Some((joint, about)) = tolerances.joint() {
            let linear = Self {
                curvature: self.curvature.map(|_| 0.0),
                ..self.clone()
            };
            let sampled = Sampled::new(&linear, joint, about)?;
            let estimate = sampled.between(low - self.value, high - self.value);
            return Ok(estimate.value);
        }
        let mean = self.value + tolerances.mean_shift(&self.slopes);
        Ok(normal_probability(mean, sigma, (low, high)))
    }

    /// Probability that the quantity lies between `low` and `high` (either may be infinite), exact for the second-order
    /// model in normal variables. In others it is the share of 32,768 quasi-random points, and the error says how far it may be
    /// off.
    ///
    /// With `L^T H L = Q diag(nu) Q^T`, `Sigma = L L^T` and `c = Q^T L^T S` the quantity is
    /// `f0 + sum_j (c_j z_j + nu_j z_j^2 / 2)` of independent standard normal `z_j`, with characteristic function
    /// `e^(i t f0) prod_j (1 - i t nu_j)^(-1/2) exp(-t^2 c_j^2 / (2 (1 - i t nu_j)))` (Imhof 1961). No curvature and a
    /// single variable have closed forms with accurate tails; the rest is inverted numerically (Gil-Pelaez 1951, Davies
    /// 1980, or on a turned contour), with an absolute error below about `1e-11`, stated beside the value.
    ///
    /// # Errors
    /// As [`probability_first_order`](Self::probability_first_order).
    pub fn probability(
        &self,
        tolerances: &Tolerances,
        (low, high): (f64, f64),
    ) -> Result<Probability, Error> {
        check_interval((low, high))?;
        self.check(tolerances)?;
        if let Some((joint, about)) = tolerances.joint() {
            let sampled = Sampled::new(self, joint, about)?;
            let estimate = sampled.between(low - self.value, high - self.value);
            return Ok(Probability {
                value: estimate.value,
                error: estimate.error,
            });
        }
        let central = self.about_means(tolerances);
        let Some(terms) = Terms::new(Standard::new(&central, tolerances)?) else {
            return Ok(Probability {
                value: normal_probability(central.value, 0.0, (low, high)),
                error: 0.0,
            });
        };
        let scaled = |end: f64| (end - central.value) / terms.unit;
        let estimate = terms.between(scaled(low), scaled(high));
        Ok(Probability {
            value: estimate.value,
            error: estimate.error,
        })
    }

    /// First-order standard deviation.
    pub(super) fn sigma(&self, tolerances: &Tolerances) -> Result<f64, Error> {
        self.check(tolerances)?;
        let sigma = tolerances.sigma(&self.slopes);
        if sigma.is_finite() {
            Ok(sigma)
        } else {
            Err(super::quadratic::beyond_range())
        }
    }
}

/// `P(low < X < high)` of a normal `X`; without spread, whether the mean lies there.
pub(super) fn normal_probability(mean: f64, sigma: f64, (low, high): (f64, f64)) -> f64 {
    if sigma > 0.0 {
        let value = normal_cdf::between((low - mean) / sigma, (high - mean) / sigma);
        value.clamp(0.0, 1.0)
    } else {
        f64::from(u8::from(low <= mean && mean <= high))
    }
}

/// Refuses ends that are NaN or in the wrong order.
pub(super) fn check_interval((low, high): (f64, f64)) -> Result<(), Error> {
    if low <= high {
        return Ok(());
    }
    Err(Error::Setting {
        setting: "interval",
        reason: format!("its low end {low} must not lie above its high end {high}"),
    })
}
