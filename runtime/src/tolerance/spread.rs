//! First-order spread of one quantity.

use super::Tolerances;
use crate::algebra::Vector;

/// First-order spread of one quantity.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Spread {
    /// Mean, SI: the nominal value, and what means of design variables beside their nominal values add to it.
    pub mean: f64,
    /// Derivatives by the design variables, per SI unit.
    pub by_design: Vector,
    /// Standard deviation, SI.
    pub sigma: f64,
    /// Half-width of the band that holds as many standard deviations as the tolerances do, SI.
    pub band: f64,
    /// Share of each design variable in the variance; they sum to 1, or are all zero when nothing varies. Correlated
    /// variables can have negative shares.
    pub variance_shares: Vector,
}

impl Spread {
    /// The spread of a quantity from its value and its derivatives by the design variables.
    #[must_use]
    pub fn new(mean: f64, by_design: Vector, tolerances: &Tolerances) -> Self {
        let (sigma, variance_shares) = tolerances.spread(&by_design);
        Self {
            mean: mean + tolerances.mean_shift(&by_design),
            by_design,
            sigma,
            band: tolerances.sigma_level() * sigma,
            variance_shares,
        }
    }

    /// That of a quantity which nothing moves, `sigma` zero, or which moves without bound, `sigma` infinite.
    pub(super) fn without_derivatives(mean: f64, sigma: f64, variables: usize) -> Self {
        Self {
            mean,
            by_design: Vector::zeros(variables),
            sigma,
            band: sigma,
            variance_shares: Vector::zeros(variables),
        }
    }
}
