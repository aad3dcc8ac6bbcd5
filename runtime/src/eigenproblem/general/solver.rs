//! What finding eigenvalues one by one works on.

use num_complex::Complex64;

use super::linearisation::Linearisation;
use super::pencil::{Pencil, Products};

/// Everything that finding pairs needs, in slices.
pub(super) struct Solver<'a> {
    pub(super) pencil: Pencil<'a>,
    pub(super) linearisation: Linearisation<'a>,
    pub(super) q: &'a mut [Complex64],
    pub(super) order: &'a mut [usize],
    pub(super) of_right: Products<'a>,
    pub(super) of_left: Products<'a>,
    /// `n^2` numbers each, for clusters and solves.
    pub(super) basis_right: &'a mut [Complex64],
    pub(super) basis_left: &'a mut [Complex64],
    pub(super) cross: &'a mut [Complex64],
}
