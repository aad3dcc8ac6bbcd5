//! Lookup of equal nodes.

use super::node::Node;
use crate::base::ids::ExprId;

/// A hash table with open addressing: in unoptimised builds of the macro, the standard library's takes a quarter of its
/// time.
#[derive(Clone, Debug)]
pub(super) struct Interner {
    /// The number of a node, counted from one, or zero. The length is a power of two, and at most half of the slots are
    /// taken.
    slots: Vec<u32>,
    taken: usize,
}

impl Default for Interner {
    fn default() -> Self {
        Self {
            slots: vec![0; 64],
            taken: 0,
        }
    }
}

impl Interner {
    /// The existing node equal to this one.
    pub(super) fn find(&self, nodes: &[Node], node: Node) -> Option<ExprId> {
        match self.slots[self.place(nodes, node)] {
            0 => None,
            number => Some(ExprId(number - 1)),
        }
    }

    /// Enters the last of the nodes, which must differ from all before it.
    pub(super) fn enter_last(&mut self, nodes: &[Node]) {
        self.taken += 1;
        if 2 * self.taken > self.slots.len() {
            self.slots = vec![0; 2 * self.slots.len()];
            for known in 0..nodes.len() {
                self.enter(nodes, known);
            }
        } else {
            self.enter(nodes, nodes.len() - 1);
        }
    }

    fn enter(&mut self, nodes: &[Node], index: usize) {
        let place = self.place(nodes, nodes[index]);
        self.slots[place] = ExprId::new(index).0 + 1;
    }

    /// The slot of an equal node, or the free slot for it.
    fn place(&self, nodes: &[Node], node: Node) -> usize {
        let last = self.slots.len() - 1;
        let mut place = (hash(node) >> self.slots.len().leading_zeros() >> 1) as usize;
        loop {
            let number = self.slots[place] as usize;
            if number == 0 || nodes[number - 1] == node {
                return place;
            }
            place = (place + 1) & last;
        }
    }
}

/// Multiplication by a large odd number spreads the bits upwards, so the leading ones are used (Knuth, The Art of
/// Computer Programming, volume 3, section 6.4).
fn hash(node: Node) -> u64 {
    const FACTOR: u64 = 0x9e37_79b9_7f4a_7c15;
    let (kind, operands) = match node {
        Node::Constant(bits) => (0, bits),
        Node::Symbol(symbol) => (1, u64::from(symbol.0)),
        Node::Unary(_, a) => (2, u64::from(a.0)),
        Node::Binary(operator, a, b) => {
            let operands = u64::from(a.0) << 32 | u64::from(b.0);
            (3 + operator as u64, operands)
        }
    };
    (operands.wrapping_mul(FACTOR) ^ kind).wrapping_mul(FACTOR)
}
