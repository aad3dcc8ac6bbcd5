//! How often nodes are used, and by which operators.

use super::super::graph::Graph;
use super::super::node::Node;
use super::super::reached::Reached;
use crate::base::ids::ExprId;
use crate::base::operators::Operator;

/// How the nodes below some roots are used.
pub(super) struct Uses {
    pub(super) nodes: Reached,
    /// By place among the nodes: what the only use of a node is.
    only: Vec<Only>,
}

/// The use of a node that is used once.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Only {
    /// None yet.
    Unused,
    /// As an operand of a sum.
    InSum,
    /// As an operand of a product.
    InProduct,
    /// As a root or any other operand, or it is used more than once.
    Other,
}

impl Uses {
    pub(super) fn new(graph: &Graph, roots: &[ExprId]) -> Self {
        let nodes = Reached::below(graph, roots);
        let only = vec![Only::Unused; nodes.len()];
        let mut this = Self { nodes, only };
        for &root in roots {
            this.note(root, Only::Other);
        }
        for k in 0..this.nodes.len() {
            let node = graph.node(this.nodes.nodes()[k]);
            let role = match node {
                Node::Binary(operator, ..) if is_sum(operator) => Only::InSum,
                Node::Binary(Operator::Multiply, ..) => Only::InProduct,
                _ => Only::Other,
            };
            for operand in operands(node).into_iter().flatten() {
                this.note(operand, role);
            }
        }
        this
    }

    fn note(&mut self, id: ExprId, role: Only) {
        if let Some(index) = self.nodes.place(id) {
            self.only[index] = match self.only[index] {
                Only::Unused => role,
                _ => Only::Other,
            };
        }
    }

    fn only(&self, id: ExprId) -> Option<Only> {
        self.nodes.place(id).map(|index| self.only[index])
    }

    /// Whether the only use of a node is as an operand of a sum.
    pub(super) fn in_sum(&self, id: ExprId) -> bool {
        self.only(id) == Some(Only::InSum)
    }

    /// Whether the only use of a node is as an operand of a product.
    pub(super) fn in_product(&self, id: ExprId) -> bool {
        self.only(id) == Some(Only::InProduct)
    }

    /// The factors of a product, expanding inner products that are used nowhere else.
    pub(super) fn factors(&self, graph: &Graph, id: ExprId, list: &mut Vec<ExprId>) {
        let Node::Binary(Operator::Multiply, a, b) = graph.node(id) else {
            list.push(id);
            return;
        };
        for operand in [a, b] {
            if self.in_product(operand) {
                self.factors(graph, operand, list);
            } else {
                list.push(operand);
            }
        }
    }

    /// The terms of a sum, expanding inner sums that are used nowhere else; `true` for subtracted terms.
    pub(super) fn terms(&self, graph: &Graph, id: ExprId, minus: bool, list: &mut Vec<(bool, ExprId)>) {
        let Node::Binary(operator @ (Operator::Add | Operator::Subtract), a, b) = graph.node(id) else {
            list.push((minus, id));
            return;
        };
        let signs = [minus, minus ^ (operator == Operator::Subtract)];
        for (operand, minus) in [a, b].into_iter().zip(signs) {
            if self.in_sum(operand) {
                self.terms(graph, operand, minus, list);
            } else {
                list.push((minus, operand));
            }
        }
    }
}

fn operands(node: Node) -> [Option<ExprId>; 2] {
    match node {
        Node::Constant(_) | Node::Symbol(_) => [None, None],
        Node::Unary(_, a) => [Some(a), None],
        Node::Binary(_, a, b) => [Some(a), Some(b)],
    }
}

pub(super) fn is_sum(operator: Operator) -> bool {
    matches!(operator, Operator::Add | Operator::Subtract)
}
