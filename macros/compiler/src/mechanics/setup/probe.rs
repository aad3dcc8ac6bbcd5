//! Tests whether expressions vanish at every state: structurally if the graph shows it, otherwise by evaluation at
//! random states, at all of which a value must vanish up to rounding.

use crate::algebra::{Evaluation, Graph, evaluate_with_error};
use crate::base::ids::{ExprId, SymbolId};
use crate::model::mechanism::CoordinateQuantity;

use super::context::Context;

/// Number of finite random states for a numerical proof, and maximum number of attempts to find them.
const STATES: usize = 4;
const ATTEMPTS: u64 = 16;

/// Values of `roots` at random states. Returns fewer than [`STATES`] only if the equations are rarely finite.
pub(crate) fn probe(g: &Graph, context: &Context, roots: &[ExprId]) -> Vec<Vec<Evaluation>> {
    (1..=ATTEMPTS)
        .map(|seed| evaluate_with_error(g, roots, |symbol| state(context, seed, symbol)))
        .filter(|values| {
            values
                .iter()
                .all(|v| v.value.is_finite() && v.error.is_finite())
        })
        .take(STATES)
        .collect()
}

/// Whether each root vanishes at every probed state.
pub(crate) fn vanish(g: &Graph, context: &Context, roots: &[ExprId]) -> Vec<bool> {
    let probes = probe(g, context, roots);
    (0..roots.len())
        .map(|k| {
            g.is(roots[k], 0.0)
                || (!probes.is_empty() && probes.iter().all(|values| values[k].is_negligible()))
        })
        .collect()
}

/// A symbol's value in random state number `seed`: design variables near their nominal values, everything else of the
/// order of one.
fn state(context: &Context, seed: u64, symbol: SymbolId) -> f64 {
    let signed = 2.0 * random(seed, symbol) - 1.0;
    let symbols = context.symbols;
    let position = |list: &[SymbolId]| list.iter().position(|&s| s == symbol);
    if let Some(k) = position(&symbols.b.ids) {
        let nominal = context.mechanism.design[k].nominal;
        return if nominal == 0.0 {
            0.1 * signed
        } else {
            nominal * (1.0 + 0.1 * signed)
        };
    }
    if position(&symbols.u.ids).is_some() {
        return 1.5 + signed;
    }
    if let Some(id) = position(&symbols.q.ids).and_then(|k| context.topology.free.get(k)) {
        let coordinate = &context.mechanism.coordinates[id.index()];
        return match coordinate.quantity {
            CoordinateQuantity::Angle => 1.2 * signed,
            CoordinateQuantity::Displacement => 0.3 * signed,
        };
    }
    signed
}

/// A number in [0, 1) that depends only on its arguments (SplitMix64).
fn random(seed: u64, symbol: SymbolId) -> f64 {
    let mut x = seed
        .wrapping_mul(0x9e37_79b9_7f4a_7c15)
        .wrapping_add(u64::from(symbol.0).wrapping_mul(0xd1b5_4a32_d192_ed03));
    for shift in [30, 27] {
        x = (x ^ (x >> shift)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    }
    x ^= x >> 31;
    (x >> 11) as f64 / (1u64 << 53) as f64
}
