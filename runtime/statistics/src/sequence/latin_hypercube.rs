//! Latin hypercube samples (McKay, Beckman and Conover, Technometrics 21, 1979).

use super::bits::{hash, keys, open_unit};
use super::permutation::Permutation;

/// In each dimension, every stratum `p/n..(p+1)/n` contains one point at a random place.
#[derive(Clone, Debug)]
pub(super) struct LatinHypercube {
    points: u64,
    permutation: Permutation,
    /// Two per dimension: for the permutation and for the place in the stratum.
    keys: Vec<u64>,
}

impl LatinHypercube {
    pub(super) fn new(dimensions: usize, points: u64, seed: u64, stream: u64) -> Self {
        Self { points, permutation: Permutation::new(points), keys: keys(seed, stream, 2 * dimensions) }
    }

    pub(super) fn write(&self, k: u64, into: &mut [f64]) {
        for (value, keys) in into.iter_mut().zip(self.keys.chunks_exact(2)) {
            let stratum = self.permutation.image(keys[0], k);
            *value = inside(stratum, self.points, hash(keys[1], k));
        }
    }
}

/// A number in one of `strata` strata. Rounding of the quotient must not carry it across an edge.
fn inside(stratum: u64, strata: u64, bits: u64) -> f64 {
    let n = strata as f64;
    let edge = n * 2.0_f64.powi(-51);
    (stratum as f64 + open_unit(bits).clamp(edge, 1.0 - edge)) / n
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn extreme_places_stay_in_their_stratum() {
        for n in (1..2000).chain([1 << 20, (1 << 32) - 5, 1 << 32]) {
            for stratum in [0, n / 3, n / 2, n - 1] {
                for bits in [0, 1, u64::MAX - 1, u64::MAX] {
                    let x = inside(stratum, n, bits);
                    assert!(0.0 < x && x < 1.0);
                    assert_eq!((x * n as f64) as u64, stratum, "{n}");
                }
            }
        }
    }
}
