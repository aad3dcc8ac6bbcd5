//! The expression graph: equal expressions are one node, and operands are always older than the nodes that use them.

use std::sync::Arc;

use rustc_hash::FxHashMap;

use super::evaluation::Evaluation;
use super::interner::Interner;
use super::node::Node;
use crate::base::ids::{ExprId, SymbolId};
use crate::base::operators::Unary;

/// When a symbol's value becomes known: if it changes, only values of its own and of later stages change.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Stage {
    /// Known to the compiler.
    Constant,
    /// Changes with the design.
    Design,
    /// Changes with the operating point.
    Input,
    /// Changes with the position.
    Configuration,
    /// Changes with velocity, acceleration or a direction of differentiation.
    Rate,
}

/// A free variable.
#[derive(Clone, Debug, PartialEq)]
pub struct Symbol {
    /// Name for reading; not necessarily unique.
    pub name: String,
    /// When its value is known.
    pub stage: Stage,
}

/// Nodes, and derivatives by them.
pub(super) type Slopes = Arc<[(ExprId, ExprId)]>;

/// The graph. Nodes are only ever added; an id stays valid and its operands have smaller ids.
#[derive(Clone, Debug, Default)]
pub struct Graph {
    nodes: Vec<Node>,
    /// The symbols a node depends on: one bit per symbol modulo 128, so a clear bit proves independence.
    support: Vec<u128>,
    interned: Interner,
    pub(super) requests: u64,
    symbols: Vec<Symbol>,
    /// By node: the number of its name, counted from one, or zero.
    named: Vec<u32>,
    names: Vec<Arc<str>>,
    /// Bound on the rounding error of each constant computed from others. Otherwise the remainder of larger constants
    /// that should cancel would look like any other number.
    rounding: FxHashMap<ExprId, f64>,
    /// By node: older nodes that determine it, and its derivatives by them.
    slopes: FxHashMap<ExprId, Slopes>,
}

impl Graph {
    /// An empty graph.
    pub fn new() -> Self {
        Self::default()
    }

    /// Number of nodes.
    pub fn len(&self) -> usize {
        self.nodes.len()
    }

    /// How often an operation was asked for, whether its node existed, was new or was simplified: the work done so far.
    pub fn requests(&self) -> u64 {
        self.requests
    }

    /// Whether the graph has no node.
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// The node behind an id.
    pub fn node(&self, id: ExprId) -> Node {
        self.nodes[id.index()]
    }

    /// The symbol behind an id.
    pub fn symbol_info(&self, id: SymbolId) -> &Symbol {
        &self.symbols[id.index()]
    }

    /// Number of symbols.
    pub fn symbol_count(&self) -> usize {
        self.symbols.len()
    }

    /// Whether `id` may depend on a symbol of `mask` (see [`Graph::mask`]); `false` is certain.
    pub fn may_depend(&self, id: ExprId, mask: u128) -> bool {
        self.support[id.index()] & mask != 0
    }

    /// The mask of a set of symbols.
    pub fn mask(symbols: impl IntoIterator<Item = SymbolId>) -> u128 {
        symbols.into_iter().fold(0, |mask, symbol| mask | bit(symbol))
    }

    /// Gives a node a name for readers of the generated code. The first name stays, and constants and symbols keep
    /// theirs. The operand of a negation called `name` becomes `minus_name`, because signs have no statement of their
    /// own.
    pub fn set_name<N: Into<Arc<str>>>(&mut self, id: ExprId, name: impl FnOnce() -> N) {
        match self.node(id) {
            Node::Constant(_) | Node::Symbol(_) => {}
            Node::Unary(Unary::Negate, operand) => {
                if self.name(operand).is_none() {
                    let name: Arc<str> = name().into();
                    let positive = match name.strip_prefix("minus_") {
                        Some(positive) => positive.into(),
                        None => format!("minus_{name}").into(),
                    };
                    self.enter_name(operand, positive);
                }
            }
            _ => {
                if self.given_name(id).is_none() {
                    self.enter_name(id, name().into());
                }
            }
        }
    }

    fn enter_name(&mut self, id: ExprId, name: Arc<str>) {
        self.names.push(name);
        self.named[id.index()] = self.names.len() as u32;
    }

    /// The name given to a node, or the name of a symbol.
    pub fn name(&self, id: ExprId) -> Option<&str> {
        match self.node(id) {
            Node::Symbol(symbol) => Some(&self.symbols[symbol.index()].name),
            _ => self.given_name(id).map(|name| &**name),
        }
    }

    /// The name given to a node.
    pub fn given_name(&self, id: ExprId) -> Option<&Arc<str>> {
        let number = self.named[id.index()].checked_sub(1)?;
        self.names.get(number as usize)
    }

    /// Gives the derivatives of a node by older nodes that determine it, where closed forms are shorter than what
    /// differentiation of its operands would find.
    pub fn set_slopes(&mut self, id: ExprId, mut slopes: Vec<(ExprId, ExprId)>) {
        slopes.retain(|(by, _)| self.constant_value(*by).is_none());
        let is_operation = !matches!(self.node(id), Node::Constant(_) | Node::Symbol(_));
        let is_new = !self.slopes.contains_key(&id);
        if is_operation && is_new && slopes.iter().all(|(by, _)| *by < id) {
            self.slopes.insert(id, slopes.into());
        }
    }

    /// The derivatives that [`set_slopes`](Self::set_slopes) has given.
    pub(super) fn given_slopes(&self, id: ExprId) -> Option<Slopes> {
        self.slopes.get(&id).cloned()
    }

    /// The value of a constant node.
    pub fn constant_value(&self, id: ExprId) -> Option<f64> {
        match self.node(id) {
            Node::Constant(bits) => Some(f64::from_bits(bits)),
            _ => None,
        }
    }

    /// Whether the node is the constant `value`.
    pub fn is(&self, id: ExprId, value: f64) -> bool {
        self.constant_value(id) == Some(value)
    }

    /// A constant node with the bound on its rounding error.
    pub(super) fn number(&self, id: ExprId) -> Option<Evaluation> {
        let number = Evaluation::nearest(self.constant_value(id)?);
        Some(match self.rounding.get(&id) {
            Some(&error) => Evaluation { error, ..number },
            None => number,
        })
    }

    /// A number; negative zero becomes zero.
    pub fn constant(&mut self, value: f64) -> ExprId {
        let id = self.intern(Node::Constant((value + 0.0).to_bits()));
        self.rounding.remove(&id);
        id
    }

    /// A number computed from others. If several computations give the same number, the smallest error bound is kept.
    pub(super) fn computed(&mut self, number: Evaluation) -> ExprId {
        let known = self.len();
        let id = self.intern(Node::Constant((number.value + 0.0).to_bits()));
        if id.index() == known {
            self.rounding.insert(id, number.error);
        } else if let Some(error) = self.rounding.get_mut(&id) {
            *error = error.min(number.error);
        }
        id
    }

    /// Zero.
    pub fn zero(&mut self) -> ExprId {
        self.constant(0.0)
    }

    /// A new free variable.
    pub fn symbol(&mut self, name: impl Into<String>, stage: Stage) -> (SymbolId, ExprId) {
        let id = SymbolId::new(self.symbols.len());
        self.symbols.push(Symbol { name: name.into(), stage });
        (id, self.intern(Node::Symbol(id)))
    }

    /// The latest stage that each node depends on.
    pub fn stages(&self) -> Vec<Stage> {
        let mut stages: Vec<Stage> = Vec::with_capacity(self.nodes.len());
        for node in &self.nodes {
            stages.push(match *node {
                Node::Constant(_) => Stage::Constant,
                Node::Symbol(symbol) => self.symbols[symbol.index()].stage,
                Node::Unary(_, a) => stages[a.index()],
                Node::Binary(_, a, b) => stages[a.index()].max(stages[b.index()]),
            });
        }
        stages
    }

    /// The id of a node, if it exists.
    pub(super) fn find(&self, node: Node) -> Option<ExprId> {
        self.interned.find(&self.nodes, node)
    }

    /// The id of a node, created if necessary without simplification.
    pub(super) fn intern(&mut self, node: Node) -> ExprId {
        if let Some(id) = self.find(node) {
            return id;
        }
        let id = ExprId::new(self.nodes.len());
        let support = match node {
            Node::Constant(_) => 0,
            Node::Symbol(symbol) => bit(symbol),
            Node::Unary(_, a) => self.support[a.index()],
            Node::Binary(_, a, b) => self.support[a.index()] | self.support[b.index()],
        };
        self.nodes.push(node);
        self.support.push(support);
        self.named.push(0);
        self.interned.enter_last(&self.nodes);
        id
    }
}

fn bit(symbol: SymbolId) -> u128 {
    1 << (symbol.0 % 128)
}
