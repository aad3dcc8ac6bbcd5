//! Numeric evaluation of the graph, for checks inside the compiler and for tests.

use super::count::reachable;
use super::graph::{Graph, Node, Operator, Unary};
use crate::base::ids::{ExprId, SymbolId};

/// A value and the size of the terms that it is made of: a value far below its magnitude is a rounded zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Evaluation {
    /// The value.
    pub value: f64,
    /// What the value would be if nothing cancelled.
    pub magnitude: f64,
}

impl Evaluation {
    /// Whether the value is zero up to rounding.
    pub fn is_negligible(self) -> bool {
        self.value.abs() <= 1e-10 * self.magnitude || self.value == 0.0
    }
}

/// Values of `roots` for the given symbol values.
pub fn evaluate(graph: &Graph, roots: &[ExprId], symbol: impl Fn(SymbolId) -> f64) -> Vec<f64> {
    evaluate_with_magnitude(graph, roots, symbol)
        .iter()
        .map(|e| e.value)
        .collect()
}

/// Values of `roots` together with the magnitude of their terms.
pub fn evaluate_with_magnitude(
    graph: &Graph,
    roots: &[ExprId],
    symbol: impl Fn(SymbolId) -> f64,
) -> Vec<Evaluation> {
    let mut done = vec![
        Evaluation {
            value: 0.0,
            magnitude: 0.0
        };
        graph.len()
    ];
    for id in reachable(graph, roots) {
        done[id.index()] = match graph.node(id) {
            Node::Constant(bits) => leaf(f64::from_bits(bits)),
            Node::Symbol(s) => leaf(symbol(s)),
            Node::Unary(operator, a) => {
                let a = done[a.index()];
                let value = apply_unary(operator, a.value);
                let magnitude = match operator {
                    Unary::Negate => a.magnitude,
                    // A root or a function of a cancelled argument inherits the loss of the argument's digits.
                    _ => value.abs() * (a.magnitude / a.value.abs()).clamp(1.0, 1e12),
                };
                Evaluation {
                    value,
                    magnitude: magnitude.max(value.abs()),
                }
            }
            Node::Binary(operator, a, b) => {
                let (a, b) = (done[a.index()], done[b.index()]);
                let value = apply_binary(operator, a.value, b.value);
                let magnitude = match operator {
                    Operator::Add | Operator::Subtract => a.magnitude + b.magnitude,
                    Operator::Multiply => a.magnitude * b.magnitude,
                    Operator::Divide => a.magnitude / b.value.abs(),
                    Operator::Power | Operator::Atan2 => value.abs(),
                };
                Evaluation { value, magnitude }
            }
        };
    }
    roots.iter().map(|root| done[root.index()]).collect()
}

fn leaf(value: f64) -> Evaluation {
    Evaluation {
        value,
        magnitude: value.abs(),
    }
}

/// `operator a`.
pub(crate) fn apply_unary(operator: Unary, a: f64) -> f64 {
    match operator {
        Unary::Negate => -a,
        Unary::Sqrt => a.sqrt(),
        Unary::Sin => a.sin(),
        Unary::Cos => a.cos(),
        Unary::Tan => a.tan(),
        Unary::Asin => a.asin(),
        Unary::Acos => a.acos(),
        Unary::Exp => a.exp(),
        Unary::Ln => a.ln(),
        Unary::PowerInteger(n) => a.powi(n),
    }
}

/// `a operator b`.
pub(crate) fn apply_binary(operator: Operator, a: f64, b: f64) -> f64 {
    match operator {
        Operator::Add => a + b,
        Operator::Subtract => a - b,
        Operator::Multiply => a * b,
        Operator::Divide => a / b,
        Operator::Power => a.powf(b),
        Operator::Atan2 => a.atan2(b),
    }
}
