//! An evaluation of mechanisms that owes nothing to the compiler, to judge it by.
//!
//! A [`model::Model`] is plain data. [`Oracle`] evaluates it by the paper's matrices, [`energy`] by Lagrange's equations;
//! the two share no kinematics. [`declaration`] prints it in the language, [`random`] makes models nobody thought of,
//! [`examples`] holds the ones with known answers ([`truth`]). [`agreement`] compares anything that offers the
//! [`kernels`] of generated code with the oracle.
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
    Along, Functional, Linear, LinearPartials, ModeFunctional, Motion, Oracle, PencilFunctional,
    Place, ResidualFunctional, Scalar, State,
};
