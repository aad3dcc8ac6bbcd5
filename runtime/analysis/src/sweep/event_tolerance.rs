//! First-order spread of the input values at which an event occurs: critical speeds and resonances.

use super::condition::{Change, Condition, Crossing};
use super::event_sensitivity::{critical_sensitivity, crossing_sensitivity};
use super::points::CriticalState;
use crate::algebra::Vector;
use crate::kernels::{DirectionalKernels, Kernels};
use crate::modes::{Family, Whirl, whirls};
use crate::tolerance::{Spread, Tolerances};
use crate::{Complex, Description, Error, Input, Shared};

/// An event at a value of an input.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Event {
    /// The lowest mode loses its stiffness.
    Critical,
    /// A mode meets a condition.
    Crossing {
        /// Position of the mode, from 0.
        mode: usize,
        /// The condition it meets.
        condition: Condition,
        /// Its eigenvalue at the event, 1/s.
        s: Complex,
        /// Its kind and whirl at the event; `None` where no kind is applicable.
        whirl: Option<Whirl>,
    },
}

/// The input value at which an event occurs, and its spread due to tolerances.
///
/// A tolerance of the varied input counts too, with a derivative of -1: the event occurs at a value of what acts, and
/// the value that is set lies below it by the deviation. One in per cent is that at the operating point.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct EventTolerance {
    /// The event.
    pub event: Event,
    /// Whether an instability begins or ends there.
    pub change: Change,
    /// The input.
    pub input: Input,
    /// Its nominal value at the event, SI.
    pub value: f64,
    /// Spread of the value, or the reason why it has no derivative.
    pub spread: Result<Spread, Error>,
    /// Number of standard deviations that a tolerance and a band represent.
    pub sigma_level: f64,
    /// The family of modes used to find the event.
    pub family: Family,
    /// The inputs at the event, SI.
    pub inputs: Vector,
    /// The mechanism it belongs to.
    pub description: Shared<Description>,
}

impl EventTolerance {
    /// Whether anything can excite the mode of a crossing there ([`Whirl::is_excited_at`]); true of other events.
    #[must_use]
    pub fn is_excited(&self) -> bool {
        match self.event {
            Event::Crossing { s, whirl: Some(whirl), condition: Condition::Line(_), .. } => whirl.is_excited_at(s.im),
            _ => true,
        }
    }

    /// The event with another number for the mode of a crossing.
    pub(crate) fn with_mode(mut self, number: usize) -> Self {
        if let Event::Crossing { mode, .. } = &mut self.event {
            *mode = number;
        }
        self
    }

    /// Standard deviation of the value, SI; `None` if it has no derivative.
    #[must_use]
    pub fn sigma(&self) -> Option<f64> {
        self.spread.as_ref().ok().map(|spread| spread.sigma)
    }
}

/// First-order spread of a critical value ([`critical_sensitivity`]).
pub fn critical_tolerance(
    mechanism: &dyn DirectionalKernels,
    critical: &CriticalState,
    tolerances: &Tolerances,
) -> EventTolerance {
    EventTolerance {
        event: Event::Critical,
        change: critical.change,
        input: critical.input,
        value: critical.value,
        spread: critical_sensitivity(mechanism, critical).and_then(|slopes| spread(critical.value, slopes, tolerances)),
        sigma_level: tolerances.sigma_level(),
        family: Family::General,
        inputs: critical.equilibrium.inputs.clone(),
        description: critical.equilibrium.description.clone(),
    }
}

/// First-order spread of a crossing ([`crossing_sensitivity`]).
pub fn crossing_tolerance(mechanism: &dyn Kernels, crossing: &Crossing, tolerances: &Tolerances) -> EventTolerance {
    EventTolerance {
        event: Event::Crossing {
            mode: crossing.mode,
            condition: crossing.condition,
            s: crossing.modes.modes.get(crossing.mode).map_or_else(Complex::default, |mode| mode.s),
            whirl: whirls(mechanism, &crossing.equilibrium, &crossing.modes).get(crossing.mode).copied().flatten(),
        },
        change: crossing.change,
        input: crossing.input,
        value: crossing.value,
        spread: crossing_sensitivity(mechanism, crossing).and_then(|slopes| spread(crossing.value, slopes, tolerances)),
        sigma_level: tolerances.sigma_level(),
        family: crossing.modes.family,
        inputs: crossing.equilibrium.inputs.clone(),
        description: crossing.equilibrium.description.clone(),
    }
}

fn spread(value: f64, by_design: Vector, tolerances: &Tolerances) -> Result<Spread, Error> {
    tolerances.check_count(by_design.len())?;
    Ok(Spread::new(value, by_design, tolerances))
}
