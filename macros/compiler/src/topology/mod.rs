//! The computed spanning forest: which body hangs on which, in an order that visits parents first, and which joints close
//! loops on it.

pub mod build;
mod cut;
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
    /// Joints that close loops, in order of declaration: they are no branches, and have no coordinates.
    pub cut: Vec<JointId>,
}

impl Topology {
    /// Coordinates that run in steady motion: driven ones, then coasting ones.
    pub fn running(&self) -> impl Iterator<Item = CoordinateId> + '_ {
        self.driven.iter().chain(&self.coasting).copied()
    }
}

/// How a body hangs on the body nearer to the ground.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Branch {
    /// The body.
    pub body: BodyId,
    /// The frame nearer to the ground.
    pub parent: Frame,
    /// The joint between the two.
    pub joint: JointId,
    /// The joint was declared from the body to its parent.
    pub reversed: bool,
}
