//! Constraints: the roles of the unknowns, the directions that constraints leave free, and which constraints are
//! redundant.
//!
//! # Constraints make unknowns
//!
//! The array `q` of every kernel holds all unknowns of the steady motion: free coordinates, speeds of coasting
//! coordinates, multipliers of constraints (`Role`). The residual has a row for each: equations of motion including
//! constraint forces, then the constraints. Its `Khat`, `Chat`, `Mhat` are the bordered matrices, so every formula for
//! derivatives, adjoint or not, first or second order, holds unchanged, and reactions are unknowns like any other:
//! outputs, with sensitivities and tolerances. Only eigenproblems, stability, descent and counting along branches,
//! which need a regular mass matrix or a definite stiffness, work in the directions that the constraints leave.

mod rows;
mod state;
mod structure;
mod tangent;

pub(crate) use rows::Rows;
pub use state::ConstraintState;
pub(crate) use state::curvature;
#[doc(hidden)]
pub use structure::Structure;
#[doc(hidden)]
pub(crate) use tangent::all_rows;
pub use tangent::{Tangent, fix_gauge, inertias, placed, redundant_rows};

#[cfg(test)]
mod tests;
