//! The equilibrium of a sample: the steps to it, and the check that it continues the nominal equilibrium.

use super::statics::{Forces, Potential, Statics, row};
use super::{SampleBatch, TaylorModel};
use crate::algebra::Matrix;
use crate::batched::POSITIVE;
use crate::batched::algebra::{self, Row, Square, congruent, for_size_up_to, keep, load_matrix, small};
use crate::batched::closed::{self, FactoredMatrix};
use crate::equilibrium::{LAST_STEP, SMALL_MOTION};
use crate::kernels::{BatchPoint, Kernels};
use crate::scalar::{Instructions, Lanes};

/// A correction this small, relative to the coordinate and a millimetre or milliradian, is the last. It uses the
/// nominal change of the stiffness, so that the remainder is a share of it comparable to that of the tolerances.
const LAST_CORRECTION: f64 = 1e-12;
/// Smallest pivot of the stiffness between the nominal position and its mirror image about the equilibrium.
const CLEARLY_POSITIVE: f64 = 1e-3;
/// Largest displacement from the nominal position, in displacements of one standard deviation.
pub(super) const FAR: f64 = 6.0;
/// Largest change of the stiffness, relative to the nominal one: an equal change in the opposite direction leaves it
/// regular.
const CHANGED: f64 = 0.5;

/// A Newton step; a sample fails if its stiffness departs from the nominal one on the way.
#[inline(always)]
pub(super) fn newton_step<V: Lanes, const N: usize>(
    n: usize,
    prepared: &TaylorModel<'_, N>,
    batch: &mut SampleBatch<'_>,
    at: usize,
) {
    let one = V::constant(1.0);
    let mut q: Row<V, N> = algebra::load(n, batch.coordinates, at);
    let stiffness = load_matrix(n, batch.stiffness, at);
    let residual = algebra::load(n, batch.residual, at);
    let (step, last, regular) = match &prepared.statics {
        Statics::Potential(potential) => potential.step(n, &q, &stiffness, &residual),
        Statics::Forces(forces) => {
            let motions = prepared.motions.min(n);
            forces.step((n, motions), &q, &stiffness, &residual)
        }
    };
    // Samples at rest do not move, so that none depends on the others.
    let rested = V::load(&batch.resting, at);
    let moving = rested.at_most(V::constant(0.0));
    let flag = V::load(&batch.flags, at);
    keep(flag, one.at_most(V::choose(moving, regular, one))).store(&mut batch.flags, at);
    for i in 0..n {
        q[i] = V::choose(moving, q[i] - step[i], q[i]);
    }
    algebra::store(n, &q, batch.coordinates, at);
    V::choose(moving, last, rested).store(&mut batch.resting, at);
}

/// The stiffness of the nominal design at the equilibrium of a sample, where no derivative of it is known.
pub(super) fn nominal_stiffness<const N: usize>(
    prepared: &TaylorModel<'_, N>,
    instructions: Instructions,
    batch: &mut SampleBatch<'_>,
) {
    let point = BatchPoint { q: batch.coordinates, u: &prepared.inputs, b: &prepared.design };
    prepared.kernels.residual_and_stiffness_batch(instructions, point, batch.residual, batch.stiffness);
}

/// Flags samples at rest near the nominal equilibrium whose stiffness stays close to the nominal one all the way. They
/// are on its branch: each of the two equilibria is in the basin of the other.
#[inline(always)]
pub(super) fn continues_nominal<V: Lanes, const N: usize>(
    n: usize,
    prepared: &TaylorModel<'_, N>,
    batch: &SampleBatch<'_>,
    at: usize,
) -> V {
    let one = V::constant(1.0);
    let q: Row<V, N> = algebra::load(n, batch.coordinates, at);
    let at_rest = one.at_most(V::load(&batch.resting, at));
    let mut flag = keep(V::load(&batch.flags, at), at_rest);
    let (displacement, near) = prepared.displacement(n, &q);
    flag = keep(flag, one.at_most(near));
    let regular = match &prepared.statics {
        Statics::Potential(potential) => {
            let stiffness = load_matrix(n, batch.stiffness, at);
            potential.definite_all_the_way(n, &stiffness, &displacement)
        }
        Statics::Forces(forces) => {
            let stiffness = load_matrix(n, batch.linear.stiffness, at);
            forces.both_regular(n, &stiffness, &load_matrix(n, batch.stiffness, at))
        }
    };
    keep(flag, one.at_most(regular))
}

impl<const N: usize> TaylorModel<'_, N> {
    /// [`continues_nominal`] for one equilibrium that is known, with its stiffness.
    pub(super) fn is_continued_by(&self, q: &[f64], stiffness: &Matrix) -> bool {
        let mut continues = false;
        for_size_up_to::<N>(
            q.len(),
            #[inline(always)]
            |n| {
                let (displacement, near) = self.displacement::<f64>(n, &row(q));
                let stiffness = small(n, stiffness);
                let regular = match &self.statics {
                    Statics::Potential(potential) => {
                        let stiffness = congruent(n, &stiffness, &potential.shapes);
                        potential.definite_all_the_way(n, &stiffness, &displacement)
                    }
                    Statics::Forces(forces) => {
                        let kernels: &dyn Kernels = self.kernels;
                        let (u, b) = (&self.nominal.inputs, &self.nominal.design);
                        let (_, nominal) = kernels.residual_and_stiffness(q, u, b);
                        forces.both_regular(n, &stiffness, &small(n, &nominal))
                    }
                };
                continues = near >= 1.0 && regular >= 1.0;
            },
        );
        continues
    }

    /// The displacement from the nominal equilibrium, and whether it is within reach of the tolerances.
    #[inline(always)]
    fn displacement<V: Lanes>(&self, n: usize, q: &Row<V, N>) -> (Row<V, N>, V) {
        let mut displacement = [V::constant(0.0); N];
        let mut near = V::constant(1.0);
        for k in 0..self.motions.min(n) {
            displacement[k] = q[k] - V::constant(self.nominal.coordinates[k]);
            let far = V::constant(FAR * self.reach[k]);
            near = keep(near, displacement[k].abs().at_most(far));
        }
        (displacement, near)
    }
}

/// Mass and stiffness at the equilibrium, in the basis of the undamped nominal modes.
#[inline(always)]
pub(super) fn between_modes<V: Lanes, const N: usize>(
    n: usize,
    potential: &Potential<N>,
    batch: &mut SampleBatch<'_>,
    at: usize,
) {
    for (from, to) in [(&*batch.linear.mass, &mut *batch.mass), (&*batch.linear.stiffness, &mut *batch.stiffness)] {
        let matrix: Square<V, N> = load_matrix(n, from, at);
        let matrix = congruent(n, &matrix, &potential.shapes);
        let to = &mut to[..n * n];
        for i in 0..n {
            for j in 0..=i {
                matrix[i][j].store(&mut to[i * n + j], at);
            }
        }
    }
}

impl<const N: usize> Potential<N> {
    /// A step, whether it is the last, and whether the stiffness is positive definite.
    #[inline(always)]
    fn step<V: Lanes>(
        &self,
        n: usize,
        q: &Row<V, N>,
        stiffness: &Square<V, N>,
        residual: &Row<V, N>,
    ) -> (Row<V, N>, V, V) {
        let (solver, positive) = FactoredMatrix::new(n, stiffness, POSITIVE);
        let mut step = solver.solve(n, residual);
        let correction = solver.solve(n, &curved(n, &self.curvature, &step));
        let mut last = V::constant(1.0);
        for i in 0..n {
            let scale = V::constant(LAST_CORRECTION) * (q[i].abs() + V::constant(SMALL_MOTION));
            last = keep(last, correction[i].abs().at_most(scale));
            step[i] = step[i] + correction[i];
        }
        (step, last, positive)
    }

    /// Whether the stiffness, in the basis of the nominal modes, is positive definite all the way from the nominal
    /// position, and the nominal one all the way from there.
    ///
    /// It is checked here and, using its derivative, from the nominal position to its mirror image.
    #[inline(always)]
    fn definite_all_the_way<V: Lanes>(&self, n: usize, stiffness: &Square<V, N>, displacement: &Row<V, N>) -> V {
        let mut nearby = *stiffness;
        let mut nominal = [[V::constant(0.0); N]; N];
        for i in 0..n {
            nominal[i][i] = V::constant(self.lambda[i]);
        }
        let stiffening = &self.stiffening[..n];
        for k in 0..n {
            for i in 0..n {
                for j in 0..=i {
                    let change = V::constant(stiffening[k][i][j]) * displacement[k];
                    nearby[i][j] = nearby[i][j] - (change + change);
                    nominal[i][j] = nominal[i][j] + change;
                }
            }
        }
        keep(
            closed::definite(n, &nearby, CLEARLY_POSITIVE),
            V::constant(1.0).at_most(closed::definite(n, &nominal, CLEARLY_POSITIVE)),
        )
    }
}

impl<const N: usize> Forces<N> {
    /// A step, whether it is the last, and whether the stiffness is close to the nominal one.
    #[inline(always)]
    fn step<V: Lanes>(
        &self,
        (n, motions): (usize, usize),
        q: &Row<V, N>,
        stiffness: &Square<V, N>,
        residual: &Row<V, N>,
    ) -> (Row<V, N>, V, V) {
        let (mut relative, regular) = self.relative(n, stiffness);
        let mut step = *residual;
        for i in 0..n {
            step[i] = residual[0] * V::constant(self.inverse[i][0]);
            for k in 1..n {
                step[i] = step[i] + residual[k] * V::constant(self.inverse[i][k]);
            }
        }
        // Near the identity, elimination needs no pivoting.
        for k in 0..n {
            let inverse = V::constant(1.0) / relative[k][k];
            for i in k + 1..n {
                let factor = relative[i][k] * inverse;
                for j in k + 1..n {
                    relative[i][j] = relative[i][j] - factor * relative[k][j];
                }
                step[i] = step[i] - factor * step[k];
            }
            relative[k][k] = inverse;
        }
        for i in (0..n).rev() {
            for j in i + 1..n {
                step[i] = step[i] - relative[i][j] * step[j];
            }
            step[i] = step[i] * relative[i][i];
        }
        let mut last = V::constant(1.0);
        for i in 0..n {
            step[i] = step[i] * V::constant(self.units[i]);
        }
        for i in 0..motions {
            let scale = V::constant(LAST_STEP) * (q[i].abs() + V::constant(SMALL_MOTION));
            last = keep(last, step[i].abs().at_most(scale));
        }
        (step, last, regular)
    }

    /// Whether the stiffness, and that of the nominal design at the same place, are close to the nominal one.
    #[inline(always)]
    fn both_regular<V: Lanes>(&self, n: usize, stiffness: &Square<V, N>, of_nominal_design: &Square<V, N>) -> V {
        let (_, regular) = self.relative(n, stiffness);
        let (_, nominal) = self.relative(n, of_nominal_design);
        keep(regular, V::constant(1.0).at_most(nominal))
    }

    /// The nominal inverse times a stiffness, in units of the coordinates, and whether the product is near the
    /// identity.
    #[inline(always)]
    fn relative<V: Lanes>(&self, n: usize, stiffness: &Square<V, N>) -> (Square<V, N>, V) {
        let zero = V::constant(0.0);
        let mut product = [[zero; N]; N];
        let mut flag = V::constant(1.0);
        for i in 0..n {
            let mut change = zero;
            for j in 0..n {
                let mut sum = stiffness[0][j] * V::constant(self.inverse[i][0]);
                for k in 1..n {
                    sum = sum + stiffness[k][j] * V::constant(self.inverse[i][k]);
                }
                let sum = sum * V::constant(self.units[j]);
                product[i][j] = sum;
                let identity = if i == j { 1.0 } else { 0.0 };
                change = change + (sum - V::constant(identity)).abs();
            }
            flag = keep(flag, change.at_most(V::constant(CHANGED)));
        }
        (product, flag)
    }
}

/// `1/2 d2g/dq2 step step`, the residual that a Newton step leaves. `curvature` holds `1/2 dKhat/dq_k`, doubled off the
/// diagonal in `k` and `j`.
#[inline(always)]
fn curved<V: Lanes, const N: usize>(n: usize, curvature: &[Square<f64, N>], step: &Row<V, N>) -> Row<V, N> {
    let mut rest = [V::constant(0.0); N];
    let curvature = &curvature[..n];
    for k in 0..n {
        for j in 0..=k {
            let product = step[k] * step[j];
            for i in 0..n {
                rest[i] = rest[i] + V::constant(curvature[k][j][i]) * product;
            }
        }
    }
    rest
}
