//! Expressions, their algebra and derivatives, and the straight-line programs made from them. It knows no mechanisms.
//!
//! An internal part of `eigentol`. The compiler behind `mechanism!` derives expressions with [`algebra`] and lowers them to
//! a [`program`]. It promises nothing to others.

pub mod algebra;
pub mod base;
pub mod program;
