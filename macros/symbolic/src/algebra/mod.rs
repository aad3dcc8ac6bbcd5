//! Symbolic scalars: one hash-consed graph, simplified as it grows, differentiated without ever being expanded.
//!
//! Architecture invariant: this module knows no mechanics and imports only `base`.

mod build;
mod count;
mod disturbed;
mod evaluate;
mod evaluation;
mod forward;
mod function;
mod graph;
mod interner;
mod node;
mod node_map;
mod null_space;
mod reached;
mod regroup;
mod reverse;
mod rules;
mod substitute;
mod vector;

pub use count::{Cost, cost};
pub use disturbed::{Disturbed, Evaluator};
pub use evaluate::evaluate;
pub use forward::{Direction, derivatives_along};
pub use function::{Array, Function, Parameter};
pub use graph::{Graph, Stage, Symbol};
pub use node::Node;
pub use null_space::{NullSpace, scale, times};
pub use reached::Reached;
pub use regroup::{regroup, regrouped};
pub use reverse::{gradient, rough};
pub use rules::{Rule, TABLES, Table};
pub use substitute::substitute;
pub use vector::{Matrix3, Vector3};

pub use crate::base::ids::{ExprId, SymbolId};
pub use crate::base::operators::{Operator, Unary};

#[cfg(test)]
mod tests;
