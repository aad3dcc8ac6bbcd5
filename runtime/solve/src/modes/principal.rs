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
/// With a periodic part of relative size `e`, the harmonics have shares of `e^2` in the modes. They move the eigenvalues by as
/// much; those left out move them by `e^4` of their distance, which is at most that of the furthest eigenvalue.
pub(super) fn keep_principal(
    linear: &Linear,
    description: &Description,
    modes: &mut Vec<Mode>,
) -> Result<(), ModesFailure> {
    if description.harmonics.is_empty() {
        return Ok(());
    }
    let blocks = 1 + 2 * description.harmonics.len();
    let n = linear.mass.row_count() / blocks;
    let share = |mode: &Mode| {
        let energy = |k: usize| energy(&linear.mass, k * n, &mode.shape[k * n..(k + 1) * n]);
        let harmonics: f64 = (1..blocks).map(energy).sum();
        harmonics / (energy(0) + harmonics)
    };
    let furthest = modes.iter().map(|mode| mode.s.norm()).fold(0.0, f64::max);
    modes.retain(|mode| share(mode) < 0.5);
    let shares: Vec<f64> = modes.iter().map(share).collect();
    let largest = shares.iter().copied().fold(0.0, f64::max);
    let count: usize = modes.iter().map(|mode| if mode.s.im > 0.0 { 2 } else { 1 }).sum();
    if count != 2 * n || largest > LARGEST {
        return Err(ModesFailure::Periodic { share: largest });
    }
    for (mode, share) in modes.iter_mut().zip(shares) {
        mode.error += share * largest * furthest;
    }
    Ok(())
}

/// `phi^H M phi` of a block of the mass matrix.
fn energy(mass: &Matrix, first: usize, shape: &[Complex]) -> f64 {
    let pairs = (0..shape.len()).flat_map(|i| (0..shape.len()).map(move |j| (i, j)));
    pairs.map(|(i, j)| (shape[i].conj() * shape[j]).re * mass[first + i][first + j]).sum()
}
