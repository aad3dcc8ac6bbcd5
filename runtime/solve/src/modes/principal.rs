//! Modes of a mechanism whose coefficients are periodic: Hill's method finds each exponent `s` once for every harmonic, as
//! `s + i h W`. The one whose vibration is mostly in the means of the coordinates is the natural frequency.

use super::ModesFailure;
use crate::algebra::Matrix;
use crate::kernels::Linear;
use crate::{Complex, Description, Mode};

/// What the estimate of the error is multiplied with.
const SAFETY: f64 = 10.0;
/// Largest error of an eigenvalue, relative to it, with which the periodic part is small.
const SMALL: f64 = 0.01;
/// Relative distance within which exponents are of one family.
const SAME: f64 = 1e-6;

/// Keeps one exponent of each family, that with the most in the means, and adds the error that the harmonics left out make.
///
/// With a periodic part of relative size `e`, the harmonics have shares of `e^2` in the modes. They move the eigenvalues by as
/// much. Those left out act on these harmonics in the same way, and move the eigenvalue by `e^2` times their share, or `e^4`, of
/// the distance to the next exponent, which is at most that of the furthest. Where exponents of two families meet, they mix with
/// any shares.
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
    let shares: Vec<f64> = modes.iter().map(share).collect();
    let turn = turning(linear, n);
    let same = |a: Complex, b: Complex| {
        let turns = if turn == 0.0 { 0.0 } else { ((a - b).im / turn).round() };
        turns != 0.0 && (a - b - Complex::new(0.0, turns * turn)).norm() <= SAME * furthest
    };
    let mut ascending: Vec<usize> = (0..modes.len()).collect();
    ascending.sort_by(|a, b| shares[*a].total_cmp(&shares[*b]));
    let (mut kept, mut count): (Vec<usize>, usize) = (Vec::new(), 0);
    for k in ascending {
        let s = modes[k].s;
        let size = if s.im > 0.0 { 2 } else { 1 };
        let known = kept.iter().map(|&other| modes[other].s).any(|t| same(s, t) || same(s, t.conj()));
        if count + size <= 2 * n && !known {
            kept.push(k);
            count += size;
        }
    }
    let square = periodic_part(linear, n).powi(2);
    for &k in &kept {
        modes[k].error += SAFETY * shares[k].max(square) * square * furthest;
        let error = modes[k].error / modes[k].s.norm();
        if count < 2 * n || error.is_nan() || error > SMALL {
            return Err(ModesFailure::Periodic { error });
        }
    }
    let mut place = 0..;
    modes.retain(|_| place.next().is_some_and(|k| kept.contains(&k)));
    Ok(())
}

/// The part of the matrices that couples means with harmonics, relative to that of the means alone.
fn periodic_part(linear: &Linear, n: usize) -> f64 {
    let scale = |i: usize| linear.mass[i % n][i % n].abs().max(f64::MIN_POSITIVE).sqrt();
    let size = |matrix: &Matrix, columns: core::ops::Range<usize>| {
        let entries = (0..n).flat_map(|i| columns.clone().map(move |j| (i, j)));
        entries.map(|(i, j)| (matrix[i][j] / (scale(i) * scale(j))).powi(2)).sum::<f64>().sqrt()
    };
    let all = [&linear.mass, &linear.damping, &linear.stiffness].map(|matrix| {
        let means = size(matrix, 0..n);
        if means > 0.0 { size(matrix, n..matrix.column_count()) / means } else { 0.0 }
    });
    all.into_iter().fold(0.0, f64::max)
}

/// The frequency of the first harmonic, rad/s: from what its rotation adds to the damping.
fn turning(linear: &Linear, n: usize) -> f64 {
    let heaviest = (n..2 * n).max_by(|i, j| linear.mass[*i][*i].total_cmp(&linear.mass[*j][*j]));
    heaviest.map_or(0.0, |i| linear.damping[i][i + n] / (2.0 * linear.mass[i][i]))
}

/// `phi^H M phi` of a block of the mass matrix.
fn energy(mass: &Matrix, first: usize, shape: &[Complex]) -> f64 {
    let pairs = (0..shape.len()).flat_map(|i| (0..shape.len()).map(move |j| (i, j)));
    pairs.map(|(i, j)| (shape[i].conj() * shape[j]).re * mass[first + i][first + j]).sum()
}
