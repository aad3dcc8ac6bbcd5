//! The stages of a sample: design, prediction, steps to the equilibrium, matrices, modes.

use super::{Prepared, Solved};
use crate::batched::POSITIVE;
use crate::batched::algebra::{congruent, constants, keep};
use crate::batched::closed::{self, Solver};
use crate::equilibrium::convergence::SMALL_MOTION;
use crate::lanes::{Batch, Store, Vector, WIDTH, load, load_matrix};
use crate::tolerance::normal::standard_normal_pair;
use crate::tolerance::sampling::Bits;
use crate::{Linear, Mechanism};

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

impl<M, const N: usize, const U: usize, const P: usize, const O: usize> Prepared<'_, M, N, U, P, O>
where
    M: Mechanism<N, U, P, O>,
{
    /// `b = b_nominal + L z`, `z` standard normal.
    #[inline(always)]
    pub(super) fn draw<V: Vector>(&self, pairs: &[[Bits; 2]; P], at: usize) -> [V; P] {
        let mut standard = [V::constant(0.0); P];
        for pair in 0..P.div_ceil(2) {
            if self.drawn[pair] {
                let [radius, angle] = &pairs[pair];
                let (first, second) =
                    standard_normal_pair(V::probability(radius, at), V::probability(angle, at));
                standard[2 * pair] = first;
                if 2 * pair + 1 < P {
                    standard[2 * pair + 1] = second;
                }
            }
        }
        let mut design: [V; P] = constants(&self.nominal.design);
        for &(i, j, factor) in &self.shared {
            design[i] = design[i] + V::constant(factor) * standard[j];
        }
        for ((design, standard), factor) in design.iter_mut().zip(standard).zip(&self.own) {
            *design = *design + V::constant(*factor) * standard;
        }
        design
    }

    /// Ones for the members whose bodies can exist.
    #[inline(always)]
    pub(super) fn possible(&self, design: &[Batch; P], members: usize) -> Batch {
        let mut flags = Batch([0.0; WIDTH]);
        for sample in 0..members {
            let design = core::array::from_fn(|i| design[i].0[sample]);
            let violation = self.mechanism.violation(&self.nominal.inputs, &design);
            flags.0[sample] = f64::from(u8::from(violation.is_none()));
        }
        flags
    }

    /// The equilibrium as the derivatives of the nominal one predict it.
    #[inline(always)]
    pub(super) fn predicted<V: Vector>(&self, design: &[V; P]) -> [V; N] {
        let mut q: [V; N] = constants(&self.nominal.coordinates);
        let mut change = [V::constant(0.0); P];
        // Bounds that the compiler knows: these loops are unrolled.
        for k in 0..P {
            let Some(&variable) = self.varied.get(k) else {
                break;
            };
            change[k] = design[variable] - V::constant(self.nominal.design[variable]);
            let mut slope: [V; N] = constants(&self.first[k]);
            if let Some(second) = self.second.get(k) {
                for j in 0..=k {
                    for (slope, coefficient) in slope.iter_mut().zip(&second[j]) {
                        *slope = *slope + V::constant(*coefficient) * change[j];
                    }
                }
            }
            for (q, slope) in q.iter_mut().zip(slope) {
                *q = *q + slope * change[k];
            }
        }
        q
    }

    /// Residual and stiffness on the way to the equilibrium.
    #[inline(always)]
    pub(super) fn evaluate<V: Vector>(&self, batch: &mut Solved<N, P>, at: usize) {
        let q: [V; N] = load(&batch.coordinates, at);
        let inputs = constants(&self.nominal.inputs);
        let design = load(&batch.design, at);
        let (residual, stiffness) = self
            .mechanism
            .residual_and_stiffness_inlined(&q, &inputs, &design);
        batch.residual.store(&residual, at);
        batch.stiffness.store(&stiffness, at);
    }

    /// A step of Newton's method; a sample fails where the stiffness is not positive definite on the way.
    #[inline(always)]
    pub(super) fn improve<V: Vector>(&self, batch: &mut Solved<N, P>, at: usize) {
        let one = V::constant(1.0);
        let mut q: [V; N] = load(&batch.coordinates, at);
        let stiffness: [[V; N]; N] = load_matrix(&batch.stiffness, at);
        let (solver, positive) = Solver::new(&stiffness, POSITIVE);
        let step = solver.solve(&load(&batch.residual, at));
        let correction = solver.solve(&curved(&self.curvature, &step));
        // Samples at rest stay where they are, so that none depends on the others.
        let rested = V::load(&batch.resting, at);
        let moving = rested.at_most(V::constant(0.0));
        let flag = V::load(&batch.flags, at);
        let flag = keep(flag, one.at_most(V::choose(moving, positive, one)));
        flag.store(&mut batch.flags, at);
        let mut resting = one;
        for ((q, step), correction) in q.iter_mut().zip(step).zip(correction) {
            let scale = V::constant(LAST_CORRECTION) * (q.abs() + V::constant(SMALL_MOTION));
            resting = keep(resting, correction.abs().at_most(scale));
            *q = V::choose(moving, *q - (step + correction), *q);
        }
        batch.coordinates.store(&q, at);
        V::choose(moving, resting, rested).store(&mut batch.resting, at);
    }

    /// Mass and stiffness at the equilibrium, between the nominal modes.
    #[inline(always)]
    pub(super) fn matrices<V: Vector>(&self, batch: &mut Solved<N, P>, at: usize) {
        let q: [V; N] = load(&batch.coordinates, at);
        let inputs = constants(&self.nominal.inputs);
        let design = load(&batch.design, at);
        let Linear {
            mass, stiffness, ..
        } = self.mechanism.linear_inlined(&q, &inputs, &design);
        batch.mass.store(&congruent(&mass, &self.shapes), at);
        let stiffness = congruent(&stiffness, &self.shapes);
        batch.stiffness.store(&stiffness, at);
    }

    /// `lambda` of the modes in the nominal order; the flag says that every check was passed: at last, that all modes are recognised,
    /// the equilibrium is near the nominal one, and the stiffness is positive definite here and, as far as its derivative
    /// tells, from the nominal position to its mirror image: then so it is all the way.
    #[inline(always)]
    pub(super) fn modes<V: Vector>(&self, batch: &Solved<N, P>, at: usize) -> ([V; N], V) {
        let one = V::constant(1.0);
        let q: [V; N] = load(&batch.coordinates, at);
        let mass = load_matrix(&batch.mass, at);
        let stiffness: [[V; N]; N] = load_matrix(&batch.stiffness, at);
        let at_rest = one.at_most(V::load(&batch.resting, at));
        let mut flag = keep(V::load(&batch.flags, at), at_rest);
        let mut nearby = stiffness;
        let displacements = q.iter().zip(&self.nominal.coordinates);
        for ((q, nominal), stiffening) in displacements.zip(&self.stiffening) {
            let twice = (*q - V::constant(*nominal)) * V::constant(2.0);
            for (row, slopes) in nearby.iter_mut().zip(stiffening) {
                for (entry, slope) in row.iter_mut().zip(slopes) {
                    *entry = *entry - V::constant(*slope) * twice;
                }
            }
        }
        let displacements = q.iter().zip(&self.nominal.coordinates);
        for ((q, nominal), reach) in displacements.zip(&self.reach) {
            let displacement = (*q - V::constant(*nominal)).abs();
            flag = keep(flag, displacement.at_most(V::constant(FAR * reach)));
        }
        let flag = keep(
            flag,
            one.at_most(closed::definite(&nearby, CLEARLY_POSITIVE)),
        );
        let (lambda, recognised) = closed::eigenvalues(&stiffness, &mass);
        let mut flag = keep(flag, one.at_most(recognised));
        for (lambda, nominal) in lambda.iter().zip(self.lambda) {
            flag = keep(flag, V::constant(WEAKENED * nominal).at_most(*lambda));
            flag = keep(flag, lambda.at_most(V::constant(STIFFENED * nominal)));
        }
        (lambda, flag)
    }
}

/// `1/2 d2g/dq2 step step`, which a Newton step leaves of the residual: `curvature` holds `1/2 dKhat/dq_k`, off its diagonal
/// in `k` and `j` twice.
#[inline(always)]
fn curved<V: Vector, const N: usize>(curvature: &[[[f64; N]; N]; N], step: &[V; N]) -> [V; N] {
    let mut rest = [V::constant(0.0); N];
    for (k, slopes) in curvature.iter().enumerate() {
        for (j, slopes) in slopes[..=k].iter().enumerate() {
            let product = step[k] * step[j];
            for (rest, slope) in rest.iter_mut().zip(slopes) {
                *rest = *rest + V::constant(*slope) * product;
            }
        }
    }
    rest
}
