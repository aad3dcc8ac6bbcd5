//! Speeds at which something happens, with the tolerance that the design variables give them.

use eigentol::sweep::EventTolerance;
use eigentol::{Error, Mechanism, Study};

use crate::Question;

/// A speed at which something happens.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Event {
    /// Nominal speed, rad/s.
    pub speed: f64,
    /// Its standard deviation at the first tolerance of the question, rad/s; `None` where it has no derivative.
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
    /// Looks for them over the range of the question.
    ///
    /// # Errors
    /// Those of [`Study::critical_tolerance`] and [`Study::crossing_tolerances`].
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
