//! Variables as functions of a standard normal one: `x(z) = F^-1(Phi(z))`.

use super::{Distribution, Kind, beta};
use crate::normal;

impl Distribution {
    /// The value with the same probability of being exceeded as the standard normal `z`: increasing, and accurate in
    /// both tails.
    #[must_use]
    pub fn from_normal(&self, z: f64) -> f64 {
        if self.sigma == 0.0 {
            return self.mean;
        }
        match &self.kind {
            Kind::Normal => self.mean + self.sigma * z,
            Kind::Lognormal { log_mean, log_sigma } => (log_mean + log_sigma * z).exp(),
            Kind::Weibull { shape, scale } => scale * (-normal::ln_upper(z)).powf(1.0 / shape),
            Kind::TruncatedNormal { centre, scale, within } => centre + scale * within.quantile(z),
            Kind::Uniform { low, high } => {
                let width = high - low;
                if z < 0.0 { low + width * normal::cdf(z) } else { high - width * normal::cdf(-z) }
            }
            Kind::Triangular { low, peak, high } => {
                let (below, above, width) = (peak - low, high - peak, high - low);
                let probability = normal::cdf(z);
                if probability * width < below {
                    low + (probability * width * below).sqrt()
                } else {
                    let left = (normal::cdf(-z) * width * above).sqrt();
                    if z < 0.0 {
                        // `high - left`, computed from the peak, which may be near.
                        peak + above * (probability * width - below) / (above + left)
                    } else {
                        high - left
                    }
                }
            }
            Kind::Beta { shapes, low, high } => match beta::quantile(*shapes, z) {
                (x, false) => low + (high - low) * x,
                (rest, true) => high - (high - low) * rest,
            },
            Kind::Discrete(discrete) => discrete.quantile(z),
        }
    }

    /// Derivative of [`Self::from_normal`]; zero for discrete values, where the function is a step function.
    #[must_use]
    pub fn slope_from_normal(&self, z: f64) -> f64 {
        if self.sigma == 0.0 {
            return 0.0;
        }
        match &self.kind {
            Kind::Normal => self.sigma,
            Kind::Lognormal { log_sigma, .. } => log_sigma * self.from_normal(z),
            Kind::Weibull { shape, .. } => {
                let value = self.from_normal(z);
                if value == 0.0 {
                    return 0.0;
                }
                value * normal::hazard(z) / (-shape * normal::ln_upper(z))
            }
            Kind::TruncatedNormal { scale, within, .. } => scale * within.slope(z),
            Kind::Uniform { low, high } => (high - low) * normal::density(z),
            Kind::Triangular { low, peak, high } => {
                let (below, above, width) = (peak - low, high - peak, high - low);
                let (probability, density) = (normal::cdf(z), normal::density(z));
                if density == 0.0 {
                    return 0.0;
                }
                let side = if probability * width < below { below / probability } else { above / normal::cdf(-z) };
                0.5 * density * (width * side).sqrt()
            }
            Kind::Beta { shapes, low, high } => (high - low) * beta::slope(*shapes, z),
            Kind::Discrete(_) => 0.0,
        }
    }
}
