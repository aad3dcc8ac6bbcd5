//! Covariance of two quantities, in mergeable form.

use super::lanes;
use super::mean::Mean;

/// Statistics of the samples that have both quantities: count, means, and sums of the squares and products of the
/// deviations from them.
///
/// Merging follows Pébay (2008), equation 3.1, like that of [`super::Moments`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Comoments {
    pub(super) count: u64,
    pub(super) means: [Mean; 2],
    #[cfg_attr(feature = "serde", serde(with = "super::bits::two"))]
    pub(super) squares: [f64; 2],
    #[cfg_attr(feature = "serde", serde(with = "super::bits::one"))]
    pub(super) product: f64,
}

fn centre(values: &[f64]) -> f64 {
    let pivot = values.first().copied().unwrap_or_default();
    pivot + lanes::sum_from(values, pivot) / values.len() as f64
}

impl Comoments {
    /// The statistics of pairs of values; excess values of the longer slice are ignored.
    #[must_use]
    pub fn of(first: &[f64], second: &[f64]) -> Self {
        let count = first.len().min(second.len());
        if count == 0 {
            return Self::default();
        }
        let values = [&first[..count], &second[..count]];
        let centres = values.map(centre);
        let [x, y, xx, yy, xy] = lanes::products(values, centres);
        let shifts = [x / count as f64, y / count as f64];
        Self {
            count: count as u64,
            means: [0, 1].map(|k| Mean::new(centres[k], shifts[k])),
            squares: [xx - x * shifts[0], yy - y * shifts[1]],
            product: xy - x * shifts[1],
        }
    }

    /// Adds the pairs of another instance.
    pub fn merge(&mut self, other: &Self) {
        if other.count == 0 {
            return;
        }
        if self.count == 0 {
            *self = *other;
            return;
        }
        let count = self.count + other.count;
        let b = other.count as f64 / count as f64;
        let weight = self.count as f64 * b;
        let steps = [0, 1].map(|k| other.means[k].minus(self.means[k]));
        for (k, step) in steps.into_iter().enumerate() {
            self.squares[k] += other.squares[k] + step * step * weight;
            self.means[k] = self.means[k].moved(step * b);
        }
        self.product += other.product + steps[0] * steps[1] * weight;
        self.count = count;
    }
}
