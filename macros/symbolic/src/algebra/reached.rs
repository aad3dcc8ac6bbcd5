//! The nodes below some roots.

use super::graph::{Graph, Slopes};
use super::node::Node;
use crate::base::ids::ExprId;

/// Some nodes of a graph, operands first, and the place of each among them. What is known about these nodes is stored
/// by place, so that work on part of a large graph needs room for this part only.
pub struct Reached {
    nodes: Vec<ExprId>,
    /// One bit for each node of the graph, and how many are set before each word.
    bits: Vec<u64>,
    before: Vec<u32>,
}

impl Reached {
    /// The nodes needed to evaluate `roots`, themselves included.
    pub fn below(graph: &Graph, roots: &[ExprId]) -> Self {
        Self::through(graph, roots, false, |_| true)
    }

    /// Of the nodes needed to evaluate `roots`, those that may depend on a symbol of `mask`.
    pub(super) fn dependent(graph: &Graph, roots: &[ExprId], mask: u128) -> Self {
        Self::through(graph, roots, false, |id| graph.may_depend(id, mask))
    }

    /// [`dependent`](Self::dependent), with the derivatives that nodes have been given.
    pub(super) fn dependent_with_slopes(graph: &Graph, roots: &[ExprId], mask: u128) -> Self {
        Self::through(graph, roots, true, |id| graph.may_depend(id, mask))
    }

    /// The nodes reached from `roots` through `wanted` nodes only.
    fn through(graph: &Graph, roots: &[ExprId], slopes: bool, wanted: impl Fn(ExprId) -> bool) -> Self {
        let mut bits = vec![0_u64; graph.len() / 64 + 1];
        // Those whose operands are still to be visited, and the last word that has any: operands are older, so that the
        // way leads down, near to where it was before.
        let mut open = bits.clone();
        let (mut word, mut count) = (0, 0);
        let mut visit = |open: &mut [u64], last: &mut usize, id: ExprId| {
            let (word, bit) = (id.index() / 64, 1 << (id.index() % 64));
            if bits[word] & bit == 0 && wanted(id) {
                bits[word] |= bit;
                open[word] |= bit;
                *last = word.max(*last);
                count += 1;
            }
        };
        for &root in roots {
            visit(&mut open, &mut word, root);
        }
        loop {
            let Some(bit) = open[word].checked_ilog2() else {
                if word == 0 {
                    break;
                }
                word -= 1;
                continue;
            };
            open[word] ^= 1 << bit;
            let id = ExprId::new(word * 64 + bit as usize);
            if slopes && let Some(given) = graph.given_slopes(id) {
                for &(by, slope) in given.iter() {
                    visit(&mut open, &mut word, by);
                    visit(&mut open, &mut word, slope);
                }
            }
            match graph.node(id) {
                Node::Constant(_) | Node::Symbol(_) => {}
                Node::Unary(_, a) => visit(&mut open, &mut word, a),
                Node::Binary(_, a, b) => {
                    visit(&mut open, &mut word, a);
                    visit(&mut open, &mut word, b);
                }
            }
        }
        Self::in_order(bits, count)
    }

    /// The `count` nodes whose bits are set.
    fn in_order(bits: Vec<u64>, count: usize) -> Self {
        let mut nodes = Vec::with_capacity(count);
        let mut before = Vec::with_capacity(bits.len());
        for (word, &set) in bits.iter().enumerate() {
            before.push(nodes.len() as u32);
            let mut rest = set;
            while rest != 0 {
                nodes.push(ExprId::new(word * 64 + rest.trailing_zeros() as usize));
                rest &= rest - 1;
            }
        }
        Self { nodes, bits, before }
    }

    /// The derivatives that a node has been given, unless one of those that it may depend on is by a node that is not
    /// among these.
    pub(super) fn slopes(&self, graph: &Graph, id: ExprId, mask: u128) -> Option<Slopes> {
        let known = |by: ExprId| !graph.may_depend(by, mask) || self.place(by).is_some();
        let given = graph.given_slopes(id)?;
        given.iter().all(|(by, _)| known(*by)).then_some(given)
    }

    /// The nodes, operands first.
    pub fn nodes(&self) -> &[ExprId] {
        &self.nodes
    }

    /// Number of nodes.
    pub fn len(&self) -> usize {
        self.nodes.len()
    }

    /// Whether there is no node.
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// The place of a node; `None` if it is not one of them.
    pub fn place(&self, id: ExprId) -> Option<usize> {
        let (word, bit) = (id.index() / 64, id.index() % 64);
        let set = self.bits.get(word)? >> bit;
        let earlier = self.bits[word] & ((1 << bit) - 1);
        (set & 1 == 1).then(|| self.before[word] as usize + earlier.count_ones() as usize)
    }
}
