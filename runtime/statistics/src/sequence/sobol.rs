//! The Sobol' sequence (Sobol' 1967) in Gray-code order (Antonov and Saleev 1979).

use super::bits::{keys, open_unit};
use super::direction_numbers::{Directions, directions};
use super::scrambling::{DIGITS, scramble};

/// A digital sequence in base 2, scrambled or not.
#[derive(Clone, Debug)]
pub(super) struct Sobol {
    directions: Vec<Directions>,
    /// Scrambling key of each dimension.
    keys: Option<Vec<u64>>,
}

impl Sobol {
    pub(super) fn plain(dimensions: usize) -> Self {
        Self { directions: directions(dimensions), keys: None }
    }

    pub(super) fn scrambled(dimensions: usize, seed: u64, stream: u64) -> Self {
        Self { keys: Some(keys(seed, stream, dimensions)), ..Self::plain(dimensions) }
    }

    /// Binary digits of point `k`, by dimension.
    pub(super) fn digits(&self, k: u64) -> Vec<u64> {
        let gray = k ^ k >> 1;
        let sum =
            |v: &Directions| v.iter().enumerate().filter(|(i, _)| gray >> i & 1 == 1).fold(0, |sum, (_, v)| sum ^ v);
        self.directions.iter().map(sum).collect()
    }

    /// Advances from the digits of point `k` to those of the next, using one direction number. The last point has no
    /// successor.
    pub(super) fn advance(&self, k: u64, digits: &mut [u64]) {
        let changed = (k + 1).trailing_zeros() as usize;
        for (digits, directions) in digits.iter_mut().zip(&self.directions) {
            *digits ^= directions.get(changed).unwrap_or(&0);
        }
    }

    /// Writes the point with these digits. Without scrambling it is moved to the centre of the cell that the digits
    /// describe.
    pub(super) fn write(&self, digits: &[u64], into: &mut [f64]) {
        match &self.keys {
            Some(keys) => {
                for (value, (&digits, &key)) in into.iter_mut().zip(digits.iter().zip(keys)) {
                    *value = open_unit(scramble(key, digits));
                }
            }
            None => {
                for (value, &digits) in into.iter_mut().zip(digits) {
                    *value = (digits as f64 + 0.5) * 2.0_f64.powi(-(DIGITS as i32));
                }
            }
        }
    }
}
