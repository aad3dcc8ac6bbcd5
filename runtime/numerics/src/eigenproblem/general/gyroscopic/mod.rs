//! Conservative gyroscopic pencils: `M` and `K` positive definite, `C` skew. With `M = L L^T`, `K = R R^T` and the
//! energy coordinates `x = (R^T q, L^T q')` they are the equation `x' = W x` with a real skew-symmetric matrix
//!
//! ```text
//! W = [ 0   B^T ]     B = L^-1 R,   G = L^-1 C L^-T.
//!     [ -B  -G  ]
//! ```
//!
//! All eigenvalues are imaginary and their vectors orthogonal, so clusters need no care, and a residual bounds the error
//! of a frequency.

mod bidiagonal;
mod bounds;
mod skew;

use num_complex::Complex64;

use super::Root;
use super::order::finish;
use super::pencil::{Degree, Pencil};
use crate::eigenproblem::dense;

/// A frequency and its vector, in the units of the scaled pencil; the left vector is the conjugate.
pub(super) struct Oscillation {
    /// Angular frequency.
    pub(super) omega: f64,
    /// Normalised in the mass matrix.
    pub(super) phi: Vec<Complex64>,
    /// Largest component of `Q(i omega) phi`, relative to the largest sum of the terms in one.
    pub(super) residual: f64,
    /// Bound on the error of `omega`.
    pub(super) error: f64,
}

impl Oscillation {
    /// The root in the units of vectors and eigenvalues.
    pub(super) fn root(self, rate: f64, units: &[f64]) -> Root {
        let left: Vec<_> = self.phi.iter().map(|x| x.conj()).collect();
        Root {
            s: Complex64::new(0.0, self.omega * rate),
            right: finish(&self.phi, units),
            left: finish(&left, units),
            residual: self.residual,
            error: self.error * rate,
            condition: 1.0,
        }
    }
}

/// Frequencies from this share of the largest one on are better known from velocities, lower ones from displacements.
const FAST: f64 = 0.03;

/// All oscillations of a conservative gyroscopic pencil, ascending; `None` if it is not one, or so close to a critical
/// state that the general method serves it better.
pub(super) fn oscillations(pencil: &Pencil) -> Option<Vec<Oscillation>> {
    let n = pencil.n;
    if !is_conservative(pencil) {
        return None;
    }
    let (mut lower, mut root) = (vec![0.0; n * n], vec![0.0; n * n]);
    dense::cholesky(n, pencil.mass, &mut lower).ok()?;
    dense::cholesky(n, pencil.stiffness, &mut root).ok()?;
    let matrix = skew_matrix(pencil, &lower, &root);
    let sum = matrix.iter().map(|x| x * x).sum();
    let (q, beside) = skew::tridiagonal(2 * n, matrix);
    // Conjugation with powers of i makes the form symmetric; its even places then act on the odd ones only.
    let mut omega: Vec<f64> = beside.iter().skip(1).step_by(2).copied().collect();
    let mut above: Vec<f64> = beside.iter().skip(2).step_by(2).copied().collect();
    let (mut left, mut right) = (identity(n), identity(n));
    if !bidiagonal::singular_values(&mut omega, &mut above, &mut left, &mut right) {
        return None;
    }
    let mut order: Vec<usize> = (0..n).collect();
    order.sort_by(|&a, &b| omega[a].total_cmp(&omega[b]));
    let mut x = vec![0.0; 4 * n * n];
    for (index, row) in x.chunks_exact_mut(2 * n).enumerate() {
        let (from, part) = match index % 2 {
            0 => (&right, 0),
            _ => (&left, 1),
        };
        // Component `k` is that of the symmetric form times `(-i)^k`.
        let sign = if matches!(index % 4, 0 | 3) { 1.0 } else { -1.0 };
        for (pair, &r) in row.chunks_exact_mut(2).zip(&order) {
            pair[part] = sign * from[r * n + index / 2];
        }
    }
    q.apply(2 * n, &mut x);
    let slow = order.partition_point(|&r| omega[r] < FAST * omega[order[n - 1]]);
    let phi = shapes(n, &x, slow, (&lower, &root));
    bounds::measured(pencil, &lower, &phi, sum)
}

fn is_conservative(pencil: &Pencil) -> bool {
    let n = pencil.n;
    let [mass, damping, stiffness] = [pencil.mass, pencil.damping, pencil.stiffness];
    let [mass_t, damping_t, stiffness_t] = pencil.transposed;
    let opposite = |(x, y): (&f64, &f64)| *x == -*y;
    pencil.degree == Degree::Two
        && (0..n).all(|i| damping[i * (n + 1)] == 0.0)
        && damping.iter().zip(damping_t).all(opposite)
        && mass == mass_t
        && stiffness == stiffness_t
}

/// The lower triangle of `W`.
fn skew_matrix(pencil: &Pencil, lower: &[f64], root: &[f64]) -> Vec<f64> {
    let n = pencil.n;
    let mut coupling = root.to_vec();
    dense::solve_lower(n, lower, n, &mut coupling);
    let mut spin = pencil.damping.to_vec();
    dense::solve_lower(n, lower, n, &mut spin);
    // (L^-1 C)^T = -C L^-T
    dense::transpose(n, &mut spin);
    dense::solve_lower(n, lower, n, &mut spin);
    let mut matrix = vec![0.0; 4 * n * n];
    for (i, row) in matrix[2 * n * n..].chunks_exact_mut(2 * n).enumerate() {
        for j in 0..n {
            row[j] = -coupling[i * n + j];
        }
        for j in 0..i {
            row[n + j] = 0.5 * (spin[i * n + j] - spin[j * n + i]);
        }
    }
    matrix
}

/// `q` for the vectors `x`, interleaved real and imaginary parts in the same layout; the first `slow` from
/// displacements, the others from velocities.
fn shapes(n: usize, x: &[f64], slow: usize, (lower, root): (&[f64], &[f64])) -> Vec<f64> {
    let width = 2 * n;
    let columns = |rows: usize, range: core::ops::Range<usize>| -> Vec<f64> {
        x[rows * width..(rows + n) * width].chunks_exact(width).flat_map(|row| &row[range.clone()]).copied().collect()
    };
    let mut displacements = columns(0, 0..2 * slow);
    let mut velocities = columns(n, 2 * slow..width);
    dense::solve_lower_transposed(n, root, 2 * slow, &mut displacements);
    dense::solve_lower_transposed(n, lower, width - 2 * slow, &mut velocities);
    let mut phi = vec![0.0; n * width];
    for (i, row) in phi.chunks_exact_mut(width).enumerate() {
        let (first, second) = row.split_at_mut(2 * slow);
        first.copy_from_slice(&displacements[i * 2 * slow..][..2 * slow]);
        second.copy_from_slice(&velocities[i * (width - 2 * slow)..][..width - 2 * slow]);
    }
    phi
}

fn identity(n: usize) -> Vec<f64> {
    let mut matrix = vec![0.0; n * n];
    (0..n).for_each(|i| matrix[i * (n + 1)] = 1.0);
    matrix
}
