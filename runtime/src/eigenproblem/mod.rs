//! Eigenproblems: `K phi = lambda M phi` with symmetric matrices, and `(s^2 M + s C + K) phi = 0` with any matrices.

mod dense;
pub(crate) mod general;
mod jacobi;
mod refine;
mod residual;
pub(crate) mod symmetric;
mod tridiagonal;

pub(crate) use general::{
    Eigenproblem, Near, Reference, ReferencePair, Root, roots_near, roots_of,
};
pub(crate) use jacobi::diagonalise;
pub(crate) use symmetric::{INACCURATE, Pairs, Trouble};
pub(crate) use tridiagonal::Tridiagonal;
