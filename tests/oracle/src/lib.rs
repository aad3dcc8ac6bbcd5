//! Evaluates mechanisms independently of the compiler, as a reference to judge it by.
//!
//! A [`model::Model`] is plain data. [`Oracle`] evaluates it by the paper's matrices, [`energy`] by Lagrange's
//! equations; the two share no kinematics. [`declaration`] prints a model in the language, [`random`] generates models
//! that nobody would think of, and [`examples`] holds models with known solutions ([`truth`]). [`agreement`] compares
//! any implementation of the generated code's [`kernels`] with the oracle.
//!
//! Invariant: nothing here depends on the compiler or the runtime.

pub mod agreement;
pub mod declaration;
pub mod energy;
pub mod examples;
pub mod kernels;
mod matrices;
pub mod model;
pub mod random;
pub mod truth;

pub use matrices::{
    Along, Functional, Linear, LinearPartials, ModeFunctional, Motion, Oracle, PencilFunctional, Place,
    ResidualFunctional, Scalar, State,
};
