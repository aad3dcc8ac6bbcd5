//! Newton's method in every lane.

use super::algebra::keep;
use super::block::{Block, POSITIVE};
use super::closed::Solver;
use crate::Mechanism;
use crate::equilibrium::convergence::{LAST_STEP, SMALL_MOTION};
use crate::lanes::{Store, Task, Vector, WIDTH, load};

/// Steps at most: predicted states are near to what they predict.
const STEPS: usize = 6;
/// Greatest change of a coordinate in a step, rad or m.
const RADIUS: f64 = 1.0;

/// Takes the coordinates of a block to the equilibria next to them. Flags the lanes that came to rest, the stiffness positive
/// definite all the way.
pub(super) struct Newton<'a, M, const N: usize, const U: usize, const P: usize, const O: usize> {
    pub(super) mechanism: &'a M,
    pub(super) block: &'a mut Block<N, U, P>,
}

impl<M, const N: usize, const U: usize, const P: usize, const O: usize> Task
    for Newton<'_, M, N, U, P, O>
where
    M: Mechanism<N, U, P, O>,
{
    type Output = ();

    #[inline(always)]
    fn run<V: Vector>(self) {
        let Self { mechanism, block } = self;
        let (zero, one) = (V::constant(0.0), V::constant(1.0));
        for at in (0..WIDTH).step_by(V::WIDTH) {
            let (u, b): ([V; U], [V; P]) = (load(&block.inputs, at), load(&block.design, at));
            let mut q: [V; N] = load(&block.coordinates, at);
            let (mut flag, mut resting, mut steps) = (one, zero, zero);
            for _ in 0..STEPS {
                let (residual, stiffness) = mechanism.residual_and_stiffness_inlined(&q, &u, &b);
                let (solver, positive) = Solver::new(&stiffness, POSITIVE);
                let step = solver.solve(&residual);
                // Lanes at rest stay where they are, so that none depends on the others.
                let moving = resting.at_most(zero);
                let (mut last, mut near) = (one, positive);
                for (q, step) in q.iter_mut().zip(step) {
                    let scale = V::constant(LAST_STEP) * (q.abs() + V::constant(SMALL_MOTION));
                    last = keep(last, step.abs().at_most(scale));
                    near = keep(near, step.abs().at_most(V::constant(RADIUS)));
                    *q = V::choose(moving, *q - step, *q);
                }
                flag = keep(flag, one.at_most(V::choose(moving, near, one)));
                steps = steps + V::choose(moving, one, zero);
                // Lanes that failed rest too.
                let done = V::choose(one.at_most(flag), last, one);
                resting = V::choose(moving, done, resting);
                if V::every(one.at_most(resting)) {
                    break;
                }
            }
            block.coordinates.store(&q, at);
            steps.store(&mut block.iterations, at);
            keep(flag, one.at_most(resting)).store(&mut block.flags, at);
        }
    }
}
