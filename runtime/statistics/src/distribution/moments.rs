//! Third and fourth moments.

use super::{Distribution, Kind};
use crate::legendre;
use crate::normal;

impl Distribution {
    /// Skewness: third central moment over the cube of the standard deviation. Zero for a constant.
    #[must_use]
    pub fn skewness(&self) -> f64 {
        match &self.kind {
            _ if self.sigma == 0.0 => 0.0,
            Kind::Normal | Kind::Uniform { .. } => 0.0,
            Kind::Triangular { low, peak, high } => {
                // In terms of the distances from the peak: if one is zero, the third moment is the cube of the other.
                let (below, above) = (peak - low, high - peak);
                let third = (above - below) * (2.0 * below + above) * (below + 2.0 * above) / 270.0;
                third / self.sigma.powi(3)
            }
            _ => self.standardised(3),
        }
    }

    /// Excess kurtosis: fourth central moment over the fourth power of the standard deviation, minus the 3 of a normal
    /// variable.
    ///
    /// Zero for a constant.
    #[must_use]
    pub fn excess_kurtosis(&self) -> f64 {
        match &self.kind {
            _ if self.sigma == 0.0 => 0.0,
            Kind::Normal => 0.0,
            Kind::Uniform { .. } => -1.2,
            Kind::Triangular { .. } => -0.6,
            _ => self.standardised(4) - 3.0,
        }
    }

    /// Central moment of an order over the same power of the standard deviation.
    fn standardised(&self, order: i32) -> f64 {
        let power = |value: f64| ((value - self.mean) / self.sigma).powi(order);
        if let Kind::Discrete(discrete) = &self.kind {
            return discrete.sum(power);
        }
        over_normal(|z| power(self.from_normal(z)))
    }
}

/// Mean of a smooth function of a standard normal variable that grows no faster than a power of `exp(z)`.
pub(super) fn over_normal(f: impl Fn(f64) -> f64) -> f64 {
    const REACH: f64 = 26.0;
    let weighted = |z: f64| {
        let density = normal::density(z);
        let value = f(z);
        if value == 0.0 { 0.0 } else { value * density }
    };
    legendre::composite((-REACH, REACH), 104, weighted)
}
