//! Numeric evaluation of the graph, for checks inside the compiler and for tests.

use super::graph::Graph;
use super::node::Node;
use super::reached::Reached;
use crate::base::ids::{ExprId, SymbolId};

/// Values of `roots` for the given symbol values.
pub fn evaluate(graph: &Graph, roots: &[ExprId], symbol: impl Fn(SymbolId) -> f64) -> Vec<f64> {
    let part = Reached::below(graph, roots);
    let mut values: Vec<f64> = Vec::with_capacity(part.len());
    let read = |values: &[f64], id: ExprId| part.place(id).map_or(f64::NAN, |index| values[index]);
    for &id in part.nodes() {
        values.push(match graph.node(id) {
            Node::Constant(bits) => f64::from_bits(bits),
            Node::Symbol(s) => symbol(s),
            Node::Unary(operator, a) => operator.apply(read(&values, a)),
            Node::Binary(operator, a, b) => operator.apply(read(&values, a), read(&values, b)),
        });
    }
    roots.iter().map(|&root| read(&values, root)).collect()
}
