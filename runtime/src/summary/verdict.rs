//! What is said of a mode: its verdict, what speaks against it, what sampling found.

use super::paired::Measured;
use crate::Error;
use crate::sensitivity::Quantity;

/// A first-order standard deviation that is off by more than this is not to be trusted.
pub const TRUSTED_SIGMA_ERROR: f64 = 0.05;

/// The verdict on the first-order standard deviation of one mode.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Trust {
    /// Position of the mode, from 0.
    pub mode: usize,
    /// What speaks against it; empty when nothing does.
    pub doubts: Vec<Doubt>,
    /// What sampling found of its quantities; empty where it was not asked: where samples are too dear, for a mode that does not
    /// oscillate, for the members of a cluster.
    pub checks: Vec<Check>,
    /// What to use.
    pub advice: Advice,
}

impl Trust {
    /// Whether nothing speaks against it.
    #[must_use]
    pub fn trusted(&self) -> bool {
        self.doubts.is_empty()
    }

    /// What sampling found of a quantity.
    #[must_use]
    pub fn check(&self, quantity: Quantity) -> Option<&Check> {
        self.checks.iter().find(|check| check.quantity == quantity)
    }
}

/// The method that gives the standard deviation of a mode.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Advice {
    /// First order.
    FirstOrder,
    /// The second-order model, which samples confirmed.
    SecondOrder,
    /// Samples: those that were drawn for the check, or [`monte_carlo`](crate::tolerance::monte_carlo) with more.
    Sampling,
    /// The mode has none of its own: that of its cluster ([`Summary::cluster_of`](super::Summary::cluster_of)).
    Cluster,
}

/// A quantity of a mode over samples that were solved anew, beside its predictions.
///
/// A mode that does not oscillate has no frequency and no damping ratio: mean and standard deviation are those of the samples in which
/// it does, on whatever branch of equilibria these lie. The number of the others is known.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Check {
    /// Of what: the frequency in rad/s, or the damping ratio.
    pub quantity: Quantity,
    /// Samples that were drawn.
    pub samples: usize,
    /// Those that have the quantity: that are stable, and oscillate in this mode.
    pub count: usize,
    /// Mean over these.
    pub mean: f64,
    /// Standard deviation over these.
    pub sigma: Measured,
    /// By how much the first-order standard deviation misses it, as a fraction of it: negative where first order is below. `None`
    /// where there is none to compare.
    pub first_order_error: Option<Measured>,
    /// By how much that of the second-order model does.
    pub second_order_error: Option<Measured>,
}

/// Why a first-order standard deviation is not to be trusted.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Doubt {
    /// The mode does not oscillate: it has no frequency.
    NoFrequency,
    /// Tolerances mix it with other modes.
    Clustered {
        /// Positions of all modes of the cluster, its own included.
        modes: Vec<usize>,
        /// Least distance of two of them, in standard deviations.
        #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
        distance: f64,
        /// They have merged into one defective eigenvalue.
        defective: bool,
    },
    /// The critical state, beyond which the equilibrium changes branch, is this many standard deviations away; zero within
    /// rounding of it, negative beyond it. Of a mode that was sampled it is said where first order was found wrong.
    NearCritical {
        /// Standard deviations.
        #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
        distance: f64,
    },
    /// The mode begins to grow this many standard deviations away; zero when it neither grows nor decays within rounding,
    /// negative when it grows. It is said whatever samples show: sigma tells nothing of the unstable ones.
    NearInstability {
        /// Standard deviations.
        #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
        distance: f64,
    },
    /// The mode ceases to oscillate this many standard deviations away: it meets its conjugate and becomes two real ones. Of a mode
    /// that was sampled it is said where first order was found wrong.
    NearCriticalDamping {
        /// Standard deviations, `Im s / (2 sigma)`: the distance of `(Im s)^2` from zero.
        #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
        distance: f64,
    },
    /// First order misses the standard deviation of the second-order model. Asked only where samples did not decide, and where the
    /// series may converge: not near a critical state or critical damping.
    Nonlinear {
        /// Of what.
        quantity: Quantity,
        /// By how much, as a fraction of the second-order one.
        #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
        sigma_error: f64,
    },
    /// First order misses the standard deviation of samples.
    Inaccurate {
        /// Of what.
        quantity: Quantity,
        /// By how much, as [`Check::first_order_error`].
        error: Measured,
    },
    /// Not half of the samples have the quantity, for another reason than an instability nearby.
    Missing {
        /// Of what.
        quantity: Quantity,
        /// Samples that have it.
        count: usize,
        /// Samples that were drawn.
        samples: usize,
    },
    /// The second-order model that should check it does not exist, and no samples decided.
    Unchecked {
        /// Why.
        reason: Error,
    },
}
