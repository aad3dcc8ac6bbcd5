//! Symbolic scalars: one hash-consed graph, simplified as it grows, differentiated without ever being expanded.
//!
//! Architecture invariant: this wing knows no mechanics and imports only `base`.

mod count;
mod evaluate;
mod forward;
mod function;
mod graph;
mod regroup;
mod reverse;
mod rules;
mod substitute;
mod vector;

pub use count::{Cost, cost, reachable};
pub use evaluate::{Evaluation, evaluate, evaluate_with_error};
pub(crate) use evaluate::{apply_binary, apply_unary};
pub use forward::{Direction, derivatives_along};
pub use function::{Array, Function, Parameter};
pub use graph::{Graph, Node, Operator, Stage, Symbol, Unary};
pub use regroup::{regroup, regrouped};
pub use reverse::gradient;
pub use rules::{Rule, TABLES, Table};
pub use substitute::substitute;
pub use vector::{Matrix3, Vector3};

#[cfg(test)]
mod tests;
