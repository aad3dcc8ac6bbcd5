//! The general eigenproblem `(s^2 M + s C + K) phi = 0`, `psi^T (s^2 M + s C + K) = 0` with `M` symmetric positive
//! definite and any real `C` and `K`, by code that is compiled once in this crate; the same for `A phi = s phi`, which is
//! the case `M = 0`, `C = I`, `K = -A`.
//!
//! The eigenvalues come from a bounded QR iteration on a balanced linearisation ([`schur`]), the vectors and the last
//! digits from the pencil itself ([`pair`]); what the pencil cannot tell apart is merged ([`cluster`]), every error is
//! estimated ([`accuracy`]), and what remains inaccurate is found by a second method ([`aberth`]). No library does this
//! well enough: nalgebra's general Schur form is not bounded and has no vectors, faer's left vectors fail where
//! eigenvalues meet.

#![allow(
    clippy::needless_range_loop,
    reason = "index loops read as the formulas they are"
)]

mod aberth;
mod accuracy;
mod cluster;
mod driver;
mod eigenspaces;
mod hessenberg;
mod linearisation;
mod lu;
mod measure;
mod order;
mod pair;
mod pencil;
mod problem;
mod scaling;
mod schur;
mod scratch;
#[cfg(test)]
mod tests;

use num_complex::Complex64;

pub(super) use driver::{Numbers, solve as solve_on};
pub(super) use problem::Eigenproblem;

use super::symmetric::Trouble;
use crate::Linear;

/// One eigenvalue, or one of a conjugate pair, with its vectors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Root<const N: usize> {
    /// Eigenvalue, 1/s; `Im s >= 0`.
    pub(crate) s: Complex64,
    /// `phi` with `phi^H M phi = 1`, largest component real and positive.
    pub(crate) right: [Complex64; N],
    /// `psi`, normalised in the same way.
    pub(crate) left: [Complex64; N],
    /// Greatest component of `Q(s) phi` and of `psi^T Q(s)` relative to the terms in it.
    pub(crate) residual: f64,
    /// Estimated absolute error of `s`.
    pub(crate) error: f64,
    /// Condition number of `s` as an eigenvalue of the balanced linearisation; infinite for a defective one.
    pub(crate) condition: f64,
}

/// The roots with `Im s >= 0`: conjugates are left out, so that there are between `N` and `2 N`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Roots<const N: usize> {
    roots: [[Root<N>; 2]; N],
    count: usize,
}

impl<const N: usize> Roots<N> {
    pub(super) const EMPTY: Self = Self {
        roots: [[Root {
            s: Complex64::ZERO,
            right: [Complex64::ZERO; N],
            left: [Complex64::ZERO; N],
            residual: 0.0,
            error: 0.0,
            condition: 1.0,
        }; 2]; N],
        count: 0,
    };

    /// Adds one of at most `2 N`.
    pub(super) fn push(&mut self, root: Root<N>) {
        if let Some(place) = self.roots.as_flattened_mut().get_mut(self.count) {
            *place = root;
            self.count += 1;
        }
    }

    /// Ascending in `|s|`, those of equal size by `Im s`, then by `Re s`.
    pub(crate) fn as_slice(&self) -> &[Root<N>] {
        &self.roots.as_flattened()[..self.count]
    }
}

/// Solves the general eigenproblem of `linear`.
pub(crate) fn solve<const N: usize>(linear: &Linear<f64, N>) -> Result<Roots<N>, Trouble> {
    let mut roots = Roots::EMPTY;
    let mut numbers = [[Numbers::NONE; 2]; N];
    let mut right = [[[Complex64::ZERO; N]; 2]; N];
    let mut left = right;
    roots.count = driver::solve(
        Eigenproblem::of(linear),
        numbers.as_flattened_mut(),
        right.as_flattened_mut().as_flattened_mut(),
        left.as_flattened_mut().as_flattened_mut(),
    )?;
    let vectors = right.as_flattened().iter().zip(left.as_flattened());
    let places = roots.roots.as_flattened_mut().iter_mut();
    for ((root, numbers), (right, left)) in places.zip(numbers.as_flattened()).zip(vectors) {
        *root = Root {
            s: numbers.s,
            right: *right,
            left: *left,
            residual: numbers.residual,
            error: numbers.error,
            condition: numbers.condition,
        };
    }
    Ok(roots)
}
