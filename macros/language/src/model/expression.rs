//! Values as the user wrote them, with names resolved and units converted to SI.

use std::rc::Rc;

use rustc_hash::FxHashSet;

use crate::base::ids::{ConstantId, ConstraintId, CoordinateId, DesignId, ForceId, InputId, JointId, PointId};
pub use eigentol_symbolic::base::operators::Unary as Function;

/// A scalar value in SI; dimensions have been checked and are no longer stored.
#[derive(Clone, Debug, PartialEq)]
pub enum Expr {
    /// A number in SI.
    Number(f64),
    /// A design variable.
    Design(DesignId),
    /// An input.
    Input(InputId),
    /// A named constant.
    Constant(ConstantId),
    /// A joint coordinate (in force laws, constraints and outputs).
    Coordinate(CoordinateId),
    /// Rate of a joint coordinate (in force laws; in outputs only of a coasting one).
    Rate(CoordinateId),
    /// Component 0, 1 or 2 of a point's position in the ground frame (in force laws, constraints and outputs).
    Position(PointId, usize),
    /// Distance of the two points in a tension law.
    Length,
    /// Rate of the distance of the two points in a tension law.
    LengthRate,
    /// Component of the load that a joint transmits at rest (in outputs): 0 to 2 the force, 3 to 5 the moment at the
    /// joint, by the `from` side on the `to` side, in the axes of the joint frame on the `from` side.
    Reaction(JointId, usize),
    /// Component of the load that a constraint exerts at rest (in outputs). Coincident: 0 to 2 the force of `from` on
    /// `to`, in the axes of `from`. Aligned: 3 to 5 the moment of `from` on `to`, in the axes of `from`. Distance: 0
    /// the tension, positive if it pulls the ends together. Equation: 0 the generalised force in the direction in which
    /// the expression grows. Rolling: 0 to 2 the force of the plane on the wheel, forward (axle cross normal), sideways
    /// (normal cross forward) and along the normal; for a ball, forward is the axis of `on` farthest from the normal,
    /// made perpendicular to it, so that with z as the normal these are the components along x, y and z of `on`.
    ConstraintReaction(ConstraintId, usize),
    /// Component of what a force element exerts (in outputs). Bushing: 0 to 2 the force and 3 to 5 the moment of `from` on
    /// `to`, in the axes of `from`. Between two points along their line: 0 the tension.
    Exerted(ForceId, usize),
    /// Component of what a beam does at a point of it (in outputs), in the axes of the section before it was twisted: 0 to
    /// 2 twist rate and curvatures, 1/m; 3 to 5 the moment that the outer part exerts on the inner one, N m, due to these
    /// and, if the material lags, their rates; 6 to 8 stretch and the angles of shear; 9 to 11 the force that the outer
    /// part exerts on the inner one, N.
    Bent(PointId, usize),
    /// Kinetic energy in steady motion (in outputs).
    KineticEnergy,
    /// Energy of gravity, springs and potentials, zero at the ground's origin and at free lengths (in outputs).
    PotentialEnergy,
    /// `-a`.
    Negate(Rc<Expr>),
    /// `a + b`.
    Add(Rc<Expr>, Rc<Expr>),
    /// `a - b`.
    Subtract(Rc<Expr>, Rc<Expr>),
    /// `a * b`.
    Multiply(Rc<Expr>, Rc<Expr>),
    /// `a / b`.
    Divide(Rc<Expr>, Rc<Expr>),
    /// `a ^ n` with an integer exponent.
    PowerInteger(Rc<Expr>, i32),
    /// `a ^ b` with a positive base.
    Power(Rc<Expr>, Rc<Expr>),
    /// An elementary function of one argument; signs and integer powers have their own variants.
    Call(Function, Rc<Expr>),
    /// `atan2(y, x)`.
    Atan2(Rc<Expr>, Rc<Expr>),
}

impl Expr {
    /// The leaves; each repeated part is visited only once.
    pub fn leaves(&self) -> Vec<&Expr> {
        let mut leaves = Vec::new();
        let mut seen = FxHashSet::default();
        let mut waiting = vec![self];
        while let Some(expr) = waiting.pop() {
            if !seen.insert(std::ptr::from_ref(expr)) {
                continue;
            }
            match expr {
                Expr::Negate(a) | Expr::PowerInteger(a, _) | Expr::Call(_, a) => waiting.push(a),
                Expr::Add(a, b)
                | Expr::Subtract(a, b)
                | Expr::Multiply(a, b)
                | Expr::Divide(a, b)
                | Expr::Power(a, b)
                | Expr::Atan2(a, b) => waiting.extend([&**a, &**b]),
                leaf => leaves.push(leaf),
            }
        }
        leaves
    }
}

/// Three components.
pub type Vector = [Expr; 3];

/// Three rows.
pub type Matrix = [Vector; 3];
