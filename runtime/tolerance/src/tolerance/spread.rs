//! First-order spread of one quantity.

use super::Tolerances;
use crate::algebra::Vector;

/// First-order spread of one quantity.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Spread {
    /// Mean, SI: the nominal value plus the effect of means of design variables that differ from their nominal values.
    #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
    pub mean: f64,
    /// Derivatives with respect to the design variables, per SI unit.
    pub by_design: Vector,
    /// Standard deviation, SI.
    #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
    pub sigma: f64,
    /// Half-width of the band that spans as many standard deviations as the tolerances do, SI.
    #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
    pub band: f64,
    /// Share of each design variable in the variance; they sum to 1, or are all zero if nothing varies. Shares of
    /// correlated variables can be negative.
    pub variance_shares: Vector,
}

impl Spread {
    /// The spread of a quantity from its value and its derivatives with respect to the design variables.
    #[must_use]
    pub fn new(mean: f64, by_design: Vector, tolerances: &Tolerances) -> Self {
        let mut spread = Self::blank();
        spread.by_design = by_design;
        spread.finish(mean, tolerances);
        spread
    }

    /// An empty spread, to be overwritten.
    #[inline]
    pub(super) fn blank() -> Self {
        Self { mean: 0.0, by_design: Vector::default(), sigma: 0.0, band: 0.0, variance_shares: Vector::default() }
    }

    /// Completes the spread of a quantity whose derivatives are already written; returns the effect of means that
    /// differ from the nominal values.
    #[inline]
    pub(super) fn finish(&mut self, mean: f64, tolerances: &Tolerances) -> f64 {
        let shift = tolerances.mean_shift(&self.by_design);
        self.mean = mean + shift;
        self.sigma = tolerances.spread(&self.by_design, &mut self.variance_shares);
        self.band = tolerances.sigma_level() * self.sigma;
        shift
    }

    /// The spread of a quantity that changes `rate` times as fast.
    #[doc(hidden)]
    #[must_use]
    pub fn scaled(&self, rate: f64, mean: f64) -> Self {
        Self {
            mean,
            by_design: self.by_design.map(|slope| rate * slope),
            sigma: rate.abs() * self.sigma,
            band: rate.abs() * self.band,
            variance_shares: self.variance_shares.clone(),
        }
    }

    /// The spread of a quantity that these variables do not change.
    pub(super) fn still(&self, mean: f64) -> Self {
        let mut spread = Self::blank();
        spread.set_without_derivatives(mean, 0.0, self.by_design.len());
        spread
    }

    /// Overwrites this with the spread of a quantity that nothing changes (`sigma` zero) or that changes without bound
    /// (`sigma` infinite).
    #[inline]
    pub(super) fn set_without_derivatives(&mut self, mean: f64, sigma: f64, variables: usize) {
        self.mean = mean;
        self.sigma = sigma;
        self.band = sigma;
        self.by_design.make_room(variables).fill(0.0);
        self.variance_shares.make_room(variables).fill(0.0);
    }
}
