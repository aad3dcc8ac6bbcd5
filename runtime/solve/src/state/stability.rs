//! Whether a mechanism stays at an equilibrium.

use core::fmt;

/// Stability of an equilibrium against small disturbances.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Stability {
    /// No small disturbance grows.
    Stable,
    /// Stable only by gyroscopic forces, which hold directions of negative stiffness; the least dissipation destroys
    /// it.
    GyroscopicallyStabilised {
        /// Number of directions with negative stiffness.
        negative: usize,
    },
    /// Some oscillation neither grows nor decays within rounding, and no theorem rules out that it grows.
    Marginal,
    /// Not unstable, but with directions of zero stiffness: the mechanism rests anywhere along them.
    Neutral {
        /// Number of eigenvalues that are zero within rounding, or that oscillate with a vector of another one: seen from
        /// a turning frame, a motion that drifts does.
        zero: usize,
    },
    /// A disturbance grows without oscillation (static instability).
    Divergent {
        /// Number of negative eigenvalues `lambda`, or of growing real eigenvalues `s`.
        negative: usize,
    },
    /// A disturbance grows in an oscillation (dynamic instability).
    Flutter {
        /// Number of growing oscillations.
        growing: usize,
    },
    /// The general eigenvalues, which would decide, were not found to working accuracy.
    Undecided,
}

impl Stability {
    /// Whether small disturbances stay small as far as the linearised mechanism tells; neutral directions count as
    /// holding, although a motion along them may go on for ever.
    #[must_use]
    pub fn holds(self) -> bool {
        matches!(self, Self::Stable | Self::GyroscopicallyStabilised { .. } | Self::Marginal | Self::Neutral { .. })
    }
}

impl fmt::Display for Stability {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Stable => write!(f, "stable"),
            Self::Neutral { zero: 1 } => write!(f, "neutral (one free direction)"),
            Self::Neutral { zero } => write!(f, "neutral ({zero} free directions)"),
            Self::Divergent { negative } => match negative {
                1 => write!(f, "divergent (unstable in one direction)"),
                _ => write!(f, "divergent (unstable in {negative} directions)"),
            },
            Self::GyroscopicallyStabilised { negative } => {
                write!(f, "stable by gyroscopic forces alone ({negative} directions without stiffness)")
            }
            Self::Marginal => write!(f, "marginal (an oscillation neither grows nor decays within rounding)"),
            Self::Flutter { growing } => match growing {
                1 => write!(f, "flutter (one growing oscillation)"),
                _ => write!(f, "flutter ({growing} growing oscillations)"),
            },
            Self::Undecided => write!(f, "undecided: its eigenvalues were not found"),
        }
    }
}

impl Stability {
    /// The state after "the equilibrium is", in a sentence.
    ///
    /// ```
    /// # use eigentol_solve as eigentol;
    /// use eigentol::Stability;
    ///
    /// let state = Stability::Flutter { growing: 1 }.predicate();
    /// assert_eq!(state, "unstable (flutter: one growing oscillation)");
    /// ```
    #[must_use]
    pub fn predicate(self) -> String {
        match self {
            Self::Flutter { growing: 1 } => "unstable (flutter: one growing oscillation)".to_owned(),
            Self::Flutter { growing } => {
                format!("unstable (flutter: {growing} growing oscillations)")
            }
            Self::Divergent { negative: 1 } => "unstable in one direction (divergence)".to_owned(),
            Self::Divergent { negative } => {
                format!("unstable in {negative} directions (divergence)")
            }
            other => other.to_string(),
        }
    }
}
