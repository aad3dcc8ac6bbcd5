//! Points of a search, and design points.

use crate::normal;
use crate::reliability::closest::{Closest, Evaluations, Residuals};
use crate::reliability::limit_state::LimitValue;
use crate::reliability::vector::{add_scaled, dot, norm, scaled, unit};

/// A design point: the point of the limit nearest to the origin, at least locally.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct DesignPoint {
    /// Its coordinates `z*`.
    pub point: Vec<f64>,
    /// The reliability index: distance from the origin, negative if the origin fails.
    pub beta: f64,
    /// Unit vector towards failure, `-grad g / |grad g|`; `z* = beta n`.
    pub direction: Vec<f64>,
    /// Length of the gradient of the limit state, in the unit of the latter.
    pub gradient_norm: f64,
    /// Accuracy of `z*` as a design point.
    pub residuals: Residuals,
}

/// Derivatives with respect to a parameter of the limit state.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct FormSensitivity {
    /// `d beta / d theta`, per unit of the parameter.
    pub beta: f64,
    /// `d Phi(-beta) / d theta`, per unit of the parameter.
    pub probability: f64,
}

impl DesignPoint {
    /// First-order failure probability, `Phi(-beta)`.
    pub fn probability(&self) -> f64 {
        normal::cdf(-self.beta)
    }

    /// Natural logarithm of the probability, valid even if the probability underflows.
    pub fn ln_probability(&self) -> f64 {
        normal::ln_upper(self.beta)
    }

    /// Importance factors: the fraction of the variance of the linearised limit state due to each variable. They sum to
    /// 1.
    pub fn importance_factors(&self) -> Vec<f64> {
        self.direction.iter().map(|n| n * n).collect()
    }

    /// Derivatives with respect to a parameter of the limit state, given the partial derivative `dg/dtheta` at the
    /// design point (in the unit of the limit state per unit of the parameter):
    /// `d beta / d theta = (dg/dtheta) / |grad g|` (Ditlevsen and Madsen 1996, *Structural Reliability Methods*,
    /// section 8.2).
    pub fn sensitivity(&self, limit_by_parameter: f64) -> FormSensitivity {
        let beta = limit_by_parameter / self.gradient_norm;
        FormSensitivity { beta, probability: -normal::density(self.beta) * beta }
    }
}

/// A point at which the limit state has been evaluated.
#[derive(Clone, Debug)]
pub(super) struct Iterate {
    pub(super) point: Vec<f64>,
    pub(super) limit: LimitValue,
    /// `None` if the gradient is zero.
    slope: Option<Slope>,
}

/// First-order expansion of the limit state at a point.
#[derive(Clone, Debug)]
pub(super) struct Slope {
    pub(super) direction: Vec<f64>,
    pub(super) norm: f64,
    pub(super) residuals: Residuals,
}

impl Iterate {
    /// `sign` is +1 if the origin is safe, -1 if it fails.
    pub(super) fn new(point: Vec<f64>, limit: LimitValue, sign: f64) -> Self {
        let slope = unit(&limit.gradient).map(|upwards| {
            let direction = scaled(-1.0, &upwards);
            let (length, norm_of_gradient) = (norm(&point), norm(&limit.gradient));
            let scale = length.max(1.0);
            let off_normal = add_scaled(&point, -sign * length, &direction);
            Slope {
                residuals: Residuals {
                    limit: (limit.value / norm_of_gradient).abs() / scale,
                    direction: norm(&off_normal) / scale,
                },
                direction,
                norm: norm_of_gradient,
            }
        });
        let slope = slope.filter(|slope| slope.residuals.largest().is_finite());
        Self { point, limit, slope }
    }

    pub(super) fn slope(&self) -> Option<&Slope> {
        self.slope.as_ref()
    }

    pub(super) fn residual(&self) -> f64 {
        self.slope.as_ref().map_or(f64::INFINITY, |slope| slope.residuals.largest())
    }

    pub(super) fn design_point(self) -> Option<DesignPoint> {
        let slope = self.slope?;
        Some(DesignPoint {
            beta: dot(&self.point, &slope.direction),
            point: self.point,
            direction: slope.direction,
            gradient_norm: slope.norm,
            residuals: slope.residuals,
        })
    }

    pub(super) fn closest(self, evaluations: Evaluations) -> Closest {
        Closest {
            residuals: self.slope.map(|slope| slope.residuals),
            value: self.limit.value,
            point: self.point,
            evaluations,
        }
    }
}
