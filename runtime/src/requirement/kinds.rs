//! The kinds of requirements.

use super::limit::Edge;
use crate::Error;
use crate::response::Response;
use crate::tolerance::Outcome;

/// Something that a design has to meet. Numbers are in the SI unit of the response.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Requirement {
    /// A response lies in a band, ends included; either may be infinite.
    Within {
        /// What has to lie there.
        response: Response,
        /// Low end.
        #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
        low: f64,
        /// High end.
        #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
        high: f64,
    },
    /// A response lies outside a forbidden band, or on one of its ends; either may be infinite.
    Outside {
        /// What must not lie there.
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
    /// Stability is no number, so it has chances but no design point. For that, require a critical value of an input beyond
    /// the operating point ([`Response::Critical`]).
    Stable,
}

impl Requirement {
    /// A response is at least this.
    #[must_use]
    pub fn at_least(response: Response, low: f64) -> Self {
        let high = f64::INFINITY;
        Self::Within {
            response,
            low,
            high,
        }
    }

    /// A response is at most this.
    #[must_use]
    pub fn at_most(response: Response, high: f64) -> Self {
        let low = f64::NEG_INFINITY;
        Self::Within {
            response,
            low,
            high,
        }
    }

    /// The response that it is about.
    #[must_use]
    pub fn response(&self) -> Option<Response> {
        match self {
            Self::Within { response, .. } | Self::Outside { response, .. } => Some(*response),
            Self::Stable => None,
        }
    }

    /// Whether a design meets it that has this outcome and this response; `None` where it has no response to tell.
    #[must_use]
    pub fn met(&self, outcome: Outcome, response: Option<f64>) -> Option<bool> {
        match *self {
            Self::Within { low, high, .. } => response.map(|value| low <= value && value <= high),
            Self::Outside { low, high, .. } => response.map(|value| value <= low || value >= high),
            Self::Stable => Some(outcome == Outcome::Stable),
        }
    }

    /// The limits of failure.
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
