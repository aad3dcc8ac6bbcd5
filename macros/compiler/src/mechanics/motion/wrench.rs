//! A force and its moment.

use crate::algebra::{Graph, Vector3};

/// A force and its moment about the origin of the frame it belongs to.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Wrench {
    pub(crate) force: Vector3,
    pub(crate) moment: Vector3,
}

impl Wrench {
    pub(crate) fn zero(g: &mut Graph) -> Self {
        Self { force: Vector3::zero(g), moment: Vector3::zero(g) }
    }

    pub(crate) fn add(self, g: &mut Graph, other: Self) -> Self {
        Self { force: self.force.add(g, other.force), moment: self.moment.add(g, other.moment) }
    }

    pub(crate) fn neg(self, g: &mut Graph) -> Self {
        Self { force: self.force.neg(g), moment: self.moment.neg(g) }
    }
}
