//! How to interpret the numbers of a picture; their order is defined by the runtime's contract.

use crate::base::ids::PointId;
use crate::model::elements::Element;
use crate::model::mechanism::Frame;

/// The visible parts of a mechanism.
#[derive(Clone, Debug)]
pub struct Picture {
    /// Bodies.
    pub bodies: Vec<PictureBody>,
    /// Beams, then shafts.
    pub beams: Vec<PictureBeam>,
    /// Joints.
    pub joints: Vec<PictureJoint>,
    /// Points, and the frame that each is fixed in.
    pub points: Vec<(String, Frame)>,
    /// Forces and constraints between two points.
    pub links: Vec<PictureLink>,
    /// Rolling constraints: name, centre of the wheel, and a point of the plane.
    pub wheels: Vec<(String, [PointId; 2])>,
    /// Forces and constraints, in words.
    pub elements: Vec<Element>,
    /// All numbers, with zeros in place of those that are computed.
    pub numbers: Vec<f64>,
    /// Positions of the computed numbers.
    pub computed: Vec<u32>,
}

/// A body.
#[derive(Clone, Debug)]
pub struct PictureBody {
    /// Declared name.
    pub name: String,
    /// Its pieces: the kind of each, and whether it is a hole in the others.
    pub solids: Vec<(SolidKind, bool)>,
}

/// A beam or a shaft.
#[derive(Clone, Debug)]
pub struct PictureBeam {
    /// Declared name.
    pub name: String,
    /// The number of its sections that are shown, from the root to the tip; two where a load splits it or the diameter of
    /// a shaft jumps.
    pub sections: u32,
    /// Whether its sections are circles or tubes.
    pub round: bool,
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
    /// A body given by its inertia tensor.
    Rigid,
}

/// A joint.
#[derive(Clone, Debug)]
pub struct PictureJoint {
    /// Declared name.
    pub name: String,
    /// The keyword it was declared with.
    pub kind: &'static str,
    /// Its `from` side and its `to` side.
    pub sides: [Frame; 2],
    /// Whether it closes a loop.
    pub cut: bool,
    /// Whether one of its motions runs at a prescribed speed.
    pub driven: bool,
}

/// A force or a constraint between two points.
#[derive(Clone, Debug)]
pub struct PictureLink {
    /// Declared name.
    pub name: String,
    /// The keyword it was declared with.
    pub kind: &'static str,
    /// Its ends.
    pub ends: [PointId; 2],
}
