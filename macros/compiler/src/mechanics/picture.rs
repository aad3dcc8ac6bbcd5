//! How the numbers of a picture are read; the order of the numbers is that of the runtime's contract.

use crate::base::ids::PointId;
use crate::model::elements::Element;
use crate::model::mechanism::Frame;

/// What there is to see of a mechanism.
#[derive(Clone, Debug)]
pub struct Picture {
    /// Bodies.
    pub bodies: Vec<PictureBody>,
    /// Joints.
    pub joints: Vec<PictureJoint>,
    /// Points, and what they are fixed in.
    pub points: Vec<(String, Frame)>,
    /// Forces and constraints between two points.
    pub links: Vec<PictureLink>,
    /// What rolls: name, centre, point of the plane.
    pub wheels: Vec<(String, [PointId; 2])>,
    /// What acts and what binds, in words.
    pub elements: Vec<Element>,
    /// All numbers; zero in the places of those that are computed.
    pub numbers: Vec<f64>,
    /// The places of the numbers that are computed.
    pub computed: Vec<u32>,
}

/// A body.
#[derive(Clone, Debug)]
pub struct PictureBody {
    /// Declared name.
    pub name: String,
    /// Its pieces: what each is, and whether it is missing from the others.
    pub solids: Vec<(SolidKind, bool)>,
}

/// Kinds of solids.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SolidKind {
    /// A point mass.
    Point,
    /// A slender bar.
    Rod,
    /// A thin disk.
    Disk,
    /// A cylinder.
    Cylinder,
    /// A cylinder with a bore.
    Tube,
    /// A box.
    Box,
    /// A ball.
    Sphere,
    /// A tensor.
    Rigid,
}

/// A joint.
#[derive(Clone, Debug)]
pub struct PictureJoint {
    /// Declared name.
    pub name: String,
    /// The word it was declared with.
    pub kind: &'static str,
    /// Its `from` and its `to` side.
    pub sides: [Frame; 2],
    /// It closes a loop.
    pub cut: bool,
    /// One of its motions runs at a prescribed speed.
    pub driven: bool,
}

/// A force or a constraint between two points.
#[derive(Clone, Debug)]
pub struct PictureLink {
    /// Declared name.
    pub name: String,
    /// The word it is declared with.
    pub kind: &'static str,
    /// Its ends.
    pub ends: [PointId; 2],
}
