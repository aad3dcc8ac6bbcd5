//! Samples paired with their predictions: the ratio of two standard deviations over the same samples is known much more
//! accurately than either.

use crate::judge::Measured;

/// Number of groups of samples; the jackknife leaves out one at a time.
const GROUPS: usize = 32;
/// Samples represent a distribution if their standard deviation is that of the distribution within this fraction, or
/// within so many standard errors.
const REPRESENTATIVE: f64 = 0.2;
const UNLIKELY: f64 = 5.0;

/// Sums over numbers, as deviations from a fixed value.
#[derive(Clone, Copy, Debug, Default)]
struct Sums {
    count: f64,
    values: f64,
    squares: f64,
}

impl Sums {
    fn add(&mut self, value: f64) {
        self.count += 1.0;
        self.values += value;
        self.squares += value * value;
    }

    fn join(&mut self, other: &Self, sign: f64) {
        self.count += sign * other.count;
        self.values += sign * other.values;
        self.squares += sign * other.squares;
    }

    fn mean(&self) -> Option<f64> {
        (self.count > 0.0).then(|| self.values / self.count)
    }

    fn sigma(&self) -> Option<f64> {
        let spread = self.squares - self.values * self.mean()?;
        (self.count > 1.0).then(|| (spread.max(0.0) / (self.count - 1.0)).sqrt())
    }
}

/// Sums over some samples: the values found, and the predictions for all of them.
#[derive(Clone, Copy, Debug, Default)]
struct Group {
    found: Sums,
    first: Sums,
    second: Sums,
}

impl Group {
    fn join(&mut self, other: &Self, sign: f64) {
        self.found.join(&other.found, sign);
        self.first.join(&other.first, sign);
        self.second.join(&other.second, sign);
    }
}

/// A quantity of a mode over samples, with its first- and second-order prediction for each. All are deviations from the
/// nominal value, so that no digits are lost.
#[derive(Clone, Debug)]
pub(super) struct Paired {
    groups: [Group; GROUPS],
    samples: usize,
}

impl Paired {
    pub(super) fn new() -> Self {
        Self { groups: [Group::default(); GROUPS], samples: 0 }
    }

    /// Adds a sample; `value` is `None` if it does not have the quantity.
    pub(super) fn add(&mut self, value: Option<f64>, first: f64, second: f64) {
        let group = &mut self.groups[self.samples % GROUPS];
        self.samples += 1;
        if let Some(found) = value {
            group.found.add(found);
        }
        group.first.add(first);
        group.second.add(second);
    }

    /// Number of samples that have the quantity.
    pub(super) fn count(&self) -> usize {
        self.total().found.count as usize
    }

    /// Number of samples.
    pub(super) fn samples(&self) -> usize {
        self.samples
    }

    /// Mean of the values found.
    pub(super) fn mean(&self) -> Option<f64> {
        self.total().found.mean()
    }

    /// Standard deviation of the values found.
    pub(super) fn sigma(&self) -> Option<Measured> {
        self.jackknife(|group| group.found.sigma())
    }

    /// Ratio of the standard deviation of the first-order prediction to that of the values found.
    pub(super) fn first_ratio(&self) -> Option<Measured> {
        self.jackknife(|group| Some(group.first.sigma()? / group.found.sigma()?))
    }

    /// Ratio of the standard deviation of the second-order prediction to that of the values found.
    pub(super) fn second_ratio(&self) -> Option<Measured> {
        self.jackknife(|group| Some(group.second.sigma()? / group.found.sigma()?))
    }

    /// Whether the first-order predictions of the samples have about the standard deviation `sigma`, which they have in
    /// the limit of many samples.
    pub(super) fn represents(&self, sigma: f64) -> bool {
        let measured = self.jackknife(|group| group.first.sigma());
        measured.is_some_and(|found| {
            let off = (found.value - sigma).abs();
            off <= REPRESENTATIVE * sigma || off <= UNLIKELY * found.standard_error
        })
    }

    fn total(&self) -> Group {
        let mut total = Group::default();
        for group in &self.groups {
            total.join(group, 1.0);
        }
        total
    }

    /// A statistic and its standard error, from its values with one group left out at a time (Efron, The Jackknife, the
    /// Bootstrap and Other Resampling Plans, 1982, section 2.2); `None` if it is not finite.
    fn jackknife(&self, statistic: impl Fn(&Group) -> Option<f64>) -> Option<Measured> {
        let total = self.total();
        let value = statistic(&total)?;
        let mut without = [0.0; GROUPS];
        for (value, group) in without.iter_mut().zip(&self.groups) {
            let mut rest = total;
            rest.join(group, -1.0);
            *value = statistic(&rest)?;
        }
        let count = GROUPS as f64;
        let mean = without.iter().sum::<f64>() / count;
        let squares: f64 = without.iter().map(|value| (value - mean).powi(2)).sum();
        let standard_error = ((count - 1.0) / count * squares).sqrt();
        (value.is_finite() && standard_error.is_finite()).then_some(Measured { value, standard_error })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// With ten numbers in each group, the jackknife standard error of a mean is that of the group means.
    #[test]
    fn the_jackknife_of_a_mean_is_its_standard_error() {
        let mut paired = Paired::new();
        let value = |k: usize| ((k * 7919) % 1009) as f64;
        (0..10 * GROUPS).for_each(|k| paired.add(Some(value(k)), 0.0, 0.0));
        let measured = paired.jackknife(|group| group.found.mean());
        let means: Vec<f64> = (0..GROUPS).map(|g| (0..10).map(|k| value(g + GROUPS * k)).sum::<f64>() / 10.0).collect();
        let mean = means.iter().sum::<f64>() / GROUPS as f64;
        let squares: f64 = means.iter().map(|x| (x - mean).powi(2)).sum();
        let expected = (squares / (GROUPS * (GROUPS - 1)) as f64).sqrt();
        let ratios = measured.map(|found| (found.value / mean, found.standard_error / expected));
        assert!(ratios.is_some_and(|(a, b)| (a - 1.0).abs() < 1e-12 && (b - 1.0).abs() < 1e-9));
    }

    #[test]
    fn samples_without_a_value_count_for_the_prediction_alone() {
        let mut paired = Paired::new();
        for k in 0..4 * GROUPS {
            let value = k as f64;
            paired.add((k < 2 * GROUPS).then_some(value), 2.0 * value, 0.0);
        }
        assert_eq!(paired.count(), 2 * GROUPS);
        // The variance of 0, 1 .. n-1 is n (n + 1) / 12.
        let n = (2 * GROUPS) as f64;
        let expected = 2.0 * (4.0 * (2.0 * n + 1.0) / (2.0 * (n + 1.0))).sqrt();
        let ratio = paired.first_ratio().map_or(0.0, |ratio| ratio.value);
        assert!((ratio * ratio - expected * expected).abs() < 1e-9, "{ratio}");
    }

    #[test]
    fn a_quantity_that_does_not_vary_has_no_ratio() {
        let mut paired = Paired::new();
        (0..4 * GROUPS).for_each(|k| paired.add(Some(1.0), k as f64, 0.0));
        assert!(paired.first_ratio().is_none());
        assert_eq!(paired.sigma().map(|sigma| sigma.value), Some(0.0));
    }
}
