//! Samples of one batch.

use crate::batched::room::BatchArena;
use crate::kernels::BatchLinear;
use crate::modes::{Family, in_order};
use crate::scalar::{Batch, WIDTH};
use crate::tolerance::sampling::Bits;
use crate::{Complex, Equilibrium, Modes};

/// Samples of one batch. Matrices are stored row by row.
pub(in crate::tolerance) struct SampleBatch<'a> {
    pub(in crate::tolerance) design: &'a mut [Batch],
    pub(in crate::tolerance) coordinates: &'a mut [Batch],
    /// `Im s` of each nominal mode.
    pub(in crate::tolerance) frequencies: &'a mut [Batch],
    /// `Re s`; zero for undamped modes.
    pub(in crate::tolerance) rates: &'a mut [Batch],
    /// Bit `k` is set if sample `k` passed every check. For others only the design is meaningful.
    pub(in crate::tolerance) accepted: u32,
    /// Random bits, by pair of design variables.
    pub(in crate::tolerance) bits: &'a mut [[Bits; 2]],
    /// Number of lanes that hold samples.
    pub(in crate::tolerance) members: usize,
    /// Standard normal numbers, one for each design variable.
    pub(in crate::tolerance) standard: &'a mut [Batch],
    /// The normal numbers are given, not drawn.
    pub(in crate::tolerance) given: bool,
    /// One for samples that have passed every check so far.
    pub(super) flags: Batch,
    /// One for samples at whose equilibrium Newton's method has come to rest.
    pub(super) resting: Batch,
    pub(super) residual: &'a mut [Batch],
    /// In coordinates on the way to the equilibrium; in the basis of the undamped nominal modes there.
    pub(super) stiffness: &'a mut [Batch],
    pub(super) mass: &'a mut [Batch],
    /// Without damping if modes are undamped.
    pub(super) linear: BatchLinear<'a>,
}

/// Workspace for several batches.
pub(in crate::tolerance) struct Memory {
    numbers: Vec<Batch>,
    bits: Vec<[Bits; 2]>,
}

/// Dimensions of a batch.
#[derive(Clone, Copy)]
pub(in crate::tolerance) struct Size {
    pub(in crate::tolerance) unknowns: usize,
    pub(in crate::tolerance) design: usize,
    pub(in crate::tolerance) modes: usize,
    pub(in crate::tolerance) damped: bool,
}

impl Size {
    /// Dimensions for samples about a nominal state.
    pub(in crate::tolerance) fn of(nominal: &Equilibrium, modes: &Modes) -> Self {
        Self {
            unknowns: nominal.coordinates.len(),
            design: nominal.design.len(),
            modes: modes.modes.len(),
            damped: modes.family == Family::General,
        }
    }

    /// Number of elements of a damping matrix.
    fn damping(self) -> usize {
        self.unknowns * self.unknowns * usize::from(self.damped)
    }
}

impl Memory {
    /// Workspace for `count` batches of samples.
    pub(in crate::tolerance) fn new(count: usize, size: Size) -> Self {
        let (n, p) = (size.unknowns, size.design);
        let pairs = p.div_ceil(2);
        let of_each = p + 2 * pairs + 2 * n + 2 * size.modes + 4 * n * n + size.damping();
        Self { numbers: vec![Batch::default(); count * of_each], bits: vec![[[0; WIDTH]; 2]; count * pairs] }
    }

    /// The batches.
    pub(in crate::tolerance) fn batches<const COUNT: usize>(&mut self, size: Size) -> [SampleBatch<'_>; COUNT] {
        let (n, p) = (size.unknowns, size.design);
        let pairs = p.div_ceil(2);
        let mut room = BatchArena::new(&mut self.numbers);
        let mut bits = self.bits.chunks_mut(pairs.max(1));
        core::array::from_fn(|_| SampleBatch {
            design: room.take(p),
            coordinates: room.take(n),
            frequencies: room.take(size.modes),
            rates: room.take(size.modes),
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
                damping: room.take(size.damping()),
                stiffness: room.take(n * n),
            },
        })
    }
}

impl SampleBatch<'_> {
    /// Eigenvalues of a member, 1/s, in the order of the nominal modes.
    pub(in crate::tolerance) fn eigenvalues(&self, member: usize) -> impl Iterator<Item = Complex> {
        self.rates.iter().zip(&*self.frequencies).map(move |(re, im)| Complex::new(re.0[member], im.0[member]))
    }

    /// Puts the modes of a group of equal nominal ones in ascending order, in every member.
    pub(super) fn put_in_order(&mut self, group: &[usize]) {
        for k in 0..self.members {
            let size = |this: &Self, r: usize| this.rates[r].0[k].hypot(this.frequencies[r].0[k]);
            in_order(group, self, size, |item, i, j| {
                for parts in [&mut *item.rates, &mut *item.frequencies] {
                    let (a, b) = (parts[i].0[k], parts[j].0[k]);
                    (parts[i].0[k], parts[j].0[k]) = (b, a);
                }
            });
        }
    }

    /// Accepts the members that have passed every check so far.
    pub(super) fn accept(&mut self) {
        let passed = self.flags.0[..self.members].iter().enumerate().map(|(k, flag)| u32::from(*flag >= 1.0) << k);
        self.accepted = passed.sum();
    }

    /// Whether all samples have come to rest.
    pub(super) fn rests(&self) -> bool {
        self.resting.0[..self.members].iter().all(|rests| *rests >= 1.0)
    }
}
