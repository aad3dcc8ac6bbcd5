//! A single piece of memory for all lists and matrices of a block, allocated at once.

use crate::scalar::Batch;

/// Memory from which pieces are taken one after the other.
pub(crate) struct BatchArena<'a> {
    rest: &'a mut [Batch],
}

impl<'a> BatchArena<'a> {
    pub(crate) fn new(rest: &'a mut [Batch]) -> Self {
        Self { rest }
    }

    /// Takes the next `count` batches.
    pub(crate) fn take(&mut self, count: usize) -> &'a mut [Batch] {
        let (taken, rest) = core::mem::take(&mut self.rest).split_at_mut(count);
        self.rest = rest;
        taken
    }

    /// Takes batches that hold the same number in every lane.
    pub(crate) fn constants(&mut self, values: &[f64]) -> &'a mut [Batch] {
        let taken = self.take(values.len());
        for (slot, value) in taken.iter_mut().zip(values) {
            *slot = Batch::all(*value);
        }
        taken
    }
}
