//! Sums over samples, which can be joined.

/// An estimate with its standard error.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Estimate {
    /// The estimate.
    pub value: f64,
    /// Its estimated standard deviation over repetitions with other seeds.
    pub standard_error: f64,
}

/// Sum and sum of squares.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Moments {
    pub(super) sum: f64,
    pub(super) squares: f64,
}

impl Moments {
    fn add(&mut self, value: f64) {
        self.sum += value;
        self.squares += value * value;
    }

    fn join(&mut self, other: &Self) {
        self.sum += other.sum;
        self.squares += other.squares;
    }

    /// The mean of `samples` values, of which those not added are zero.
    pub(super) fn mean(&self, samples: u64) -> Estimate {
        let n = samples as f64;
        let value = self.sum / n;
        let variance = (self.squares / n - value * value).max(0.0);
        let standard_error = (variance / (n - 1.0).max(1.0)).sqrt();
        Estimate { value, standard_error }
    }
}

/// Sums over a range of samples. Ranges joined in the same order give the same bits, wherever they were computed.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SampleSums {
    pub(super) samples: u64,
    pub(super) failures: u64,
    pub(super) without_value: u64,
    pub(super) weights: Moments,
    pub(super) weights_without_value: Moments,
    /// Derivatives with respect to the mean and to the standard deviation of each variable.
    pub(super) by_mean: Vec<Moments>,
    pub(super) by_sigma: Vec<Moments>,
}

impl SampleSums {
    pub(super) fn new(dimension: usize) -> Self {
        Self {
            samples: 0,
            failures: 0,
            without_value: 0,
            weights: Moments::default(),
            weights_without_value: Moments::default(),
            by_mean: vec![Moments::default(); dimension],
            by_sigma: vec![Moments::default(); dimension],
        }
    }

    pub(super) fn add_failure(&mut self, z: &[f64], weight: f64) {
        self.failures += 1;
        self.weights.add(weight);
        for ((z, mean), sigma) in z.iter().zip(&mut self.by_mean).zip(&mut self.by_sigma) {
            mean.add(weight * z);
            sigma.add(weight * (z * z - 1.0));
        }
    }

    pub(super) fn add_without_value(&mut self, weight: f64) {
        self.without_value += 1;
        self.weights_without_value.add(weight);
    }

    /// Adds the sums over another range of the same sampler.
    pub fn join(&mut self, other: &Self) {
        self.samples += other.samples;
        self.failures += other.failures;
        self.without_value += other.without_value;
        self.weights.join(&other.weights);
        self.weights_without_value.join(&other.weights_without_value);
        for (sum, other) in self.by_mean.iter_mut().zip(&other.by_mean) {
            sum.join(other);
        }
        for (sum, other) in self.by_sigma.iter_mut().zip(&other.by_sigma) {
            sum.join(other);
        }
    }

    /// Number of samples drawn.
    pub fn samples(&self) -> u64 {
        self.samples
    }

    /// Number of samples that failed.
    pub fn failures(&self) -> u64 {
        self.failures
    }
}
