//! Samples of one batch.

use crate::batched::room::Room;
use crate::kernels::BatchLinear;
use crate::scalar::{Batch, WIDTH};
use crate::tolerance::sampling::Bits;

/// Samples of one batch. Matrices stand row by row.
pub(in crate::tolerance) struct Solved<'a> {
    pub(in crate::tolerance) design: &'a mut [Batch],
    pub(in crate::tolerance) coordinates: &'a mut [Batch],
    pub(in crate::tolerance) frequencies: &'a mut [Batch],
    /// Bit `k`: sample `k` passed every check. Of others only the design means anything.
    pub(in crate::tolerance) accepted: u32,
    /// Random bits, by pair of design variables.
    pub(in crate::tolerance) bits: &'a mut [[Bits; 2]],
    /// How many of them are samples.
    pub(in crate::tolerance) members: usize,
    /// Standard normal numbers, one for each design variable.
    pub(in crate::tolerance) standard: &'a mut [Batch],
    /// They are given, not drawn.
    pub(in crate::tolerance) given: bool,
    /// One for those that passed every check so far.
    pub(super) flags: Batch,
    /// One for those at whose equilibrium Newton's method came to rest.
    pub(super) resting: Batch,
    pub(super) residual: &'a mut [Batch],
    /// In coordinates on the way to the equilibrium, between the nominal modes there.
    pub(super) stiffness: &'a mut [Batch],
    pub(super) mass: &'a mut [Batch],
    /// Without damping.
    pub(super) linear: BatchLinear<'a>,
}

/// What some batches are solved in.
pub(in crate::tolerance) struct Memory {
    numbers: Vec<Batch>,
    bits: Vec<[Bits; 2]>,
}

impl Memory {
    /// For `count` batches of samples of a mechanism with `n` unknowns and `p` design variables.
    pub(in crate::tolerance) fn new(count: usize, n: usize, p: usize) -> Self {
        let pairs = p.div_ceil(2);
        Self {
            numbers: vec![Batch::default(); count * (p + 2 * pairs + 3 * n + 4 * n * n)],
            bits: vec![[[0; WIDTH]; 2]; count * pairs],
        }
    }

    /// The batches.
    pub(in crate::tolerance) fn batches<const COUNT: usize>(
        &mut self,
        n: usize,
        p: usize,
    ) -> [Solved<'_>; COUNT] {
        let pairs = p.div_ceil(2);
        let mut room = Room::new(&mut self.numbers);
        let mut bits = self.bits.chunks_mut(pairs.max(1));
        core::array::from_fn(|_| Solved {
            design: room.take(p),
            coordinates: room.take(n),
            frequencies: room.take(n),
            accepted: 0,
            bits: bits.next().unwrap_or_default(),
            members: 0,
            standard: room.take(2 * pairs),
            given: false,
            flags: Batch::default(),
            resting: Batch::default(),
            residual: room.take(n),
            stiffness: room.take(n * n),
            mass: room.take(n * n),
            linear: BatchLinear {
                mass: room.take(n * n),
                damping: &mut [],
                stiffness: room.take(n * n),
            },
        })
    }
}

impl Solved<'_> {
    /// Whether all samples have come to rest.
    pub(super) fn rests(&self) -> bool {
        self.resting.0[..self.members]
            .iter()
            .all(|rests| *rests >= 1.0)
    }
}
