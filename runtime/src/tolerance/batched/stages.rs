//! The stages of a sample: design, prediction, steps to the equilibrium, matrices, modes.

use super::taylor_model::FEW;
use super::{Solved, TaylorModel};
use crate::batched::POSITIVE;
use crate::batched::algebra::{self, LARGEST, Row, Square, congruent, keep, load_matrix};
use crate::batched::closed::{self, Solver};
use crate::equilibrium::SMALL_MOTION;
use crate::kernels::Kernels;
use crate::scalar::{Batch, Lanes, WIDTH};
use crate::tolerance::normal_sampling::standard_normal_pair;

/// A correction this small, relative to the coordinate and a millimetre or milliradian, is the last: it takes the nominal change
/// of the stiffness, so that what remains is a share of it like that of the tolerances.
const LAST_CORRECTION: f64 = 1e-12;
/// Least pivot of the stiffness between the nominal position and its mirror image about the equilibrium.
const CLEARLY_POSITIVE: f64 = 1e-3;
/// Least and greatest `lambda` relative to the nominal one: what changes more may have changed on its way too.
const WEAKENED: f64 = 0.5;
const STIFFENED: f64 = 2.0;
/// Greatest displacement from the nominal position, in displacements of one standard deviation.
pub(super) const FAR: f64 = 6.0;

/// `b = b_mean + L z`, `z` standard normal; of other distributions the normal numbers behind them.
#[inline(always)]
pub(super) fn draw<V: Lanes>(prepared: &TaylorModel<'_>, batch: &mut Solved<'_>, at: usize) {
    let (design, standard) = (&mut batch.design[..], &mut batch.standard[..]);
    let pairs = batch.bits.iter().zip(standard.chunks_exact_mut(2));
    for (([radius, angle], normal), drawn) in pairs.zip(&prepared.drawn) {
        if *drawn && !batch.given {
            let (first, second) =
                standard_normal_pair(V::probability(radius, at), V::probability(angle, at));
            first.store(&mut normal[0], at);
            second.store(&mut normal[1], at);
        }
    }
    let mut shared = &prepared.shared[..];
    let means = prepared.means.iter().zip(&prepared.own);
    for (i, (design, (mean, own))) in design.iter_mut().zip(means).enumerate() {
        let start = if prepared.joint.is_some() { 0.0 } else { *mean };
        let mut value = V::constant(start);
        while let Some((&(_, j, factor), behind)) =
            shared.split_first().filter(|(one, _)| one.0 == i)
        {
            value = value + V::constant(factor) * V::load(&standard[j], at);
            shared = behind;
        }
        value = value + V::constant(*own) * V::load(&standard[i], at);
        value.store(design, at);
    }
}

/// Values that are not normal, from the standard normal numbers in their places.
pub(super) fn distribute(prepared: &TaylorModel<'_>, design: &mut [Batch]) {
    let Some((joint, moved)) = &prepared.joint else {
        return;
    };
    let variables = joint.variables().iter().zip(moved);
    for (batch, (variable, moved)) in design.iter_mut().zip(variables) {
        for value in &mut batch.0 {
            *value = variable.from_normal(*value) + moved;
        }
    }
}

/// Ones for the members whose bodies can exist.
pub(super) fn possible(prepared: &TaylorModel<'_>, design: &[Batch], members: usize) -> Batch {
    let mut flags = Batch([0.0; WIDTH]);
    let mut own = prepared.nominal.design.clone();
    for sample in 0..members {
        for (own, design) in own.iter_mut().zip(design) {
            *own = design.0[sample];
        }
        let kernels: &dyn Kernels = prepared.kernels;
        let violation = kernels.violation(&prepared.nominal.inputs, &own);
        flags.0[sample] = f64::from(u8::from(violation.is_none()));
    }
    flags
}

/// The equilibrium as the derivatives of the nominal one predict it.
#[inline(always)]
pub(super) fn predict<V: Lanes>(
    n: usize,
    prepared: &TaylorModel<'_>,
    batch: &mut Solved<'_>,
    at: usize,
) {
    let coordinates = &prepared.nominal.coordinates[..n];
    let (design, nominal) = (&batch.design[..], &prepared.nominal.design[..]);
    let mut q = [V::constant(0.0); LARGEST];
    for i in 0..n {
        q[i] = V::constant(coordinates[i]);
    }
    let mut changes = [V::constant(0.0); FEW];
    let varied = prepared.varied.iter().zip(&prepared.first);
    for (k, (&variable, first)) in varied.enumerate() {
        let change = V::load(&design[variable], at) - V::constant(nominal[variable]);
        let mut slope = [V::constant(0.0); LARGEST];
        for i in 0..n {
            slope[i] = V::constant(first[i]);
        }
        if let Some(second) = prepared.second.get(k) {
            changes[k] = change;
            for (second, change) in second[..=k].iter().zip(&changes) {
                for i in 0..n {
                    slope[i] = slope[i] + V::constant(second[i]) * *change;
                }
            }
        }
        for i in 0..n {
            q[i] = q[i] + slope[i] * change;
        }
    }
    algebra::store(n, &q, batch.coordinates, at);
}

/// A step of Newton's method; a sample fails where the stiffness is not positive definite on the way.
#[inline(always)]
pub(super) fn improve<V: Lanes>(
    n: usize,
    prepared: &TaylorModel<'_>,
    batch: &mut Solved<'_>,
    at: usize,
) {
    let one = V::constant(1.0);
    let mut q: Row<V> = algebra::load(n, batch.coordinates, at);
    let stiffness = load_matrix(n, batch.stiffness, at);
    let (solver, positive) = Solver::new(n, &stiffness, POSITIVE);
    let step = solver.solve(n, &algebra::load(n, batch.residual, at));
    let correction = solver.solve(n, &curved(n, &prepared.curvature, &step));
    // Samples at rest stay where they are, so that none depends on the others.
    let rested = V::load(&batch.resting, at);
    let moving = rested.at_most(V::constant(0.0));
    let flag = V::load(&batch.flags, at);
    let flag = keep(flag, one.at_most(V::choose(moving, positive, one)));
    flag.store(&mut batch.flags, at);
    let mut resting = one;
    for i in 0..n {
        let scale = V::constant(LAST_CORRECTION) * (q[i].abs() + V::constant(SMALL_MOTION));
        resting = keep(resting, correction[i].abs().at_most(scale));
        q[i] = V::choose(moving, q[i] - (step[i] + correction[i]), q[i]);
    }
    algebra::store(n, &q, batch.coordinates, at);
    V::choose(moving, resting, rested).store(&mut batch.resting, at);
}

/// Mass and stiffness at the equilibrium, between the nominal modes.
#[inline(always)]
pub(super) fn between_modes<V: Lanes>(
    n: usize,
    prepared: &TaylorModel<'_>,
    batch: &mut Solved<'_>,
    at: usize,
) {
    for (from, to) in [
        (&*batch.linear.mass, &mut *batch.mass),
        (&*batch.linear.stiffness, &mut *batch.stiffness),
    ] {
        let matrix: Square<V> = load_matrix(n, from, at);
        let matrix = congruent(n, &matrix, &prepared.shapes);
        let to = &mut to[..n * n];
        for i in 0..n {
            for j in 0..=i {
                matrix[i][j].store(&mut to[i * n + j], at);
            }
        }
    }
}

/// `lambda` of the modes in the nominal order; the flag says that every check was passed: at last, that all modes are recognised,
/// the equilibrium is near the nominal one, and the stiffness is positive definite here and, as far as its derivative
/// tells, from the nominal position to its mirror image: then so it is all the way.
#[inline(always)]
pub(super) fn modes<V: Lanes>(
    n: usize,
    prepared: &TaylorModel<'_>,
    batch: &Solved<'_>,
    at: usize,
) -> (Row<V>, V) {
    let one = V::constant(1.0);
    let q: Row<V> = algebra::load(n, batch.coordinates, at);
    let mass: Square<V> = load_matrix(n, batch.mass, at);
    let stiffness: Square<V> = load_matrix(n, batch.stiffness, at);
    let at_rest = one.at_most(V::load(&batch.resting, at));
    let mut flag = keep(V::load(&batch.flags, at), at_rest);
    let mut nearby = stiffness;
    let nominal = &prepared.nominal.coordinates[..n];
    let stiffening = &prepared.stiffening[..n];
    for k in 0..n {
        let displacement = q[k] - V::constant(nominal[k]);
        let twice = displacement * V::constant(2.0);
        for i in 0..n {
            for j in 0..=i {
                nearby[i][j] = nearby[i][j] - V::constant(stiffening[k][i][j]) * twice;
            }
        }
        let far = V::constant(FAR * prepared.reach[k]);
        flag = keep(flag, displacement.abs().at_most(far));
    }
    let flag = keep(
        flag,
        one.at_most(closed::definite(n, &nearby, CLEARLY_POSITIVE)),
    );
    let (lambda, recognised) = closed::eigenvalues(n, &stiffness, &mass);
    let mut flag = keep(flag, one.at_most(recognised));
    for r in 0..n {
        let nominal = prepared.lambda[r];
        flag = keep(flag, V::constant(WEAKENED * nominal).at_most(lambda[r]));
        flag = keep(flag, lambda[r].at_most(V::constant(STIFFENED * nominal)));
    }
    (lambda, flag)
}

/// `1/2 d2g/dq2 step step`, which a Newton step leaves of the residual: `curvature` holds `1/2 dKhat/dq_k`, off its diagonal
/// in `k` and `j` twice.
#[inline(always)]
fn curved<V: Lanes>(n: usize, curvature: &[Square<f64>], step: &Row<V>) -> Row<V> {
    let mut rest = [V::constant(0.0); LARGEST];
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
