//! The verdict of an analysis on a mechanism.

use eigentol::{Error, Study};
use eigentol_interpreter::Interpreted;

/// The verdict behind the numbers.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Verdict {
    Yes,
    /// No, with the reason.
    No(String),
    /// Interrupted by Ctrl-C, with the progress made.
    Stopped(String),
}

impl Verdict {
    /// Interrupted by Ctrl-C after `done` of `wanted` steps.
    pub(crate) fn stopped(done: usize, wanted: usize, steps: &str) -> Self {
        Self::Stopped(format!("after {done} of {wanted} {steps}"))
    }

    /// Whether the equilibrium is stable and no mode grows.
    pub(crate) fn of(study: &Study<Interpreted>) -> Result<Self, Error> {
        let modes = study.modes()?.modes;
        let stability = study.equilibrium()?.stability;
        if !stability.holds() {
            let predicate = stability.predicate();
            return Ok(Self::No(format!("the equilibrium is {predicate}")));
        }
        let growing = modes.iter().find(|mode| mode.behaviour.grows());
        Ok(match growing {
            Some(mode) => Self::No(format!("mode {} {}", mode.label + 1, mode.behaviour)),
            None => Self::Yes,
        })
    }
}
