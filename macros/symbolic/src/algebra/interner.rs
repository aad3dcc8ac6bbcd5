//! Lookup of equal nodes.

use super::node::Node;
use crate::base::ids::ExprId;

/// Nodes that are looked up together were built together: most lookups find their slots, and the node, in a cache if
/// the table is ordered like the graph. A node is therefore entered in a bucket chosen by its younger operand. What
/// does not fit there, because some operands are used everywhere, and what has no operands is in a hash table.
#[derive(Clone, Debug, Default)]
pub(super) struct Interner {
    /// Buckets of [`ROOM`] slots, filled from the front.
    near: Vec<Slot>,
    far: Table,
}

/// Slots of a bucket, as many as fill a line of a cache; and the number of nodes that share a bucket.
const ROOM: usize = 8;
const SHARING: usize = 5;

/// Upper half: part of the hash of a node, so that only the node that is found is read. Lower half: its number, counted
/// from one, or zero.
type Slot = u64;

impl Interner {
    /// The existing node equal to this one.
    pub(super) fn find(&self, nodes: &[Node], node: Node) -> Option<ExprId> {
        let hash = hash(node);
        if let Some(first) = bucket(node) {
            for &slot in self.near.get(first..first + ROOM)? {
                match number(slot) {
                    0 => return None,
                    number if is(slot, hash) && nodes[number - 1] == node => {
                        return Some(ExprId::new(number - 1));
                    }
                    _ => {}
                }
            }
        }
        self.far.find(nodes, node, hash)
    }

    /// Enters the last of the nodes, which must differ from all before it.
    pub(super) fn enter_last(&mut self, nodes: &[Node]) {
        let node = nodes[nodes.len() - 1];
        let slot = hash(node) << 32 | nodes.len() as u64;
        if let Some(first) = bucket(node) {
            if self.near.len() < first + ROOM {
                self.near.resize(first + ROOM, 0);
            }
            let bucket = &mut self.near[first..first + ROOM];
            if let Some(free) = bucket.iter_mut().find(|slot| **slot == 0) {
                *free = slot;
                return;
            }
        }
        self.far.enter(nodes, hash(node), slot);
    }
}

/// The first slot of the bucket of a node that has operands.
fn bucket(node: Node) -> Option<usize> {
    let younger = match node {
        Node::Constant(_) | Node::Symbol(_) => return None,
        Node::Unary(_, a) => a,
        Node::Binary(_, a, b) => a.max(b),
    };
    Some(younger.index() / SHARING * ROOM)
}

fn number(slot: Slot) -> usize {
    slot as u32 as usize
}

fn is(slot: Slot, hash: u64) -> bool {
    slot >> 32 == hash & 0xffff_ffff
}

/// A hash table with open addressing: in unoptimised builds of the macro, the standard library's takes a quarter of its
/// time.
#[derive(Clone, Debug)]
struct Table {
    /// The length is a power of two, and at most two thirds of the slots are taken.
    slots: Vec<Slot>,
    taken: usize,
}

impl Default for Table {
    fn default() -> Self {
        Self { slots: vec![0; 64], taken: 0 }
    }
}

impl Table {
    fn find(&self, nodes: &[Node], node: Node, hash: u64) -> Option<ExprId> {
        let mut bucket = self.first_place(hash);
        loop {
            let slot = self.slots[bucket];
            match number(slot) {
                0 => return None,
                number if is(slot, hash) && nodes[number - 1] == node => {
                    return Some(ExprId::new(number - 1));
                }
                _ => bucket = self.next_place(bucket),
            }
        }
    }

    fn enter(&mut self, nodes: &[Node], hash: u64, slot: Slot) {
        self.taken += 1;
        if 3 * self.taken > 2 * self.slots.len() {
            let double = vec![0; 2 * self.slots.len()];
            for slot in std::mem::replace(&mut self.slots, double) {
                if slot != 0 {
                    self.place(self::hash(nodes[number(slot) - 1]), slot);
                }
            }
        }
        self.place(hash, slot);
    }

    fn place(&mut self, hash: u64, slot: Slot) {
        let mut bucket = self.first_place(hash);
        while self.slots[bucket] != 0 {
            bucket = self.next_place(bucket);
        }
        self.slots[bucket] = slot;
    }

    fn first_place(&self, hash: u64) -> usize {
        (hash >> self.slots.len().leading_zeros() >> 1) as usize
    }

    fn next_place(&self, index: usize) -> usize {
        (index + 1) & (self.slots.len() - 1)
    }
}

/// Multiplication by a large odd number spreads the bits upwards, so the leading ones choose the slot (Knuth, The Art of
/// Computer Programming, volume 3, section 6.4). Folding them down before the second makes the others as good.
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
    let spread = operands.wrapping_mul(FACTOR) ^ kind;
    (spread ^ spread >> 32).wrapping_mul(FACTOR)
}
