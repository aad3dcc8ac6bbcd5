//! How often nodes are used, and by which operators.

use super::super::count::reachable;
use super::super::graph::Graph;
use super::super::node::Node;
use crate::base::ids::ExprId;
use crate::base::operators::Operator;

/// How the nodes below some roots are used.
pub(super) struct Uses {
    pub(super) order: Vec<ExprId>,
    /// By node: how often it is an operand or a root.
    pub(super) count: Vec<u32>,
    /// By node: whether its only use is as an operand of a sum (or of a product, below).
    pub(super) in_sum: Vec<bool>,
    pub(super) in_product: Vec<bool>,
}

impl Uses {
    pub(super) fn new(graph: &Graph, roots: &[ExprId]) -> Self {
        let order = reachable(graph, roots);
        let size = order.last().map_or(0, |last| last.index() + 1);
        let mut this = Self {
            order,
            count: vec![0; size],
            in_sum: vec![false; size],
            in_product: vec![false; size],
        };
        for root in roots {
            this.count[root.index()] += 1;
        }
        for &id in &this.order {
            let node = graph.node(id);
            for operand in operands(node).into_iter().flatten() {
                let k = operand.index();
                this.count[k] += 1;
                if let Node::Binary(operator, ..) = node {
                    this.in_sum[k] = is_sum(operator);
                    this.in_product[k] = operator == Operator::Multiply;
                }
            }
        }
        for k in this.order.iter().map(|id| id.index()) {
            this.in_sum[k] &= this.count[k] == 1;
            this.in_product[k] &= this.count[k] == 1;
        }
        this
    }

    /// The factors of a product, expanding inner products that are used nowhere else.
    pub(super) fn factors(&self, graph: &Graph, id: ExprId, list: &mut Vec<ExprId>) {
        let Node::Binary(Operator::Multiply, a, b) = graph.node(id) else {
            list.push(id);
            return;
        };
        for operand in [a, b] {
            if self.in_product[operand.index()] {
                self.factors(graph, operand, list);
            } else {
                list.push(operand);
            }
        }
    }

    /// The terms of a sum, expanding inner sums that are used nowhere else; `true` for subtracted terms.
    pub(super) fn terms(
        &self,
        graph: &Graph,
        id: ExprId,
        minus: bool,
        list: &mut Vec<(bool, ExprId)>,
    ) {
        let Node::Binary(operator @ (Operator::Add | Operator::Subtract), a, b) = graph.node(id)
        else {
            list.push((minus, id));
            return;
        };
        let signs = [minus, minus ^ (operator == Operator::Subtract)];
        for (operand, minus) in [a, b].into_iter().zip(signs) {
            if self.in_sum[operand.index()] {
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
