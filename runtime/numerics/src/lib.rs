//! Dense linear algebra and quadratic eigenvalue problems with error bounds. Nothing here knows a mechanism.
//!
//! An internal part of `eigentol`, which re-exports what its users need. It promises nothing to others.

pub mod algebra;
pub mod eigenproblem;
pub mod linear;
pub mod rounding;

use eigentol_contract::scalar;

pub use num_complex::Complex64 as Complex;
