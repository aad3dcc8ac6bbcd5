//! The kinds of requirements.

use super::limit::Edge;
use crate::Error;
use crate::response::Response;
use crate::tolerance::Outcome;

/// A requirement on a design. Numbers are in the SI unit of the response.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Requirement {
    /// A response lies in a band, ends included; either end may be infinite.
    Within {
        /// The response.
        response: Response,
        /// Low end.
        #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
        low: f64,
        /// High end.
        #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
        high: f64,
    },
    /// A response lies outside a forbidden band or on one of its ends; either end may be infinite.
    Outside {
        /// The response.
        response: Response,
        /// Low end.
        #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
        low: f64,
        /// High end.
        #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
        high: f64,
    },
    /// The equilibrium is stable: the design has [`Outcome::Stable`].
    ///
    /// Stability is not a number, so it has a probability but no design point. For a design point, require a critical
    /// value of an input beyond the operating point ([`Response::Critical`]).
    Stable,
}

impl Requirement {
    /// Requires a response to be at least `low`.
    #[must_use]
    pub fn at_least(response: Response, low: f64) -> Self {
        let high = f64::INFINITY;
        Self::Within {
            response,
            low,
            high,
        }
    }

    /// Requires a response to be at most `high`.
    #[must_use]
    pub fn at_most(response: Response, high: f64) -> Self {
        let low = f64::NEG_INFINITY;
        Self::Within {
            response,
            low,
            high,
        }
    }

    /// The response it constrains, if any.
    #[must_use]
    pub fn response(&self) -> Option<Response> {
        match self {
            Self::Within { response, .. } | Self::Outside { response, .. } => Some(*response),
            Self::Stable => None,
        }
    }

    /// Whether a design with this outcome and response meets it; `None` if the response needed to tell is missing.
    ///
    /// A design without a stable equilibrium has no modes and no outputs to speak of, and meets no requirement on them.
    #[must_use]
    pub fn met(&self, outcome: Outcome, response: Option<f64>) -> Option<bool> {
        let Some(value) = response else {
            return match self.response() {
                None => Some(outcome == Outcome::Stable),
                Some(Response::Mode { .. } | Response::Output(_)) if outcome.lost() => Some(false),
                Some(_) => None,
            };
        };
        match *self {
            Self::Within { low, high, .. } => Some(low <= value && value <= high),
            Self::Outside { low, high, .. } => Some(value <= low || value >= high),
            Self::Stable => Some(outcome == Outcome::Stable),
        }
    }

    /// The limits at which the requirement fails.
    pub(super) fn edges(&self) -> Vec<Edge> {
        let (low, high) = match *self {
            Self::Stable => return Vec::new(),
            Self::Within { low, high, .. } => (Edge::AtLeast(low), Edge::AtMost(high)),
            Self::Outside { low, high, .. } if low.is_finite() && high.is_finite() => {
                return vec![Edge::Outside { low, high }];
            }
            Self::Outside { low, high, .. } => (Edge::AtLeast(high), Edge::AtMost(low)),
        };
        [low, high].into_iter().filter(Edge::is_finite).collect()
    }

    pub(super) fn check(&self) -> Result<(), Error> {
        let refuse = |reason: String| {
            Err(Error::Setting {
                setting: "requirement",
                reason,
            })
        };
        match *self {
            Self::Stable => Ok(()),
            Self::Within { low, high, .. } | Self::Outside { low, high, .. } => {
                if low.is_nan() || high.is_nan() || low >= high {
                    return refuse(format!("the band from {low} to {high} is empty"));
                }
                if self.edges().is_empty() {
                    return refuse("a band without a finite end asks for nothing".to_owned());
                }
                Ok(())
            }
        }
    }
}
