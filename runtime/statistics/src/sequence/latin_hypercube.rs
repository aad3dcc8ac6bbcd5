//! Latin hypercube samples (McKay, Beckman and Conover, Technometrics 21, 1979).

use super::bits::{hash, keys, open_unit};
use super::permutation::Permutation;

/// In each dimension every stratum `p/n..(p+1)/n` holds one point, anywhere inside.
#[derive(Clone, Debug)]
pub(super) struct LatinHypercube {
    points: u64,
    permutation: Permutation,
    /// By dimension: of the permutation and of the place in the stratum.
    keys: Vec<u64>,
}

impl LatinHypercube {
    pub(super) fn new(dimensions: usize, points: u64, seed: u64, stream: u64) -> Self {
        Self {
            points,
            permutation: Permutation::new(points),
            keys: keys(seed, stream, 2 * dimensions),
        }
    }

    pub(super) fn write(&self, k: u64, into: &mut [f64]) {
        let n = self.points as f64;
        // Rounding of the quotient must not carry a point across the edge of its stratum.
        let edge = n * 2.0_f64.powi(-51);
        for (value, keys) in into.iter_mut().zip(self.keys.chunks_exact(2)) {
            let stratum = self.permutation.image(keys[0], k);
            let place = open_unit(hash(keys[1], k)).clamp(edge, 1.0 - edge);
            *value = (stratum as f64 + place) / n;
        }
    }
}
