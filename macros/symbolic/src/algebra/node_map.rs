//! A map from nodes to nodes.

use super::reached::Reached;
use crate::base::ids::ExprId;

/// Maps nodes of a part of a graph to nodes.
pub(super) struct NodeMap<'a> {
    part: &'a Reached,
    /// By place: the number of the image, counted from one, or zero.
    images: Vec<u32>,
}

impl<'a> NodeMap<'a> {
    /// An empty map of these nodes.
    pub(super) fn new(part: &'a Reached) -> Self {
        let images = vec![0; part.len()];
        Self { part, images }
    }

    pub(super) fn get(&self, id: ExprId) -> Option<ExprId> {
        match self.images[self.part.place(id)?] {
            0 => None,
            number => Some(ExprId(number - 1)),
        }
    }

    /// Sets the image of one of the nodes; that of any other is not kept.
    pub(super) fn set(&mut self, id: ExprId, image: ExprId) {
        if let Some(index) = self.part.place(id) {
            self.images[index] = image.0 + 1;
        }
    }
}
