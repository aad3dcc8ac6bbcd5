//! One piece of memory for all the lists and matrices of a block: as much as they need together, found at once.

use crate::scalar::Batch;

/// Memory of which pieces are taken, one after the other.
pub(crate) struct Room<'a> {
    rest: &'a mut [Batch],
}

impl<'a> Room<'a> {
    pub(crate) fn new(rest: &'a mut [Batch]) -> Self {
        Self { rest }
    }

    /// The next `count` batches.
    pub(crate) fn take(&mut self, count: usize) -> &'a mut [Batch] {
        let (taken, rest) = core::mem::take(&mut self.rest).split_at_mut(count);
        self.rest = rest;
        taken
    }

    /// Numbers that are the same in every lane.
    pub(crate) fn constants(&mut self, values: &[f64]) -> &'a mut [Batch] {
        let taken = self.take(values.len());
        for (place, value) in taken.iter_mut().zip(values) {
            *place = Batch::all(*value);
        }
        taken
    }
}
