//! What the tests share: an evaluation of mechanisms that owes nothing to the compiler, to judge it by.
//!
//! A [`model::Model`] is plain data. [`oracle`] evaluates it by the paper's matrices, [`energy`] by Lagrange's
//! equations; the two share no kinematics. [`declaration`] prints it in the language, [`random`] makes models nobody
//! thought of, [`examples`] holds the ones with known answers ([`truth`]). [`agreement`] compares anything that offers
//! the [`kernels`] of generated code with the oracle.
//!
//! [`corpus`] holds machines declared with the macro, [`machines`] more of them with closed forms, [`loops`] those whose loops
//! close, [`wheels`] those that roll; [`generated`] calls their kernels by name, [`dual`] and [`hyper`] differentiate them,
//! [`interpreter`] runs them without rustc. [`resolved`] solves a whole problem again in hyper-dual numbers: total
//! derivatives of equilibria, eigenvalues and mode shapes.
//!
//! Invariant: the oracle and what it stands on use neither the compiler nor the runtime; `compiled`, [`corpus`],
//! [`machines`] and all that runs them do.

pub mod agreement;
pub mod compiled;
pub mod corpus;
pub mod declaration;
pub mod dual;
pub mod energy;
pub mod examples;
pub mod fixed;
pub mod generated;
pub mod hyper;
pub mod interpreter;
pub mod kernels;
pub mod loops;
pub mod machines;
pub mod model;
mod num_dual;
pub mod oracle;
pub mod random;
pub mod resolved;
pub mod truth;
pub mod unheld;
pub mod wheels;
