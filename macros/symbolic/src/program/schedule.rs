//! The order of the operations.
//!
//! A processor has sixteen registers, and values that do not fit are written to memory and read again. Values are
//! therefore computed where they are needed: depth first from the results, starting with the operand that needs more
//! registers. Sines and cosines come first: no other value then has to survive the branch that they contain, and
//! several are computed at once.
//!
//! # Order of the operations
//!
//! Sines and cosines that need no others come first, in one call, two in a vector (one by one in long kernels, where
//! short code matters more). The rest is depth first from the results, the operand that takes more registers first
//! (`program/schedule.rs`). LLVM orders what is left; of several orders none was more than a tenth faster. Results are
//! assembled at the end; more than four thousand partial derivatives, which would then be written twice, are stored one
//! by one into a variable set to zero (`emit/results.rs`). The caller may keep it for the next evaluation
//! (`linear_partials_into`), which then writes no zeros.

use crate::algebra::{Graph, Node, Reached, Unary};
use crate::base::ids::ExprId;

/// Every operation that the results need, operands before their users. `needed` are the nodes below the results.
pub(super) fn schedule(graph: &Graph, needed: &Reached, results: &[ExprId]) -> Vec<ExprId> {
    let mut schedule = Schedule::new(graph, needed);
    for id in sines(graph, needed) {
        schedule.place(id);
    }
    for &id in results {
        schedule.place(id);
    }
    schedule.order
}

/// Sines and cosines, starting with those that need no others: those that can be computed side by side become
/// neighbours.
fn sines(graph: &Graph, needed: &Reached) -> Vec<ExprId> {
    let mut depths: Vec<u32> = Vec::with_capacity(needed.len());
    let mut sines = Vec::new();
    for &id in needed.nodes() {
        let depth = |id| needed.place(id).map_or(0, |index| depths[index]);
        depths.push(match graph.node(id) {
            Node::Constant(_) | Node::Symbol(_) => 0,
            Node::Unary(Unary::Sin | Unary::Cos, a) => {
                sines.push((depth(a) + 1, id));
                depth(a) + 1
            }
            Node::Unary(_, a) => depth(a),
            Node::Binary(_, a, b) => depth(a).max(depth(b)),
        });
    }
    sines.sort_by_key(|(depth, _)| *depth);
    sines.into_iter().map(|(_, id)| id).collect()
}

fn is_leaf(graph: &Graph, id: ExprId) -> bool {
    matches!(graph.node(id), Node::Constant(_) | Node::Symbol(_))
}

struct Schedule<'a> {
    graph: &'a Graph,
    needed: &'a Reached,
    /// By place among the needed nodes: registers that the tree of each takes (Sethi and Ullman 1970).
    registers: Vec<u32>,
    placed: Vec<bool>,
    order: Vec<ExprId>,
    pending: Vec<(ExprId, bool)>,
}

impl<'a> Schedule<'a> {
    fn new(graph: &'a Graph, needed: &'a Reached) -> Self {
        let mut this = Self {
            graph,
            needed,
            registers: Vec::with_capacity(needed.len()),
            placed: vec![false; needed.len()],
            order: Vec::with_capacity(needed.len()),
            pending: Vec::new(),
        };
        for &id in needed.nodes() {
            let registers = match graph.node(id) {
                Node::Constant(_) | Node::Symbol(_) => 0,
                Node::Unary(_, a) => this.registers(a).max(1),
                Node::Binary(_, a, b) => match (this.registers(a), this.registers(b)) {
                    (a, b) if a == b => a + 1,
                    (a, b) => a.max(b),
                },
            };
            this.registers.push(registers);
        }
        this
    }

    fn registers(&self, id: ExprId) -> u32 {
        self.registers[self.index(id)]
    }

    fn index(&self, id: ExprId) -> usize {
        self.needed.place(id).expect("results need their operands")
    }

    /// Places a value after everything that it needs.
    fn place(&mut self, id: ExprId) {
        self.pending.push((id, false));
        while let Some((id, ready)) = self.pending.pop() {
            let index = self.index(id);
            if self.placed[index] || is_leaf(self.graph, id) {
                continue;
            }
            if ready {
                self.placed[index] = true;
                self.order.push(id);
                continue;
            }
            self.pending.push((id, true));
            match self.graph.node(id) {
                Node::Constant(_) | Node::Symbol(_) => {}
                Node::Unary(_, a) => self.pending.push((a, false)),
                Node::Binary(_, a, b) => {
                    let swapped = self.registers(b) > self.registers(a);
                    let (first, second) = if swapped { (b, a) } else { (a, b) };
                    self.pending.extend([(second, false), (first, false)]);
                }
            }
        }
    }
}
