//! Force elements and the expressions in them.

use super::curves::Curve;
use super::joints::Coordinate;
use super::values::{Matrix, Unit, Value, Values};

/// A named force element.
#[derive(Clone, Debug, PartialEq)]
pub struct Force {
    /// Declared name.
    pub name: String,
    /// The law.
    pub law: ForceLaw,
}

/// A scalar expression of the motion.
#[derive(Clone, Debug, PartialEq)]
pub enum Expr {
    /// A value and its unit.
    Value(Value, Unit),
    /// An input, by its index.
    Input(usize),
    /// A coordinate.
    Coordinate(Coordinate),
    /// Speed of a coordinate.
    Rate(Coordinate),
    /// Component 0, 1 or 2 in the ground of a point's position.
    Position(usize, usize),
    /// Distance of two points.
    Distance(usize, usize),
    /// Distance of the two points of a tension.
    Length,
    /// Its rate.
    LengthRate,
    /// Sum.
    Sum(Vec<Expr>),
    /// Product.
    Product(Vec<Expr>),
    /// Integer power.
    Power(Box<Expr>, i32),
    /// Sine.
    Sine(Box<Expr>),
    /// Cosine.
    Cosine(Box<Expr>),
    /// A curve, and what it is asked for.
    Curve(Curve, Box<Expr>),
}

impl Expr {
    /// A pure number.
    pub fn number(number: f64) -> Self {
        Self::Value(Value::Number(number), Unit::Of([0; 3]))
    }

    /// `factor * self`.
    pub fn times(self, factor: f64) -> Self {
        Self::Product(vec![Self::number(factor), self])
    }

    /// `self - other`.
    pub fn minus(self, other: Self) -> Self {
        Self::Sum(vec![self, other.times(-1.0)])
    }

    /// The curves in it, in order.
    pub fn curves(&self) -> Vec<&Curve> {
        match self {
            Self::Sum(parts) | Self::Product(parts) => {
                parts.iter().flat_map(Self::curves).collect()
            }
            Self::Power(part, _) | Self::Sine(part) | Self::Cosine(part) => part.curves(),
            Self::Curve(curve, part) => {
                let mut curves = part.curves();
                curves.push(curve);
                curves
            }
            _ => Vec::new(),
        }
    }

    /// Calls `visit` on every part that has no parts.
    pub fn leaves(&self, visit: &mut dyn FnMut(&Expr)) {
        match self {
            Self::Sum(parts) | Self::Product(parts) => {
                parts.iter().for_each(|part| part.leaves(visit));
            }
            Self::Power(part, _) | Self::Sine(part) | Self::Cosine(part) | Self::Curve(_, part) => {
                part.leaves(visit)
            }
            leaf => visit(leaf),
        }
    }
}

/// Force laws.
#[allow(
    clippy::large_enum_variant,
    reason = "a model has a handful of them, and numbers are copied"
)]
#[derive(Clone, Debug, PartialEq)]
pub enum ForceLaw {
    /// `-stiffness (q - rest)` on a coordinate.
    Spring {
        /// The coordinate.
        coordinate: Coordinate,
        /// Stiffness.
        stiffness: Value,
        /// Coordinate without force.
        rest: Value,
    },
    /// `-damping qdot` on a coordinate.
    Damper {
        /// The coordinate.
        coordinate: Coordinate,
        /// Damping.
        damping: Value,
    },
    /// Tension `stiffness (distance - length) + damping d(distance)/dt` between two points.
    SpringDamper {
        /// Index of one point.
        from: usize,
        /// Index of the other point.
        to: usize,
        /// Stiffness.
        stiffness: Value,
        /// Damping.
        damping: Value,
        /// Free length.
        length: Value,
    },
    /// Tension between two points by an expression of their distance and its rate.
    Tension {
        /// Index of one point.
        from: usize,
        /// Index of the other point.
        to: usize,
        /// Positive when it pulls.
        tension: Expr,
    },
    /// A generalised force on a coordinate.
    Generalized {
        /// The coordinate.
        coordinate: Coordinate,
        /// Positive along the coordinate.
        value: Expr,
    },
    /// Forces from a potential energy.
    Potential {
        /// Expression of coordinates and points.
        energy: Expr,
    },
    /// Elastic connection of two points with axes: along the axes of `from`, the force `-stiffness d - damping d'` and
    /// the moment `-turning_stiffness r - turning_damping r'` on `to`, and the opposite on the body of `from` at the
    /// place of `to`. `d` is where `to` is, `r` half the antisymmetric part of how it is turned; both as seen in `from`,
    /// rates too.
    Bushing {
        /// Index of one point.
        from: usize,
        /// Index of the other point.
        to: usize,
        /// Of displacements along x, y, z.
        stiffness: Matrix,
        /// Of their rates.
        damping: Matrix,
        /// Of rotations about x, y, z.
        turning_stiffness: Matrix,
        /// Of their rates.
        turning_damping: Matrix,
    },
    /// A force and a moment at a point.
    Load {
        /// Index of the point.
        point: usize,
        /// Force.
        force: Values,
        /// Moment.
        moment: Values,
        /// Along the axes of the point; else along those of the ground.
        following: bool,
    },
    /// Force `-damping v` and moment `-turning_damping omega` at a point, absolute velocities.
    Drag {
        /// Index of the point.
        point: usize,
        /// Of the velocity.
        damping: Value,
        /// Of the angular velocity.
        turning_damping: Value,
    },
}
