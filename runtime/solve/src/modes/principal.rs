//! Modes of a mechanism whose coefficients are periodic: Hill's method finds each exponent `s` once for every harmonic, as
//! `s + i h W`. The one whose vibration is mostly in the means of the coordinates is the natural frequency.

use super::ModesFailure;
use crate::algebra::Matrix;
use crate::kernels::Linear;
use crate::{Complex, Description, Mode};

/// Largest share of harmonics in the energy of a mode: beyond, more of them are needed.
const LARGEST: f64 = 0.1;

/// Keeps the modes that are mostly in the means, and adds the error that the harmonics left out make.
///
/// With a periodic part of relative size `e`, the harmonics have a share of `e^2` in a mode. They move its eigenvalue by as
/// much; those left out, by `e^4` of the distance to the next eigenvalue of the same family. Their share to the power of 3/2
/// is greater.
pub(super) fn keep_principal(linear: &Linear, description: &Description, modes: &mut Vec<Mode>) -> Result<(), ModesFailure> {
    if description.harmonics.is_empty() {
        return Ok(());
    }
    let blocks = 1 + 2 * description.harmonics.len();
    let n = linear.mass.row_count() / blocks;
    let furthest = modes.iter().map(|mode| mode.s.norm()).fold(0.0, f64::max);
    let mut count = 0;
    let mut largest: f64 = 0.0;
    modes.retain_mut(|mode| {
        let energy = |k: usize| energy(&linear.mass, k * n, &mode.shape[k * n..(k + 1) * n]);
        let harmonics: f64 = (1..blocks).map(energy).sum();
        let share = harmonics / (energy(0) + harmonics);
        if share >= 0.5 {
            return false;
        }
        count += if mode.s.im > 0.0 { 2 } else { 1 };
        largest = largest.max(share);
        mode.error += share.powf(1.5) * furthest;
        true
    });
    if count != 2 * n || largest > LARGEST {
        return Err(ModesFailure::Periodic { share: largest });
    }
    Ok(())
}

/// `phi^H M phi` of a block of the mass matrix.
fn energy(mass: &Matrix, first: usize, shape: &[Complex]) -> f64 {
    let pairs = (0..shape.len()).flat_map(|i| (0..shape.len()).map(move |j| (i, j)));
    pairs.map(|(i, j)| (shape[i].conj() * shape[j]).re * mass[first + i][first + j]).sum()
}
