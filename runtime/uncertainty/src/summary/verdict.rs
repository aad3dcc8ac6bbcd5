//! The verdict on a mode: advice, doubts and the results of sampling.

use crate::judge::{Doubt, Measured};
use crate::sensitivity::Quantity;

/// The verdict on the first-order standard deviation of one mode.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Trust {
    /// Position of the mode, from 0.
    pub mode: usize,
    /// The reasons not to trust it; empty if there are none.
    pub doubts: Vec<Doubt>,
    /// Results of sampling its quantities. Empty if samples are too expensive, if the mode neither oscillates nor is
    /// neutral, or if samples do not separate it from the other modes of its cluster.
    pub checks: Vec<Check>,
    /// The method to use.
    pub advice: Advice,
}

impl Trust {
    /// Whether there are no doubts.
    #[must_use]
    pub fn trusted(&self) -> bool {
        self.doubts.is_empty()
    }

    /// The result of sampling a quantity.
    #[must_use]
    pub fn check(&self, quantity: Quantity) -> Option<&Check> {
        self.checks.iter().find(|check| check.quantity == quantity)
    }
}

/// The method to use for the standard deviation of a mode.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Advice {
    /// First order.
    FirstOrder,
    /// The second-order model, confirmed by samples.
    SecondOrder,
    /// Samples: those drawn for the check, or more of them by [`monte_carlo`](crate::tolerance::monte_carlo).
    Sampling,
    /// The mode has no standard deviation of its own: use that of its cluster
    /// ([`Summary::cluster_of`](super::Summary::cluster_of)).
    Cluster,
}

/// A quantity of a mode over re-solved samples, with its predictions.
///
/// A mode that does not oscillate has no frequency and no damping ratio. Mean and standard deviation are over the
/// samples in which it does, on whatever branch of equilibria these lie; the number of other samples is known.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Check {
    /// The quantity: frequency in rad/s, or damping ratio.
    pub quantity: Quantity,
    /// Number of samples drawn.
    pub samples: usize,
    /// Number of samples that have the quantity: they are stable and oscillate in this mode.
    pub count: usize,
    /// Mean over the samples that have the quantity.
    pub mean: f64,
    /// Standard deviation over the samples that have the quantity.
    pub sigma: Measured,
    /// Whether the first-order predictions of the samples spread as first order says. If not, the samples miss rare
    /// values to which the standard deviation is due, and the errors below are `None`.
    pub representative: bool,
    /// Relative error of the first-order standard deviation with respect to the sampled one; negative if first order is
    /// too small. `None` if there is nothing to compare.
    pub first_order_error: Option<Measured>,
    /// Relative error of the second-order standard deviation, likewise.
    pub second_order_error: Option<Measured>,
}
