//! Checks the kernels of a mechanism against each other. All of them follow from the equations of motion
//! `g(qddot, qdot, q; u, b)`, so [`check`] derives each one again from the kernel `motion_residual` in dual numbers.
//! This needs no oracle and works for any declaration.
//!
//! [`interpreter`] runs kernels without rustc, [`bounded`] is the number type it uses, [`state`] defines the point of
//! comparison, and [`trees`] generates random mechanisms full of special cases.

pub mod bounded;
pub mod check;
pub mod closing;
pub mod interpreter;
pub mod state;
pub mod subject;
pub mod trees;
