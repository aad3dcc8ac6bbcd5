//! Eigenproblems: `K phi = lambda M phi` with symmetric matrices, and `(s^2 M + s C + K) phi = 0` with any matrices.

mod complex;
mod dense;
mod diagonalise;
#[doc(hidden)]
pub mod general;
#[doc(hidden)]
pub mod symmetric;
mod tridiagonal;

#[doc(hidden)]
pub use complex::eigenvalues;
#[doc(hidden)]
pub use diagonalise::diagonalise;
#[doc(hidden)]
pub use general::{
    Eigenproblem, Near, Reference, ReferencePair, Root, roots_near, roots_of,
};
#[doc(hidden)]
pub use symmetric::{INACCURATE, Pairs, Trouble};
#[doc(hidden)]
pub use tridiagonal::Tridiagonal;
