//! The rewrite rules: a named table with side conditions. The right side never costs more than the left.
//!
//! A rule sees the operands of a node about to be built and may return something simpler. A test samples every rule
//! numerically and checks that it fires.

use super::evaluation::{Evaluation, combined, folded};
use super::graph::Graph;
use super::node::Node;
use crate::base::ids::ExprId;
use crate::base::operators::{Operator, Unary};

/// One rewrite rule for `a op b`; unary operators ignore `b`.
pub struct Rule {
    /// The rewrite, left to right.
    pub name: &'static str,
    /// Where both sides are equal; empty if everywhere.
    pub condition: &'static str,
    /// The simpler form, if the rule applies.
    pub apply: fn(&mut Graph, ExprId, ExprId) -> Option<ExprId>,
}

/// The rules of one operator, tried in order.
pub struct Table {
    /// The operator that the rules apply to.
    pub operator: TableOperator,
    /// The rules.
    pub rules: &'static [Rule],
}

/// The operator of a table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TableOperator {
    /// A binary operator.
    Binary(Operator),
    /// Negation.
    Negate,
    /// A sine.
    Sin,
    /// A cosine.
    Cos,
}

const fn rule(
    name: &'static str,
    condition: &'static str,
    apply: fn(&mut Graph, ExprId, ExprId) -> Option<ExprId>,
) -> Rule {
    Rule { name, condition, apply }
}

/// Every table, for documentation and tests.
pub const TABLES: &[Table] = &[
    Table { operator: TableOperator::Binary(Operator::Add), rules: ADD },
    Table { operator: TableOperator::Binary(Operator::Subtract), rules: SUBTRACT },
    Table { operator: TableOperator::Binary(Operator::Multiply), rules: MULTIPLY },
    Table { operator: TableOperator::Binary(Operator::Divide), rules: DIVIDE },
    Table { operator: TableOperator::Negate, rules: NEGATE },
    Table { operator: TableOperator::Sin, rules: SIN },
    Table { operator: TableOperator::Cos, rules: COS },
];

const ADD: &[Rule] = &[
    rule("0 + a = a", "", |g, a, b| {
        if g.is(a, 0.0) {
            Some(b)
        } else if g.is(b, 0.0) {
            Some(a)
        } else {
            None
        }
    }),
    rule("a + (-b) = a - b", "", |g, a, b| match (negated(g, a), negated(g, b)) {
        (Some(a), Some(b)) => {
            let sum = g.add(a, b);
            Some(g.neg(sum))
        }
        (None, Some(b)) => Some(g.sub(a, b)),
        (Some(a), None) => Some(g.sub(b, a)),
        (None, None) => None,
    }),
    rule("a + a = 2 a", "", |g, a, b| (a == b).then(|| g.scale(2.0, a))),
    rule("(a - b) + b = a", "", |g, a, b| match (difference(g, a), difference(g, b)) {
        (Some((x, y)), _) if y == b => Some(x),
        (_, Some((x, y))) if y == a => Some(x),
        _ => None,
    }),
    rule("c a + d a = (c + d) a for constants c, d", "c + d is finite", |g, a, b| {
        let ((c, x), (d, y)) = (scaled(g, a), scaled(g, b));
        let sum = combined(Operator::Add, c, d);
        (x == y && sum.value.is_finite()).then(|| times(g, sum, x))
    }),
    rule("sin(x)^2 + cos(x)^2 = 1", "", |g, a, b| match (square(g, a), square(g, b)) {
        (Some(Node::Unary(Unary::Sin, x)), Some(Node::Unary(Unary::Cos, y)))
        | (Some(Node::Unary(Unary::Cos, x)), Some(Node::Unary(Unary::Sin, y)))
            if x == y =>
        {
            Some(g.constant(1.0))
        }
        _ => None,
    }),
];

const SUBTRACT: &[Rule] = &[
    rule("a - 0 = a", "", |g, a, b| g.is(b, 0.0).then_some(a)),
    rule("0 - a = -a", "", |g, a, b| g.is(a, 0.0).then(|| g.neg(b))),
    rule("a - a = 0", "", |g, a, b| (a == b).then(|| g.zero())),
    rule("a - (-b) = a + b", "", |g, a, b| match (negated(g, a), negated(g, b)) {
        (Some(a), Some(b)) => Some(g.sub(b, a)),
        (None, Some(b)) => Some(g.add(a, b)),
        (Some(a), None) => {
            let sum = g.add(a, b);
            Some(g.neg(sum))
        }
        (None, None) => None,
    }),
    rule("(a + b) - b = a", "", |g, a, b| match sum(g, a) {
        Some((x, y)) if y == b => Some(x),
        Some((x, y)) if x == b => Some(y),
        _ => None,
    }),
    rule("a - (a - b) = b", "", |g, a, b| match difference(g, b) {
        Some((x, y)) if x == a => Some(y),
        _ => None,
    }),
    rule("c a - d a = (c - d) a for constants c, d", "c - d is finite", |g, a, b| {
        let ((c, x), (d, y)) = (scaled(g, a), scaled(g, b));
        let difference = combined(Operator::Subtract, c, d);
        (x == y && difference.value.is_finite()).then(|| times(g, difference, x))
    }),
    rule("a - b = -(b - a) where b - a is known", "", |g, a, b| {
        let known = g.find(Node::Binary(Operator::Subtract, b, a))?;
        Some(g.neg(known))
    }),
];

const MULTIPLY: &[Rule] = &[
    rule("0 a = 0", "a is finite", |g, a, b| (g.is(a, 0.0) || g.is(b, 0.0)).then(|| g.zero())),
    rule("1 a = a", "", |g, a, b| {
        if g.is(a, 1.0) {
            Some(b)
        } else if g.is(b, 1.0) {
            Some(a)
        } else {
            None
        }
    }),
    rule("(-a) b = -(a b)", "", |g, a, b| match (negated(g, a), negated(g, b)) {
        (Some(x), Some(y)) => Some(g.mul(x, y)),
        (Some(x), None) => {
            let product = g.mul(x, b);
            Some(g.neg(product))
        }
        (None, Some(y)) => {
            let product = g.mul(a, y);
            Some(g.neg(product))
        }
        (None, None) => None,
    }),
    rule("c (d a) = (c d) a for constants c, d", "c d is finite", |g, a, b| {
        let (c, other) = match (g.number(a), g.number(b)) {
            (Some(c), None) => (c, b),
            (None, Some(c)) => (c, a),
            _ => return None,
        };
        let (d, x) = scaled(g, other);
        let product = combined(Operator::Multiply, c, d);
        (x != other && product.value.is_normal()).then(|| times(g, product, x))
    }),
    rule("a (1 / a) = 1, a (b / a) = b", "a is not zero", |g, a, b| match (quotient(g, a), quotient(g, b)) {
        (Some((x, y)), _) if y == b => Some(x),
        (_, Some((x, y))) if y == a => Some(x),
        _ => None,
    }),
    rule("sqrt(a) sqrt(a) = a", "a is not negative", |g, a, b| match g.node(a) {
        Node::Unary(Unary::Sqrt, x) if a == b => Some(x),
        _ => None,
    }),
];

const DIVIDE: &[Rule] = &[
    rule("a / 1 = a", "", |g, a, b| g.is(b, 1.0).then_some(a)),
    rule("0 / a = 0", "a is not zero", |g, a, b| (g.is(a, 0.0) && !g.is(b, 0.0)).then(|| g.zero())),
    rule("a / a = 1", "a is not zero", |g, a, b| (a == b).then(|| g.constant(1.0))),
    rule("a / c = (1 / c) a for a constant c", "1 / c is finite", |g, a, b| {
        let reciprocal = combined(Operator::Divide, Evaluation::ONE, g.number(b)?);
        reciprocal.value.is_normal().then(|| times(g, reciprocal, a))
    }),
    rule("(-a) / b = -(a / b)", "", |g, a, b| match (negated(g, a), negated(g, b)) {
        (Some(a), Some(b)) => Some(g.div(a, b)),
        (Some(a), None) => {
            let ratio = g.div(a, b);
            Some(g.neg(ratio))
        }
        (None, Some(b)) => {
            let ratio = g.div(a, b);
            Some(g.neg(ratio))
        }
        (None, None) => None,
    }),
    rule("(a b) / b = a", "b is not zero", |g, a, b| match product(g, a) {
        Some((x, y)) if y == b => Some(x),
        Some((x, y)) if x == b => Some(y),
        _ => None,
    }),
    rule("a / sqrt(a) = sqrt(a)", "a is positive", |g, a, b| match g.node(b) {
        Node::Unary(Unary::Sqrt, x) if x == a => Some(b),
        _ => None,
    }),
];

const NEGATE: &[Rule] = &[rule("-(-a) = a", "", |g, a, _| match g.node(a) {
    Node::Unary(Unary::Negate, x) => Some(x),
    _ => None,
})];

const SIN: &[Rule] = &[rule("sin(-a) = -sin(a)", "", |g, a, _| {
    let a = negated(g, a)?;
    let sine = g.unary(Unary::Sin, a);
    Some(g.neg(sine))
})];

const COS: &[Rule] = &[rule("cos(-a) = cos(a)", "", |g, a, _| {
    let a = negated(g, a)?;
    Some(g.unary(Unary::Cos, a))
})];

/// Simplifies `a op b`, if a rule applies.
pub(super) fn simplify_binary(g: &mut Graph, operator: Operator, a: ExprId, b: ExprId) -> Option<ExprId> {
    if let (Some(x), Some(y)) = (g.number(a), g.number(b)) {
        let number = combined(operator, x, y);
        if number.value.is_finite() {
            return Some(g.computed(number));
        }
    }
    let rules = match operator {
        Operator::Add => ADD,
        Operator::Subtract => SUBTRACT,
        Operator::Multiply => MULTIPLY,
        Operator::Divide => DIVIDE,
        Operator::Power | Operator::Atan2 => &[],
    };
    rules.iter().find_map(|rule| (rule.apply)(g, a, b))
}

/// Simplifies a unary operator, if a rule applies.
pub(super) fn simplify_unary(g: &mut Graph, operator: Unary, a: ExprId) -> Option<ExprId> {
    if let Some(x) = g.number(a) {
        let number = folded(operator, x);
        if number.value.is_finite() {
            return Some(g.computed(number));
        }
    }
    let rules = match operator {
        Unary::Negate => NEGATE,
        Unary::Sin => SIN,
        Unary::Cos => COS,
        Unary::PowerInteger(exponent) => return small_power(g, a, exponent),
        _ => &[],
    };
    rules.iter().find_map(|rule| (rule.apply)(g, a, a))
}

/// Powers from -4 to 4 as products.
fn small_power(g: &mut Graph, a: ExprId, exponent: i32) -> Option<ExprId> {
    match exponent {
        0 => Some(g.constant(1.0)),
        1 => Some(a),
        2 => Some(g.mul(a, a)),
        3 => {
            let square = g.mul(a, a);
            Some(g.mul(square, a))
        }
        4 => {
            let square = g.mul(a, a);
            Some(g.mul(square, square))
        }
        -4..=-1 => {
            let power = small_power(g, a, -exponent)?;
            let one = g.constant(1.0);
            Some(g.div(one, power))
        }
        _ => None,
    }
}

/// `x` if the node is `-x`, or `c` if it is the negative constant `-c`.
fn negated(g: &mut Graph, a: ExprId) -> Option<ExprId> {
    match g.node(a) {
        Node::Unary(Unary::Negate, x) => Some(x),
        _ => {
            let number = g.number(a).filter(|number| number.value < 0.0)?;
            let positive = folded(Unary::Negate, number);
            Some(g.computed(positive))
        }
    }
}

fn sum(g: &Graph, a: ExprId) -> Option<(ExprId, ExprId)> {
    operands(g, a, Operator::Add)
}

fn difference(g: &Graph, a: ExprId) -> Option<(ExprId, ExprId)> {
    operands(g, a, Operator::Subtract)
}

fn product(g: &Graph, a: ExprId) -> Option<(ExprId, ExprId)> {
    operands(g, a, Operator::Multiply)
}

fn quotient(g: &Graph, a: ExprId) -> Option<(ExprId, ExprId)> {
    operands(g, a, Operator::Divide)
}

fn operands(g: &Graph, a: ExprId, wanted: Operator) -> Option<(ExprId, ExprId)> {
    match g.node(a) {
        Node::Binary(operator, x, y) if operator == wanted => Some((x, y)),
        _ => None,
    }
}

/// The node as a constant times a node: `(c, x)` of `c x`, or `(1, a)`.
fn scaled(g: &Graph, a: ExprId) -> (Evaluation, ExprId) {
    match product(g, a) {
        Some((x, y)) => match (g.number(x), g.number(y)) {
            (Some(c), _) => (c, y),
            (_, Some(c)) => (c, x),
            _ => (Evaluation::ONE, a),
        },
        None => (Evaluation::ONE, a),
    }
}

fn times(g: &mut Graph, factor: Evaluation, a: ExprId) -> ExprId {
    let factor = g.computed(factor);
    g.mul(factor, a)
}

/// The node whose square is `a`.
fn square(g: &Graph, a: ExprId) -> Option<Node> {
    product(g, a).filter(|(x, y)| x == y).map(|(x, _)| g.node(x))
}
