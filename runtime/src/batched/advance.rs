//! The next block: predicted, solved, checked, lane by lane.

use super::block::{Block, Past, sizes};
use super::continuity::Continuity;
use super::newton::newton;
use super::slopes::{Slopes, slopes};
use super::state::{Scratch, state};
use crate::algebra::Matrix;
use crate::kernels::BatchKernels;
use crate::scalar::{Batch, Instructions, WIDTH};
use crate::{Description, Input};

/// What is written on the way to a block, and over again.
pub(crate) struct Workspace {
    scratch: Scratch,
    /// For derivatives of the modes, where they are wanted.
    slopes: Option<Slopes>,
}

impl Workspace {
    /// For blocks of a mechanism.
    pub(crate) fn new(description: &Description, with_slopes: bool) -> Self {
        let sizes = sizes(description);
        Self {
            scratch: Scratch::new(sizes.coordinates),
            slopes: with_slopes.then(|| Slopes::new(description, sizes)),
        }
    }
}

impl Block {
    /// Solves the first of `values`, as many as there is room for, from where the way leads. `shapes` are the modes of the last
    /// state, one in each row. Returns how many of the states in a row passed every check; if wanted, their modes have
    /// derivatives.
    pub(crate) fn solve(
        &mut self,
        workspace: &mut Workspace,
        (kernels, instructions): (&dyn BatchKernels, Instructions),
        (input, values): (Input, &[f64]),
        past: &Past,
        shapes: &Matrix,
    ) -> usize {
        let number = values.len().min(WIDTH);
        let Some(&last) = values[..number].last() else {
            return 0;
        };
        // Lanes without a value of their own repeat the last.
        self.values = Batch::from_fn(|k| if k < number { values[k] } else { last });
        self.inputs[input.index()] = self.values;
        self.predict(past);
        let Workspace {
            scratch,
            slopes: derivatives,
        } = workspace;
        newton(kernels, instructions, self, scratch);
        instructions.run(Continuity { past, block: self });
        if self.flags.0[0] == 1.0 {
            state(kernels, instructions, self, scratch, shapes);
            if let Some(derivatives) = derivatives {
                slopes(kernels, instructions, self, derivatives);
            }
        }
        let passed = self.flags.0[..number]
            .iter()
            .take_while(|flag| **flag == 1.0);
        passed.count()
    }

    /// The parabola through the last states.
    fn predict(&mut self, past: &Past) {
        let [(u0, q0), (u1, q1), (u2, q2)] = past;
        let (step, before, both) = (1.0 / (u0 - u1), 1.0 / (u1 - u2), 1.0 / (u0 - u2));
        for (i, place) in self.coordinates.iter_mut().enumerate() {
            let slope = (q0[i] - q1[i]) * step;
            let bend = (slope - (q1[i] - q2[i]) * before) * both;
            for (q, u) in place.0.iter_mut().zip(&self.values.0) {
                *q = q0[i] + (u - u0) * (slope + (u - u1) * bend);
            }
        }
    }
}
