//! Building expressions: every new node is simplified by the rules.

use super::graph::Graph;
use super::node::Node;
use super::rules;
use crate::base::ids::ExprId;
use crate::base::operators::{Operator, Unary};

impl Graph {
    /// `a + b`.
    pub fn add(&mut self, a: ExprId, b: ExprId) -> ExprId {
        self.binary(Operator::Add, a, b)
    }

    /// `a - b`.
    pub fn sub(&mut self, a: ExprId, b: ExprId) -> ExprId {
        self.binary(Operator::Subtract, a, b)
    }

    /// `a * b`.
    pub fn mul(&mut self, a: ExprId, b: ExprId) -> ExprId {
        self.binary(Operator::Multiply, a, b)
    }

    /// `a / b`.
    pub fn div(&mut self, a: ExprId, b: ExprId) -> ExprId {
        self.binary(Operator::Divide, a, b)
    }

    /// `-a`.
    pub fn neg(&mut self, a: ExprId) -> ExprId {
        self.unary(Unary::Negate, a)
    }

    /// `factor * a`.
    pub fn scale(&mut self, factor: f64, a: ExprId) -> ExprId {
        let factor = self.constant(factor);
        self.mul(factor, a)
    }

    /// The sum of some terms, from the first to the last.
    pub fn sum(&mut self, terms: impl IntoIterator<Item = ExprId>) -> ExprId {
        let zero = self.zero();
        terms.into_iter().fold(zero, |sum, term| self.add(sum, term))
    }

    /// A unary operator, simplified.
    pub fn unary(&mut self, operator: Unary, a: ExprId) -> ExprId {
        self.requests += 1;
        rules::simplify_unary(self, operator, a).unwrap_or_else(|| self.intern(Node::Unary(operator, a)))
    }

    /// A binary operator, simplified.
    pub fn binary(&mut self, operator: Operator, a: ExprId, b: ExprId) -> ExprId {
        self.requests += 1;
        let (first, second) = match operator {
            Operator::Add | Operator::Multiply if b < a => (b, a),
            _ => (a, b),
        };
        let node = Node::Binary(operator, first, second);
        // a node that already exists could not be simplified
        if let Some(known) = self.find(node) {
            return known;
        }
        rules::simplify_binary(self, operator, a, b).unwrap_or_else(|| self.intern(node))
    }
}
