//! Straight-line code: the operations, their order, and nothing that is not needed.
//!
//! Dead code and common subexpressions are eliminated by construction: a kernel is made from the nodes that its results
//! reach, and equal expressions are one node. This module knows no mechanics.

mod interpret;
mod lower;
mod print;
mod schedule;

pub use lower::lower;

use std::sync::Arc;

use crate::algebra::{Cost, Operator, Stage, Unary};

/// All kernels of a mechanism.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Program {
    /// In the order of the runtime's contract.
    pub kernels: Vec<Kernel>,
}

/// One function as straight-line code.
#[derive(Clone, Debug, PartialEq)]
pub struct Kernel {
    /// Name of the generated method.
    pub name: &'static str,
    /// Arguments.
    pub parameters: Vec<Parameter>,
    /// Instructions; their operands are arguments, constants and earlier instructions.
    pub instructions: Vec<Instruction>,
    /// Results.
    pub results: Vec<Array>,
    /// Total number of operations.
    pub cost: Cost,
}

/// An argument.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    /// Name of the argument.
    pub name: &'static str,
    /// Names of its entries.
    pub entries: Vec<String>,
    /// Whether it is a number rather than an array.
    pub scalar: bool,
}

/// One operation.
#[derive(Clone, Debug, PartialEq)]
pub struct Instruction {
    /// Name given by the derivation.
    pub name: Option<Arc<str>>,
    /// The latest stage of its operands.
    pub stage: Stage,
    /// The operation.
    pub operation: Operation,
}

/// The operation of an instruction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Operation {
    /// A unary operator.
    Unary(Unary, Operand),
    /// A binary operator.
    Binary(Operator, Operand, Operand),
}

/// The source of a value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Operand {
    /// A number.
    Constant(f64),
    /// Entry of an argument: index of the argument, and index of the entry.
    Parameter(usize, usize),
    /// The result of an instruction.
    Instruction(usize),
}

/// A result: nested arrays, flattened with the first index outermost.
#[derive(Clone, Debug, PartialEq)]
pub struct Array {
    /// Name of the result.
    pub name: &'static str,
    /// Lengths, outermost first.
    pub shape: Vec<usize>,
    /// Entries.
    pub values: Vec<Operand>,
}

impl Operation {
    /// The operands, one or two.
    pub fn operands(&self) -> impl Iterator<Item = Operand> {
        let (first, second) = match *self {
            Self::Unary(_, a) => (a, None),
            Self::Binary(_, a, b) => (a, Some(b)),
        };
        std::iter::once(first).chain(second)
    }
}

impl Program {
    /// The kernel with the given name.
    pub fn kernel(&self, name: &str) -> Option<&Kernel> {
        self.kernels.iter().find(|kernel| kernel.name == name)
    }
}

impl Kernel {
    /// Number of operations in each stage that occurs, not counting signs: the savings when only later stages change.
    pub fn cost_by_stage(&self) -> Vec<(Stage, usize)> {
        let mut counts: Vec<(Stage, usize)> = Vec::new();
        for instruction in &self.instructions {
            if matches!(instruction.operation, Operation::Unary(Unary::Negate, _)) {
                continue;
            }
            match counts.binary_search_by_key(&instruction.stage, |&(stage, _)| stage) {
                Ok(position) => counts[position].1 += 1,
                Err(error) => counts.insert(error, (instruction.stage, 1)),
            }
        }
        counts
    }
}
