//! How the numbers of a picture are read: which bodies, solids, joints and points they belong to.

use super::shared::{List, Shared, Text};

/// What [`Mechanism::picture`](crate::Mechanism::picture) shows, in the order of its numbers.
///
/// The numbers of a picture, SI, are those of the bodies, then of their solids, of the joints, of the points, of the wheels, of gravity:
///
/// - a body has 12: the place of its origin in the common frame, and the rows of the rotation that takes vectors of the body into
///   the common frame. That is the frame of the ground at the instant at which all running coordinates are zero;
/// - a solid has as many as its kind ([`SolidKind::numbers`]);
/// - a joint has 12: its place and the axis of its first motion on the `from` side, its place and the axis of its last motion on the
///   `to` side, each in the frame of that side;
/// - a point has 3: its place in the frame it is fixed in;
/// - a wheel has 7: its radius, its axle in the frame that carries it, the normal of the plane in the frame of the plane. Of a
///   ball the axle is zero;
/// - gravity has 3: its acceleration in the common frame, zero where none is declared.
///
/// Most of them are the same for every state and design. These stand in `numbers`; the kernel computes the others.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct PictureInfo {
    /// The bodies, in the order of declaration.
    pub bodies: List<BodyInfo>,
    /// The joints, in the order of declaration.
    pub joints: List<JointInfo>,
    /// The declared points, in the order of declaration.
    pub points: List<PointInfo>,
    /// Forces and constraints between two points.
    pub links: List<LinkInfo>,
    /// What rolls.
    pub wheels: List<WheelInfo>,
    /// What acts and what binds, in words.
    pub elements: List<ElementInfo>,
    /// All numbers; zero in the places of those that the kernel computes.
    pub numbers: List<f64>,
    /// The places of the numbers that the kernel computes, in the order of its results.
    pub computed: List<u32>,
}

impl PictureInfo {
    /// Nothing to see: of mechanisms that say nothing of their bodies.
    pub const EMPTY: Self = Self {
        bodies: Shared::Static(&[]),
        joints: Shared::Static(&[]),
        points: Shared::Static(&[]),
        links: Shared::Static(&[]),
        wheels: Shared::Static(&[]),
        elements: Shared::Static(&[]),
        numbers: Shared::Static(&[]),
        computed: Shared::Static(&[]),
    };
}

/// A body of a picture.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct BodyInfo {
    /// Declared name.
    pub name: Text,
    /// What its mass is made of; nothing when massless.
    pub solids: List<SolidInfo>,
}

/// A piece of a body's mass.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SolidInfo {
    /// What it is.
    pub kind: SolidKind,
    /// The piece is missing from the others.
    pub hole: bool,
}

/// Kinds of solids, and their numbers: places and directions in the frame of the body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum SolidKind {
    /// Place, mass.
    Point,
    /// Centre, direction, length.
    Rod,
    /// Centre, axis, radius.
    Disk,
    /// Centre, axis, radius, length.
    Cylinder,
    /// Centre, axis, inner radius, outer radius, length.
    Tube,
    /// Centre, directions of the three edges, lengths of the edges.
    Box,
    /// Centre, radius.
    Sphere,
    /// Centre of mass, the three axes of the frame in which the tensor is given, mass, the tensor's xx, yy, zz, xy, yz, xz in this
    /// frame, the point that it is about from the centre of mass in this frame.
    Rigid,
}

impl SolidKind {
    /// How many numbers it has.
    #[must_use]
    pub const fn numbers(self) -> usize {
        match self {
            Self::Point | Self::Sphere => 4,
            Self::Rod | Self::Disk => 7,
            Self::Cylinder => 8,
            Self::Tube => 9,
            Self::Box => 15,
            Self::Rigid => 22,
        }
    }
}

/// A joint of a picture.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct JointInfo {
    /// Declared name.
    pub name: Text,
    /// The word it was declared with, for example `revolute`.
    pub kind: Text,
    /// The body on its `from` side; `None` for the ground.
    pub from: Option<u32>,
    /// The body on its `to` side; `None` for the ground.
    pub to: Option<u32>,
    /// It closes a loop.
    pub cut: bool,
    /// One of its motions runs at a prescribed speed.
    pub driven: bool,
}

/// A declared point of a picture.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct PointInfo {
    /// Declared name.
    pub name: Text,
    /// The body it is fixed in; `None` for the ground.
    pub body: Option<u32>,
}

/// A force or a constraint between two points.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct LinkInfo {
    /// Declared name.
    pub name: Text,
    /// The word it is declared with, for example `spring_damper`.
    pub kind: Text,
    /// The points at its ends.
    pub ends: [u32; 2],
}

/// A wheel or a ball that rolls on a plane.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct WheelInfo {
    /// Name of the constraint.
    pub name: Text,
    /// The point at its centre.
    pub center: u32,
    /// The point in the plane.
    pub on: u32,
}

/// Something that acts on the mechanism or binds it, as it was declared: gravity, a drive, a force, a constraint, a curve.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ElementInfo {
    /// Declared name.
    pub name: Text,
    /// The word it is declared with, for example `bushing`; `drive` of a driven coordinate.
    pub kind: Text,
    /// What it acts on and its law, without arguments that are zero, with numbers in SI: `on theta stiffness k rest 0.1`.
    pub law: Text,
}
