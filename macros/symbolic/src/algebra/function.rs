//! A function to be generated: named lists of symbols in, named arrays of expressions out.

use super::count::{Cost, cost};
use super::graph::Graph;
use crate::base::ids::{ExprId, SymbolId};

/// A function over one graph.
#[derive(Clone, Debug)]
pub struct Function {
    /// Name of the generated method.
    pub name: &'static str,
    /// Arguments in order.
    pub parameters: Vec<Parameter>,
    /// Results in order.
    pub results: Vec<Array>,
}

/// An argument: an array of symbols, or a single one.
#[derive(Clone, Debug)]
pub struct Parameter {
    /// Name of the argument.
    pub name: &'static str,
    /// The symbols that its entries stand for.
    pub symbols: Vec<SymbolId>,
    /// Whether the argument is a number rather than an array.
    pub scalar: bool,
}

/// A result: nested arrays, flattened with the first index outermost.
#[derive(Clone, Debug)]
pub struct Array {
    /// Name of the result.
    pub name: &'static str,
    /// Lengths, outermost first.
    pub shape: Vec<usize>,
    /// Entries.
    pub values: Vec<ExprId>,
}

impl Function {
    /// All results, one after the other.
    pub fn roots(&self) -> Vec<ExprId> {
        self.results.iter().flat_map(|array| array.values.iter().copied()).collect()
    }

    /// Cost of one evaluation.
    pub fn cost(&self, graph: &Graph) -> Cost {
        cost(graph, &self.roots())
    }
}
