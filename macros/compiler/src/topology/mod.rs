//! The computed spanning forest: which body hangs on which, in an order that visits parents first.

pub mod build;
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
    /// Driven coordinates in order of declaration.
    pub driven: Vec<CoordinateId>,
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
