//! The contents of a picture: bodies with their solids, beams, joints, points, links and wheels.
//!
//! Only bodies and the sections of beams have a pose in the common frame; everything else is fixed to a body or to the
//! ground. To show another state of the same mechanism, only the poses need to be replaced.

use crate::Text;

/// The kind of the joints between the ground and the stations of shafts and superelements.
const STATION: &str = "station";

/// A mechanism at one state. Lengths m, masses kg.
///
/// The common frame is the ground's, at the instant when all running coordinates (driven and coasting ones) are zero.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Scene {
    /// The bodies, in declaration order.
    pub bodies: Vec<Body>,
    /// The beams, in declaration order, then the shafts.
    pub beams: Vec<Beam>,
    /// The joints, in declaration order.
    pub joints: Vec<Joint>,
    /// The declared points, in declaration order.
    pub points: Vec<Point>,
    /// Forces and constraints between two points.
    pub links: Vec<Link>,
    /// Rolling wheels and balls.
    pub wheels: Vec<Wheel>,
    /// Loads and constraints in words: gravity, drives, forces, constraints, curves.
    pub elements: Vec<Element>,
    /// Acceleration of gravity in the common frame, m/s^2; `None` if undeclared or zero.
    pub gravity: Option<[f64; 3]>,
    /// Two opposite corners of the smallest box along the axes of the common frame that contains everything.
    pub bounds: [[f64; 3]; 2],
}

impl Scene {
    /// Diagonal of [`Scene::bounds`], m.
    #[must_use]
    pub fn size(&self) -> f64 {
        let [low, high] = self.bounds;
        low.iter().zip(high).map(|(low, high)| (high - low).powi(2)).sum::<f64>().sqrt()
    }

    /// The upward direction, a unit vector in the common frame: against gravity.
    ///
    /// Without gravity it is the axis of the first driven joint on the ground, since most machines turn about their
    /// long axis or stand on it; without such a joint it is z. Of the two directions of an axis, the one whose largest
    /// component is positive is used.
    #[must_use]
    pub fn up(&self) -> [f64; 3] {
        if let Some(gravity) = self.gravity {
            let size = gravity.iter().fold(0.0_f64, |size, x| size.hypot(*x));
            return gravity.map(|component| -component / size + 0.0);
        }
        let on_ground = |joint: &&Joint| joint.driven && joint.from.body.is_none();
        let axis = self.joints.iter().find(on_ground).and_then(|joint| joint.from.axis).unwrap_or([0.0, 0.0, 1.0]);
        let largest = axis.into_iter().max_by(|a, b| a.abs().total_cmp(&b.abs()));
        let sign = if largest.is_some_and(|largest| largest < 0.0) { -1.0 } else { 1.0 };
        axis.map(|component| sign * component + 0.0)
    }

    /// Whether a body is the root or a station of a beam or a shaft: a frame of a section, which the beam shows.
    #[must_use]
    pub fn is_of_beam(&self, body: usize) -> bool {
        let mut flexures = self.joints.iter().filter(|joint| joint.is_flexure());
        let is_bare = self.bodies.get(body).is_some_and(|body| body.solids.is_empty());
        is_bare && flexures.any(|joint| [joint.from.body, joint.to.body].contains(&Some(body)))
    }

    /// Whether a beam is a shaft, whose first station carries its name.
    #[must_use]
    pub fn is_shaft(&self, beam: &Beam) -> bool {
        self.joints.iter().any(|joint| &*joint.kind == STATION && joint.name == beam.name)
    }

    /// The number of poses: of all bodies, then of the sections of all beams.
    #[must_use]
    pub fn poses(&self) -> usize {
        self.bodies.len() + self.beams.iter().map(|beam| beam.sections.len()).sum::<usize>()
    }

    /// Transforms a place on a body, or on the ground, to the common frame.
    #[must_use]
    pub fn place(&self, body: Option<usize>, point: [f64; 3]) -> [f64; 3] {
        match body.and_then(|body| self.bodies.get(body)) {
            Some(body) => body.pose.place(point),
            None => point,
        }
    }
}

/// Position and orientation of a frame: a vector `r` in it is `position + rotation r` in the common frame.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Pose {
    /// Origin in the common frame.
    pub position: [f64; 3],
    /// Rows of the rotation matrix; its columns are the axes of the frame.
    pub rotation: [[f64; 3]; 3],
}

impl Pose {
    /// Transforms a place to the common frame.
    #[must_use]
    pub fn place(&self, point: [f64; 3]) -> [f64; 3] {
        let turned = self.direction(point);
        core::array::from_fn(|i| self.position[i] + turned[i])
    }

    /// Transforms a direction to the common frame.
    #[must_use]
    pub fn direction(&self, direction: [f64; 3]) -> [f64; 3] {
        self.rotation.map(|row| row.iter().zip(direction).map(|(r, d)| r * d).sum())
    }
}

/// A body.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Body {
    /// Declared name.
    pub name: Text,
    /// Its position and orientation.
    pub pose: Pose,
    /// The pieces of its mass; empty if massless. Of a station of a superelement a rod to the middle of all stations.
    pub solids: Vec<Solid>,
}

/// A beam or a shaft.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Beam {
    /// Declared name.
    pub name: Text,
    /// Its sections are circles or tubes; otherwise rectangles, or known by numbers only.
    pub round: bool,
    /// Sections from the root to the tip; their centres of mass are places of the centre line. Two are where a load
    /// splits it or the diameter of a shaft jumps.
    pub sections: Vec<Section>,
}

/// A section of a beam.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Section {
    /// Its centre of mass and its axes: along the beam, and across it in the directions of its width and its height.
    pub pose: Pose,
    /// Width and height, m; of a round section the diameter twice; zero if the section is known by numbers only.
    pub size: [f64; 2],
}

/// A piece of a body's mass, in the frame of the body.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Solid {
    /// Its centre of mass.
    pub center: [f64; 3],
    /// Its shape.
    pub shape: Shape,
    /// Whether the piece is subtracted from the others.
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
        /// Length, m.
        length: f64,
    },
    /// A thin disk.
    Disk {
        /// Its axis.
        axis: [f64; 3],
        /// Radius, m.
        radius: f64,
    },
    /// A solid cylinder.
    Cylinder {
        /// Its axis.
        axis: [f64; 3],
        /// Radius, m.
        radius: f64,
        /// Length, m.
        length: f64,
    },
    /// A cylinder with a coaxial bore.
    Tube {
        /// Its axis.
        axis: [f64; 3],
        /// Radius of the bore, m.
        inner: f64,
        /// Outer radius, m.
        outer: f64,
        /// Length, m.
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
        /// Radius, m.
        radius: f64,
    },
    /// The uniform solid ellipsoid with the mass and inertia of a body whose tensor is given; flat if no body can have
    /// this inertia.
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
    /// The keyword it was declared with, for example `revolute`.
    pub kind: Text,
    /// The side it was declared from; its axis is that of the first motion.
    pub from: Seat,
    /// The side it was declared to; its axis is that of the last motion.
    pub to: Seat,
    /// Whether it closes a loop.
    pub closes_loop: bool,
    /// Whether one of its motions runs at a prescribed speed.
    pub driven: bool,
}

impl Joint {
    /// Whether it connects the root of a beam to one of its stations, or the ground to one of a shaft or a superelement.
    #[must_use]
    pub fn is_flexure(&self) -> bool {
        ["flexure", STATION].contains(&&*self.kind)
    }
}

/// One side of a joint.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Seat {
    /// Number of its body; `None` for the ground.
    pub body: Option<usize>,
    /// Its place in the frame of the body.
    pub place: [f64; 3],
    /// A unit vector in the frame of the body; `None` for a joint without motion.
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
    /// The keyword it was declared with, for example `spring_damper`.
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
    /// Its axle, a unit vector in the frame of the body of its centre; `None` for a ball.
    pub axle: Option<[f64; 3]>,
    /// Radius, m.
    pub radius: f64,
    /// Number of the point in the plane.
    pub on: usize,
    /// Normal of the plane, a unit vector in the frame of the body of `on`.
    pub normal: [f64; 3],
}

/// A load or constraint as declared: gravity, a drive, a force, a constraint, a curve.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Element {
    /// Declared name.
    pub name: Text,
    /// The keyword it was declared with, for example `bushing`; `drive` for a driven coordinate.
    pub kind: Text,
    /// The elements it acts on and its law, omitting zero arguments, with numbers in SI:
    /// `on theta stiffness k rest 0.1`.
    pub law: Text,
}

/// A mode as poses over one period.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ModePictures {
    /// Number of the mode, counted from 0.
    pub mode: usize,
    /// Scale factor of the mode shape; zero if the mode moves no body.
    pub amplitude: f64,
    /// The poses of all bodies, then of the sections of all beams, at evenly spaced phases, the first at phase 0.
    pub frames: Vec<Vec<Pose>>,
}

/// A forced vibration as poses over one period.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct VibrationPictures {
    /// `w`, rad/s.
    pub frequency: f64,
    /// The factor between the displacements shown and those of the vibration; zero if it moves no body.
    pub enlargement: f64,
    /// The poses of all bodies, then of the sections of all beams, at evenly spaced phases, the first at phase 0.
    pub frames: Vec<Vec<Pose>>,
}
