//! Constraints: which unknowns are what, which directions they leave free, and which of them say the same.

mod rows;
mod structure;
mod tangent;

pub(crate) use rows::Rows;
pub(crate) use structure::Structure;
pub(crate) use tangent::{Tangent, fix_gauge, reduce};

#[cfg(test)]
mod tests;
