//! Designs at given points of the standard normal space, solved side by side.

use super::Tolerances;
use super::batched::{Memory, Prepared, Size, TOGETHER};
use super::normal_sampling::GREATEST_NORMAL;
use crate::algebra::Vector;
use crate::kernels::BatchKernels;
use crate::scalar::{Instructions, WIDTH};
use crate::{Complex, Equilibrium, Error, Modes};

/// Solves designs about a nominal state in vectors.
#[doc(hidden)]
pub struct SideBySide<'a> {
    prepared: Prepared<'a>,
    vectors: Instructions,
    size: Size,
}

/// Workspace of one thread.
#[doc(hidden)]
pub struct DesignWorkspace(Memory);

/// A design that passed every check.
#[doc(hidden)]
pub struct SolvedDesign<'a> {
    /// Its equilibrium.
    pub coordinates: &'a [f64],
    /// Its eigenvalues, 1/s, in the order of the nominal modes.
    pub eigenvalues: &'a [Complex],
}

impl<'a> SideBySide<'a> {
    /// Maximum number of designs solved together.
    #[doc(hidden)]
    pub const MOST: usize = TOGETHER * WIDTH;

    /// `None` if designs must be solved one by one.
    #[doc(hidden)]
    pub fn new(
        mechanism: &'a dyn BatchKernels,
        nominal: &'a Equilibrium,
        modes: &Modes,
        tolerances: &'a Tolerances,
        vectors: Instructions,
    ) -> Option<Self> {
        Some(Self {
            prepared: Prepared::new(mechanism, (nominal, modes), tolerances)?,
            vectors,
            size: Size::of(nominal, modes),
        })
    }

    #[doc(hidden)]
    pub fn room(&self) -> DesignWorkspace {
        DesignWorkspace(Memory::new(TOGETHER, self.size))
    }

    /// Solves up to [`Self::MOST`] designs, each given by a row of standard normal numbers. Calls `each` with the
    /// position, the design, and its solution: `None` if the design must be solved alone.
    #[doc(hidden)]
    pub fn solve(
        &self,
        DesignWorkspace(memory): &mut DesignWorkspace,
        rows: &[Vector],
        mut each: impl FnMut(usize, &[f64], Option<SolvedDesign<'_>>) -> Result<(), Error>,
    ) -> Result<(), Error> {
        let mut together = memory.batches::<TOGETHER>(self.size);
        let count = rows.len().div_ceil(WIDTH).min(TOGETHER);
        for (batch, rows) in together.iter_mut().zip(rows.chunks(WIDTH)) {
            batch.members = rows.len();
            batch.given = true;
            for (member, row) in rows.iter().enumerate() {
                for (slot, z) in batch.standard.iter_mut().zip(row) {
                    slot.0[member] = *z;
                }
            }
        }
        self.prepared.solve(self.vectors, &mut together[..count]);
        let mut design = Vector::zeros(self.size.design);
        let mut coordinates = Vector::zeros(self.size.unknowns);
        let mut eigenvalues = vec![Complex::ZERO; self.size.modes];
        for (k, row) in rows.iter().enumerate() {
            let (batch, member) = (&together[k / WIDTH], k % WIDTH);
            for (value, all) in design.iter_mut().zip(&*batch.design) {
                *value = all.0[member];
            }
            for (coordinate, all) in coordinates.iter_mut().zip(&*batch.coordinates) {
                *coordinate = all.0[member];
            }
            for (eigenvalue, s) in eigenvalues.iter_mut().zip(batch.eigenvalues(member)) {
                *eigenvalue = s;
            }
            // The check of which designs can exist only covered numbers below this bound.
            let usual = row.iter().all(|z| z.abs() < GREATEST_NORMAL);
            let solved = usual && batch.accepted >> member & 1 == 1;
            let solved_design = SolvedDesign { coordinates: &coordinates, eigenvalues: &eigenvalues };
            each(k, &design, solved.then_some(solved_design))?;
        }
        Ok(())
    }
}
