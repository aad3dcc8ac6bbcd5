//! Samples of independent standard normal variables: sample `k` is a function of seed, stream and `k` alone.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

use crate::normal::quantile;

/// Draws samples in sequence from a given one on.
pub(super) struct NormalSamples {
    random: ChaCha8Rng,
    sample: Vec<f64>,
}

impl NormalSamples {
    /// Prepares to draw sample `first` of this many variables and its successors.
    pub(super) fn new(seed: u64, stream: u64, first: u64, dimension: usize) -> Self {
        // Two words of 32 bits for each variable, and as many for the choice that comes with each sample.
        let words = 2 * (dimension as u128 + 1);
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        random.set_stream(stream);
        random.set_word_pos(u128::from(first) * words);
        Self {
            random,
            sample: vec![0.0; dimension],
        }
    }

    /// The next sample, without its choice.
    pub(super) fn next_sample(&mut self) -> &[f64] {
        self.next_with_choice().1
    }

    /// The next sample, and a number uniform in (0, 1) that is independent of it.
    pub(super) fn next_with_choice(&mut self) -> (f64, &[f64]) {
        let choice = probability(self.random.next_u64());
        for value in &mut self.sample {
            *value = quantile(probability(self.random.next_u64()));
        }
        (choice, &self.sample)
    }
}

/// A probability strictly inside (0, 1).
fn probability(bits: u64) -> f64 {
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
    fn samples_are_addressable() {
        let mut sequence = NormalSamples::new(7, 2, 0, 3);
        for k in 0..20 {
            let (choice, sample) = sequence.next_with_choice();
            let mut alone = NormalSamples::new(7, 2, k, 3);
            assert_eq!(alone.next_with_choice(), (choice, sample));
            let mut other = NormalSamples::new(7, 3, k, 3);
            assert_ne!(other.next_sample(), sample);
        }
    }

    /// Kolmogorov's distance of 20,000 values from the normal distribution; 1.95 / sqrt(n) is exceeded once in a thousand.
    #[test]
    fn samples_are_normal() {
        let mut samples = NormalSamples::new(5, 0, 0, 2);
        let mut values: Vec<f64> = (0..10_000)
            .flat_map(|_| samples.next_sample().to_vec())
            .collect();
        values.sort_by(f64::total_cmp);
        let number = values.len() as f64;
        let distances = values
            .iter()
            .enumerate()
            .map(|(k, &x)| ((k as f64 + 0.5) / number - crate::normal::cdf(x)).abs());
        assert!(distances.fold(0.0, f64::max) < 1.95 / number.sqrt());
    }
}
