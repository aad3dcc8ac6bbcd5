//! What rounding may have added to a value, by measurement.
//!
//! To first order, the rounding error of a value is `sum g_i d_i` over the operations on the way to it, with `|d_i| <= u`,
//! the unit roundoff: at most `sqrt(N) |g| u` for `N` operations. Here the value is computed again with every result
//! disturbed by a share between -1 and 1 of `AMPLITUDE`, drawn at random. Its change is `AMPLITUDE sum g_i xi_i`, with the
//! mean square `(AMPLITUDE |g|)^2 / 3`, and the largest of several changes is rarely far below that (N. J. Higham and
//! T. Mary, "A new approach to probabilistic rounding error analysis", 2019; J. Vignes, "Discrete stochastic arithmetic",
//! 2004). A bound carried along from operation to operation is no substitute: in a chain of bodies it grows by a constant
//! factor per body, because it does not know that what a rotation takes from one component it gives to another.

use std::ops::{Add, Div, Mul, Neg, Sub};

use super::evaluation::{UNIT_ROUNDOFF, rounding_of};
use super::graph::Graph;
use super::node::Node;
use super::reached::Reached;
use crate::base::ids::{ExprId, SymbolId};

/// How often a value is computed: once as it is, then disturbed.
const LANES: usize = 8;

/// Largest disturbance, relative to a result: far above rounding, and far below what a root or an arc changes sharply at.
const AMPLITUDE: f64 = 512.0 * UNIT_ROUNDOFF;

/// By how much the largest change may fail to show what rounding adds.
const MARGIN: f64 = 8.0;

/// A value, first as it is, then computed with every operation on the way disturbed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Disturbed([f64; LANES]);

impl Disturbed {
    /// The value.
    pub fn value(&self) -> f64 {
        self.0[0]
    }

    /// A number without rounding.
    pub fn exact(value: f64) -> Self {
        Self([value; LANES])
    }

    /// A number that rounding has changed by at most `rounding`. `seed` chooses the disturbances.
    pub fn rounded(value: f64, rounding: f64, seed: u64) -> Self {
        Self([value; LANES]).disturbed(rounding, seed)
    }

    /// The value in another unit, a power of two.
    #[must_use]
    pub fn scaled(self, factor: f64) -> Self {
        Self(self.0.map(|lane| lane * factor))
    }

    /// Whether it is exactly zero, disturbed or not.
    pub fn is_zero(&self) -> bool {
        self.0.iter().all(|lane| *lane == 0.0)
    }

    /// The result of an operation that adds at most `rounding`.
    fn disturbed(mut self, rounding: f64, seed: u64) -> Self {
        if rounding != 0.0 {
            let amount = rounding * (AMPLITUDE / UNIT_ROUNDOFF);
            for (lane, share) in self.0.iter_mut().zip(shares(seed)) {
                *lane += amount * share;
            }
        }
        self
    }

    /// The result of an operation on two values, rounded.
    fn of(a: Self, b: Self, operation: impl Fn(f64, f64) -> f64) -> Self {
        let result = Self(std::array::from_fn(|k| operation(a.0[k], b.0[k])));
        let value = result.value();
        result.disturbed(UNIT_ROUNDOFF * value.abs(), value.to_bits())
    }

    /// Whether it is finite, disturbed or not.
    pub fn is_finite(&self) -> bool {
        self.0.iter().all(|lane| lane.is_finite())
    }

    /// What rounding may have added in a computation of that many operations.
    pub fn rounding(&self, operations: usize) -> f64 {
        let most = self.0.iter().map(|lane| (lane - self.value()).abs()).fold(0.0, f64::max);
        MARGIN * (operations as f64).sqrt() * UNIT_ROUNDOFF / AMPLITUDE * most
    }

    /// Whether rounding alone can explain that the value is not zero.
    pub fn is_rounding(&self, operations: usize) -> bool {
        self.value().abs() <= self.rounding(operations)
    }
}

/// Some expressions, to be evaluated at several states.
pub struct Evaluator<'a> {
    graph: &'a Graph,
    roots: &'a [ExprId],
    part: Reached,
}

impl<'a> Evaluator<'a> {
    /// An evaluator of `roots`.
    pub fn new(graph: &'a Graph, roots: &'a [ExprId]) -> Self {
        let part = Reached::below(graph, roots);
        Self { graph, roots, part }
    }

    /// Number of operations in one evaluation.
    pub fn operations(&self) -> usize {
        self.part.len()
    }

    /// Values of the expressions. `seed` chooses the disturbances.
    pub fn at(&self, seed: u64, symbol: impl Fn(SymbolId) -> Disturbed) -> Vec<Disturbed> {
        let mut values: Vec<[f64; LANES]> = Vec::with_capacity(self.part.len());
        let read = |values: &[[f64; LANES]], id: ExprId| match self.part.place(id) {
            Some(index) => values[index],
            None => unreachable!("operands are among the nodes below the roots"),
        };
        for &id in self.part.nodes() {
            let (lanes, rounding) = match self.graph.node(id) {
                Node::Symbol(s) => (symbol(s).0, 0.0),
                Node::Constant(bits) => {
                    let value = f64::from_bits(bits);
                    let rounding = self.graph.number(id).map_or(0.0, |number| number.error);
                    ([value; LANES], rounding)
                }
                Node::Unary(operator, a) => {
                    let a = read(&values, a);
                    let lanes = a.map(|a| operator.apply(a));
                    (lanes, rounding_of(operator, a[0], lanes[0]))
                }
                Node::Binary(operator, a, b) => {
                    let (a, b) = (read(&values, a), read(&values, b));
                    let lanes = std::array::from_fn(|k| operator.apply(a[k], b[k]));
                    (lanes, UNIT_ROUNDOFF * f64::abs(lanes[0]))
                }
            };
            let Disturbed(lanes) = Disturbed(lanes).disturbed(rounding, seed << 32 | u64::from(id.0));
            values.push(lanes);
        }
        self.roots.iter().map(|&root: &ExprId| Disturbed(read(&values, root))).collect()
    }
}

/// Shares between -1 and 1 that depend only on the seed (SplitMix64); the first is zero.
fn shares(seed: u64) -> [f64; LANES] {
    let mut x = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15);
    x = (x ^ x >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    x = (x ^ x >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
    let bytes = (x ^ x >> 31).to_le_bytes();
    std::array::from_fn(|k| match k {
        0 => 0.0,
        _ => f64::from(bytes[k] as i8) / 128.0,
    })
}

impl Add for Disturbed {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self::of(self, other, |a, b| a + b)
    }
}

impl Sub for Disturbed {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Self::of(self, other, |a, b| a - b)
    }
}

impl Mul for Disturbed {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        Self::of(self, other, |a, b| a * b)
    }
}

impl Div for Disturbed {
    type Output = Self;

    fn div(self, other: Self) -> Self {
        Self::of(self, other, |a, b| a / b)
    }
}

impl Neg for Disturbed {
    type Output = Self;

    fn neg(self) -> Self {
        Self(self.0.map(|lane| -lane))
    }
}
