//! The general eigenproblem `(s^2 M + s C + K) phi = 0`, `psi^T (s^2 M + s C + K) = 0` with symmetric positive definite
//! `M` and any real `C` and `K`; also `A phi = s phi`, the case `M = 0`, `C = I`, `K = -A`.
//!
//! The eigenvalues come from a bounded QR iteration on a balanced linearisation (`schur`), the vectors and the last
//! digits from the pencil itself (`pair`). Eigenvalues that the pencil cannot distinguish are merged (`cluster`),
//! every error is estimated (`accuracy`), and eigenvalues that are still inaccurate are found by a second method
//! (`aberth`). No library does this well enough: nalgebra's general Schur form is not bounded and has no vectors, and
//! faer's left vectors fail where eigenvalues meet.
//!
//! # The quadratic pencil is solved as it is
//!
//! Its linearisation gives starting values; pairs are checked, and polished if necessary, on `s^2 Mhat + s Chat + Khat`
//! itself, left and right, with a fallback method and an estimated error on every eigenvalue. That error decides what
//! counts as zero: whether a mode is neutral, whether an oscillation keeps its amplitude. No library does this:
//! nalgebra's nonsymmetric Schur form may not converge and has no vectors; faer's left vectors are wrong on degenerate
//! matrices, and it builds for minutes.

#![allow(clippy::needless_range_loop, reason = "index loops read as the formulas they are")]

mod aberth;
mod accuracy;
mod census;
mod cluster;
mod driver;
mod eigenspaces;
mod gyroscopic;
mod hessenberg;
mod iteration;
mod linearisation;
mod lu;
mod measure;
mod order;
mod pair;
mod pencil;
mod polished;
mod powers;
mod prediction;
mod reference;
mod scaled_pencil;
mod scaling;
mod schur;
mod scratch;
mod search;
mod shifted;
mod signs;
mod solver;
#[cfg(test)]
pub(crate) mod tests;

use num_complex::Complex64;

pub use driver::{solve as roots_of, solve_near as roots_near};
pub use prediction::ApproximatePair;
pub use reference::{Reference, ReferencePair};
pub use scaled_pencil::Eigenproblem;
pub use schur::eigenvalues as hessenberg_eigenvalues;
pub use signs::{Growing, growing};

use super::symmetric::EigenproblemError;
use crate::algebra::Vector;
use crate::linear::Linear;

/// One eigenvalue, or one of a conjugate pair, with its vectors.
#[derive(Clone, Debug, PartialEq)]
pub struct Root {
    /// Eigenvalue, 1/s; `Im s >= 0`.
    pub s: Complex64,
    /// `phi` with `phi^H M phi = 1` and its largest component real and positive.
    pub right: Vector<Complex64>,
    /// `psi`, normalised in the same way.
    pub left: Vector<Complex64>,
    /// Largest component of `Q(s) phi` and of `psi^T Q(s)`, relative to the terms in it.
    pub residual: f64,
    /// Estimated absolute error of `s`.
    pub error: f64,
    /// Condition number of `s` as an eigenvalue of the balanced linearisation; infinite for a defective one.
    pub condition: f64,
}

/// Solves the general eigenproblem of `linear`.
pub fn solve(linear: &Linear) -> Result<Vec<Root>, EigenproblemError> {
    driver::solve(Eigenproblem::Quadratic(linear))
}
