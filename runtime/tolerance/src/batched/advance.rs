//! Advances to the next block: predicted, solved and checked, lane by lane.

use super::block::Block;
use super::continuity::Continuity;
use super::newton::newton;
use super::room::BatchArena;
use super::slopes::{Slopes, slopes};
use super::state::{Scratch, state};
use crate::Input;
use crate::algebra::{Matrix, dot};
use crate::equilibrium::Path;
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

    /// Solves the first of `values`, as many as there are lanes for, continuing a path of at least three states.
    ///
    /// `shapes` are the modes of the last state, one per row. Returns how many consecutive states passed every check;
    /// their modes have derivatives if wanted.
    pub fn solve(
        &mut self,
        (kernels, instructions): (&dyn BatchKernels, Instructions),
        (input, values): (Input, &[f64]),
        path: &Path,
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
        block.predict(path);
        newton(kernels, instructions, block, scratch);
        instructions.run(Continuity { path, block });
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
    /// Continues a path.
    fn predict(&mut self, path: &Path) {
        let reach = self.values.0.map(|value| path.reach(value));
        for (i, coordinate) in self.coordinates.iter_mut().enumerate() {
            let terms = path.terms(i, &reach[WIDTH - 1]);
            *coordinate = Batch::from_fn(|lane| dot(&terms, &reach[lane]));
        }
    }
}
