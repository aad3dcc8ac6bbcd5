//! The next block: predicted, solved, checked, lane by lane.

use super::algebra::Square;
use super::block::{Block, Past};
use super::continuity::Continuity;
use super::newton::newton;
use super::room::Room;
use super::slopes::{Slopes, slopes};
use super::state::{Scratch, state};
use crate::Input;
use crate::kernels::{BatchKernels, Kernels, Sizes};
use crate::scalar::{Batch, Instructions, WIDTH};

/// A block, and what is written on the way to it over and over again.
pub(crate) struct Workspace<'a> {
    pub(crate) block: Block<'a>,
    scratch: Scratch<'a>,
    /// For derivatives of the modes, where they are wanted.
    slopes: Option<Slopes<'a>>,
}

impl<'a> Workspace<'a> {
    /// Memory for one.
    pub(crate) fn memory(sizes: Sizes, with_slopes: bool) -> Vec<Batch> {
        let slopes = if with_slopes { Slopes::size(sizes) } else { 0 };
        let size = Block::size(sizes) + Scratch::size(sizes.coordinates) + slopes;
        vec![Batch::default(); size]
    }

    /// One for a design and inputs of which one will vary, in memory of its size.
    pub(crate) fn new(
        memory: &'a mut [Batch],
        kernels: &dyn Kernels,
        (inputs, design): (&[f64], &[f64]),
        with_slopes: bool,
    ) -> Self {
        let sizes = kernels.sizes();
        let room = &mut Room::new(memory);
        Self {
            block: Block::new(room, inputs, design, sizes.coordinates),
            scratch: Scratch::new(room, sizes.coordinates),
            slopes: with_slopes.then(|| Slopes::new(room, &kernels.description(), sizes)),
        }
    }

    /// Solves the first of `values`, as many as there is room for, from where the way leads. `shapes` are the modes of the last
    /// state, one in each row. Returns how many of the states in a row passed every check; if wanted, their modes have
    /// derivatives.
    pub(crate) fn solve(
        &mut self,
        (kernels, instructions): (&dyn BatchKernels, Instructions),
        (input, values): (Input, &[f64]),
        past: &Past,
        shapes: &Square<f64>,
    ) -> usize {
        let Self {
            block,
            scratch,
            slopes: derivatives,
        } = self;
        let number = values.len().min(WIDTH);
        let Some(&last) = values[..number].last() else {
            return 0;
        };
        // Lanes without a value of their own repeat the last.
        block.values = Batch::from_fn(|k| if k < number { values[k] } else { last });
        block.inputs[input.index()] = block.values;
        block.predict(past);
        newton(kernels, instructions, block, scratch);
        instructions.run(Continuity { past, block });
        if block.flags.0[0] == 1.0 {
            state(kernels, instructions, block, scratch, shapes);
            if let Some(derivatives) = derivatives {
                slopes(kernels, instructions, block, derivatives);
            }
        }
        let passed = block.flags.0[..number]
            .iter()
            .take_while(|flag| **flag == 1.0);
        passed.count()
    }
}

impl Block<'_> {
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
