//! Samples of independent standard normal variables: sample `k` depends only on seed, stream and `k`.

use crate::normal::quantile;
use crate::random::RandomNumbers;

/// Generates samples in sequence, starting at a given one.
pub(super) struct NormalSamples {
    random: RandomNumbers,
    sample: Vec<f64>,
}

impl NormalSamples {
    /// Prepares to generate samples of this many variables, starting at sample `first`.
    pub(super) fn new(seed: u64, stream: u64, first: u64, dimension: usize) -> Self {
        // One number per variable, and one for the choice that accompanies each sample.
        let numbers = dimension as u128 + 1;
        Self {
            random: RandomNumbers::starting_at(seed, stream, u128::from(first) * numbers),
            sample: vec![0.0; dimension],
        }
    }

    /// The next sample, without its choice.
    pub(super) fn next_sample(&mut self) -> &[f64] {
        self.next_with_choice().1
    }

    /// The next sample, and an independent number uniform in (0, 1).
    pub(super) fn next_with_choice(&mut self) -> (f64, &[f64]) {
        let choice = self.random.probability();
        for value in &mut self.sample {
            *value = quantile(self.random.probability());
        }
        (choice, &self.sample)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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

    /// Kolmogorov distance of 20,000 values from the normal distribution; 1.95 / sqrt(n) is exceeded once in a
    /// thousand.
    #[test]
    fn samples_are_normal() {
        let mut samples = NormalSamples::new(5, 0, 0, 2);
        let mut values: Vec<f64> = (0..10_000).flat_map(|_| samples.next_sample().to_vec()).collect();
        values.sort_by(f64::total_cmp);
        let number = values.len() as f64;
        let distances =
            values.iter().enumerate().map(|(k, &x)| ((k as f64 + 0.5) / number - crate::normal::cdf(x)).abs());
        assert!(distances.fold(0.0, f64::max) < 1.95 / number.sqrt());
    }
}
