//! Independent points.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::Rng;

use super::bits::{generator, open_unit};

/// Points of ChaCha8: coordinate `j` of point `k` is number `k d + j` of the stream.
#[derive(Clone, Debug)]
pub(super) struct Random {
    pub(super) dimensions: usize,
    pub(super) seed: u64,
    pub(super) stream: u64,
}

impl Random {
    /// The generator at point `k`. A coordinate takes two words.
    pub(super) fn at(&self, k: u64) -> ChaCha8Rng {
        let mut random = generator(self.seed, self.stream);
        random.set_word_pos(u128::from(k) * 2 * self.dimensions as u128);
        random
    }
}

/// Writes the point the generator stands at, and goes on to the next.
pub(super) fn draw(random: &mut ChaCha8Rng, into: &mut [f64]) {
    into.fill_with(|| open_unit(random.next_u64()));
}
