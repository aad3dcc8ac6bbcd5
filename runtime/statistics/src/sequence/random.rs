//! Independent points.

use super::bits::open_unit;
use crate::random::RandomNumbers;

/// Points from ChaCha8: coordinate `j` of point `k` is number `k d + j` of the stream.
#[derive(Clone, Debug)]
pub(super) struct Random {
    pub(super) dimensions: usize,
    pub(super) seed: u64,
    pub(super) stream: u64,
}

impl Random {
    /// The generator, positioned at point `k`.
    pub(super) fn at(&self, k: u64) -> RandomNumbers {
        let index = u128::from(k) * self.dimensions as u128;
        RandomNumbers::starting_at(self.seed, self.stream, index)
    }
}

/// Writes the next point.
pub(super) fn draw(random: &mut RandomNumbers, into: &mut [f64]) {
    into.fill_with(|| open_unit(random.bits()));
}
