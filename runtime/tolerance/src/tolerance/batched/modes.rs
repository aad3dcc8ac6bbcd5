//! The modes of a sample, each identified with a nominal one.

use super::statics::Potential;
use super::{SampleBatch, TaylorModel};
use crate::DampingKind;
use crate::batched::algebra::{Square, keep, load_matrix};
use crate::batched::closed;
use crate::batched::general::Pencil;
use crate::eigenproblem::Reference;
use crate::scalar::Lanes;

/// Smallest and largest `lambda` relative to the nominal one: a mode that changes more may have changed on its way too.
const WEAKENED: f64 = 0.5;
const STIFFENED: f64 = 2.0;
/// A motion clearly decays or grows if `Re s` differs from zero by this many errors and this share of `|s|`.
const CLEAR: f64 = 8.0;
const SLOW: f64 = 1e-12;

/// Undamped modes in the nominal order; clears the flags of samples with a mode that is not recognised.
#[inline(always)]
pub(super) fn undamped<V: Lanes, const N: usize>(
    n: usize,
    potential: &Potential<N>,
    batch: &mut SampleBatch<'_>,
    mut flag: V,
    at: usize,
) -> V {
    let mass: Square<V, N> = load_matrix(n, batch.mass, at);
    let stiffness: Square<V, N> = load_matrix(n, batch.stiffness, at);
    let (lambda, recognised) = closed::eigenvalues(n, &stiffness, &mass);
    flag = keep(flag, V::constant(1.0).at_most(recognised));
    let frequencies = &mut batch.frequencies[..n];
    for r in 0..n {
        let nominal = potential.lambda[r];
        flag = keep(flag, V::constant(WEAKENED * nominal).at_most(lambda[r]));
        flag = keep(flag, lambda[r].at_most(V::constant(STIFFENED * nominal)));
        lambda[r].sqrt().store(&mut frequencies[r], at);
    }
    flag
}

/// Damped or constrained modes in the nominal order; clears the flags of samples whose equilibrium is not stable beyond
/// doubt or that have a mode that is not recognised.
#[inline(always)]
pub(super) fn general<V: Lanes, const N: usize>(
    n: usize,
    (prepared, reference): (&TaylorModel<'_, N>, &Reference),
    batch: &mut SampleBatch<'_>,
    at: usize,
) {
    let mut flag = V::load(&batch.flags, at);
    let linear = &batch.linear;
    let description = &prepared.nominal.description;
    let damped = description.damping != DampingKind::Zero;
    let mut matrices = [[[V::constant(0.0); N]; N]; 3];
    matrices[0] = load_matrix(n, linear.mass, at);
    if damped {
        matrices[1] = load_matrix(n, linear.damping, at);
    }
    matrices[2] = load_matrix(n, linear.stiffness, at);
    let pencil: Pencil<V, N> = Pencil::new(n, matrices, reference);
    let (all, recognised) = pencil.eigenvalues(reference, damped);
    flag = keep(flag, V::constant(1.0).at_most(recognised));
    // Without dissipation, a motion that stays bounded has imaginary eigenvalues.
    let conservative = description.symmetric_stiffness && description.damping != DampingKind::General;
    let modes = batch.frequencies.iter_mut().zip(&mut *batch.rates);
    for ((frequency, rate), (s, error)) in modes.zip(all.as_flattened()) {
        s.im.store(frequency, at);
        if conservative {
            flag = keep(flag, s.re.abs().at_most(*error));
            V::constant(0.0).store(rate, at);
        } else {
            let size = s.square().sqrt();
            let least = V::constant(CLEAR) * *error + V::constant(SLOW) * size;
            flag = keep(flag, least.at_most(-s.re));
            s.re.store(rate, at);
        }
    }
    flag.store(&mut batch.flags, at);
}
