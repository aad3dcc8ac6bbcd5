//! The language of declarations: read, printed, and resolved to the mechanism that they declare.
//!
//! An internal part of `eigentol`, behind the compiler. [`syntax`] turns tokens into a tree and back, [`model`] the tree
//! into a mechanism in the user's terms, with names resolved and values in SI. It knows no equations. It promises nothing
//! to others.

pub mod base;
pub mod include;
pub mod matrix_market;
#[cfg(feature = "locations")]
pub mod mistakes;
pub mod model;
pub mod syntax;
