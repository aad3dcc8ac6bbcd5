//! The first stages of a sample: its design, and the prediction of its equilibrium.

use super::nominal::FEW;
use super::{SampleBatch, TaylorModel};
use crate::batched::algebra;
use crate::kernels::Kernels;
use crate::scalar::{Batch, Lanes, WIDTH};
use crate::tolerance::normal_sampling::standard_normal_pair;

/// `b = b_mean + L z`, `z` standard normal; for other distributions, the normal numbers behind them.
#[inline(always)]
pub(super) fn draw<V: Lanes, const N: usize>(prepared: &TaylorModel<'_, N>, batch: &mut SampleBatch<'_>, at: usize) {
    let (design, standard) = (&mut batch.design[..], &mut batch.standard[..]);
    let pairs = batch.bits.iter().zip(standard.chunks_exact_mut(2));
    for (([radius, angle], normal), drawn) in pairs.zip(&prepared.drawn) {
        if *drawn && !batch.given {
            let (first, second) = standard_normal_pair(V::probability(radius, at), V::probability(angle, at));
            first.store(&mut normal[0], at);
            second.store(&mut normal[1], at);
        }
    }
    let mut shared = &prepared.shared[..];
    let means = prepared.means.iter().zip(&prepared.diagonal);
    for (i, (design, (mean, diagonal))) in design.iter_mut().zip(means).enumerate() {
        let start = if prepared.joint.is_some() { 0.0 } else { *mean };
        let mut value = V::constant(start);
        while let Some((&(_, j, factor), behind)) = shared.split_first().filter(|(one, _)| one.0 == i) {
            value = value + V::constant(factor) * V::load(&standard[j], at);
            shared = behind;
        }
        value = value + V::constant(*diagonal) * V::load(&standard[i], at);
        value.store(design, at);
    }
}

/// Converts standard normal numbers, in place, to values that are not normal.
pub(super) fn distribute<const N: usize>(prepared: &TaylorModel<'_, N>, design: &mut [Batch]) {
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

/// One for the members whose bodies can exist.
pub(super) fn possible<const N: usize>(prepared: &TaylorModel<'_, N>, design: &[Batch], members: usize) -> Batch {
    let mut flags = Batch([0.0; WIDTH]);
    let mut sample_design = prepared.nominal.design.clone();
    for sample in 0..members {
        for (entry, design) in sample_design.iter_mut().zip(design) {
            *entry = design.0[sample];
        }
        let kernels: &dyn Kernels = prepared.kernels;
        flags.0[sample] = f64::from(u8::from(kernels.violation(&prepared.nominal.inputs, &sample_design).is_none()));
    }
    flags
}

/// Predicts the equilibrium from the derivatives of the nominal one.
#[inline(always)]
pub(super) fn predict<V: Lanes, const N: usize>(
    n: usize,
    prepared: &TaylorModel<'_, N>,
    batch: &mut SampleBatch<'_>,
    at: usize,
) {
    let coordinates = &prepared.nominal.coordinates[..n];
    let (design, nominal) = (&batch.design[..], &prepared.nominal.design[..]);
    let mut q = [V::constant(0.0); N];
    for i in 0..n {
        q[i] = V::constant(coordinates[i]);
    }
    let mut changes = [V::constant(0.0); FEW];
    let varied = prepared.varied.iter().zip(&prepared.first);
    for (k, (&variable, first)) in varied.enumerate() {
        let change = V::load(&design[variable], at) - V::constant(nominal[variable]);
        let mut slope = [V::constant(0.0); N];
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
