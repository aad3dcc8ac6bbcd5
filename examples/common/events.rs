//! Speeds at which something happens, with the tolerance that the design variables give them.

use eigentol::sensitivity::{critical_sensitivity, crossing_sensitivity};
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
    /// Those of [`Study::critical_state`] and [`Study::crossings`].
    pub fn find<M, const N: usize, const U: usize, const P: usize, const O: usize>(
        study: &Study<M, N, U, P, O>,
        question: &Question,
    ) -> Result<Self, Error>
    where
        M: Mechanism<N, U, P, O>,
    {
        let (low, high) = question.range;
        let state = study.critical_state(question.speed, low, high)?;
        let nominal = state.equilibrium.design;
        let level = question.levels.first().copied().unwrap_or(0.0);
        let deviations = question.tolerances(&nominal, level)?.standard_deviations();
        let event = |speed: f64, slope: Result<[f64; P], Error>| Event {
            speed,
            sigma: slope.ok().map(|slope| {
                let moved = slope.iter().zip(&deviations).map(|(s, sigma)| s * sigma);
                moved.map(|move_by| move_by * move_by).sum::<f64>().sqrt()
            }),
        };
        let mechanism = study.mechanism();
        let resonances = study.crossings(question.speed, low, high, 1.0)?;
        Ok(Self {
            critical: event(state.value, critical_sensitivity(mechanism, &state)),
            resonances: resonances
                .iter()
                .map(|crossing| event(crossing.value, crossing_sensitivity(mechanism, crossing)))
                .collect(),
        })
    }
}
