//! Shared machines and helpers of the tests.
//!
//! Machines: [`corpus`] holds machines declared with the macro, [`machines`] more with closed forms, [`loops`] those
//! with closed loops, [`wheels`] those that roll, [`robots`] published robots, [`fits`] one with all kinds of
//! tolerances, [`every`] one with springs on every free coordinate, and [`tables`] all of them.
//!
//! Helpers: [`generated`] calls their kernels by name, [`dual`] and [`hyper`] differentiate them, and the interpreter
//! of `eigentol_consistency` runs them without rustc. [`compiled`] takes a model of the oracle through the compiler,
//! [`to_oracle_model`] converts a declaration back to such a model, and [`op_counter`] counts the operations of a
//! kernel. `eigentol_rederived` solves a whole problem again in hyper-dual numbers to obtain total derivatives of
//! equilibria, eigenvalues and mode shapes; [`rederived`] holds its machines and operating points. [`sampled`] compares
//! samples solved in vectors with samples solved one by one.

pub mod compiled;
pub mod corpus;
pub mod every;
pub mod fits;
pub mod generated;
pub mod loops;
pub mod machines;
pub mod op_counter;
pub mod rederived;
pub mod robots;
pub mod sampled;
pub mod statically_unstable;
pub mod tables;
pub mod to_oracle_model;
pub mod wheels;

pub use eigentol_rederived::{dual, hyper};

/// The example from the language reference.
#[cfg(doctest)]
#[doc = include_str!("../../macros/REFERENCE.md")]
pub struct Reference;
