//! An event in the space of designs, and its probability by lines of designs solved anew.

use core::cell::RefCell;
use core::convert::Infallible;

use eigentol_statistics::Distribution;
use eigentol_statistics::reliability::lines::{Direction, LineSampler, LineSettings};
use eigentol_statistics::reliability::{LimitState, LimitValue};

use super::cost::{BUDGET, operations};
use super::judged::{Judged, Judgement, Unjudged};
use crate::Error;
use crate::algebra::Vector;
use crate::deviations::Deviations;
use crate::response::{Realisation, Responses, Workspace};

/// Most designs: further ones would not change a verdict.
const MOST: u64 = 20_000;
/// States that a search along an input solves for each of its steps, and designs worth such a search whatever it costs.
const STATES: f64 = 20.0;
const SEARCHES: u64 = 600;
/// Target coefficient of variation, well within what is trusted.
const ACCURACY: f64 = 0.02;
/// Standard deviations up to which lines are searched at least and at most, and by how much beyond what is known to
/// fail.
const REACH: f64 = 8.0;
const FARTHEST: f64 = 40.0;
const BEYOND: f64 = 3.0;

/// A function of a design and its responses.
pub(crate) type Distance<'a> = dyn Fn(&[f64], &Realisation) -> Option<f64> + 'a;

/// An event: designs for which a function of their responses is not positive.
pub(crate) struct Event<'a> {
    responses: &'a Responses<'a>,
    deviations: &'a Deviations<'a>,
    /// The function; infinite where only the sign is known, `None` where nothing can be told.
    distance: &'a Distance<'a>,
    room: RefCell<Workspace>,
}

/// Where to look for an event first.
#[derive(Clone, Debug)]
pub(crate) struct Lines {
    /// Directions in the space of standard normal numbers, and how far the event is along them.
    pub(crate) directions: Vec<Direction>,
    /// Designs worth solving whatever they cost.
    pub(crate) worth: u64,
    /// How many times the usual budget an answer is worth.
    pub(crate) effort: f64,
    /// Seed and stream of the lines.
    pub(crate) sequence: (u64, u64),
}

impl Lines {
    /// Along the change of a quantity with these derivatives with respect to the design variables, at this distance in
    /// standard deviations.
    pub(crate) fn along(deviations: &Deviations<'_>, slopes: &[f64], distance: f64) -> Self {
        let origin = vec![0.0; deviations.dimension()];
        let along = deviations.gradient(&origin, slopes);
        Self { directions: vec![Direction { along, distance }], worth: 0, effort: 1.0, sequence: (0, 0) }
    }

    /// The farthest distance.
    pub(crate) fn farthest(&self) -> f64 {
        self.directions.iter().map(|direction| direction.distance).fold(0.0, f64::max)
    }
}

impl<'a> Event<'a> {
    pub(crate) fn new(
        responses: &'a Responses<'a>,
        deviations: &'a Deviations<'a>,
        distance: &'a Distance<'a>,
    ) -> Self {
        Self { responses, deviations, distance, room: RefCell::new(responses.workspace()) }
    }

    /// The probability of the event, from as many designs as a verdict needs and the budget allows.
    ///
    /// # Errors
    /// [`Error::Stopped`].
    pub(crate) fn judge(&self, lines: &Lines) -> Result<Judgement, Error> {
        let tolerances = self.deviations.tolerances();
        let variables = tolerances.normal_dimensions();
        if variables.is_empty() {
            return Ok(Judgement::Open(Unjudged::Still));
        }
        let joint = tolerances.joint().map(|(joint, _)| joint.variables());
        if joint.is_some_and(|all| !all.iter().all(Distribution::is_continuous)) {
            return Ok(Judgement::Open(Unjudged::Discrete));
        }
        let price = self.responses.price();
        let (worth, states) = match price {
            1 => (lines.worth, 1.0),
            _ => (lines.worth.min(SEARCHES), price as f64 * STATES),
        };
        let each = operations(self.responses.modes(), false) * states;
        let budget = lines.effort * BUDGET;
        let affordable = (budget / each).min(MOST as f64);
        let evaluations = worth.max(affordable as u64);
        let (seed, stream) = lines.sequence;
        let settings = LineSettings {
            seed,
            stream,
            evaluations,
            coefficient_of_variation: ACCURACY,
            reach: (lines.farthest() + BEYOND).clamp(REACH, FARTHEST),
        };
        let dimension = self.deviations.dimension();
        let sampler = LineSampler::new(dimension, &variables, &lines.directions, &settings)?;
        let fewest = sampler.fewest();
        if evaluations < fewest {
            return Ok(Judgement::Open(Unjudged::TooDear { operations: fewest as f64 * each, budget }));
        }
        let probability = sampler.run(self);
        self.responses.go_on()?;
        Ok(Judgement::Judged(Judged::new(&probability, settings.reach)))
    }

    fn at(&self, z: &[f64]) -> Option<f64> {
        let design: Vector = self.deviations.design(z);
        let realisation = self.responses.at(&mut self.room.borrow_mut(), &design).ok()?;
        // A design on the limit meets it.
        (self.distance)(&design, &realisation).map(|value| if value == 0.0 { f64::MIN_POSITIVE } else { value })
    }
}

impl LimitState for Event<'_> {
    type Error = Infallible;

    fn dimension(&self) -> usize {
        self.deviations.dimension()
    }

    fn evaluate(&self, z: &[f64]) -> Result<LimitValue, Infallible> {
        let value = self.value(z)?;
        let gradient = vec![0.0; z.len()];
        Ok(LimitValue { value, gradient })
    }

    fn value(&self, z: &[f64]) -> Result<f64, Infallible> {
        Ok(self.at(z).unwrap_or(f64::NAN))
    }
}
