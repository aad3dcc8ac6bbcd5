//! What the tests share.
//!
//! [`corpus`] holds machines declared with the macro, [`machines`] more of them with closed forms, [`loops`] those whose loops
//! close, [`wheels`] those that roll, [`robots`] by others, [`fits`] one with all kinds of tolerances, [`every`] one with springs on all that is free; [`generated`] calls their kernels by name, [`dual`] and [`hyper`] differentiate them,
//! the interpreter of `eigentol_consistency` runs them without rustc, [`tables`] has all of them. [`compiled`] takes a model of the oracle through the compiler, [`fixed`] a
//! declaration back to such a model, [`counted`] counts what a kernel does. `eigentol_resolved` solves a whole problem again in hyper-dual numbers: total derivatives of
//! equilibria, eigenvalues and mode shapes; [`resolved`] holds the machines and where they are run. [`sampled`] compares samples in vectors with samples one by one.

pub mod compiled;
pub mod corpus;
pub mod counted;
pub mod every;
pub mod fits;
pub mod fixed;
pub mod generated;
pub mod loops;
pub mod machines;
pub mod resolved;
pub mod robots;
pub mod sampled;
pub mod tables;
pub mod unheld;
pub mod wheels;

pub use eigentol_resolved::{dual, hyper};

/// The example of the language's reference.
#[cfg(doctest)]
#[doc = include_str!("../../macros/REFERENCE.md")]
pub struct Reference;
