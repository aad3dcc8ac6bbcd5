//! What an evaluation costs.

use super::graph::{Graph, Node, Operator, Unary};
use crate::base::ids::ExprId;

/// Operations of a straight line of code.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Cost {
    /// Additions, subtractions and multiplications.
    pub operations: usize,
    /// Divisions, roots, powers and elementary functions.
    pub functions: usize,
    /// Changes of sign that no addition or subtraction takes up.
    pub negations: usize,
}

/// The nodes that `roots` need, operands first.
pub fn reachable(graph: &Graph, roots: &[ExprId]) -> Vec<ExprId> {
    let Some(last) = roots.iter().map(|root| root.index()).max() else {
        return Vec::new();
    };
    let mut needed = vec![false; last + 1];
    for root in roots {
        needed[root.index()] = true;
    }
    for index in (0..=last).rev() {
        if needed[index] {
            match graph.node(ExprId::new(index)) {
                Node::Constant(_) | Node::Symbol(_) => {}
                Node::Unary(_, a) => needed[a.index()] = true,
                Node::Binary(_, a, b) => {
                    needed[a.index()] = true;
                    needed[b.index()] = true;
                }
            }
        }
    }
    (0..=last)
        .filter(|&index| needed[index])
        .map(ExprId::new)
        .collect()
}

/// Cost of evaluating `roots` together, each shared node once.
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
