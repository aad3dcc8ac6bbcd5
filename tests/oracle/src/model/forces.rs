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
    /// Component 0, 1 or 2 of a point's position in the ground.
    Position(usize, usize),
    /// Distance of two points.
    Distance(usize, usize),
    /// Distance between the two points of a tension.
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
    /// A curve and its argument.
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

    /// The curves in the expression, in order.
    pub fn curves(&self) -> Vec<&Curve> {
        match self {
            Self::Sum(parts) | Self::Product(parts) => parts.iter().flat_map(Self::curves).collect(),
            Self::Power(part, _) | Self::Sine(part) | Self::Cosine(part) => part.curves(),
            Self::Curve(curve, part) => {
                let mut curves = part.curves();
                curves.push(curve);
                curves
            }
            _ => Vec::new(),
        }
    }

    /// Calls `visit` on every leaf.
    pub fn leaves(&self, visit: &mut dyn FnMut(&Expr)) {
        match self {
            Self::Sum(parts) | Self::Product(parts) => {
                parts.iter().for_each(|part| part.leaves(visit));
            }
            Self::Power(part, _) | Self::Sine(part) | Self::Cosine(part) | Self::Curve(_, part) => part.leaves(visit),
            leaf => visit(leaf),
        }
    }
}

/// Force laws.
#[allow(clippy::large_enum_variant, reason = "a model has a handful of them, and numbers are copied")]
#[derive(Clone, Debug, PartialEq)]
pub enum ForceLaw {
    /// `-stiffness (q - rest)` on a coordinate.
    Spring {
        /// The coordinate.
        coordinate: Coordinate,
        /// Stiffness.
        stiffness: Value,
        /// Coordinate at which the force is zero.
        rest: Value,
    },
    /// `-damping qdot` on a coordinate.
    Damper {
        /// The coordinate.
        coordinate: Coordinate,
        /// Damping.
        damping: Value,
    },
    /// `-inertance qddot` on a coordinate.
    Inerter {
        /// Coordinate.
        coordinate: Coordinate,
        /// Inertance.
        inertance: Value,
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
    /// Tension between two points, an expression of their distance and its rate.
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
    /// Elastic connection of two points with axes. It applies, along the axes of `from`, the force
    /// `-stiffness d - damping d'` and the moment `-turning_stiffness r - turning_damping r'` to `to`, and the opposite
    /// to the body of `from` at the position of `to`. `d` is the position of `to`, `r` the axial vector of the
    /// antisymmetric part of its rotation matrix; both, and their rates, are measured in `from`.
    Bushing {
        /// Index of one point.
        from: usize,
        /// Index of the other point.
        to: usize,
        /// Stiffness for displacements along x, y, z.
        stiffness: Matrix,
        /// Damping for their rates.
        damping: Matrix,
        /// Stiffness for rotations about x, y, z.
        turning_stiffness: Matrix,
        /// Damping for their rates.
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
        /// Components along the axes of the point if true, of the ground otherwise.
        following: bool,
    },
    /// Force `-damping v` and moment `-turning_damping omega` at a point, proportional to absolute velocities.
    Drag {
        /// Index of the point.
        point: usize,
        /// Damping of the velocity.
        damping: Value,
        /// Damping of the angular velocity.
        turning_damping: Value,
    },
}
