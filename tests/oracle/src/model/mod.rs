//! A mechanism as plain data: an open tree of bodies whose values are numbers or multiples of design variables.
//!
//! All values are SI. Fields have the same meaning as in the language; for its syntax see [`crate::declaration`].

mod beams;
mod bodies;
mod curves;
mod forces;
mod joints;
mod values;

pub use beams::{Beam, Flexure, Prebend, Section};
pub use bodies::{Amount, Body, Part, Shape};
pub use curves::Curve;
pub use forces::{Expr, Force, ForceLaw};
pub use joints::{Coordinate, Drive, Joint, Motion, Step, Word};
pub use values::{DesignVariable, Input, Matrix, ORIGIN, Unit, Value, Values, ZERO, diagonal};

/// A frame to which something is fixed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Frame {
    /// The inertial frame.
    Ground,
    /// A body, by its index in [`Model::bodies`].
    Body(usize),
}

/// A fixed placement: the offset first, then rotations (axis, angle), each about the axes resulting from the previous
/// one.
#[derive(Clone, Debug, PartialEq)]
pub struct Placement {
    /// Origin.
    pub offset: Values,
    /// Rotations in order; axes need not be unit vectors.
    pub rotations: Vec<([f64; 3], Value)>,
}

impl Placement {
    /// No displacement at all.
    pub const NONE: Self = Self { offset: ORIGIN, rotations: Vec::new() };

    /// An offset without rotation.
    pub fn at(offset: Values) -> Self {
        Self { offset, rotations: Vec::new() }
    }
}

/// A named point, with axes, fixed in a frame.
#[derive(Clone, Debug, PartialEq)]
pub struct Point {
    /// Declared name.
    pub name: String,
    /// The frame.
    pub frame: Frame,
    /// Its position and axes there.
    pub placement: Placement,
}

/// A mechanism: an open tree of bodies rooted in the ground.
#[derive(Clone, Debug, PartialEq)]
pub struct Model {
    /// Name of the declaration.
    pub name: String,
    /// Operating parameters.
    pub inputs: Vec<Input>,
    /// Design variables.
    pub design: Vec<DesignVariable>,
    /// Acceleration of gravity.
    pub gravity: Values,
    /// Bodies.
    pub bodies: Vec<Body>,
    /// Flexible bodies, to which slices and stations are joined by flexures.
    pub beams: Vec<Beam>,
    /// Joints, one per body, in any order.
    pub joints: Vec<Joint>,
    /// Points.
    pub points: Vec<Point>,
    /// Force elements.
    pub forces: Vec<Force>,
}

/// How a body connects to its parent, the frame nearer to the ground.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Branch {
    /// The body.
    pub body: usize,
    /// Its parent.
    pub parent: Frame,
    /// The joint between them.
    pub joint: usize,
    /// The joint is declared from the body to its parent.
    pub reversed: bool,
}

impl Model {
    /// The bodies from the ground outwards, parents before children.
    ///
    /// # Panics
    /// When the joints do not make a tree.
    pub fn tree(&self) -> Vec<Branch> {
        let mut branches: Vec<Branch> = Vec::new();
        let mut used = vec![false; self.joints.len()];
        while branches.len() < self.bodies.len() {
            let reached = |frame: Frame, branches: &[Branch]| {
                frame == Frame::Ground || branches.iter().any(|b| Frame::Body(b.body) == frame)
            };
            let found = self.joints.iter().enumerate().find_map(|(joint, declared)| {
                if used[joint] {
                    return None;
                }
                match (declared.from, declared.to) {
                    (parent, Frame::Body(body)) if reached(parent, &branches) => {
                        Some(Branch { body, parent, joint, reversed: false })
                    }
                    (Frame::Body(body), parent) if reached(parent, &branches) => {
                        Some(Branch { body, parent, joint, reversed: true })
                    }
                    _ => None,
                }
            });
            let branch = found.expect("every body has a path to the ground");
            assert!(!reached(Frame::Body(branch.body), &branches), "the joints close no loop");
            used[branch.joint] = true;
            branches.push(branch);
        }
        assert!(used.iter().all(|used| *used), "the joints close no loop");
        branches
    }

    /// All coordinates, ordered by joint, then by step.
    pub fn coordinates(&self) -> Vec<Coordinate> {
        let of_joint = |joint: usize| {
            let steps = 0..self.joints[joint].steps.len();
            steps.map(move |step| Coordinate { joint, step })
        };
        (0..self.joints.len()).flat_map(of_joint).collect()
    }

    /// The free coordinates, in the order of `q`.
    pub fn free(&self) -> Vec<Coordinate> {
        self.select(|step| step.drive.is_none())
    }

    /// The driven coordinates.
    pub fn driven(&self) -> Vec<Coordinate> {
        self.select(|step| step.drive.is_some())
    }

    /// The step of a coordinate.
    pub fn step(&self, coordinate: Coordinate) -> &Step {
        &self.joints[coordinate.joint].steps[coordinate.step]
    }

    /// Nominal values of the design variables.
    pub fn nominal(&self) -> Vec<f64> {
        self.design.iter().map(|variable| variable.nominal).collect()
    }

    fn select(&self, wanted: impl Fn(&Step) -> bool) -> Vec<Coordinate> {
        let mut coordinates = self.coordinates();
        coordinates.retain(|&coordinate| wanted(self.step(coordinate)));
        coordinates
    }
}
