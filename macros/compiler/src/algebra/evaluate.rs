//! Numeric evaluation of the graph, for checks inside the compiler and for tests.

use super::count::reachable;
use super::evaluation::{Evaluation, combined, unary};
use super::graph::Graph;
use super::node::Node;
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
    // zeroed memory, which costs nothing to allocate
    let (mut values, mut errors) = (vec![0.0; graph.len()], vec![0.0; graph.len()]);
    let read = |values: &[f64], errors: &[f64], id: ExprId| Evaluation {
        value: values[id.index()],
        error: errors[id.index()],
    };
    for id in reachable(graph, roots) {
        let result = match graph.node(id) {
            Node::Constant(bits) => {
                let number = graph.number(id);
                number.unwrap_or(Evaluation::nearest(f64::from_bits(bits)))
            }
            Node::Symbol(s) => Evaluation {
                value: symbol(s),
                error: 0.0,
            },
            Node::Unary(operator, a) => unary(operator, read(&values, &errors, a)),
            Node::Binary(operator, a, b) => combined(
                operator,
                read(&values, &errors, a),
                read(&values, &errors, b),
            ),
        };
        values[id.index()] = result.value;
        errors[id.index()] = result.error;
    }
    roots
        .iter()
        .map(|&root| read(&values, &errors, root))
        .collect()
}
