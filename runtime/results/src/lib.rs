//! How results describe themselves as text: aligned columns, digits and units, what matters and what is omitted, and the
//! mechanism and operating point that a result belongs to.
//!
//! An internal part of `eigentol`. It promises nothing to others.

pub mod naming;
pub mod numbers;
pub mod relevance;
mod setters;
pub mod shares;
pub mod table;
pub mod title;
