//! Random designs: sample `k` is a function of seed, stream and `k` alone, so any sample can be drawn on any machine.

use super::Tolerances;
use super::quantile::standard_normal;
use crate::lanes::{Batch, WIDTH};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

/// Draws designs in sequence from a given sample on.
pub(super) struct Draw<'a, const P: usize> {
    random: ChaCha8Rng,
    nominal: &'a [f64; P],
    tolerances: &'a Tolerances<P>,
    /// Whether anything depends on this random number.
    used: [bool; P],
}

impl<'a, const P: usize> Draw<'a, P> {
    /// Prepares to draw sample `first` and its successors; each takes two words of the stream by design variable.
    pub(super) fn from(
        (seed, stream): (u64, u64),
        first: u64,
        nominal: &'a [f64; P],
        tolerances: &'a Tolerances<P>,
    ) -> Self {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        random.set_stream(stream);
        random.set_word_pos(u128::from(first) * 2 * P as u128);
        let factor = tolerances.factor();
        let used = core::array::from_fn(|j| factor.iter().any(|row| row[j] != 0.0));
        Self {
            random,
            nominal,
            tolerances,
            used,
        }
    }

    /// The probabilities that the next `number` samples are made of, up to a batch of them; other places mean
    /// nothing, nor do variables on which nothing depends.
    pub(super) fn probabilities(&mut self, number: usize) -> [Batch; P] {
        let mut probabilities = [Batch::all(0.5); P];
        let mut bytes = [[[0; 8]; P]; WIDTH];
        let filled = bytes[..number.min(WIDTH)].as_flattened_mut();
        self.random.fill_bytes(filled.as_flattened_mut());
        for (j, batch) in probabilities.iter_mut().enumerate() {
            if self.used[j] {
                for (value, bytes) in batch.0.iter_mut().zip(&bytes) {
                    *value = probability(u64::from_le_bytes(bytes[j]));
                }
            }
        }
        probabilities
    }

    pub(super) fn next(&mut self) -> [f64; P] {
        let standard: [f64; P] = core::array::from_fn(|j| {
            let bits = self.random.next_u64();
            if self.used[j] {
                standard_normal(probability(bits))
            } else {
                0.0
            }
        });
        let factor = self.tolerances.factor();
        core::array::from_fn(|i| {
            let row = &factor[i];
            (0..=i).fold(self.nominal[i], |sum, j| sum + row[j] * standard[j])
        })
    }
}

/// A probability strictly inside (0, 1) of 64 random bits, which takes one bit less than a double has.
pub(super) fn probability(bits: u64) -> f64 {
    // As a signed number, which processors convert at once.
    ((bits >> 12).cast_signed() as f64 + 0.5) / (1_u64 << 52) as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends_are_finite_and_symmetric() {
        let value = |bits| standard_normal(probability(bits));
        let (low, high) = (value(0), value(u64::MAX));
        assert!((low + 8.21).abs() < 0.01 && low == -high);
        assert!((value(0x1000_0000_0000_0000) + 1.534_120_544).abs() < 1e-8);
    }

    #[test]
    fn samples_are_addressable() {
        let Ok(tolerances) = Tolerances::new([0.3, 0.6], 3.0, None) else {
            panic!("valid")
        };
        let nominal = [1.0, 2.0];
        let mut sequence = Draw::from((7, 0), 0, &nominal, &tolerances);
        let all: Vec<_> = (0..20).map(|_| sequence.next()).collect();
        for (k, sample) in all.iter().enumerate() {
            let mut alone = Draw::from((7, 0), k as u64, &nominal, &tolerances);
            assert_eq!(*sample, alone.next());
            let mut other = Draw::from((7, 1), k as u64, &nominal, &tolerances);
            assert_ne!(*sample, other.next());
        }
    }
}
