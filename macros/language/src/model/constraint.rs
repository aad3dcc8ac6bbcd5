//! Constraints as declared, with names resolved.

use proc_macro2::Ident;

use super::expression::{Expr, Vector};
use super::unit::Unit;
use crate::base::ids::PointId;

/// A constraint.
#[derive(Clone, Debug)]
pub struct Constraint {
    /// Declared name.
    pub name: Ident,
    /// The condition that it imposes.
    pub law: ConstraintLaw,
}

/// Kinds of constraint.
#[derive(Clone, Debug, PartialEq)]
pub enum ConstraintLaw {
    /// Two points coincide, as seen along the chosen axes of `from`.
    Coincident {
        /// One point.
        from: PointId,
        /// The other.
        to: PointId,
        /// The selected axes x, y, z of `from`.
        along: [bool; 3],
    },
    /// The axes of two points agree.
    Aligned {
        /// One point.
        from: PointId,
        /// The other.
        to: PointId,
        /// The only direction that must agree, a unit vector in the axes of either point; all three axes if absent.
        axis: Option<Vector>,
    },
    /// Two points keep a distance.
    Distance {
        /// One end.
        from: PointId,
        /// The other end.
        to: PointId,
        /// m.
        length: Expr,
    },
    /// An expression of coordinates and points is zero. An expression of coordinates only may contain running ones (a
    /// gear); then its rate is zero.
    Equation {
        /// The expression.
        zero: Expr,
        /// Its SI unit.
        unit: Unit,
    },
    /// A wheel (a thin disk, or a ball) rolls without slip on a plane.
    Rolling {
        /// The centre of the wheel.
        wheel: PointId,
        /// The axle, a unit vector in the axes of `wheel`; if absent, the wheel is a ball.
        axis: Option<Vector>,
        /// m.
        radius: Expr,
        /// A point of the plane.
        on: PointId,
        /// The normal of the plane towards the wheel, a unit vector in the axes of `on`.
        normal: Vector,
    },
}
