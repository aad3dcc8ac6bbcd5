//! The cost of an evaluation.

use super::graph::Graph;
use super::node::Node;
use super::reached::Reached;
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

/// Cost of evaluating `roots` together, counting each shared node once.
pub fn cost(graph: &Graph, roots: &[ExprId]) -> Cost {
    let mut cost = Cost::default();
    for &id in Reached::below(graph, roots).nodes() {
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
