//! Eigenproblems: `K phi = lambda M phi` with symmetric matrices, and `(s^2 M + s C + K) phi = 0` with any matrices.

mod complex;
mod dense;
mod diagonalise;
pub mod general;
pub mod symmetric;
mod tridiagonal;

pub use complex::eigenvalues;
pub use diagonalise::diagonalise;
pub use general::{
    ApproximatePair, Eigenproblem, Growing, Reference, ReferencePair, Root, growing, roots_near, roots_of,
};
pub use symmetric::{EigenproblemError, INACCURATE, Pairs};
pub use tridiagonal::Tridiagonal;
