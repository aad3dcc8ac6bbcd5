//! The data on which eigenvalues are found one by one.

use num_complex::Complex64;

use super::iteration::Iteration;
use super::linearisation::Linearisation;
use super::pencil::{Pencil, Products};

/// All data needed to find pairs, in slices.
pub(super) struct PairSolver<'a> {
    pub(super) pencil: Pencil<'a>,
    pub(super) linearisation: Linearisation<'a>,
    pub(super) q: &'a mut [Complex64],
    pub(super) order: &'a mut [usize],
    pub(super) of_right: Products<'a>,
    pub(super) of_left: Products<'a>,
    /// `n^2` numbers each, for clusters and linear solves.
    pub(super) basis_right: &'a mut [Complex64],
    pub(super) basis_left: &'a mut [Complex64],
    pub(super) cross: &'a mut [Complex64],
    /// For pencils that are not small.
    pub(super) iteration: Option<Iteration<'a>>,
}
