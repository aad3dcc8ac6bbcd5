//! The verdict on a mode: advice, doubts and the results of sampling.

use super::paired::Measured;
use crate::Error;
use crate::sensitivity::Quantity;

/// A first-order standard deviation with a larger error is not to be trusted.
pub const TRUSTED_SIGMA_ERROR: f64 = 0.05;

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

/// A reason not to trust a first-order standard deviation.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Doubt {
    /// The mode does not oscillate: it has no frequency.
    NoFrequency,
    /// Tolerances mix it with other modes.
    Clustered {
        /// Positions of all modes of the cluster, including this one.
        modes: Vec<usize>,
        /// Smallest distance between two of them, in standard deviations.
        #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
        distance: f64,
        /// They have merged into one defective eigenvalue.
        defective: bool,
    },
    /// The critical state, beyond which the equilibrium changes branch, is near: the distance is zero within rounding
    /// of it, negative beyond it. A positive distance is not reported if samples found first order right.
    NearCritical {
        /// Standard deviations.
        #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
        distance: f64,
    },
    /// The mode is close to growing: the distance is zero if it neither grows nor decays within rounding, negative if
    /// it grows. It is reported whatever samples show, because sigma says nothing about unstable ones.
    NearInstability {
        /// Standard deviations.
        #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
        distance: f64,
    },
    /// The mode is close to ceasing to oscillate: its eigenvalue meets its conjugate and splits into two real ones. It
    /// is not reported near a critical state, or if samples found first order right.
    NearCriticalDamping {
        /// Standard deviations, `Im s / (2 sigma)`: the distance of `(Im s)^2` from zero.
        #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
        distance: f64,
    },
    /// First order disagrees with the standard deviation of the second-order model. Checked only where samples did not
    /// decide and the series may converge: not near a critical state or critical damping.
    Nonlinear {
        /// The quantity.
        quantity: Quantity,
        /// Relative error with respect to second order.
        #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
        sigma_error: f64,
    },
    /// First order disagrees with the standard deviation of samples.
    Inaccurate {
        /// The quantity.
        quantity: Quantity,
        /// The error, as in [`Check::first_order_error`].
        error: Measured,
    },
    /// The standard deviation is due to values too rare to be among the samples, such as an outlier in a list of measured
    /// values: nothing confirms first order.
    Unrepresentative {
        /// The quantity.
        quantity: Quantity,
    },
    /// Fewer than half of the samples have the quantity, for a reason other than a nearby instability.
    Missing {
        /// The quantity.
        quantity: Quantity,
        /// Number of samples that have it.
        count: usize,
        /// Number of samples drawn.
        samples: usize,
    },
    /// The second-order model needed for the check does not exist, and no samples decided.
    Unchecked {
        /// The reason.
        reason: Error,
    },
}
