//! Tests whether expressions vanish at every state: structurally if the graph shows it, otherwise by evaluation at
//! random states, at all of which a value must vanish up to rounding.

use crate::algebra::{Disturbed, Evaluator, ExprId, Graph, SymbolId};

use super::context::Context;
use super::sections::Mirrored;

/// Number of finite random states for a numerical proof, and maximum number of attempts to find them.
const STATES: usize = 4;
const ATTEMPTS: u64 = 16;

/// Values of `roots` at random states, one state after the other: fewer than [`STATES`] only if the equations are rarely
/// finite.
pub(crate) fn probe<'a>(evaluator: &'a Evaluator, context: &'a Context) -> impl Iterator<Item = Vec<Disturbed>> + 'a {
    (1..=ATTEMPTS)
        .map(|seed| evaluator.at(seed, |symbol| exact(context, seed, symbol)))
        .filter(|values| values.iter().all(Disturbed::is_finite))
        .take(STATES)
}

/// Whether each root vanishes at every probed state.
pub(crate) fn vanish(g: &Graph, context: &Context, roots: &[ExprId]) -> Vec<bool> {
    let mut zero: Vec<bool> = roots.iter().map(|&root| g.is(root, 0.0)).collect();
    let mut open: Vec<usize> = (0..roots.len()).filter(|&k| !zero[k]).collect();
    let (mut states, mut seeds) = (0, 1..=ATTEMPTS);
    while states < STATES && !open.is_empty() && !seeds.is_empty() {
        let rest: Vec<ExprId> = open.iter().map(|&k| roots[k]).collect();
        let evaluator = Evaluator::new(g, &rest);
        for seed in seeds.by_ref() {
            let values = evaluator.at(seed, |symbol| exact(context, seed, symbol));
            if !values.iter().all(Disturbed::is_finite) {
                continue;
            }
            states += 1;
            let mut values = values.iter();
            open.retain(|_| values.next().is_some_and(|v| v.is_rounding(evaluator.operations())));
            if states == STATES || open.len() < rest.len() {
                break;
            }
        }
    }
    if states > 0 {
        open.into_iter().for_each(|k| zero[k] = true);
    }
    zero
}

/// How the entries of a matrix are related across its diagonal.
pub(crate) fn mirrored(g: &mut Graph, context: &Context, columns: &[Vec<ExprId>]) -> Mirrored {
    let mut vanishes = |compared: fn(&mut Graph, ExprId, ExprId) -> ExprId| {
        let mut both = Vec::new();
        for (j, column) in columns.iter().enumerate() {
            for (i, other) in columns[..j].iter().enumerate() {
                both.push(compared(g, column[i], other[j]));
            }
        }
        vanish(g, context, &both).into_iter().all(|zero| zero)
    };
    if vanishes(Graph::sub) {
        Mirrored::Equal
    } else if !context.sections.rows.is_empty() && vanishes(Graph::add) {
        Mirrored::Opposite
    } else {
        Mirrored::Unrelated
    }
}

fn exact(context: &Context, seed: u64, symbol: SymbolId) -> Disturbed {
    Disturbed::exact(RandomState { design: seed, motion: seed }.value(context, symbol))
}

/// A random state: design variables near their nominal values, everything else of the order of one.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RandomState {
    /// Chooses design variables and inputs; zero is the nominal design.
    pub(crate) design: u64,
    /// Chooses everything else.
    pub(crate) motion: u64,
}

impl RandomState {
    /// A symbol's value.
    pub(crate) fn value(self, context: &Context, symbol: SymbolId) -> f64 {
        let signed = |seed| 2.0 * random(seed, symbol) - 1.0;
        let symbols = context.symbols;
        let position = |list: &[SymbolId]| list.iter().position(|&s| s == symbol);
        if let Some(k) = position(&symbols.b.ids) {
            let nominal = context.mechanism.design[k].nominal;
            return match (self.design, nominal == 0.0) {
                (0, _) => nominal,
                (seed, true) => 0.1 * signed(seed),
                (seed, false) => nominal * (1.0 + 0.1 * signed(seed)),
            };
        }
        if position(&symbols.u.ids).is_some() {
            return 1.5 + signed(self.design);
        }
        let signed = signed(self.motion);
        if position(&symbols.q.ids).is_some_and(|k| context.multiblade.is_lateral(k)) {
            return 0.0;
        }
        if let Some(id) = position(&symbols.q.ids).and_then(|k| context.topology.free.get(k)) {
            let coordinate = &context.mechanism.coordinates[id.index()];
            return coordinate.quantity.either(1.2 * signed, 0.3 * signed);
        }
        signed
    }
}

/// A number in [0, 1) that depends only on its arguments (SplitMix64).
fn random(seed: u64, symbol: SymbolId) -> f64 {
    let mut x =
        seed.wrapping_mul(0x9e37_79b9_7f4a_7c15).wrapping_add(u64::from(symbol.0).wrapping_mul(0xd1b5_4a32_d192_ed03));
    for shift in [30, 27] {
        x = (x ^ (x >> shift)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    }
    x ^= x >> 31;
    (x >> 11) as f64 / (1u64 << 53) as f64
}
