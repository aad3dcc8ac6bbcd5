//! Derivatives by lists of symbols, and evaluation at rest.

use crate::algebra::{Direction, ExprId, Graph, SymbolId, derivatives_along, substitute};

use super::symbols::{SymbolList, Symbols};

/// Derivative of `roots` by one symbol.
pub(crate) fn by_symbol(g: &mut Graph, roots: &[ExprId], symbol: SymbolId) -> Vec<ExprId> {
    let direction = Direction::unit(g, symbol);
    derivatives_along(g, roots, &direction)
}

/// Derivatives of `roots` by each symbol of a list: `columns[j][i]`.
pub(crate) fn columns(g: &mut Graph, roots: &[ExprId], by: &SymbolList) -> Vec<Vec<ExprId>> {
    by.ids.iter().map(|&symbol| by_symbol(g, roots, symbol)).collect()
}

/// `roots` with velocities and accelerations set to zero.
pub(crate) fn at_rest(g: &mut Graph, s: &Symbols, roots: &[ExprId]) -> Vec<ExprId> {
    let zeros = vec![g.zero(); s.q.ids.len()];
    let still: Vec<_> = s.velocity.with(&zeros).chain(s.acceleration.with(&zeros)).collect();
    substitute(g, roots, &still)
}

/// The sum of two matrices.
pub(crate) fn added(g: &mut Graph, a: &[Vec<ExprId>], b: &[Vec<ExprId>]) -> Vec<Vec<ExprId>> {
    a.iter().zip(b).map(|(a, b)| a.iter().zip(b).map(|(&a, &b)| g.add(a, b)).collect()).collect()
}

pub(crate) fn weighted_sum(g: &mut Graph, weights: &[ExprId], values: &[ExprId]) -> ExprId {
    let terms: Vec<ExprId> = weights.iter().zip(values).map(|(&weight, &value)| g.mul(weight, value)).collect();
    g.sum(terms)
}
