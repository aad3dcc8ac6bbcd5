//! Eigenproblems: `K phi = lambda M phi` with symmetric matrices, and `(s^2 M + s C + K) phi = 0` with any matrices.

mod complex;
mod dense;
mod diagonalise;
pub(crate) mod general;
pub(crate) mod symmetric;
mod tridiagonal;

pub(crate) use complex::eigenvalues;
pub(crate) use diagonalise::diagonalise;
pub(crate) use general::{
    Eigenproblem, Near, Reference, ReferencePair, Root, roots_near, roots_of,
};
pub(crate) use symmetric::{INACCURATE, Pairs, Trouble};
pub(crate) use tridiagonal::Tridiagonal;
