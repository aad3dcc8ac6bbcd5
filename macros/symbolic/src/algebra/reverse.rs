//! Reverse differentiation: the derivatives of one expression by many symbols, at a small multiple of its cost.

use super::forward::{slope, slopes};
use super::graph::Graph;
use super::node::Node;
use super::node_map::NodeMap;
use super::reached::Reached;
use crate::base::ids::{ExprId, SymbolId};
use crate::base::operators::{Operator, Unary};

/// Derivatives of `root` by each of `symbols`.
pub fn gradient(graph: &mut Graph, root: ExprId, symbols: &[SymbolId]) -> Vec<ExprId> {
    let mask = Graph::mask(symbols.iter().copied());
    let zero = graph.zero();
    let changing = Reached::dependent(graph, &[root], mask);
    let adjoints = adjoints(graph, root, &changing, mask);
    let mut by_symbol = vec![zero; graph.symbol_count()];
    for &id in changing.nodes() {
        if let Node::Symbol(symbol) = graph.node(id) {
            by_symbol[symbol.index()] = adjoints.get(id).unwrap_or(zero);
        }
    }
    symbols.iter().map(|symbol| by_symbol[symbol.index()]).collect()
}

/// The functions below `root` that have no slope somewhere, as a square root at zero, among those that change with one
/// of `symbols`: the slope of each, and the derivative of `root` by it.
pub fn rough(graph: &mut Graph, root: ExprId, symbols: &[SymbolId]) -> Vec<[ExprId; 2]> {
    let mask = Graph::mask(symbols.iter().copied());
    let zero = graph.zero();
    let changing = Reached::dependent(graph, &[root], mask);
    let rough = |graph: &Graph, id| match graph.node(id) {
        Node::Unary(operator @ (Unary::Sqrt | Unary::Asin | Unary::Acos), a) => Some((operator, a)),
        _ => None,
    };
    if changing.nodes().iter().all(|&id| rough(graph, id).is_none()) {
        return Vec::new();
    }
    let adjoints = adjoints(graph, root, &changing, mask);
    let mut all = Vec::new();
    for &id in changing.nodes() {
        if let Some((operator, a)) = rough(graph, id) {
            let slope = slope(graph, operator, id, a);
            all.push([slope, adjoints.get(id).unwrap_or(zero)]);
        }
    }
    all
}

/// Derivatives of `root` by each node below it that may depend on a symbol of `mask`.
fn adjoints<'a>(graph: &mut Graph, root: ExprId, changing: &'a Reached, mask: u128) -> NodeMap<'a> {
    let zero = graph.zero();
    let known = graph.len();
    let mut adjoints = NodeMap::new(changing);
    adjoints.set(root, graph.constant(1.0));
    for &id in changing.nodes().iter().rev() {
        let adjoint = adjoints.get(id).unwrap_or(zero);
        if adjoint == zero {
            continue;
        }
        if adjoint.index() >= known
            && let Some(name) = graph.name(id).map(|name| format!("{name}_adjoint"))
        {
            graph.set_name(adjoint, || name);
        }
        let mut accumulate = |graph: &mut Graph, operand: ExprId, slope: ExprId| {
            if graph.may_depend(operand, mask) {
                let share = graph.mul(slope, adjoint);
                let sum = graph.add(adjoints.get(operand).unwrap_or(zero), share);
                adjoints.set(operand, sum);
            }
        };
        match graph.node(id) {
            Node::Constant(_) | Node::Symbol(_) => {}
            Node::Unary(Unary::Negate, a) => {
                let minus = graph.constant(-1.0);
                accumulate(graph, a, minus);
            }
            Node::Unary(operator, a) => {
                let slope = slope(graph, operator, id, a);
                accumulate(graph, a, slope);
            }
            Node::Binary(Operator::Divide, a, b) => {
                let share = graph.div(adjoint, b);
                if graph.may_depend(a, mask) {
                    let sum = graph.add(adjoints.get(a).unwrap_or(zero), share);
                    adjoints.set(a, sum);
                }
                if graph.may_depend(b, mask) {
                    let loss = graph.mul(id, share);
                    let rest = graph.sub(adjoints.get(b).unwrap_or(zero), loss);
                    adjoints.set(b, rest);
                }
            }
            Node::Binary(operator, a, b) => {
                let (by_a, by_b) = slopes(graph, operator, id, a, b);
                accumulate(graph, a, by_a);
                accumulate(graph, b, by_b);
            }
        }
    }
    adjoints
}
