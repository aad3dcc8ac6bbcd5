//! Sums of chunks in a binary tree over the chunk index; only nodes that have not yet been merged into a larger one are
//! kept.

use std::ops::Range;

use super::chunk::Chunk;
use super::mask::CHUNK;
use super::plan::Plan;
use super::{Comoments, Moments};

/// Sums of `2^level` chunks, starting at `start`, a multiple of that number.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Node {
    pub(super) start: u64,
    pub(super) level: u32,
    pub(super) moments: Vec<Moments>,
    pub(super) pairs: Vec<Comoments>,
}

impl Node {
    /// The sums over the samples present in a chunk.
    #[inline(always)]
    pub(super) fn of(chunk: &Chunk, plan: &Plan) -> Self {
        let (mut room, mut second_room) = ([0.0; CHUNK], [0.0; CHUNK]);
        let mut moments = Vec::with_capacity(plan.quantities());
        for k in 0..plan.quantities() {
            moments.push(match chunk.column(k) {
                Some((values, mask)) => Moments::of(mask.select(values, &mut room)),
                None => Moments::default(),
            });
        }
        let pairs = plan.pairs.iter().map(|&(first, second)| {
            let (Some((x, in_x)), Some((y, in_y))) = (chunk.column(first), chunk.column(second)) else {
                return Comoments::default();
            };
            let both = in_x.and(in_y);
            Comoments::of(both.select(x, &mut room), both.select(y, &mut second_room))
        });
        Self { start: chunk.index, level: 0, pairs: pairs.collect(), moments }
    }

    /// Adds the samples of a later node.
    pub(super) fn merge(&mut self, later: &Self) {
        for (moment, other) in self.moments.iter_mut().zip(&later.moments) {
            moment.merge(other);
        }
        for (pair, other) in self.pairs.iter_mut().zip(&later.pairs) {
            pair.merge(other);
        }
    }

    pub(super) fn samples(&self) -> Range<u64> {
        let size = CHUNK as u64;
        self.start * size..(self.start + (1 << self.level)) * size
    }
}

/// Nodes in order, no two of which are halves of the same parent.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Tree {
    pub(super) nodes: Vec<Node>,
}

impl Tree {
    /// Adds a node that does not overlap with any other.
    pub(super) fn insert(&mut self, node: Node) {
        let mut at = self.nodes.partition_point(|other| other.start < node.start);
        self.nodes.insert(at, node);
        while let Some(left) = self.left_half(at) {
            let right = self.nodes.remove(left + 1);
            self.nodes[left].merge(&right);
            self.nodes[left].level += 1;
            at = left;
        }
    }

    /// Position of the left of two halves, one of which is the node at `at`; `None` unless both are present.
    fn left_half(&self, at: usize) -> Option<usize> {
        let node = self.nodes.get(at)?;
        let is_right = node.start >> node.level & 1 == 1;
        let left = if is_right { at.checked_sub(1)? } else { at };
        let (first, second) = (self.nodes.get(left)?, self.nodes.get(left + 1)?);
        let halves = first.level == second.level && first.start + (1 << first.level) == second.start;
        halves.then_some(left)
    }
}
