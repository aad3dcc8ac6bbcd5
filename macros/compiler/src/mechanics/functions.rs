//! What mechanics hands on: the functions to generate, and what was proved about them.

use crate::algebra::{Function, Graph};
use crate::base::ids::ExprId;

/// The equations of a mechanism and all that is derived from them, over one graph.
#[derive(Clone, Debug)]
pub struct Functions {
    /// Holds every expression.
    pub graph: Graph,
    /// The kernels, in the order of the runtime's contract.
    pub functions: Vec<Function>,
    /// Physical requirements on inputs and design variables.
    pub requirements: Vec<Requirement>,
    /// What holds for every design, input and position.
    pub properties: Properties,
}

/// A value that must be positive.
#[derive(Clone, Debug)]
pub struct Requirement {
    /// What it is, for example `mass of bar1`.
    pub quantity: String,
    /// What it has to be, in words.
    pub requirement: &'static str,
    /// The value.
    pub value: ExprId,
}

/// What the compiler established: structurally, or at random states up to rounding.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Properties {
    /// `Khat` is symmetric.
    pub symmetric_stiffness: bool,
    /// What `Chat` can be.
    pub damping: Damping,
}

/// What `Chat` can be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Damping {
    /// Zero.
    Zero,
    /// Skew-symmetric.
    Gyroscopic,
    /// Anything else.
    General,
}
