//! What there is to see: bodies with their solids, joints, points, links, wheels.
//!
//! Only bodies have a place in the common frame, their pose; all else is fixed in one of them or in the ground. To show another
//! state of the same mechanism it is enough to exchange the poses.

use crate::Text;

/// A mechanism at one state. Lengths m, masses kg.
///
/// The common frame is that of the ground at the instant at which all running coordinates (driven and coasting ones) are zero.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Scene {
    /// The bodies, in the order of declaration.
    pub bodies: Vec<Body>,
    /// The joints, in the order of declaration.
    pub joints: Vec<Joint>,
    /// The declared points, in the order of declaration.
    pub points: Vec<Point>,
    /// Forces and constraints between two points.
    pub links: Vec<Link>,
    /// What rolls.
    pub wheels: Vec<Wheel>,
    /// What acts and what binds, in words: gravity, drives, forces, constraints, curves.
    pub elements: Vec<Element>,
    /// Acceleration of gravity in the common frame, m/s^2; `None` where none is declared, or where it is zero.
    pub gravity: Option<[f64; 3]>,
    /// The least box along the axes of the common frame that holds everything: its two opposite corners.
    pub bounds: [[f64; 3]; 2],
}

impl Scene {
    /// Diagonal of [`Scene::bounds`], m.
    #[must_use]
    pub fn size(&self) -> f64 {
        let [low, high] = self.bounds;
        let squares = low.iter().zip(high).map(|(low, high)| (high - low).powi(2));
        squares.sum::<f64>().sqrt()
    }

    /// Which way is up, a unit vector in the common frame: against gravity. Without gravity it is the axis of the first driven joint on
    /// the ground, since most machines turn about their long axis or stand on it, and without such a joint z. An axis has two
    /// directions: the one whose largest component is positive is taken.
    #[must_use]
    pub fn up(&self) -> [f64; 3] {
        if let Some(gravity) = self.gravity {
            let size = gravity.iter().fold(0.0_f64, |size, own| size.hypot(*own));
            return gravity.map(|own| -own / size + 0.0);
        }
        let on_ground = |joint: &&Joint| joint.driven && joint.from.body.is_none();
        let driven = self.joints.iter().find(on_ground);
        let axis = driven
            .and_then(|joint| joint.from.axis)
            .unwrap_or([0.0, 0.0, 1.0]);
        let largest = axis.into_iter().max_by(|a, b| a.abs().total_cmp(&b.abs()));
        let sign = if largest.is_some_and(|own| own < 0.0) {
            -1.0
        } else {
            1.0
        };
        axis.map(|own| sign * own + 0.0)
    }

    /// A place of a body, or of the ground, in the common frame.
    #[must_use]
    pub fn place(&self, body: Option<usize>, place: [f64; 3]) -> [f64; 3] {
        match body.and_then(|body| self.bodies.get(body)) {
            Some(body) => body.pose.place(place),
            None => place,
        }
    }
}

/// Where a frame is: the common frame sees its vector `r` at `position + rotation r`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Pose {
    /// Origin in the common frame.
    pub position: [f64; 3],
    /// Rows of the rotation matrix; its columns are the axes of the frame.
    pub rotation: [[f64; 3]; 3],
}

impl Pose {
    /// A place of the frame in the common frame.
    #[must_use]
    pub fn place(&self, place: [f64; 3]) -> [f64; 3] {
        let turned = self.direction(place);
        core::array::from_fn(|i| self.position[i] + turned[i])
    }

    /// A direction of the frame in the common frame.
    #[must_use]
    pub fn direction(&self, direction: [f64; 3]) -> [f64; 3] {
        self.rotation
            .map(|row| row.iter().zip(direction).map(|(r, d)| r * d).sum())
    }
}

/// A body.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Body {
    /// Declared name.
    pub name: Text,
    /// Where it is.
    pub pose: Pose,
    /// What its mass is made of; nothing when massless.
    pub solids: Vec<Solid>,
}

/// A piece of a body's mass, in the frame of the body.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Solid {
    /// Its centre of mass.
    pub center: [f64; 3],
    /// What it looks like.
    pub shape: Shape,
    /// The piece is missing from the others.
    pub hole: bool,
}

/// Shapes of solids, directions as unit vectors in the frame of the body.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Shape {
    /// A point mass.
    Point {
        /// Mass, kg.
        mass: f64,
    },
    /// A slender bar.
    Rod {
        /// Its direction.
        along: [f64; 3],
        /// m.
        length: f64,
    },
    /// A thin disk.
    Disk {
        /// Its axis.
        axis: [f64; 3],
        /// m.
        radius: f64,
    },
    /// A solid cylinder.
    Cylinder {
        /// Its axis.
        axis: [f64; 3],
        /// m.
        radius: f64,
        /// m.
        length: f64,
    },
    /// A cylinder with a coaxial bore.
    Tube {
        /// Its axis.
        axis: [f64; 3],
        /// Radius of the bore, m.
        inner: f64,
        /// Radius of the outside, m.
        outer: f64,
        /// m.
        length: f64,
    },
    /// A box.
    Box {
        /// Directions of its edges.
        edges: [[f64; 3]; 3],
        /// Lengths of its edges, m.
        size: [f64; 3],
    },
    /// A ball.
    Sphere {
        /// m.
        radius: f64,
    },
    /// The uniform solid ellipsoid of the mass and inertia of a body whose tensor is given; flat where no body has such an inertia.
    Ellipsoid {
        /// Directions of its semi-axes.
        axes: [[f64; 3]; 3],
        /// Lengths of its semi-axes, m.
        semi_axes: [f64; 3],
    },
}

/// A joint.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Joint {
    /// Declared name.
    pub name: Text,
    /// The word it was declared with, for example `revolute`.
    pub kind: Text,
    /// The side it was declared from; the axis is that of its first motion.
    pub from: Seat,
    /// The side it was declared to; the axis is that of its last motion.
    pub to: Seat,
    /// It closes a loop.
    pub closes_loop: bool,
    /// One of its motions runs at a prescribed speed.
    pub driven: bool,
}

/// One side of a joint.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Seat {
    /// Number of its body; `None` for the ground.
    pub body: Option<usize>,
    /// Its place in the frame of the body.
    pub place: [f64; 3],
    /// A unit vector in the frame of the body; `None` where nothing moves.
    pub axis: Option<[f64; 3]>,
}

/// A declared point.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Point {
    /// Declared name.
    pub name: Text,
    /// Number of its body; `None` for the ground.
    pub body: Option<usize>,
    /// Its place in the frame of the body.
    pub place: [f64; 3],
}

/// A force or a constraint between two points.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Link {
    /// Declared name.
    pub name: Text,
    /// The word it is declared with, for example `spring_damper`.
    pub kind: Text,
    /// Numbers of the points at its ends.
    pub ends: [usize; 2],
}

/// A wheel or a ball that rolls on a plane.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Wheel {
    /// Name of the constraint.
    pub name: Text,
    /// Number of the point at its centre.
    pub center: usize,
    /// Its axle, a unit vector in the frame of the body of its centre; `None` of a ball.
    pub axle: Option<[f64; 3]>,
    /// m.
    pub radius: f64,
    /// Number of the point in the plane.
    pub on: usize,
    /// Normal of the plane, a unit vector in the frame of the body of `on`.
    pub normal: [f64; 3],
}

/// Something that acts on the mechanism or binds it, as it was declared: gravity, a drive, a force, a constraint, a curve.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Element {
    /// Declared name.
    pub name: Text,
    /// The word it is declared with, for example `bushing`; `drive` of a driven coordinate.
    pub kind: Text,
    /// What it acts on and its law, without arguments that are zero, with numbers in SI: `on theta stiffness k rest 0.1`.
    pub law: Text,
}

/// A mode as poses along one period.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ModePictures {
    /// Number of the mode, counted from 0.
    pub mode: usize,
    /// Factor of the shape of the mode; zero where the mode moves no body.
    pub amplitude: f64,
    /// The poses of all bodies at evenly spaced phases, the first at phase 0.
    pub frames: Vec<Vec<Pose>>,
}
