//! What changes along a motion.

use eigentol_oracle::model::Model;
use nalgebra::{DMatrix, DVector};

use crate::flexible::judged::{Machine, State};

fn accelerations(machine: &Machine, state: &State) -> Vec<f64> {
    let found = machine.evaluate("motion", &[&state.velocity, &state.q, &state.u, &state.b]);
    let n = state.q.len();
    let mass = DMatrix::from_row_slice(n, n, &found[0]);
    let force = DVector::from_column_slice(&found[1]);
    let solved = mass.cholesky().expect("a mass matrix").solve(&force);
    solved.as_slice().to_vec()
}

/// The rate along the motion that the machine's own accelerations give.
pub(crate) fn rate(machine: &Machine, state: &State, model: &Model, of: impl Fn([&[f64]; 2]) -> f64) -> f64 {
    let acceleration = accelerations(machine, state);
    let at = |h: f64| {
        let (mut velocity, mut q) = (state.velocity.clone(), state.q.clone());
        for k in 0..q.len() {
            q[k] += h * state.velocity[k] + h * h * acceleration[k] / 2.0;
            velocity[k] += h * acceleration[k];
        }
        let ordered = |values: &[f64]| {
            let mut list = vec![0.0; values.len()];
            for (k, place) in machine.order(model).into_iter().enumerate() {
                list[place] = values[k];
            }
            list
        };
        of([&ordered(&velocity), &ordered(&q)])
    };
    let central = |h: f64| (at(h) - at(-h)) / (2.0 * h);
    (4.0 * central(1e-4) - central(2e-4)) / 3.0
}
