//! Advances to the next block: predicted, solved and checked, lane by lane.

use super::block::{Block, Past};
use super::continuity::Continuity;
use super::newton::newton;
use super::room::BatchArena;
use super::slopes::{Slopes, slopes};
use super::state::{Scratch, state};
use crate::Input;
use crate::algebra::Matrix;
use crate::kernels::{BatchKernels, Kernels, Sizes};
use crate::scalar::{Batch, Instructions, WIDTH};

/// A block, and the buffers that are rewritten for each block.
pub struct Workspace<'a> {
    pub block: Block<'a>,
    scratch: Scratch<'a>,
    /// For derivatives of the modes, if wanted.
    slopes: Option<Slopes<'a>>,
}

impl<'a> Workspace<'a> {
    /// Memory for one workspace.
    pub fn memory(sizes: Sizes, with_slopes: bool) -> Vec<Batch> {
        let slopes = if with_slopes { Slopes::size(sizes) } else { 0 };
        let size = Block::size(sizes) + Scratch::size(sizes.coordinates) + slopes;
        vec![Batch::default(); size]
    }

    /// A workspace in memory of its size, for a given design and inputs, one of which will vary.
    pub fn new(
        memory: &'a mut [Batch],
        kernels: &dyn Kernels,
        (inputs, design): (&[f64], &[f64]),
        with_slopes: bool,
    ) -> Self {
        let sizes = kernels.sizes();
        let room = &mut BatchArena::new(memory);
        Self {
            block: Block::new(room, inputs, design, sizes.coordinates),
            scratch: Scratch::new(room, sizes.coordinates),
            slopes: with_slopes.then(|| Slopes::new(room, &kernels.description(), sizes)),
        }
    }

    /// Solves the first of `values`, as many as there are lanes for, continuing from the states of `past`.
    ///
    /// `shapes` are the modes of the last state, one per row. Returns how many consecutive states passed every check;
    /// their modes have derivatives if wanted.
    pub fn solve(
        &mut self,
        (kernels, instructions): (&dyn BatchKernels, Instructions),
        (input, values): (Input, &[f64]),
        past: &Past<'_>,
        shapes: &Matrix,
    ) -> usize {
        let Self { block, scratch, slopes: derivatives } = self;
        let number = values.len().min(WIDTH);
        let Some(&last) = values[..number].last() else {
            return 0;
        };
        // Lanes without their own value repeat the last one.
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
        block.flags.0[..number].iter().take_while(|flag| **flag == 1.0).count()
    }
}

impl Block<'_> {
    /// Extrapolates by the parabola through the last states.
    fn predict(&mut self, past: &Past) {
        let [(u0, q0), (u1, q1), (u2, q2)] = past;
        let (step, before, both) = (1.0 / (u0 - u1), 1.0 / (u1 - u2), 1.0 / (u0 - u2));
        for (i, coordinate) in self.coordinates.iter_mut().enumerate() {
            let slope = (q0[i] - q1[i]) * step;
            let bend = (slope - (q1[i] - q2[i]) * before) * both;
            for (q, u) in coordinate.0.iter_mut().zip(&self.values.0) {
                *q = q0[i] + (u - u0) * (slope + (u - u1) * bend);
            }
        }
    }
}
