//! The questions, each prepared so that only it is timed.

use std::hint::black_box;

use eigentol::Policy;
use eigentol::equilibrium::equilibrium;
use eigentol::kernels::SummaryKernels;
use eigentol::modes::modes;
use eigentol::sensitivity::sensitivities;
use eigentol::summary::summary;
use eigentol::sweep::{Range, critical_state, sweep};
use eigentol::tolerance::first_order;
use eigentol::{Equilibrium, Input, Modes, Tolerances, Vector};

use crate::machines::{critical_speed, shaft, storeys, turning};

/// A question about a machine of `n` coordinates, or a shaft of `n` sections. Asked, it returns the number of answers.
pub(crate) struct Question {
    pub(crate) name: &'static str,
    pub(crate) prepare: fn(usize) -> Box<dyn FnMut() -> usize>,
}

pub(crate) const QUESTIONS: [Question; 17] = [
    Question { name: "equilibrium", prepare: |n| Case::turning(n, 0.0).timed(Case::equilibrium) },
    Question { name: "modes, undamped", prepare: |n| Case::storeys(n).timed(Case::modes) },
    Question { name: "modes, gyroscopic", prepare: |n| Case::turning(n, 0.0).timed(Case::modes) },
    Question { name: "modes, general", prepare: |n| Case::turning(n, 3.0).timed(Case::modes) },
    Question { name: "sensitivities, undamped", prepare: |n| Case::storeys(n).timed(Case::sensitivities) },
    Question { name: "sensitivities, gyroscopic", prepare: |n| Case::turning(n, 0.0).timed(Case::sensitivities) },
    Question { name: "sensitivities, general", prepare: |n| Case::turning(n, 3.0).timed(Case::sensitivities) },
    Question { name: "tolerances, first order, undamped", prepare: |n| Case::storeys(n).timed(Case::first_order) },
    Question { name: "tolerances, first order, general", prepare: |n| Case::turning(n, 3.0).timed(Case::first_order) },
    Question { name: "summary, undamped", prepare: |n| Case::storeys(n).timed(Case::summary) },
    Question { name: "summary, gyroscopic", prepare: |n| Case::turning(n, 0.0).timed(Case::summary) },
    Question { name: "a point of a sweep", prepare: |n| Case::turning(n, 0.0).timed(Case::sweep) },
    Question { name: "critical state", prepare: |n| Case::turning(n, 0.0).timed(Case::critical) },
    Question { name: "equilibrium, shaft", prepare: |n| Case::shaft(n).timed(Case::equilibrium) },
    Question { name: "modes, shaft", prepare: |n| Case::shaft(n).timed(Case::modes) },
    Question { name: "sensitivities, shaft", prepare: |n| Case::shaft(n).timed(Case::sensitivities) },
    Question { name: "a point of a sweep, shaft", prepare: |n| Case::shaft(n).timed(Case::sweep) },
];

const SPEED: Input = Input::new(0);
/// Points of a sweep.
const POINTS: usize = 9;

/// A machine with what is known of it beforehand.
struct Case {
    machine: Box<dyn SummaryKernels>,
    inputs: Vec<f64>,
    design: Vector,
    start: Vec<f64>,
    state: Equilibrium,
    modes: Modes,
    tolerances: Tolerances,
}

impl Case {
    fn storeys(n: usize) -> Self {
        Self::new(Box::new(storeys(n)), Vec::new())
    }

    /// At half of its critical speed.
    fn turning(n: usize, damping: f64) -> Self {
        Self::new(Box::new(turning(n, damping)), vec![0.5 * critical_speed(n)])
    }

    fn shaft(n: usize) -> Self {
        Self::new(Box::new(shaft(n)), vec![300.0])
    }

    fn new(machine: Box<dyn SummaryKernels>, inputs: Vec<f64>) -> Self {
        let description = machine.description();
        let design: Vector = description.design.iter().map(|info| info.nominal).collect();
        let start = vec![0.0; description.coordinates.len()];
        let state = equilibrium(&*machine, &inputs, &design, &start, Policy::Stable).expect("an equilibrium");
        let modes = modes(&state).expect("modes");
        let tolerances = Tolerances::declared(&description).expect("tolerances");
        Self { machine, inputs, design, start, state, modes, tolerances }
    }

    fn timed(self, question: fn(&Self) -> usize) -> Box<dyn FnMut() -> usize> {
        Box::new(move || question(&self))
    }

    fn equilibrium(&self) -> usize {
        let found = equilibrium(&*self.machine, &self.inputs, &self.design, &self.start, Policy::Stable);
        black_box(found).map_or(0, |_| 1)
    }

    fn modes(&self) -> usize {
        black_box(modes(&self.state)).map_or(0, |_| 1)
    }

    fn sensitivities(&self) -> usize {
        black_box(sensitivities(&*self.machine, &self.state, &self.modes)).map_or(0, |_| 1)
    }

    fn first_order(&self) -> usize {
        let slopes = sensitivities(&*self.machine, &self.state, &self.modes);
        let found = slopes.and_then(|slopes| first_order(&self.modes, &slopes, &self.tolerances));
        black_box(found).map_or(0, |_| 1)
    }

    fn summary(&self) -> usize {
        let found = summary(&*self.machine, &self.state, &self.modes, &self.tolerances);
        black_box(found).map_or(0, |_| 1)
    }

    fn sweep(&self) -> usize {
        let speed = |k: usize| (0.2 + 0.1 * k as f64) * self.inputs[0];
        let speeds: Vec<f64> = (0..POINTS).map(speed).collect();
        let found = sweep(&*self.machine, &self.inputs, &self.design, &self.start, Policy::Stable, SPEED, &speeds);
        black_box(found).map_or(0, |found| found.points.len())
    }

    fn critical(&self) -> usize {
        let range = Range::new(SPEED, 0.0, 1.2 * critical_speed(self.start.len()));
        let found = critical_state(&*self.machine, &self.inputs, &self.design, &self.start, range);
        black_box(found).map_or(0, |_| 1)
    }
}
