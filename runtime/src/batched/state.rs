//! What there is at the equilibrium in every lane: what remains of the residual, the linearised mechanism, its modes.

use super::algebra::{congruent, keep};
use super::block::{Block, POSITIVE};
use super::closed::{self, Solver};
use crate::equilibrium::convergence::{ROUNDED, ROUNDING, SMALL_MOTION, TOLERANCE};
use crate::lanes::{Store, Task, Vector, WIDTH, load};
use crate::modes::symmetric::INACCURATE;
use crate::rounding::{SLOW, of_elements};
use crate::sensitivity::CLUSTER_GAP;
use crate::{Linear, Mechanism, RestParts};

/// Completes the states of a block. `shapes` are modes near by, one in each row, that tell the modes apart. Keeps the flags of
/// lanes that are solved to rounding, a clear minimum, each mode recognised, oscillating and apart from the others.
pub(super) struct State<'a, M, const N: usize, const U: usize, const P: usize, const O: usize> {
    pub(super) mechanism: &'a M,
    pub(super) shapes: &'a [[f64; N]; N],
    pub(super) block: &'a mut Block<N, U, P>,
}

impl<M, const N: usize, const U: usize, const P: usize, const O: usize> Task
    for State<'_, M, N, U, P, O>
where
    M: Mechanism<N, U, P, O>,
{
    type Output = ();

    #[inline(always)]
    fn run<V: Vector>(self) {
        let Self {
            mechanism,
            shapes,
            block,
        } = self;
        let one = V::constant(1.0);
        for at in (0..WIDTH).step_by(V::WIDTH) {
            let (u, b): ([V; U], [V; P]) = (load(&block.inputs, at), load(&block.design, at));
            let q: [V; N] = load(&block.coordinates, at);
            let parts = mechanism.residual_parts_inlined(&q, &u, &b);
            let linear = mechanism.linear_inlined(&q, &u, &b);
            let mut residual = parts.inertia;
            for (residual, applied) in residual.iter_mut().zip(parts.applied) {
                *residual = *residual - applied;
            }
            let (relative, rest) = remainder(&q, &parts, &residual, &linear.stiffness);
            let mut flag = keep(V::load(&block.flags, at), one.at_most(rest));
            flag = keep(flag, one.at_most(closed::definite(&linear.mass, POSITIVE)));
            let (lambda, vectors, found) = modes(&linear, shapes);
            flag = keep(flag, one.at_most(found));
            block.residual.store(&residual, at);
            relative.store(&mut block.relative_residual, at);
            block.linear.store(&linear, at);
            block.lambda.store(&lambda, at);
            for r in 0..N {
                let (most, error, accurate) = mode_residual(&linear, lambda[r], &vectors[r]);
                flag = keep(flag, one.at_most(accurate));
                most.store(&mut block.mode_residuals[r], at);
                error.store(&mut block.mode_errors[r], at);
                block.shapes[r].store(&vectors[r], at);
            }
            flag.store(&mut block.flags, at);
        }
    }
}

/// Greatest residual relative to the forces of its equation and what small motions restore there; the flag says that it, and
/// the displacement behind it, are rounding, and that the stiffness is positive definite.
#[inline(always)]
fn remainder<V: Vector, const N: usize>(
    q: &[V; N],
    parts: &RestParts<V, N>,
    residual: &[V; N],
    stiffness: &[[V; N]; N],
) -> (V, V) {
    let mut small = [V::constant(SMALL_MOTION); N];
    for (small, q) in small.iter_mut().zip(q) {
        *small = *small + V::constant(ROUNDED) * q.abs();
    }
    let mut most = V::constant(0.0);
    for i in 0..N {
        let (inertia, applied) = (parts.inertia[i].abs(), parts.applied[i].abs());
        let mut scale = V::choose(inertia.at_most(applied), applied, inertia);
        for j in 0..N {
            scale = scale + stiffness[i][j].abs() * small[j];
        }
        let own = residual[i].abs() / scale;
        most = V::choose(own.at_most(most), most, own);
    }
    let (solver, mut flag) = Solver::new(stiffness, POSITIVE);
    flag = keep(flag, most.at_most(V::constant(TOLERANCE)));
    for (rest, q) in solver.solve(residual).iter().zip(q) {
        let scale = V::constant(ROUNDING) * (q.abs() + V::constant(SMALL_MOTION));
        flag = keep(flag, rest.abs().at_most(scale));
    }
    (most, flag)
}

/// `lambda` and vectors, by those near by; the flag says that each is recognised and clear of zero and of the others.
#[inline(always)]
fn modes<V: Vector, const N: usize>(
    linear: &Linear<V, N>,
    shapes: &[[f64; N]; N],
) -> ([V; N], [[V; N]; N], V) {
    let mass = congruent(&linear.mass, shapes);
    let stiffness = congruent(&linear.stiffness, shapes);
    let (lambda, local, mut flag) = closed::eigenpairs(&stiffness, &mass);
    let zero = V::constant(0.0);
    let mut vectors = [[zero; N]; N];
    let mut greatest = zero;
    for lambda in lambda {
        greatest = V::choose(lambda.at_most(greatest), greatest, lambda);
    }
    let (positive, slow) = (
        V::constant(2.0 * of_elements(N)) * greatest,
        V::constant(SLOW),
    );
    let least = V::choose(slow.at_most(positive), positive, slow);
    for r in 0..N {
        for s in 0..N {
            for i in 0..N {
                vectors[r][i] = vectors[r][i] + local[r][s] * V::constant(shapes[s][i]);
            }
        }
        positive_lead(&mut vectors[r]);
        // What is nearer to zero the solver for one state decides.
        flag = keep(flag, least.at_most(lambda[r]));
        for s in 0..r {
            let gap = (lambda[r] - lambda[s]).abs();
            let size = V::choose(lambda[s].at_most(lambda[r]), lambda[r], lambda[s]);
            flag = keep(flag, (V::constant(2.0 * CLUSTER_GAP) * size).at_most(gap));
        }
    }
    (lambda, vectors, flag)
}

/// Makes the largest component positive; a margin keeps the choice when two are equal but for rounding.
#[inline(always)]
fn positive_lead<V: Vector, const N: usize>(vector: &mut [V; N]) {
    let mut lead = vector[0];
    for value in &vector[1..] {
        let margin = lead.abs() * V::constant(1.0 + 1e-9);
        lead = V::choose(value.abs().at_most(margin), lead, *value);
    }
    let positive = V::constant(0.0).at_most(lead);
    for value in vector {
        *value = V::choose(positive, *value, -*value);
    }
}

/// Greatest component of `Khat phi - lambda Mhat phi` relative to the greatest sum of terms in a row, the error of `lambda`, and
/// whether the first is as small as no refinement makes it.
#[inline(always)]
fn mode_residual<V: Vector, const N: usize>(
    linear: &Linear<V, N>,
    lambda: V,
    vector: &[V; N],
) -> (V, V, V) {
    let zero = V::constant(0.0);
    let (mut most, mut size) = (zero, zero);
    let (mut along, mut weighted) = (zero, zero);
    for i in 0..N {
        let (mut sum, mut terms) = (zero, zero);
        for j in 0..N {
            let (k, m) = (
                linear.stiffness[i][j] * vector[j],
                lambda * linear.mass[i][j] * vector[j],
            );
            sum = sum + (k - m);
            terms = terms + (k.abs() + m.abs());
        }
        along = along + vector[i] * sum;
        weighted = weighted + vector[i].abs() * terms;
        let sum = sum.abs();
        most = V::choose(sum.at_most(most), most, sum);
        size = V::choose(terms.at_most(size), size, terms);
    }
    let relative = most / size;
    let flag = keep(V::constant(1.0), relative.at_most(V::constant(INACCURATE)));
    let error = V::constant(of_elements(N)) * weighted + V::constant(2.0) * along.abs();
    (relative, error, flag)
}
