//! The values at which a response fails.

use crate::response::Response;
use crate::tolerance::Outcome;

/// The values at which a response fails, in its SI unit.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Edge {
    /// Below this value.
    AtLeast(f64),
    /// Above this value.
    AtMost(f64),
    /// Between these values.
    Outside {
        /// Low end of the forbidden band.
        #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
        low: f64,
        /// High end of the forbidden band.
        #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
        high: f64,
    },
}

impl Edge {
    pub(crate) fn is_finite(&self) -> bool {
        match self {
            Self::AtLeast(end) | Self::AtMost(end) => end.is_finite(),
            Self::Outside { .. } => true,
        }
    }

    /// Distance of a value from failure, negative in failure, and its derivative with respect to the value.
    pub(crate) fn distance(&self, value: f64) -> (f64, f64) {
        match *self {
            Self::AtLeast(low) => (value - low, 1.0),
            Self::AtMost(high) => (high - value, -1.0),
            Self::Outside { low, high } if low - value > value - high => (low - value, -1.0),
            Self::Outside { high, .. } => (value - high, 1.0),
        }
    }

    /// Distance of a design from failure, given its outcome and the response; infinite if it fails without a value, for
    /// want of a stable equilibrium. `None` if the response needed to tell is missing.
    pub(crate) fn distance_of(
        &self,
        outcome: Outcome,
        response: Response,
        value: Option<f64>,
    ) -> Option<f64> {
        let distance = value.map(|value| self.distance(value).0);
        if response.of_state() && outcome.lost() {
            let fails = distance.filter(|distance| *distance <= 0.0);
            return Some(fails.unwrap_or(f64::NEG_INFINITY));
        }
        distance
    }
}
