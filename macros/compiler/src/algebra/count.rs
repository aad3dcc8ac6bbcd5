//! The cost of an evaluation.

use super::graph::Graph;
use super::node::Node;
use crate::base::ids::ExprId;
use crate::base::operators::{Operator, Unary};

/// Operations in straight-line code.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Cost {
    /// Additions, subtractions and multiplications.
    pub operations: usize,
    /// Divisions, roots, powers and elementary functions.
    pub functions: usize,
    /// Sign changes that are not absorbed by an addition or subtraction.
    pub negations: usize,
}

/// The nodes needed to evaluate `roots`, themselves included, operands first.
pub fn reachable(graph: &Graph, roots: &[ExprId]) -> Vec<ExprId> {
    gathered(graph, roots, |_| true)
}

/// Of the nodes needed to evaluate `roots`, those that may depend on a symbol of `mask`, operands first.
pub(super) fn dependent(graph: &Graph, roots: &[ExprId], mask: u128) -> Vec<ExprId> {
    gathered(graph, roots, |id| graph.may_depend(id, mask))
}

/// The nodes reached from `roots` through `wanted` nodes only, operands first.
///
/// The work grows with the number of nodes found, not with the size of the graph.
fn gathered(graph: &Graph, roots: &[ExprId], wanted: impl Fn(ExprId) -> bool) -> Vec<ExprId> {
    let mut seen = vec![0_u64; graph.len() / 64 + 1];
    let mut found = Vec::new();
    let mut visit = |found: &mut Vec<ExprId>, id: ExprId| {
        let (word, bit) = (id.index() / 64, 1 << (id.index() % 64));
        if seen[word] & bit == 0 && wanted(id) {
            seen[word] |= bit;
            found.push(id);
        }
    };
    for &root in roots {
        visit(&mut found, root);
    }
    let mut next = 0;
    while let Some(&id) = found.get(next) {
        next += 1;
        match graph.node(id) {
            Node::Constant(_) | Node::Symbol(_) => {}
            Node::Unary(_, a) => visit(&mut found, a),
            Node::Binary(_, a, b) => {
                visit(&mut found, a);
                visit(&mut found, b);
            }
        }
    }
    in_order(&seen, found)
}

/// `found` in order of ids, for each of which `seen` has a bit set. Sorting would take a fifth of the macro's time if
/// it is compiled without optimisation.
fn in_order(seen: &[u64], mut found: Vec<ExprId>) -> Vec<ExprId> {
    let mut next = 0;
    for (word, &bits) in seen.iter().enumerate() {
        let mut rest = bits;
        while rest != 0 {
            found[next] = ExprId::new(word * 64 + rest.trailing_zeros() as usize);
            next += 1;
            rest &= rest - 1;
        }
    }
    found
}

/// Cost of evaluating `roots` together, counting each shared node once.
pub fn cost(graph: &Graph, roots: &[ExprId]) -> Cost {
    let mut cost = Cost::default();
    for id in reachable(graph, roots) {
        match graph.node(id) {
            Node::Constant(_) | Node::Symbol(_) => {}
            Node::Unary(Unary::Negate, _) => cost.negations += 1,
            Node::Binary(Operator::Add | Operator::Subtract | Operator::Multiply, ..) => {
                cost.operations += 1;
            }
            Node::Unary(..) | Node::Binary(..) => cost.functions += 1,
        }
    }
    cost
}
