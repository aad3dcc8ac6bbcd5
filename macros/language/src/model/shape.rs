//! The shapes, and everything that later stages need from one: the values that must be positive, and its mass
//! distribution.
//!
//! # Shapes are reduced to a spread of mass
//!
//! Rules and `mechanics` see only which quantities of a shape must be positive, and how its mass is
//! spread about its centre: as a point, along a line, around an axis, over a box, as a ball or by a given tensor
//! (`model/shape.rs`). The oracle must learn new shapes too.

use std::rc::Rc;

use super::expression::{Expr, Vector};

/// A mass distribution in a frame. Directions are unit vectors; lengths are in m, masses in kg, inertias in kg m^2.
/// Densities have already been multiplied by the volume.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// A point mass.
    Point {
        /// Mass.
        mass: Expr,
        /// Position.
        center: Vector,
    },
    /// A uniform slender bar.
    Rod {
        /// Mass.
        mass: Expr,
        /// Length.
        length: Expr,
        /// Direction of the bar, a unit vector.
        along: Vector,
        /// Centre of mass; half the length along the bar from the origin of the frame unless given.
        center: Vector,
    },
    /// A uniform thin disk.
    Disk {
        /// Mass.
        mass: Expr,
        /// Radius.
        radius: Expr,
        /// Direction of its axis, a unit vector.
        axis: Vector,
        /// Centre of mass.
        center: Vector,
    },
    /// A uniform solid cylinder.
    Cylinder {
        /// Mass.
        mass: Expr,
        /// Radius.
        radius: Expr,
        /// Length.
        length: Expr,
        /// Direction of its axis, a unit vector.
        axis: Vector,
        /// Centre of mass.
        center: Vector,
    },
    /// A uniform tube: a cylinder with a coaxial bore.
    Tube {
        /// Mass.
        mass: Expr,
        /// Radius of the bore.
        inner: Expr,
        /// Outer radius.
        outer: Expr,
        /// Length.
        length: Expr,
        /// Direction of its axis, a unit vector.
        axis: Vector,
        /// Centre of mass.
        center: Vector,
    },
    /// A uniform solid box with edges along the axes of the frame.
    Cuboid {
        /// Mass.
        mass: Expr,
        /// Edge lengths.
        size: Vector,
        /// Centre of mass.
        center: Vector,
    },
    /// A uniform solid sphere.
    Sphere {
        /// Mass.
        mass: Expr,
        /// Radius.
        radius: Expr,
        /// Centre of mass.
        center: Vector,
    },
    /// Any rigid body.
    Rigid {
        /// Mass.
        mass: Expr,
        /// Centre of mass.
        center: Vector,
        /// Inertia tensor in the axes of the frame: xx, yy, zz, xy, yz, xz; the products are entries of the tensor,
        /// `Jxy = -integral x y dm`.
        inertia: [Expr; 6],
        /// The reference point of the inertia; the centre of mass unless given.
        about: Option<Vector>,
    },
}

/// A shape as later stages see it: they know only the kinds of [`Spread`], not the kinds of shape.
#[derive(Clone, Debug)]
pub struct Reduced<'a> {
    /// Mass.
    pub mass: &'a Expr,
    /// Centre of mass.
    pub center: &'a Vector,
    /// The distribution of the mass about its centre.
    pub spread: Spread<'a>,
    /// Quantities that must be positive besides the mass, with their names.
    pub positive: Vec<(&'static str, Expr)>,
}

/// The distribution of mass about its centre.
#[derive(Clone, Debug)]
pub enum Spread<'a> {
    /// Concentrated at the centre.
    Point,
    /// Evenly along a line.
    Line {
        /// Length.
        length: &'a Expr,
        /// Direction, a unit vector.
        along: &'a Vector,
    },
    /// Axially symmetric.
    Round {
        /// The axis, a unit vector.
        axis: &'a Vector,
        /// Mean square along any diameter.
        across: MeanSquare<'a>,
        /// Mean square along the axis.
        along: MeanSquare<'a>,
    },
    /// Evenly over a box.
    Box {
        /// Edge lengths along the axes of the frame.
        size: &'a Vector,
    },
    /// Equal in all directions.
    Ball(MeanSquare<'a>),
    /// Given by an inertia tensor, with entries as in [`Shape::Rigid`].
    Tensor {
        /// The tensor.
        inertia: &'a [Expr; 6],
        /// The reference point of the tensor; the centre of mass unless given.
        about: Option<&'a Vector>,
    },
}

/// The mean square distance from the centre in one direction: a sum of squared lengths, each with a factor.
pub type MeanSquare<'a> = Vec<(f64, &'a Expr)>;

impl Shape {
    /// The reduced form of each kind of shape.
    pub fn reduced(&self) -> Reduced<'_> {
        match self {
            Self::Point { mass, center } => Reduced { mass, center, spread: Spread::Point, positive: Vec::new() },
            Self::Rod { mass, length, along, center } => Reduced {
                mass,
                center,
                spread: Spread::Line { length, along },
                positive: vec![("length", length.clone())],
            },
            Self::Disk { mass, radius, axis, center } => Reduced {
                mass,
                center,
                spread: Spread::Round { axis, across: vec![(1.0 / 4.0, radius)], along: Vec::new() },
                positive: vec![("radius", radius.clone())],
            },
            Self::Cylinder { mass, radius, length, axis, center } => Reduced {
                mass,
                center,
                spread: Spread::Round { axis, across: vec![(1.0 / 4.0, radius)], along: vec![(1.0 / 12.0, length)] },
                positive: vec![("radius", radius.clone()), ("length", length.clone())],
            },
            Self::Tube { mass, inner, outer, length, axis, center } => Reduced {
                mass,
                center,
                spread: Spread::Round {
                    axis,
                    across: vec![(1.0 / 4.0, inner), (1.0 / 4.0, outer)],
                    along: vec![(1.0 / 12.0, length)],
                },
                positive: vec![
                    ("inner radius", inner.clone()),
                    ("length", length.clone()),
                    ("wall thickness", difference(outer, inner)),
                ],
            },
            Self::Cuboid { mass, size, center } => {
                let [x, y, z] = size.clone();
                Reduced {
                    mass,
                    center,
                    spread: Spread::Box { size },
                    positive: vec![("size along x", x), ("size along y", y), ("size along z", z)],
                }
            }
            Self::Sphere { mass, radius, center } => Reduced {
                mass,
                center,
                spread: Spread::Ball(vec![(1.0 / 5.0, radius)]),
                positive: vec![("radius", radius.clone())],
            },
            Self::Rigid { mass, center, inertia, about } => Reduced {
                mass,
                center,
                spread: Spread::Tensor { inertia, about: about.as_ref() },
                positive: Vec::new(),
            },
        }
    }
}

fn difference(a: &Expr, b: &Expr) -> Expr {
    Expr::Subtract(Rc::new(a.clone()), Rc::new(b.clone()))
}
