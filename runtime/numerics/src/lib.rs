//! Dense linear algebra and quadratic eigenvalue problems with error bounds. Nothing here knows a mechanism.
//!
//! An internal part of `eigentol`, which re-exports what its users need. It promises nothing to others.

// Tests share files with those of another crate.
#[cfg(test)]
extern crate self as eigentol_numerics;

#[doc(hidden)]
pub mod algebra;
#[doc(hidden)]
pub mod eigenproblem;
#[doc(hidden)]
pub mod linear;
#[doc(hidden)]
pub mod rounding;

use eigentol_contract::scalar;

pub use algebra::{Matrix, Vector};
pub use num_complex::Complex64 as Complex;
