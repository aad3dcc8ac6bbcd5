//! What an analysis says of a mechanism.

use eigentol::{Equilibrium, Modes};

/// The answer behind the numbers.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Verdict {
    Yes,
    /// With the reason.
    No(String),
}

impl Verdict {
    /// Whether a mechanism stays where it is and its modes do not grow.
    pub(crate) fn of(equilibrium: &Equilibrium, modes: &Modes) -> Self {
        if !equilibrium.stability.holds() {
            return Self::No(format!("the equilibrium is {}", equilibrium.stability));
        }
        let growing = modes.modes.iter().find(|mode| mode.behaviour.grows());
        match growing {
            Some(mode) => Self::No(format!("mode {} {}", mode.label + 1, mode.behaviour)),
            None => Self::Yes,
        }
    }

    /// This one, or the other where this one is yes.
    pub(crate) fn and(self, other: Self) -> Self {
        match self {
            Self::Yes => other,
            no => no,
        }
    }
}
