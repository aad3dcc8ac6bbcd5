//! The kinds of requirements.

use crate::Error;
use crate::limits::Edge;
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
        Some(self.distance(outcome, response)? >= 0.0)
    }

    /// Distance of a design from failing it, negative in failure; infinite where only the side is known. `None` if the
    /// response needed to tell is missing.
    pub(super) fn distance(&self, outcome: Outcome, value: Option<f64>) -> Option<f64> {
        let Some(response) = self.response() else {
            let side = if outcome == Outcome::Stable {
                1.0
            } else {
                -1.0
            };
            return Some(side * f64::INFINITY);
        };
        let of = |edge: Edge| edge.distance_of(outcome, response, value);
        let mut edges = self.edges().into_iter();
        edges.try_fold(f64::INFINITY, |least, edge| Some(least.min(of(edge)?)))
    }

    /// The limits at which the requirement fails.
    pub(crate) fn edges(&self) -> Vec<Edge> {
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
