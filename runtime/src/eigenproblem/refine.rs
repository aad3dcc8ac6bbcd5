//! Inverse iteration for pairs that the eigensolver left inaccurate: where eigenvalues spread over many orders of
//! magnitude, the small ones carry the rounding of the large ones.
#![allow(
    clippy::needless_range_loop,
    reason = "index loops read as the formulas they are"
)]

use super::residual::Matrices;
use crate::algebra::largest;

const STEPS: usize = 4;
/// Eigenvalues closer than this, relative to the larger, may mix in an inverse iteration.
const NEAR: f64 = 1e-3;

/// Improves pair `r` and keeps it mass-orthogonal to the earlier pairs near it. Leaves it unchanged if that does not
/// help.
#[cold]
pub(super) fn refine(matrices: &Matrices, lambda: &mut [f64], shapes: &mut [f64], r: usize) {
    let n = matrices.n;
    let own = r * n..(r + 1) * n;
    let shifted = &mut vec![0.0; n * n][..];
    let shape = &mut shapes[own.clone()].to_vec()[..];
    let weighted = &mut vec![0.0; n][..];
    let mut best = matrices.relative_residual(lambda[r], shape);
    let mut value = lambda[r];
    let rounding = f64::EPSILON * largest(matrices.k) / largest(matrices.m);
    for _ in 0..STEPS {
        multiply(matrices.m, shape, weighted);
        let found = [value, value + 1e-10 * value.abs() + rounding]
            .into_iter()
            .any(|shift| {
                for (x, (k, m)) in shifted.iter_mut().zip(matrices.k.iter().zip(matrices.m)) {
                    *x = k - shift * m;
                }
                shape.copy_from_slice(weighted);
                solve(n, shifted, shape)
            });
        if !found {
            return;
        }
        for s in 0..r {
            if (lambda[s] - value).abs() <= NEAR * lambda[s].abs().max(value.abs()) {
                let earlier = &shapes[s * n..(s + 1) * n];
                multiply(matrices.m, shape, weighted);
                let part = dot(earlier, weighted);
                for (x, y) in shape.iter_mut().zip(earlier) {
                    *x -= part * y;
                }
            }
        }
        multiply(matrices.m, shape, weighted);
        let size = dot(shape, weighted).sqrt();
        shape.iter_mut().for_each(|x| *x /= size);
        multiply(matrices.k, shape, weighted);
        value = dot(shape, weighted);
        if !shape.iter().all(|x| x.is_finite()) || !value.is_finite() {
            return;
        }
        let reached = matrices.relative_residual(value, shape);
        if reached < best {
            best = reached;
            lambda[r] = value;
            shapes[own.clone()].copy_from_slice(shape);
        }
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn multiply(matrix: &[f64], x: &[f64], into: &mut [f64]) {
    for (row, into) in matrix.chunks_exact(x.len()).zip(into) {
        *into = dot(row, x);
    }
}

/// Solves in place by elimination with row exchanges and destroys the matrix; `false` if a pivot does not exceed the
/// rounding of the matrix.
fn solve(n: usize, matrix: &mut [f64], x: &mut [f64]) -> bool {
    let threshold = 8.0 * n as f64 * f64::EPSILON;
    for i in 0..n {
        let row = &mut matrix[i * n..(i + 1) * n];
        let size = largest(row);
        row.iter_mut().for_each(|value| *value /= size);
        x[i] /= size;
    }
    for k in 0..n {
        let mut best = k;
        for i in k + 1..n {
            if matrix[i * n + k].abs() > matrix[best * n + k].abs() {
                best = i;
            }
        }
        let pivot = matrix[best * n + k];
        if pivot.is_nan() || pivot.abs() <= threshold {
            return false;
        }
        if best != k {
            x.swap(k, best);
            for j in 0..n {
                matrix.swap(k * n + j, best * n + j);
            }
        }
        for i in k + 1..n {
            let factor = matrix[i * n + k] / pivot;
            for j in k + 1..n {
                let product = factor * matrix[k * n + j];
                matrix[i * n + j] -= product;
            }
            x[i] -= factor * x[k];
        }
    }
    for i in (0..n).rev() {
        for k in i + 1..n {
            x[i] -= matrix[i * n + k] * x[k];
        }
        x[i] /= matrix[i * n + i];
    }
    true
}
