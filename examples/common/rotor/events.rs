//! Speeds at which a rotor has an event: a frequency meets an order, or an oscillation begins or ceases to grow.

use eigentol::modes::{Whirl, whirls};
use eigentol::sweep::crossing_tolerance;
use eigentol::sweep::{Condition, Crossing};
use eigentol::tolerance::Spread;
use eigentol::{Complex, Error, Mechanism, Study};

use super::RotorQuestion;

/// The kind of event.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Happening {
    /// A frequency is this multiple of the speed.
    Order(f64),
    /// An oscillation begins or ceases to grow.
    Onset,
}

/// An event at a speed.
#[derive(Clone, Debug, PartialEq)]
pub struct RotorEvent {
    /// The kind of event.
    pub happening: Happening,
    /// Number of the mode along the Campbell diagram, from 0.
    pub mode: usize,
    /// The speed, rad/s.
    pub speed: f64,
    /// Eigenvalue of the mode there, 1/s.
    pub s: Complex,
    /// How the mode whirls.
    pub whirl: Option<Whirl>,
    /// The sensitivity of the speed to the design, or why it has no derivative.
    pub spread: Result<Spread, Error>,
}

impl RotorEvent {
    /// Standard deviation of the speed, rad/s.
    pub fn sigma(&self) -> Option<f64> {
        self.spread.as_ref().ok().map(|spread| spread.sigma)
    }

    /// The event in words.
    pub fn name(&self) -> String {
        let mode = self.mode + 1;
        match self.happening {
            Happening::Order(order) => format!("mode {mode} meets {order} x speed"),
            Happening::Onset => format!("mode {mode}: limit of stability"),
        }
    }
}

/// All events over the range of the question: the orders one by one, then the onsets.
///
/// # Errors
/// The errors of [`Study::crossings`], [`Study::flutter_onsets`] and [`Study::tolerances`].
pub fn find<M: Mechanism>(
    study: &Study<M>,
    question: &RotorQuestion,
) -> Result<Vec<RotorEvent>, Error> {
    let (low, high) = question.range;
    let mut crossings: Vec<Crossing> = Vec::new();
    for &order in &question.orders {
        let mut found = study.crossings(question.input(), low, high, order)?;
        found.sort_by(|a, b| a.value.total_cmp(&b.value));
        crossings.append(&mut found);
    }
    crossings.extend(study.flutter_onsets(question.input(), low, high)?);

    let tolerances = study.tolerances()?;
    let mechanism = study.mechanism();
    let event = |crossing: &Crossing| {
        let mode = crossing.modes.modes.get(crossing.mode)?;
        let whirls = whirls(mechanism, &crossing.equilibrium, &crossing.modes);
        Some(RotorEvent {
            happening: match crossing.condition {
                Condition::Line(line) => Happening::Order(line.ratio),
                _ => Happening::Onset,
            },
            mode: mode.label,
            speed: crossing.value,
            s: mode.s,
            whirl: whirls[crossing.mode],
            spread: crossing_tolerance(mechanism, crossing, &tolerances).spread,
        })
    };
    Ok(crossings.iter().filter_map(event).collect())
}
