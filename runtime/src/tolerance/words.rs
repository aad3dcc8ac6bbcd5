//! The random words of [`ChaCha8Rng`], many blocks of them side by side: the same words, in the vectors of the processor.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

use crate::lanes::{Instructions, Task, Vector};

/// Words of a block (Bernstein 2008).
const BLOCK: usize = 16;
/// Blocks side by side, as many as the widest vectors have lanes for.
const BLOCKS: usize = 16;
/// Numbers of 64 bits in a block.
pub(super) const NUMBERS: usize = BLOCK / 2;

/// A sequence of random words, block after block.
pub(super) struct Words {
    instructions: Instructions,
    /// The block that comes next: constants, key, counter, stream.
    state: [u32; BLOCK],
    /// By word and block.
    words: [[u32; BLOCKS]; BLOCK],
    /// How many of the blocks were given away.
    taken: usize,
}

impl Words {
    /// The words of `seed` and `stream` from block `first` on.
    pub(super) fn from((seed, stream): (u64, u64), first: u64, instructions: Instructions) -> Self {
        let key = ChaCha8Rng::seed_from_u64(seed).get_seed();
        let word = |bytes: &[u8], at: usize| {
            u32::from_le_bytes(core::array::from_fn(|byte| bytes[4 * at + byte]))
        };
        let constant = b"expand 32-byte k";
        let ends = [first, stream].map(halves);
        let state = core::array::from_fn(|k| match k {
            0..4 => word(constant, k),
            4..12 => word(&key, k - 4),
            _ => ends[k / 2 - 6][k % 2],
        });
        Self {
            instructions,
            state,
            words: [[0; BLOCKS]; BLOCK],
            taken: BLOCKS,
        }
    }

    /// The numbers of the next block, with their places in it.
    #[inline(always)]
    pub(super) fn next(&mut self, mut each: impl FnMut(usize, u64)) {
        if self.taken == BLOCKS {
            self.instructions.run(Fill(self));
        }
        let block = self.taken;
        self.taken += 1;
        for k in 0..NUMBERS {
            let [low, high] = [2 * k, 2 * k + 1].map(|word| u64::from(self.words[word][block]));
            each(k, low | high << 32);
        }
    }
}

/// The low and the high word.
#[inline(always)]
fn halves(number: u64) -> [u32; 2] {
    [number as u32, (number >> 32) as u32]
}

struct Fill<'a>(&'a mut Words);

impl Task for Fill<'_> {
    type Output = ();

    /// The lanes are those that the compiler makes of the loop over the blocks.
    #[inline(always)]
    #[allow(clippy::needless_range_loop, reason = "by word, then by block")]
    fn run<V: Vector>(self) {
        let Words {
            state,
            words,
            taken,
            ..
        } = self.0;
        let counter = u64::from(state[12]) | u64::from(state[13]) << 32;
        for block in 0..BLOCKS {
            let mut start = *state;
            [start[12], start[13]] = halves(counter.wrapping_add(block as u64));
            let mut x = start;
            // Eight rounds, written out for the compiler's sake.
            double_round(&mut x);
            double_round(&mut x);
            double_round(&mut x);
            double_round(&mut x);
            for k in 0..BLOCK {
                words[k][block] = x[k].wrapping_add(start[k]);
            }
        }
        [state[12], state[13]] = halves(counter.wrapping_add(BLOCKS as u64));
        *taken = 0;
    }
}

#[inline(always)]
fn double_round(x: &mut [u32; BLOCK]) {
    quarter_round(x, [0, 4, 8, 12]);
    quarter_round(x, [1, 5, 9, 13]);
    quarter_round(x, [2, 6, 10, 14]);
    quarter_round(x, [3, 7, 11, 15]);
    quarter_round(x, [0, 5, 10, 15]);
    quarter_round(x, [1, 6, 11, 12]);
    quarter_round(x, [2, 7, 8, 13]);
    quarter_round(x, [3, 4, 9, 14]);
}

#[inline(always)]
fn quarter_round(x: &mut [u32; BLOCK], [a, b, c, d]: [usize; 4]) {
    x[a] = x[a].wrapping_add(x[b]);
    x[d] = (x[d] ^ x[a]).rotate_left(16);
    x[c] = x[c].wrapping_add(x[d]);
    x[b] = (x[b] ^ x[c]).rotate_left(12);
    x[a] = x[a].wrapping_add(x[b]);
    x[d] = (x[d] ^ x[a]).rotate_left(8);
    x[c] = x[c].wrapping_add(x[d]);
    x[b] = (x[b] ^ x[c]).rotate_left(7);
}

#[cfg(test)]
mod tests {
    use rand_chacha::rand_core::Rng;

    use super::*;

    #[test]
    fn the_words_of_the_generator() {
        for (seed, stream, first) in [
            (0, 0, 0),
            (7, 3, 5),
            (u64::MAX, u64::MAX - 1, u64::from(u32::MAX) - 20),
        ] {
            for instructions in Instructions::available() {
                let mut words = Words::from((seed, stream), first, instructions);
                let mut random = ChaCha8Rng::seed_from_u64(seed);
                random.set_stream(stream);
                random.set_word_pos(u128::from(first) * 16);
                for _ in 0..3 * BLOCKS + 1 {
                    words.next(|_, number| assert_eq!(number, random.next_u64()));
                }
            }
        }
    }
}
