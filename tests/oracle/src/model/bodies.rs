//! Bodies and their mass distributions.

use super::Placement;
use super::values::{Value, Values};

/// A rigid body.
#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    /// Declared name.
    pub name: String,
    /// Its pieces of mass; empty if massless.
    pub parts: Vec<Part>,
}

/// One piece of a body's mass.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    /// Subtract this piece from the others.
    pub hole: bool,
    /// Its mass distribution.
    pub shape: Shape,
    /// Frame of the piece in the body frame.
    pub placement: Placement,
}

impl Part {
    /// A piece placed at the body frame itself.
    pub fn whole(shape: Shape) -> Self {
        Self { hole: false, shape, placement: Placement::NONE }
    }
}

/// The amount of material in a shape.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Amount {
    /// Its mass.
    Mass(Value),
    /// Mass per volume, per area of a disk, or per length of a rod.
    Density(Value),
}

/// Mass distribution in the frame of its part. Directions need not be unit vectors.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// A point mass.
    Point {
        /// Mass.
        mass: Value,
        /// Position.
        center: Values,
    },
    /// A uniform slender bar.
    Rod {
        /// Mass or density.
        mass: Amount,
        /// Length.
        length: Value,
        /// Direction.
        along: [f64; 3],
        /// Centre of mass; if `None`, half the length along the bar.
        center: Option<Values>,
    },
    /// A uniform thin disk.
    Disk {
        /// Mass or density.
        mass: Amount,
        /// Radius.
        radius: Value,
        /// Direction of its axis.
        axis: [f64; 3],
        /// Centre of mass.
        center: Values,
    },
    /// A uniform solid cylinder.
    Cylinder {
        /// Mass or density.
        mass: Amount,
        /// Radius.
        radius: Value,
        /// Length.
        length: Value,
        /// Direction of its axis.
        axis: [f64; 3],
        /// Centre of mass.
        center: Values,
    },
    /// A uniform tube: a cylinder with a coaxial bore.
    Tube {
        /// Mass or density.
        mass: Amount,
        /// Radius of the bore.
        inner: Value,
        /// Radius of the outside.
        outer: Value,
        /// Length.
        length: Value,
        /// Direction of its axis.
        axis: [f64; 3],
        /// Centre of mass.
        center: Values,
    },
    /// A uniform solid box with edges along the axes of its frame.
    Cuboid {
        /// Mass or density.
        mass: Amount,
        /// Edge lengths.
        size: Values,
        /// Centre of mass.
        center: Values,
    },
    /// A uniform solid sphere.
    Sphere {
        /// Mass or density.
        mass: Amount,
        /// Radius.
        radius: Value,
        /// Centre of mass.
        center: Values,
    },
    /// Any rigid body.
    Rigid {
        /// Mass.
        mass: Value,
        /// Centre of mass.
        center: Values,
        /// Inertia tensor: xx, yy, zz, xy, yz, xz.
        inertia: [Value; 6],
        /// Reference point of the tensor; the centre of mass if `None`.
        about: Option<Values>,
    },
}
