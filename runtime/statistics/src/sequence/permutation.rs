//! Pseudo-random permutations without a table, evaluated one element at a time.

use super::bits::hash;

/// Permutations of the numbers below `n`, one per key: a Feistel network on the next power of two, iterated until the
/// result is below `n` (Black and Rogaway, CT-RSA 2002), then a rotation, which makes the image of each number uniform.
#[derive(Clone, Debug)]
pub(super) struct Permutation {
    n: u64,
    /// Number of digits in the lower and the upper half.
    halves: (u32, u32),
    /// Number of half-rounds of the network. Four are secure on large sets (Luby and Rackoff 1988); with twelve, the
    /// permutations of six numbers are still noticeably unequal in frequency.
    rounds: u64,
}

impl Permutation {
    /// Permutations of the numbers below `n`, which must be between 1 and 2^32.
    pub(super) fn new(n: u64) -> Self {
        let digits = u64::BITS - (n - 1).leading_zeros();
        let low = digits / 2;
        Self { n, halves: (low, digits - low), rounds: if digits < 8 { 24 } else { 12 } }
    }

    /// The image of `k`, which must be below `n`.
    pub(super) fn image(&self, key: u64, k: u64) -> u64 {
        let mut image = self.network(key, k);
        while image >= self.n {
            image = self.network(key, image);
        }
        let rotation = (u128::from(hash(key, u64::MAX)) * u128::from(self.n)) >> 64;
        (image + rotation as u64) % self.n
    }

    fn network(&self, key: u64, x: u64) -> u64 {
        let (low_digits, high_digits) = self.halves;
        let mask = |digits: u32| (1_u64 << digits) - 1;
        let (mut low, mut high) = (x & mask(low_digits), x >> low_digits);
        for round in (0..self.rounds).step_by(2) {
            high ^= hash(key, round << 32 | low) & mask(high_digits);
            low ^= hash(key, (round + 1) << 32 | high) & mask(low_digits);
        }
        high << low_digits | low
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeMap;

    #[test]
    fn every_number_is_hit_once() {
        for n in (1..=70).chain([1000, 1023, 1024, 1025]) {
            let permutation = Permutation::new(n);
            for key in 0..5 {
                let mut images: Vec<u64> = (0..n).map(|k| permutation.image(key, k)).collect();
                images.sort_unstable();
                assert!(images.into_iter().eq(0..n), "{n}");
            }
        }
    }

    /// Chi squared of the number of keys per permutation: mean one per degree of freedom.
    #[test]
    fn all_permutations_of_small_sets_are_equally_frequent() {
        for (n, permutations) in [(2, 2), (3, 6), (4, 24), (5, 120), (6, 720)] {
            let permutation = Permutation::new(n);
            let mut counts = BTreeMap::new();
            let mean = 400.0;
            let keys = 400 * permutations;
            for key in 0..keys {
                let key = hash(3, key);
                let images: Vec<u64> = (0..n).map(|k| permutation.image(key, k)).collect();
                *counts.entry(images).or_insert(0_u32) += 1;
            }
            assert_eq!(counts.len() as u64, permutations);
            let squares: f64 = counts.values().map(|&c| (f64::from(c) - mean).powi(2) / mean).sum();
            let freedom = (permutations - 1) as f64;
            assert!((squares - freedom).abs() < 4.0 * (2.0 * freedom).sqrt(), "{n}: {squares}");
        }
    }

    /// Images of two neighbours, in tenths of the set: chi squared over the hundred cells.
    #[test]
    fn neighbours_part() {
        for n in [250, 1000, 10_000, 1 << 20] {
            let permutation = Permutation::new(n);
            let mut counts = [0.0_f64; 100];
            let keys = 100_000;
            for key in 0..keys {
                let tenth = |k| (permutation.image(hash(5, key), k) * 10 / n) as usize;
                counts[10 * tenth(n / 2) + tenth(n / 2 + 1)] += 1.0;
            }
            // Two numbers in the same tenth are rarer: one fewer number is left for the second.
            let (same, other) = (0.1 * (n as f64 / 10.0 - 1.0), 0.01 * n as f64);
            let squares: f64 = (counts.iter().enumerate())
                .map(|(cell, count)| {
                    let share = if cell % 11 == 0 { same } else { other } / (n as f64 - 1.0);
                    let mean = keys as f64 * share;
                    (count - mean).powi(2) / mean
                })
                .sum();
            assert!((squares - 99.0).abs() < 4.0 * 198.0_f64.sqrt(), "{n}: {squares}");
        }
    }
}
