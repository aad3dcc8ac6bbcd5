//! Random numbers that depend only on seed, stream and index, so that any of them can be generated on any machine.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

/// Number of 32-bit words per number.
const WORDS: u128 = 2;

/// The numbers of one stream of the ChaCha8 generator, in sequence.
///
/// ```
/// use eigentol_statistics::random::RandomNumbers;
///
/// let mut numbers = RandomNumbers::new(7, 0);
/// let first = [numbers.bits(), numbers.bits(), numbers.bits()];
/// assert_eq!(RandomNumbers::starting_at(7, 0, 2).bits(), first[2]);
/// ```
#[derive(Clone, Debug)]
pub struct RandomNumbers(ChaCha8Rng);

impl RandomNumbers {
    /// The numbers of a stream from its start.
    #[must_use]
    pub fn new(seed: u64, stream: u64) -> Self {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        random.set_stream(stream);
        Self(random)
    }

    /// The numbers of a stream from number `index` on.
    #[must_use]
    pub fn starting_at(seed: u64, stream: u64, index: u128) -> Self {
        let mut numbers = Self::new(seed, stream);
        numbers.0.set_word_pos(WORDS * index);
        numbers
    }

    /// The next 64 random bits.
    #[inline]
    pub fn bits(&mut self) -> u64 {
        self.0.next_u64()
    }

    /// The next number as a fraction in [0, 1).
    pub fn fraction(&mut self) -> f64 {
        (self.bits() >> 11) as f64 * 2.0_f64.powi(-53)
    }

    /// The next number as a probability in (0, 1).
    #[inline]
    pub fn probability(&mut self) -> f64 {
        probability(self.bits())
    }
}

/// Converts 64 random bits to a probability strictly between 0 and 1, an odd multiple of `2^-53`.
#[inline]
#[must_use]
pub fn probability(bits: u64) -> f64 {
    ((bits >> 12) as f64 + 0.5) * 2.0_f64.powi(-52)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn probabilities_lie_inside() {
        assert_eq!(probability(0), 2.0_f64.powi(-53));
        assert_eq!(probability(u64::MAX), 1.0 - 2.0_f64.powi(-53));
    }

    #[test]
    fn numbers_are_addressable() {
        let mut numbers = RandomNumbers::new(9, 4);
        for index in 0..40 {
            let bits = numbers.bits();
            assert_eq!(RandomNumbers::starting_at(9, 4, index).bits(), bits);
            assert_ne!(RandomNumbers::starting_at(9, 5, index).bits(), bits);
        }
    }
}
