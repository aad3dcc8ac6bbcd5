//! Constraints: the roles of the unknowns, the directions that constraints leave free, and which constraints are
//! redundant.

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
