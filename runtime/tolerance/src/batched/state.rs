//! The state at the equilibrium in every lane: the remaining residual, the linearised mechanism, and its modes.

use super::algebra::{self, Row, Square, congruent, for_size, keep, load_matrix, small};
use super::block::{Block, POSITIVE};
use super::closed::{self, FactoredMatrix};
use super::room::BatchArena;
use crate::algebra::Matrix;
use crate::eigenproblem::INACCURATE;
use crate::equilibrium::{ROUNDED, ROUNDING, SMALL_MOTION, TOLERANCE};
use crate::kernels::{BatchKernels, BatchParts, BatchPoint};
use crate::modes::CLUSTER_GAP;
use crate::rounding::{SLOW, of_elements};
use crate::scalar::{Batch, Instructions, Lanes, Task, WIDTH};

/// Buffers for intermediate kernel results.
pub(super) struct Scratch<'a> {
    pub(super) residual: &'a mut [Batch],
    pub(super) stiffness: &'a mut [Batch],
    pub(super) parts: BatchParts<'a>,
}

impl<'a> Scratch<'a> {
    /// Number of batches that it takes.
    pub(super) fn size(n: usize) -> usize {
        3 * n + n * n
    }

    pub(super) fn new(room: &mut BatchArena<'a>, n: usize) -> Self {
        Self {
            residual: room.take(n),
            stiffness: room.take(n * n),
            parts: BatchParts { inertia: room.take(n), applied: room.take(n) },
        }
    }
}

/// Completes the states of a block.
///
/// `shapes` are nearby modes, one per row, that identify the modes. Keeps the flags of lanes that are solved to
/// rounding and clearly a minimum, with each mode recognised, oscillating and apart from the others.
pub(super) fn state<'m>(
    kernels: &dyn BatchKernels,
    instructions: Instructions,
    block: &mut Block<'m>,
    scratch: &mut Scratch<'m>,
    shapes: &Matrix,
) {
    let parts = &mut scratch.parts;
    let point = BatchPoint { q: block.coordinates, u: block.inputs, b: block.design };
    kernels.parts_and_linear_batch(instructions, point, parts, &mut block.linear);
    instructions.run(CompleteStates { shapes, parts, block });
}

struct CompleteStates<'a, 'b> {
    shapes: &'a Matrix,
    parts: &'a BatchParts<'b>,
    block: &'a mut Block<'b>,
}

impl Task for CompleteStates<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn run<V: Lanes>(self) {
        let Self { shapes, parts, block } = self;
        let one = V::constant(1.0);
        for_size!(block.coordinates.len(), |n, N| {
            let shapes: &Square<f64, N> = &small(n, shapes);
            for at in (0..WIDTH).step_by(V::WIDTH) {
                let q: Row<V, N> = algebra::load(n, block.coordinates, at);
                let inertia = algebra::load(n, parts.inertia, at);
                let applied = algebra::load(n, parts.applied, at);
                let mass = load_matrix(n, block.linear.mass, at);
                let stiffness = load_matrix(n, block.linear.stiffness, at);
                let mut residual = inertia;
                for i in 0..n {
                    residual[i] = residual[i] - applied[i];
                }
                let (relative, rest) = remainder(n, &q, [&inertia, &applied, &residual], &stiffness);
                let mut flag = keep(V::load(&block.flags, at), one.at_most(rest));
                flag = keep(flag, one.at_most(closed::definite(n, &mass, POSITIVE)));
                let (lambda, vectors, found) = modes(n, &mass, &stiffness, shapes);
                flag = keep(flag, one.at_most(found));
                algebra::store(n, &residual, block.residual, at);
                relative.store(&mut block.relative_residual, at);
                algebra::store(n, &lambda, block.lambda, at);
                for r in 0..n {
                    let (most, error, accurate) = mode_residual(n, &mass, &stiffness, lambda[r], &vectors[r]);
                    let rate = lambda[r].sqrt();
                    flag = keep(keep(flag, one.at_most(accurate)), error.at_most(V::constant(0.5) * lambda[r]));
                    most.store(&mut block.mode_residuals[r], at);
                    rate.store(&mut block.rates[r], at);
                    (error / rate).store(&mut block.mode_errors[r], at);
                    algebra::store(n, &vectors[r], &mut block.shapes[r * n..], at);
                }
                flag.store(&mut block.flags, at);
            }
        });
    }
}

/// Largest residual, relative to the forces of its equation and to what small motions restore there. The flag says that
/// it and the resulting displacement are rounding, and that the stiffness is positive definite.
#[inline(always)]
fn remainder<V: Lanes, const N: usize>(
    n: usize,
    q: &Row<V, N>,
    [inertia, applied, residual]: [&Row<V, N>; 3],
    stiffness: &Square<V, N>,
) -> (V, V) {
    let mut small = [V::constant(SMALL_MOTION); N];
    for i in 0..n {
        small[i] = small[i] + V::constant(ROUNDED) * q[i].abs();
    }
    let mut most = V::constant(0.0);
    for i in 0..n {
        let (inertia, applied) = (inertia[i].abs(), applied[i].abs());
        let mut scale = V::choose(inertia.at_most(applied), applied, inertia);
        for j in 0..n {
            scale = scale + stiffness[i][j].abs() * small[j];
        }
        let imbalance = residual[i].abs() / scale;
        most = V::choose(imbalance.at_most(most), most, imbalance);
    }
    let (solver, mut flag) = FactoredMatrix::new(n, stiffness, POSITIVE);
    flag = keep(flag, most.at_most(V::constant(TOLERANCE)));
    let rest = solver.solve(n, residual);
    for i in 0..n {
        let (rest, q) = (rest[i], q[i]);
        let scale = V::constant(ROUNDING) * (q.abs() + V::constant(SMALL_MOTION));
        flag = keep(flag, rest.abs().at_most(scale));
    }
    (most, flag)
}

/// `lambda` and vectors, identified by the nearby ones; the flag says that each is recognised and clear of zero and of
/// the others.
#[inline(always)]
fn modes<V: Lanes, const N: usize>(
    n: usize,
    mass: &Square<V, N>,
    stiffness: &Square<V, N>,
    shapes: &Square<f64, N>,
) -> (Row<V, N>, Square<V, N>, V) {
    let mass = congruent(n, mass, shapes);
    let stiffness = congruent(n, stiffness, shapes);
    let (lambda, local, mut flag) = closed::eigenpairs(n, &stiffness, &mass);
    let zero = V::constant(0.0);
    let mut vectors = [[zero; N]; N];
    let mut greatest = zero;
    for i in 0..n {
        let lambda = lambda[i];
        greatest = V::choose(lambda.at_most(greatest), greatest, lambda);
    }
    let (positive, slow) = (V::constant(2.0 * of_elements(n)) * greatest, V::constant(SLOW));
    let least = V::choose(slow.at_most(positive), positive, slow);
    for r in 0..n {
        for s in 0..n {
            for i in 0..n {
                vectors[r][i] = vectors[r][i] + local[r][s] * V::constant(shapes[s][i]);
            }
        }
        positive_lead(n, &mut vectors[r]);
        // Eigenvalues closer to zero are left to the solver for one state.
        flag = keep(flag, least.at_most(lambda[r]));
        for s in 0..r {
            let gap = (lambda[r] - lambda[s]).abs();
            let size = V::choose(lambda[s].at_most(lambda[r]), lambda[r], lambda[s]);
            flag = keep(flag, (V::constant(2.0 * CLUSTER_GAP) * size).at_most(gap));
        }
    }
    (lambda, vectors, flag)
}

/// Makes the largest component positive; a margin keeps the choice stable when two are equal up to rounding.
#[inline(always)]
fn positive_lead<V: Lanes, const N: usize>(n: usize, vector: &mut Row<V, N>) {
    let mut lead = vector[0];
    for i in 1..n {
        let margin = lead.abs() * V::constant(1.0 + 1e-9);
        lead = V::choose(vector[i].abs().at_most(margin), lead, vector[i]);
    }
    let positive = V::constant(0.0).at_most(lead);
    for i in 0..n {
        vector[i] = V::choose(positive, vector[i], -vector[i]);
    }
}

/// Largest component of `Khat phi - lambda Mhat phi` relative to the largest sum of terms in a row, the error of
/// `lambda`, and whether the first is too small for refinement to improve.
#[inline(always)]
fn mode_residual<V: Lanes, const N: usize>(
    n: usize,
    mass: &Square<V, N>,
    stiffness: &Square<V, N>,
    lambda: V,
    vector: &Row<V, N>,
) -> (V, V, V) {
    let zero = V::constant(0.0);
    let (mut most, mut size) = (zero, zero);
    let (mut along, mut weighted) = (zero, zero);
    for i in 0..n {
        let (mut sum, mut terms) = (zero, zero);
        for j in 0..n {
            let (k, m) = (stiffness[i][j] * vector[j], lambda * mass[i][j] * vector[j]);
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
    let error = V::constant(of_elements(n)) * weighted + V::constant(2.0) * along.abs();
    (relative, error, flag)
}
