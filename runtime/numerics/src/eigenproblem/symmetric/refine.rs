//! Inverse iteration for pairs that the eigensolver left inaccurate: where eigenvalues spread over many orders of
//! magnitude, the small ones carry the rounding of the large ones.
#![allow(clippy::needless_range_loop, reason = "index loops read as the formulas they are")]

use super::residual::Matrices;
use crate::algebra::{Lu, Matrix, dot, largest};

const STEPS: usize = 4;
/// Eigenvalues closer than this, relative to the larger, may mix in an inverse iteration.
const NEAR: f64 = 1e-3;
/// Mass product of two shapes above which they are of one mode; those of equal modes need not be exactly orthogonal.
const SAME: f64 = 0.5;

/// Improves pair `r` and keeps it mass-orthogonal to the earlier pairs near it. Leaves it unchanged if that does not
/// help, or finds another pair again, as inverse iteration may where eigenvalues spread over more orders of magnitude
/// than a double has digits.
#[cold]
pub(super) fn refine(matrices: &Matrices, lambda: &mut [f64], shapes: &mut [f64], r: usize) {
    let n = matrices.n;
    let range = r * n..(r + 1) * n;
    let shape = &mut shapes[range.clone()].to_vec()[..];
    let weighted = &mut vec![0.0; n][..];
    let mut best = matrices.relative_residual(lambda[r], shape);
    let mut value = lambda[r];
    let rounding = f64::EPSILON * largest(matrices.k) / largest(matrices.m);
    for _ in 0..STEPS {
        multiply(matrices.m, shape, weighted);
        let factors = [value, value + 1e-10 * value.abs() + rounding].into_iter().find_map(|shift| {
            let element = |i: usize, j: usize| matrices.k[i * n + j] - shift * matrices.m[i * n + j];
            Lu::of(Matrix::from_fn(n, n, element))
        });
        let Some(factors) = factors else {
            return;
        };
        shape.copy_from_slice(&factors.solve(weighted));
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
        multiply(matrices.m, shape, weighted);
        let mut others = shapes.chunks_exact(n).enumerate().filter(|(s, _)| *s != r);
        let repeated = others.any(|(_, other)| dot(other, weighted).abs() > SAME);
        if reached < best && !repeated {
            best = reached;
            lambda[r] = value;
            shapes[range.clone()].copy_from_slice(shape);
        }
    }
}

fn multiply(matrix: &[f64], x: &[f64], into: &mut [f64]) {
    for (row, into) in matrix.chunks_exact(x.len()).zip(into) {
        *into = dot(row, x);
    }
}
