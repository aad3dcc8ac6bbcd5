//! Samples of one batch.

use crate::algebra::{Matrix, Vector};
use crate::kernels::Linear;
use crate::scalar::{Batch, WIDTH};
use crate::tolerance::sampling::Bits;

/// Samples of one batch.
pub(in crate::tolerance) struct Solved {
    pub(in crate::tolerance) design: Vector<Batch>,
    pub(in crate::tolerance) coordinates: Vector<Batch>,
    pub(in crate::tolerance) frequencies: Vector<Batch>,
    /// Bit `k`: sample `k` passed every check. Of others only the design means anything.
    pub(in crate::tolerance) accepted: u32,
    /// Random bits, by pair of design variables.
    pub(in crate::tolerance) bits: Vec<[Bits; 2]>,
    /// How many of them are samples.
    pub(in crate::tolerance) members: usize,
    /// Standard normal numbers, one for each design variable.
    pub(super) standard: Vector<Batch>,
    /// One for those that passed every check so far.
    pub(super) flags: Batch,
    /// One for those at whose equilibrium Newton's method came to rest.
    pub(super) resting: Batch,
    pub(super) residual: Vector<Batch>,
    /// In coordinates on the way to the equilibrium, between the nominal modes there.
    pub(super) stiffness: Matrix<Batch>,
    pub(super) mass: Matrix<Batch>,
    pub(super) linear: Linear<Batch>,
}

impl Solved {
    /// Room for samples of a mechanism with `n` unknowns and `p` design variables.
    pub(in crate::tolerance) fn new(n: usize, p: usize) -> Self {
        Self {
            design: Vector::zeros(p),
            coordinates: Vector::zeros(n),
            frequencies: Vector::zeros(n),
            accepted: 0,
            bits: vec![[[0; WIDTH]; 2]; p.div_ceil(2)],
            members: 0,
            standard: Vector::zeros(2 * p.div_ceil(2)),
            flags: Batch::default(),
            resting: Batch::default(),
            residual: Vector::zeros(n),
            stiffness: Matrix::zeros(n, n),
            mass: Matrix::zeros(n, n),
            linear: Linear::zeros(n),
        }
    }

    /// Whether all samples have come to rest.
    pub(super) fn rests(&self) -> bool {
        self.resting.0[..self.members]
            .iter()
            .all(|rests| *rests >= 1.0)
    }
}
