//! A map from nodes to nodes.

use crate::base::ids::ExprId;

/// Maps some nodes of a graph to nodes. Zeroed memory costs nothing until it is used, so a walk over part of a large
/// graph pays only for this part.
pub(super) struct NodeMap {
    /// By node: the number of its image, counted from one, or zero.
    images: Vec<u32>,
}

impl NodeMap {
    /// An empty map for the first `size` nodes.
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
