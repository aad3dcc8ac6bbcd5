//! What an analysis says of a mechanism.

use eigentol::{Equilibrium, Modes};

/// The answer behind the numbers.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Verdict {
    Yes,
    /// With the reason.
    No(String),
    /// Ctrl-C came before the end; with how far it came.
    Stopped(String),
}

impl Verdict {
    /// Ctrl-C came after so many of the steps.
    pub(crate) fn stopped(done: usize, wanted: usize, steps: &str) -> Self {
        Self::Stopped(format!("after {done} of {wanted} {steps}"))
    }

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
}
