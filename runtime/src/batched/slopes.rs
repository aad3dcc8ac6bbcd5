//! Total derivatives of the modes in every lane: `dlambda/db = da/db - (dg/db)^T w`, `Khat^T w = da/dq`,
//! `a = phi^T (Khat - lambda Mhat) phi`, as [`sensitivities`](crate::sensitivity::sensitivities) has them for one state.

use super::algebra::keep;
use super::block::{Block, POSITIVE};
use super::closed::Solver;
use crate::Mechanism;
use crate::lanes::{Store, Task, Vector, WIDTH, load, load_matrix};
use crate::sensitivity::{Cheaper, of_undamped};

/// Adds the derivatives of the modes of a block. Keeps the flags of lanes where they are finite.
pub(super) struct Slopes<'a, M, const N: usize, const U: usize, const P: usize, const O: usize> {
    pub(super) mechanism: &'a M,
    pub(super) block: &'a mut Block<N, U, P>,
}

impl<M, const N: usize, const U: usize, const P: usize, const O: usize> Task
    for Slopes<'_, M, N, U, P, O>
where
    M: Mechanism<N, U, P, O>,
{
    type Output = ();

    #[inline(always)]
    fn run<V: Vector>(self) {
        let Self { mechanism, block } = self;
        for at in (0..WIDTH).step_by(V::WIDTH) {
            let (u, b): ([V; U], [V; P]) = (load(&block.inputs, at), load(&block.design, at));
            let q: [V; N] = load(&block.coordinates, at);
            let stiffness: [[V; N]; N] = load_matrix(&block.linear.stiffness, at);
            let (solver, _) = Solver::new(&stiffness, POSITIVE);
            let mut total = V::constant(0.0);
            if const { Cheaper::<M, N, U, P, O>::MATRICES } {
                let partials = mechanism.linear_partials_inlined(&q, &u, &b);
                let (inputs, design) = mechanism.residual_partials_inlined(&q, &u, &b);
                for r in 0..N {
                    let phi = load(&block.shapes[r], at);
                    let lambda = V::load(&block.lambda[r], at);
                    let direct = of_undamped(&partials, &phi, lambda, true);
                    let w = solver.solve(&direct.coordinates);
                    let by_input = difference(&direct.inputs, &combined(&w, &inputs), &mut total);
                    let by_design = difference(&direct.design, &combined(&w, &design), &mut total);
                    block.by_input[r].store(&by_input, at);
                    block.by_design[r].store(&by_design, at);
                }
            } else {
                for r in 0..N {
                    let phi = load(&block.shapes[r], at);
                    let lambda = V::load(&block.lambda[r], at);
                    let direct = mechanism.mode_gradient_inlined(&q, &u, &b, &phi, lambda);
                    let w = solver.solve(&direct.coordinates);
                    let shift = mechanism.residual_gradient_inlined(&q, &u, &b, &w);
                    let by_input = difference(&direct.inputs, &shift.inputs, &mut total);
                    let by_design = difference(&direct.design, &shift.design, &mut total);
                    block.by_input[r].store(&by_input, at);
                    block.by_design[r].store(&by_design, at);
                }
            }
            let finite = total.at_most(V::constant(f64::MAX));
            keep(V::load(&block.flags, at), finite).store(&mut block.flags, at);
        }
    }
}

/// `w^T partials`.
#[inline(always)]
fn combined<V: Vector, const N: usize, const K: usize>(
    w: &[V; N],
    partials: &[[V; K]; N],
) -> [V; K] {
    let mut sum = [V::constant(-0.0); K];
    for (w, row) in w.iter().zip(partials) {
        for (sum, slope) in sum.iter_mut().zip(row) {
            *sum = *sum + *w * *slope;
        }
    }
    sum
}

/// `direct - shift`; adds its sizes to `total`.
#[inline(always)]
fn difference<V: Vector, const K: usize>(direct: &[V; K], shift: &[V; K], total: &mut V) -> [V; K] {
    let mut difference = *direct;
    for (own, shift) in difference.iter_mut().zip(shift) {
        *own = *own - *shift;
        *total = *total + own.abs();
    }
    difference
}
