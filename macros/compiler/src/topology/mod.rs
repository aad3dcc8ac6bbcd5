//! The computed spanning forest: the parent of each body, in an order that visits parents first, and the joints that
//! close loops in it.

pub mod build;
mod cut;
mod graph;
mod hang;
mod massless;
mod print;

use crate::base::ids::{BodyId, CoordinateId, JointId};
use crate::model::mechanism::Frame;

/// The spanning forest of a mechanism and its coordinates in order.
#[derive(Clone, Debug, PartialEq)]
pub struct Topology {
    /// One branch per body, parents before children.
    pub branches: Vec<Branch>,
    /// Free coordinates in order of declaration: the order of `q`.
    pub free: Vec<CoordinateId>,
    /// Coasting coordinates in order of declaration.
    pub coasting: Vec<CoordinateId>,
    /// Driven coordinates in order of declaration.
    pub driven: Vec<CoordinateId>,
    /// Joints that close loops, in order of declaration: they are not branches and have no coordinates.
    pub cut: Vec<JointId>,
}

impl Topology {
    /// Whether another body hangs on this one.
    pub fn carries(&self, body: BodyId) -> bool {
        let mut branches = self.branches.iter();
        branches.any(|branch| branch.parent == Frame::Body(body))
    }

    /// Coordinates that run in steady motion: driven ones, then coasting ones.
    pub fn running(&self) -> impl Iterator<Item = CoordinateId> + '_ {
        self.driven.iter().chain(&self.coasting).copied()
    }
}

/// How a body is connected to the body nearer to the ground.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Branch {
    /// The body.
    pub body: BodyId,
    /// The frame nearer to the ground.
    pub parent: Frame,
    /// The joint between the two.
    pub joint: JointId,
    /// Whether the joint was declared from the body to its parent.
    pub reversed: bool,
}
