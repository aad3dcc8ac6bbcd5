//! Translates values of the declaration to expressions of the graph.

use rustc_hash::FxHashMap;

use crate::algebra::{ExprId, Graph, Matrix3, Operator, Unary, Vector3};
use crate::base::ids::ConstantId;
use crate::model::expression::{Expr, Matrix, Vector};
use crate::model::mechanism::{Mechanism, Placement};

use super::symbols::Symbols;

/// Translates values. Anything that depends on the position of the mechanism is looked up in a [`State`].
pub(crate) struct Values<'a> {
    symbols: &'a Symbols,
    constants: Vec<ExprId>,
}

/// State-dependent quantities that a value may refer to. The resolver has checked that a value refers only to
/// quantities that are available at its place, so the default is never reached.
pub(crate) trait State {
    /// A leaf of a value: a coordinate, a rate, a point, a length, a reaction or an energy.
    fn leaf(&self, leaf: &Expr) -> ExprId {
        unreachable!("resolution admits {leaf:?} elsewhere only")
    }
}

/// No state: for values that depend only on inputs and design.
struct Stateless;

impl State for Stateless {}

impl<'a> Values<'a> {
    /// Translates the named constants once; each uses only earlier ones.
    pub(crate) fn new(g: &mut Graph, mechanism: &Mechanism, symbols: &'a Symbols) -> Self {
        let mut values = Self { symbols, constants: Vec::new() };
        for constant in &mechanism.constants {
            let value = values.scalar(g, &constant.value);
            g.set_name(value, || constant.name.to_string());
            values.constants.push(value);
        }
        values
    }

    /// A scalar that depends only on inputs and design.
    pub(crate) fn scalar(&self, g: &mut Graph, value: &Expr) -> ExprId {
        self.scalar_at(g, value, &Stateless)
    }

    /// A vector that depends only on inputs and design.
    pub(crate) fn vector(&self, g: &mut Graph, value: &Vector) -> Vector3 {
        Vector3(std::array::from_fn(|i| self.scalar(g, &value[i])))
    }

    /// The rows of a matrix that depends only on inputs and design.
    pub(crate) fn matrix(&self, g: &mut Graph, value: &Matrix) -> [Vector3; 3] {
        std::array::from_fn(|i| self.vector(g, &value[i]))
    }

    /// A placement as offset and rotation; `None` if there is no rotation.
    pub(crate) fn placement(&self, g: &mut Graph, placement: &Placement) -> (Vector3, Option<Matrix3>) {
        let offset = self.vector(g, &placement.offset);
        let mut rotation: Option<Matrix3> = None;
        for (axis, angle) in &placement.rotations {
            let (axis, angle) = (self.vector(g, axis), self.scalar(g, angle));
            let next = Matrix3::rotation(g, axis, angle);
            rotation = Some(match rotation {
                Some(so_far) => so_far.multiply(g, next),
                None => next,
            });
        }
        (offset, rotation)
    }

    /// A scalar that may depend on the position of the mechanism.
    pub(crate) fn scalar_at(&self, g: &mut Graph, value: &Expr, state: &impl State) -> ExprId {
        self.shared(g, value, state, &mut FxHashMap::default())
    }

    /// Translates an expression. Repeated parts, such as the components of a cross product, are translated once:
    /// `known` holds them by address.
    fn shared(
        &self,
        g: &mut Graph,
        value: &Expr,
        state: &impl State,
        known: &mut FxHashMap<*const Expr, ExprId>,
    ) -> ExprId {
        let address = std::ptr::from_ref(value);
        if let Some(&id) = known.get(&address) {
            return id;
        }
        let mut part = |g: &mut Graph, part: &Expr| self.shared(g, part, state, known);
        let mut binary = |g: &mut Graph, operator, a: &Expr, b: &Expr| {
            let (a, b) = (part(g, a), part(g, b));
            g.binary(operator, a, b)
        };
        let id = match value {
            Expr::Number(value) => g.constant(*value),
            Expr::Design(id) => self.symbols.b.values[id.index()],
            Expr::Input(id) => self.symbols.u.values[id.index()],
            Expr::Constant(id) => self.constant(*id),
            Expr::Coordinate(_)
            | Expr::Rate(_)
            | Expr::Position(..)
            | Expr::Length
            | Expr::LengthRate
            | Expr::Reaction(..)
            | Expr::ConstraintReaction(..)
            | Expr::Exerted(..)
            | Expr::Bent(..)
            | Expr::KineticEnergy
            | Expr::PotentialEnergy => state.leaf(value),
            Expr::Add(a, b) => binary(g, Operator::Add, a, b),
            Expr::Subtract(a, b) => binary(g, Operator::Subtract, a, b),
            Expr::Multiply(a, b) => binary(g, Operator::Multiply, a, b),
            Expr::Divide(a, b) => binary(g, Operator::Divide, a, b),
            Expr::Power(a, b) => binary(g, Operator::Power, a, b),
            Expr::Atan2(a, b) => binary(g, Operator::Atan2, a, b),
            Expr::Negate(a) => {
                let a = part(g, a);
                g.unary(Unary::Negate, a)
            }
            Expr::PowerInteger(a, n) => {
                let a = part(g, a);
                g.unary(Unary::PowerInteger(*n), a)
            }
            Expr::Call(function, a) => {
                let a = part(g, a);
                g.unary(*function, a)
            }
        };
        known.insert(address, id);
        id
    }

    fn constant(&self, id: ConstantId) -> ExprId {
        self.constants[id.index()]
    }
}
