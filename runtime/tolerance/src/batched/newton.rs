//! Newton's method in every lane.

use super::algebra::{self, Square, for_size, keep, load_matrix};
use super::block::{Block, POSITIVE};
use super::closed::FactoredMatrix;
use super::state::Scratch;
use crate::equilibrium::{LAST_STEP, SMALL_MOTION};
use crate::kernels::BatchKernels;
use crate::scalar::{Batch, Instructions, Lanes, Task, WIDTH};

/// Maximum number of steps: predicted states are close to the solution.
const STEPS: usize = 6;
/// Largest change of a coordinate in a step, rad or m.
const RADIUS: f64 = 1.0;

/// Moves the coordinates of a block to the nearby equilibria. Flags the lanes that came to rest with a stiffness that
/// was positive definite all the way.
pub(super) fn newton<'m>(
    kernels: &dyn BatchKernels,
    instructions: Instructions,
    block: &mut Block<'m>,
    scratch: &mut Scratch<'m>,
) {
    let mut resting = Batch::all(0.0);
    block.flags = Batch::all(1.0);
    block.iterations = Batch::all(0.0);
    for _ in 0..STEPS {
        kernels.residual_and_stiffness_batch(instructions, block.point(), scratch.residual, scratch.stiffness);
        let resting = &mut resting;
        instructions.run(Step { scratch, block, resting });
        if resting.0.iter().all(|rests| *rests >= 1.0) {
            break;
        }
    }
    for (flag, rests) in block.flags.0.iter_mut().zip(resting.0) {
        *flag = if rests >= 1.0 { *flag } else { 0.0 };
    }
}

/// One step in every lane.
struct Step<'a, 'b> {
    scratch: &'a Scratch<'b>,
    block: &'a mut Block<'b>,
    resting: &'a mut Batch,
}

impl Task for Step<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn run<V: Lanes>(self) {
        let Self { scratch, block, resting } = self;
        let (zero, one) = (V::constant(0.0), V::constant(1.0));
        for_size!(block.coordinates.len(), |n, N| {
            for at in (0..WIDTH).step_by(V::WIDTH) {
                let stiffness: Square<V, N> = load_matrix(n, scratch.stiffness, at);
                let (solver, positive) = FactoredMatrix::new(n, &stiffness, POSITIVE);
                let step = solver.solve(n, &algebra::load(n, scratch.residual, at));
                // Lanes at rest do not move, so that none depends on the others.
                let rested = V::load(resting, at);
                let moving = rested.at_most(zero);
                let (mut last, mut near) = (one, positive);
                let coordinates = &mut block.coordinates[..n];
                for i in 0..n {
                    let (q, step) = (V::load(&coordinates[i], at), step[i]);
                    let scale = V::constant(LAST_STEP) * (q.abs() + V::constant(SMALL_MOTION));
                    last = keep(last, step.abs().at_most(scale));
                    near = keep(near, step.abs().at_most(V::constant(RADIUS)));
                    V::choose(moving, q - step, q).store(&mut coordinates[i], at);
                }
                let flag = V::load(&block.flags, at);
                let flag = keep(flag, one.at_most(V::choose(moving, near, one)));
                flag.store(&mut block.flags, at);
                let steps = V::load(&block.iterations, at) + V::choose(moving, one, zero);
                steps.store(&mut block.iterations, at);
                // Lanes that failed stop too.
                let done = V::choose(one.at_most(flag), last, one);
                V::choose(moving, done, rested).store(resting, at);
            }
        });
    }
}
