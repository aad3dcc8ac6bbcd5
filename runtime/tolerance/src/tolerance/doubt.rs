//! The reasons not to trust a standard deviation.

use crate::Error;
use crate::sensitivity::Quantity;

/// A number with its standard error.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Measured {
    /// The number.
    #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
    pub value: f64,
    /// Its standard error.
    #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
    pub standard_error: f64,
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
    /// It is equal to other modes in every design, by symmetry: each has the spread of their mean.
    EqualInEveryDesign {
        /// Positions of all modes that are equal, including this one.
        modes: Vec<usize>,
    },
    /// Blades with tolerances of their own mix it with other modes: from a blade, they are seen at one frequency.
    Blades {
        /// Positions of the others.
        modes: Vec<usize>,
    },
    /// The critical state of the mode is near, where its stiffness vanishes and the equilibrium changes branch: the
    /// distance is zero within rounding of it, negative beyond it. A positive distance is not reported if samples found
    /// first order right.
    NearCritical {
        /// Standard deviations.
        #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
        distance: f64,
    },
    /// The critical state of another mode is near, beyond which the equilibrium changes branch and every mode with it.
    /// A positive distance is not reported if samples found first order right.
    BranchNear {
        /// Position of the other mode, from 0.
        mode: usize,
        /// Its distance, in standard deviations, as in [`Doubt::NearCritical`].
        #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
        distance: f64,
    },
    /// The mode has nearly equal neighbours, and no derivative of its own. Reported by first order, where clusters are
    /// not known ([`Doubt::Clustered`]).
    EqualNeighbours,
    /// Another mode is near, which may mix with this one. Reported by first order, where clusters are not known.
    NearNeighbour {
        /// Standard deviations of the difference.
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
        /// The error, as in `Check::first_order_error`.
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

/// A critical state so near that first order exceeds the spread that the frequency can have: the first-order variance is
/// `sigma^2 / (4 lambda)`, the true one at most the mean of `|lambda|`, several times over on another branch.
const UPON_CRITICAL: f64 = 0.1;

impl Doubt {
    /// Whether it is about modes that share one spread.
    #[doc(hidden)]
    pub fn shared(&self) -> bool {
        matches!(self, Self::Clustered { .. } | Self::EqualInEveryDesign { .. })
    }

    /// Whether it shows that there is no such standard deviation, or that it is wrong. Distances to other states only
    /// warn.
    #[must_use]
    pub fn certain(&self) -> bool {
        match self {
            Self::NearCritical { distance } => *distance < UPON_CRITICAL,
            Self::BranchNear { distance, .. } | Self::NearInstability { distance } => *distance <= 0.0,
            Self::NearCriticalDamping { .. }
            | Self::NearNeighbour { .. }
            | Self::Unchecked { .. }
            | Self::Unrepresentative { .. } => false,
            _ => true,
        }
    }
}
