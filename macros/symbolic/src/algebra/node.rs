//! The nodes of the expression graph.

use crate::base::ids::{ExprId, SymbolId};
use crate::base::operators::{Operator, Unary};

/// A node. Constants are stored as bits so that nodes compare and hash exactly.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Node {
    /// A number, as `f64::to_bits`.
    Constant(u64),
    /// A free variable.
    Symbol(SymbolId),
    /// A unary operator and its operand.
    Unary(Unary, ExprId),
    /// A binary operator and its operands; those of commutative operators are in order of id.
    Binary(Operator, ExprId, ExprId),
}
