//! How to read the numbers of a picture: which bodies, solids, joints and points they belong to.

use super::shared::{List, Shared, Text};

/// What [`Mechanism::picture`](crate::Mechanism::picture) shows, in the order of its numbers.
///
/// The numbers of a picture, SI, belong to the bodies, the sections of the beams, the solids of the bodies, the sizes of
/// the sections, the joints, the points, the wheels and gravity, in this order:
///
/// - a body has 12: the position of its origin in the common frame, and the rows of the rotation that takes vectors of
///   the body into the common frame. That frame is the ground frame at the instant at which all running coordinates are
///   zero;
/// - a section of a beam has 12: the position of its centre in the common frame, and the rows of the rotation that takes
///   vectors along its axes, the first of them along the beam, into the common frame;
/// - a solid has as many as its kind requires ([`SolidKind::numbers`]);
/// - a section of a beam has 2 more: its extent along its second and its third axis, zero if it was given by numbers;
/// - a joint has 12: its position and the axis of its first motion on the `from` side, and its position and the axis of
///   its last motion on the `to` side, each in the frame of that side;
/// - a point has 3: its position in the frame in which it is fixed;
/// - a wheel has 7: its radius, its axle in the frame that carries it, and the normal of the plane in the frame of the
///   plane. The axle of a ball is zero;
/// - gravity has 3: its acceleration in the common frame, zero if none is declared.
///
/// Most of them are the same for every state and design. These are stored in `numbers`; the kernel computes the others.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct PictureInfo {
    /// The bodies, in the order of declaration.
    pub bodies: List<BodyInfo>,
    /// The beams, in the order of declaration, then the shafts.
    pub beams: List<BeamInfo>,
    /// The joints, in the order of declaration.
    pub joints: List<JointInfo>,
    /// The declared points, in the order of declaration.
    pub points: List<PointInfo>,
    /// Forces and constraints between two points.
    pub links: List<LinkInfo>,
    /// Wheels and balls that roll.
    pub wheels: List<WheelInfo>,
    /// Forces and constraints, in words.
    pub elements: List<ElementInfo>,
    /// All numbers; zero at the positions of those that the kernel computes.
    pub numbers: List<f64>,
    /// The positions of the numbers that the kernel computes, in the order of its results.
    pub computed: List<u32>,
}

impl PictureInfo {
    /// An empty picture, for mechanisms without information about their bodies.
    pub const EMPTY: Self = Self {
        bodies: Shared::Static(&[]),
        beams: Shared::Static(&[]),
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
    /// The solids that make up its mass; empty for a massless body.
    pub solids: List<SolidInfo>,
}

/// A beam or a shaft of a picture.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct BeamInfo {
    /// Declared name.
    pub name: Text,
    /// The number of its sections that are shown: at the root, at places between, and at the tip; two where a load
    /// splits the beam or the diameter of a shaft jumps.
    pub sections: u32,
    /// Its sections are circles or tubes; otherwise rectangles, or known by numbers only.
    pub round: bool,
}

/// One solid of a body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SolidInfo {
    /// Its kind.
    pub kind: SolidKind,
    /// It is a hole: it is subtracted from the others.
    pub hole: bool,
}

/// Kinds of solids, with their numbers: positions and directions are in the frame of the body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum SolidKind {
    /// Position, mass.
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
    /// Centre of mass; the three axes of the frame in which the tensor is given; mass; the tensor's xx, yy, zz, xy, yz,
    /// xz in this frame; the reference point of the tensor relative to the centre of mass, in this frame.
    Rigid,
}

impl SolidKind {
    /// The number of its numbers.
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
    /// The keyword it was declared with, for example `revolute`.
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
    /// The keyword it was declared with, for example `spring_damper`.
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

/// An element that acts on the mechanism or constrains it, as declared: gravity, a drive, a force, a constraint, a
/// curve.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ElementInfo {
    /// Declared name.
    pub name: Text,
    /// The keyword it was declared with, for example `bushing`; `drive` for a driven coordinate.
    pub kind: Text,
    /// What it acts on, and its law, without arguments that are zero and with numbers in SI:
    /// `on theta stiffness k rest 0.1`.
    pub law: Text,
}
