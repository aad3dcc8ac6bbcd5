//! Speeds at which events happen, and their tolerances due to the design variables.

use eigentol::sweep::EventTolerance;
use eigentol::{Error, Mechanism, Study};

use crate::Question;

/// The speed of an event.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Event {
    /// Nominal speed, rad/s.
    pub speed: f64,
    /// Its standard deviation under the question's first tolerance, rad/s; `None` if it has no derivative.
    pub sigma: Option<f64>,
}

/// The events of one sweep.
#[derive(Clone, Debug, PartialEq)]
pub struct Events {
    /// The hanging position loses its stiffness.
    pub critical: Event,
    /// A natural frequency equals the speed.
    pub resonances: Vec<Event>,
}

impl Events {
    /// Finds the events over the range of the question.
    ///
    /// # Errors
    /// The errors of [`Study::critical_tolerance`] and [`Study::crossing_tolerances`].
    pub fn find<M: Mechanism>(study: &Study<M>, question: &Question) -> Result<Self, Error> {
        let (low, high) = question.range;
        let level = question.levels.first().copied().unwrap_or(0.0);
        let study = question.varied_by(study, level);
        let critical = study.critical_tolerance(question.input(), low, high)?;
        let resonances = study.crossing_tolerances(question.input(), low, high, 1.0)?;
        Ok(Self {
            critical: Event::from(&critical),
            resonances: resonances.iter().map(Event::from).collect(),
        })
    }
}

impl From<&EventTolerance> for Event {
    fn from(found: &EventTolerance) -> Self {
        Self {
            speed: found.value,
            sigma: found.sigma(),
        }
    }
}
