//! Forward differentiation: the derivative of many expressions along one direction.

use super::graph::Graph;
use super::node::Node;
use super::node_map::NodeMap;
use super::reached::Reached;
use crate::base::ids::{ExprId, SymbolId};
use crate::base::operators::{Operator, Unary};

/// A direction in the space of symbols: each listed symbol changes at the given rate, the others are constant.
#[derive(Clone, Debug, Default)]
pub struct Direction {
    rates: Vec<(SymbolId, ExprId)>,
    suffix: String,
    /// Whether it is that of one symbol, along which the derivatives that nodes have been given are short.
    is_unit: bool,
}

impl Direction {
    /// A direction; `suffix` is appended to the names of differentiated nodes.
    pub fn new(suffix: impl Into<String>, rates: Vec<(SymbolId, ExprId)>) -> Self {
        Self { rates, suffix: suffix.into(), is_unit: false }
    }

    /// The direction of one symbol.
    pub fn unit(graph: &mut Graph, symbol: SymbolId) -> Self {
        let one = graph.constant(1.0);
        let suffix = format!("_by_{}", graph.symbol_info(symbol).name);
        Self { is_unit: true, ..Self::new(suffix, vec![(symbol, one)]) }
    }

    fn rate(&self, symbol: SymbolId) -> Option<ExprId> {
        self.rates.iter().find(|(s, _)| *s == symbol).map(|(_, rate)| *rate)
    }
}

/// Derivatives of `roots` along `direction`.
pub fn derivatives_along(graph: &mut Graph, roots: &[ExprId], direction: &Direction) -> Vec<ExprId> {
    let mask = Graph::mask(direction.rates.iter().map(|(symbol, _)| *symbol));
    let zero = graph.zero();
    let known = graph.len();
    let changing = Reached::dependent(graph, roots, mask);
    let mut tangents = NodeMap::new(&changing);
    for &id in changing.nodes() {
        if direction.is_unit
            && let Some(slopes) = changing.slopes(graph, id, mask)
        {
            let mut tangent = zero;
            for &(by, slope) in slopes.iter() {
                let share = graph.mul(slope, tangents.get(by).unwrap_or(zero));
                tangent = graph.add(tangent, share);
            }
            tangents.set(id, tangent);
            continue;
        }
        let tangent = match graph.node(id) {
            Node::Constant(_) => zero,
            Node::Symbol(symbol) => direction.rate(symbol).unwrap_or(zero),
            Node::Unary(operator, a) => {
                let da = tangents.get(a).unwrap_or(zero);
                if da == zero { zero } else { unary_tangent(graph, operator, id, a, da) }
            }
            Node::Binary(operator, a, b) => match [a, b].map(|operand| tangents.get(operand).unwrap_or(zero)) {
                [da, db] if da == zero && db == zero => zero,
                [da, db] => binary_tangent(graph, operator, id, (a, da), (b, db)),
            },
        };
        // Nodes that existed before have a meaning of their own.
        if tangent.index() >= known && graph.name(id).is_some() {
            let name = format!("{}{}", graph.name(id).unwrap_or_default(), direction.suffix);
            graph.set_name(tangent, || name);
        }
        tangents.set(id, tangent);
    }
    roots.iter().map(|&root| tangents.get(root).unwrap_or(zero)).collect()
}

fn unary_tangent(g: &mut Graph, operator: Unary, id: ExprId, a: ExprId, da: ExprId) -> ExprId {
    let slope = slope(g, operator, id, a);
    g.mul(slope, da)
}

/// Derivative of `operator a` by `a`, where `id` is the node itself.
pub(super) fn slope(g: &mut Graph, operator: Unary, id: ExprId, a: ExprId) -> ExprId {
    let one = g.constant(1.0);
    match operator {
        Unary::Negate => g.constant(-1.0),
        Unary::Sqrt => {
            let half = g.constant(0.5);
            g.div(half, id)
        }
        Unary::Sin => g.unary(Unary::Cos, a),
        Unary::Cos => {
            let sine = g.unary(Unary::Sin, a);
            g.neg(sine)
        }
        Unary::Tan => {
            let square = g.mul(id, id);
            g.add(one, square)
        }
        Unary::Asin | Unary::Acos => {
            let square = g.mul(a, a);
            let rest = g.sub(one, square);
            let root = g.unary(Unary::Sqrt, rest);
            let slope = g.div(one, root);
            if operator == Unary::Asin { slope } else { g.neg(slope) }
        }
        Unary::Exp => id,
        Unary::Ln => g.div(one, a),
        Unary::PowerInteger(n) => {
            let power = g.unary(Unary::PowerInteger(n - 1), a);
            g.scale(f64::from(n), power)
        }
        Unary::Spline(spline, derivative) if spline.vanishes(derivative + 1) => g.zero(),
        Unary::Spline(spline, derivative) => g.unary(Unary::Spline(spline, derivative + 1), a),
    }
}

fn binary_tangent(
    g: &mut Graph,
    operator: Operator,
    id: ExprId,
    (a, da): (ExprId, ExprId),
    (b, db): (ExprId, ExprId),
) -> ExprId {
    match operator {
        Operator::Add => g.add(da, db),
        Operator::Subtract => g.sub(da, db),
        Operator::Multiply => {
            let left = g.mul(da, b);
            let right = g.mul(a, db);
            g.add(left, right)
        }
        Operator::Divide => {
            let change = g.mul(id, db);
            let rest = g.sub(da, change);
            g.div(rest, b)
        }
        Operator::Power | Operator::Atan2 => {
            let (by_a, by_b) = slopes(g, operator, id, a, b);
            let left = if g.is(da, 0.0) { da } else { g.mul(by_a, da) };
            let right = if g.is(db, 0.0) { db } else { g.mul(by_b, db) };
            g.add(left, right)
        }
    }
}

/// Derivatives of `a operator b` by `a` and by `b`, where `id` is the node itself.
pub(super) fn slopes(g: &mut Graph, operator: Operator, id: ExprId, a: ExprId, b: ExprId) -> (ExprId, ExprId) {
    let one = g.constant(1.0);
    match operator {
        Operator::Add => (one, one),
        Operator::Subtract => (one, g.constant(-1.0)),
        Operator::Multiply => (b, a),
        Operator::Divide => {
            let by_a = g.div(one, b);
            let by_b = g.mul(id, by_a);
            (by_a, g.neg(by_b))
        }
        Operator::Power => {
            let reduced = g.sub(b, one);
            let power = g.binary(Operator::Power, a, reduced);
            let by_a = g.mul(b, power);
            let ln = g.unary(Unary::Ln, a);
            (by_a, g.mul(id, ln))
        }
        Operator::Atan2 => {
            let (aa, bb) = (g.mul(a, a), g.mul(b, b));
            let square = g.add(aa, bb);
            let by_a = g.div(b, square);
            let by_b = g.div(a, square);
            (by_a, g.neg(by_b))
        }
    }
}
