//! Numeric evaluation of the graph, for checks inside the compiler and for tests.

use super::count::reachable;
use super::evaluation::{Evaluation, combined, unary};
use super::graph::{Graph, Node};
use crate::base::ids::{ExprId, SymbolId};

/// Values of `roots` for the given symbol values.
pub fn evaluate(graph: &Graph, roots: &[ExprId], symbol: impl Fn(SymbolId) -> f64) -> Vec<f64> {
    evaluate_with_error(graph, roots, symbol)
        .iter()
        .map(|e| e.value)
        .collect()
}

/// Values of `roots` together with bounds on their rounding errors.
pub fn evaluate_with_error(
    graph: &Graph,
    roots: &[ExprId],
    symbol: impl Fn(SymbolId) -> f64,
) -> Vec<Evaluation> {
    let mut done = vec![
        Evaluation {
            value: 0.0,
            error: 0.0
        };
        graph.len()
    ];
    for id in reachable(graph, roots) {
        done[id.index()] = match graph.node(id) {
            Node::Constant(bits) => {
                let number = graph.number(id);
                number.unwrap_or(Evaluation::nearest(f64::from_bits(bits)))
            }
            Node::Symbol(s) => Evaluation {
                value: symbol(s),
                error: 0.0,
            },
            Node::Unary(operator, a) => unary(operator, done[a.index()]),
            Node::Binary(operator, a, b) => combined(operator, done[a.index()], done[b.index()]),
        };
    }
    roots.iter().map(|root| done[root.index()]).collect()
}
