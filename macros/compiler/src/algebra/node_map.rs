//! Nodes by node.

use crate::base::ids::ExprId;

/// A node for some of the nodes of a graph. Memory of zeros costs nothing until it is used, so that a walk over a part of a large
/// graph pays for this part only.
pub(super) struct NodeMap {
    /// By node: the number of its image, counted from one, or zero.
    images: Vec<u32>,
}

impl NodeMap {
    /// No node for any of the first `size` nodes.
    pub(super) fn new(size: usize) -> Self {
        Self {
            images: vec![0; size],
        }
    }

    pub(super) fn get(&self, id: ExprId) -> Option<ExprId> {
        match self.images[id.index()] {
            0 => None,
            number => Some(ExprId(number - 1)),
        }
    }

    pub(super) fn set(&mut self, id: ExprId, image: ExprId) {
        self.images[id.index()] = image.0 + 1;
    }
}
