//! The order of the operations.
//!
//! A processor has sixteen registers, and values that do not fit are written to memory and read again. Values are
//! therefore computed where they are needed: depth first from the results, starting with the operand that needs more
//! registers. Sines and cosines come first: no other value then has to survive the branch that they contain, and
//! several are computed at once.

use crate::algebra::{Graph, Node, Unary, reachable};
use crate::base::ids::ExprId;

/// Every operation that the results need, operands before their users.
pub(super) fn schedule(graph: &Graph, results: &[ExprId]) -> Vec<ExprId> {
    let needed: Vec<ExprId> = reachable(graph, results)
        .into_iter()
        .filter(|&id| !is_leaf(graph, id))
        .collect();
    let mut schedule = Schedule::new(graph, &needed);
    for id in sines(graph, &needed) {
        schedule.place(id);
    }
    for &id in results {
        schedule.place(id);
    }
    schedule.order
}

/// Sines and cosines, starting with those that need no others: those that can be computed side by side become
/// neighbours.
fn sines(graph: &Graph, needed: &[ExprId]) -> Vec<ExprId> {
    let mut depth = vec![0; graph.len()];
    let mut sines = Vec::new();
    for &id in needed {
        depth[id.index()] = match graph.node(id) {
            Node::Constant(_) | Node::Symbol(_) => 0,
            Node::Unary(Unary::Sin | Unary::Cos, a) => {
                sines.push(id);
                depth[a.index()] + 1
            }
            Node::Unary(_, a) => depth[a.index()],
            Node::Binary(_, a, b) => depth[a.index()].max(depth[b.index()]),
        };
    }
    sines.sort_by_key(|id| depth[id.index()]);
    sines
}

fn is_leaf(graph: &Graph, id: ExprId) -> bool {
    matches!(graph.node(id), Node::Constant(_) | Node::Symbol(_))
}

struct Schedule<'a> {
    graph: &'a Graph,
    /// Registers that the tree of each value needs (Sethi and Ullman 1970); zero for unneeded nodes.
    registers: Vec<u32>,
    placed: Vec<bool>,
    order: Vec<ExprId>,
    pending: Vec<(ExprId, bool)>,
}

impl<'a> Schedule<'a> {
    fn new(graph: &'a Graph, needed: &[ExprId]) -> Self {
        let mut registers = vec![0; graph.len()];
        for &id in needed {
            registers[id.index()] = match graph.node(id) {
                Node::Constant(_) | Node::Symbol(_) => 0,
                Node::Unary(_, a) => registers[a.index()].max(1),
                Node::Binary(_, a, b) => {
                    let (a, b) = (registers[a.index()], registers[b.index()]);
                    if a == b { a + 1 } else { a.max(b) }
                }
            };
        }
        Self {
            graph,
            registers,
            placed: vec![false; graph.len()],
            order: Vec::with_capacity(needed.len()),
            pending: Vec::new(),
        }
    }

    /// Places a value after everything that it needs.
    fn place(&mut self, id: ExprId) {
        self.pending.push((id, false));
        while let Some((id, ready)) = self.pending.pop() {
            if self.placed[id.index()] || is_leaf(self.graph, id) {
                continue;
            }
            if ready {
                self.placed[id.index()] = true;
                self.order.push(id);
                continue;
            }
            self.pending.push((id, true));
            match self.graph.node(id) {
                Node::Constant(_) | Node::Symbol(_) => {}
                Node::Unary(_, a) => self.pending.push((a, false)),
                Node::Binary(_, a, b) => {
                    let swapped = self.registers[b.index()] > self.registers[a.index()];
                    let (first, second) = if swapped { (b, a) } else { (a, b) };
                    self.pending.extend([(second, false), (first, false)]);
                }
            }
        }
    }
}
