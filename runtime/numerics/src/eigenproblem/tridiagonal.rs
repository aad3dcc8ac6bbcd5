//! Eigenvalues of a symmetric matrix by reduction to tridiagonal form and implicit QL, in place and without allocation:
//! `4/3 n^3` operations, and about `5 n^2` more for each vector that is carried along.
//!
//! One function for every size and both uses. nalgebra's `SymmetricEigen` is generic over the size and was a seventh of the
//! instructions that the solvers hand to the optimiser.
#![allow(clippy::needless_range_loop, reason = "index loops read as the formulas they are")]

use super::dense::{add, dot};

/// Columns that a reflection takes at once.
const PANEL: usize = 32;
/// Square of elements beside those of size one that are as good as zero, and whose reflection would not be orthogonal
/// because smaller squares lose digits.
const NEGLIGIBLE: f64 = 1e-280;
/// Steps per eigenvalue; two are usual.
const STEPS: usize = 60;

/// Workspace for matrices of one size.
pub struct Tridiagonal {
    diagonal: Vec<f64>,
    /// The element between `i` and `i + 1`.
    beside: Vec<f64>,
    product: Vec<f64>,
}

impl Tridiagonal {
    pub fn new(n: usize) -> Self {
        Self { diagonal: vec![0.0; n], beside: vec![0.0; n], product: vec![0.0; n] }
    }

    /// The eigenvalues, in no particular order, of a symmetric matrix, row by row, of which the lower triangle is read
    /// and overwritten; accurate to a few rounding errors of the largest. `None` if they were not found. Elements must
    /// be finite.
    ///
    /// Householder's reduction and QL with implicit shifts (Golub and Van Loan, Matrix Computations, sections 8.3.1 and
    /// 8.3.3).
    pub fn eigenvalues(&mut self, matrix: &mut [f64]) -> Option<&[f64]> {
        let converged = decompose(matrix, &mut [], [&mut self.diagonal, &mut self.beside, &mut self.product]);
        converged.then_some(&self.diagonal[..])
    }
}

/// The eigenvalues, to the first of three lists of room for a number for each row; whether they were found. `carried`,
/// with as many rows as the matrix, row by row, becomes `Q^T` times itself, where the columns of `Q` are the
/// eigenvectors in the order of the eigenvalues.
pub(super) fn decompose(matrix: &mut [f64], carried: &mut [f64], [diagonal, beside, product]: [&mut [f64]; 3]) -> bool {
    let size = matrix.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    if size == 0.0 {
        diagonal.fill(0.0);
        return true;
    }
    matrix.iter_mut().for_each(|x| *x /= size);
    reduce(matrix, [&mut *diagonal, &mut *beside, product]);
    let columns = carried.len() / diagonal.len();
    if columns > 0 {
        reflect(matrix, diagonal.len(), carried, columns);
    }
    let converged = ql(diagonal, beside, carried);
    diagonal.iter_mut().for_each(|value| *value *= size);
    converged
}

/// To tridiagonal form; the vector of each reflection is left in its row.
fn reduce(matrix: &mut [f64], [diagonal, beside, product]: [&mut [f64]; 3]) {
    let n = diagonal.len();
    for i in (1..n).rev() {
        let (rows, row) = matrix.split_at_mut(i * n);
        diagonal[i] = row[i];
        let v = &mut row[..i];
        let (size, end) = (v[..i - 1].iter().map(|x| x * x).sum::<f64>(), v[i - 1]);
        if size <= NEGLIGIBLE {
            beside[i - 1] = end;
            v.fill(0.0);
            continue;
        }
        // The reflection 1 - v v^T / half turns the row towards its last element.
        let length = (size + end * end).sqrt();
        let length = if end > 0.0 { -length } else { length };
        beside[i - 1] = length;
        v[i - 1] = end - length;
        let half = size + end * end - end * length;
        let product = &mut product[..i];
        product.fill(0.0);
        for a in 0..i {
            let row = &rows[a * n..a * n + a];
            let mut sum = rows[a * n + a] * v[a];
            for b in 0..a {
                sum += row[b] * v[b];
                product[b] += row[b] * v[a];
            }
            product[a] += sum;
        }
        let along = product.iter().zip(&*v).map(|(p, v)| p * v).sum::<f64>();
        for (p, v) in product.iter_mut().zip(&*v) {
            *p = (*p - along / (2.0 * half) * v) / half;
        }
        for a in 0..i {
            let row = &mut rows[a * n..=a * n + a];
            for b in 0..=a {
                row[b] -= v[a] * product[b] + product[a] * v[b];
            }
        }
    }
    if let (Some(first), Some(corner)) = (diagonal.first_mut(), matrix.first()) {
        *first = *corner;
    }
}

/// Applies the transpose of the product of all reflections.
fn reflect(matrix: &[f64], n: usize, carried: &mut [f64], columns: usize) {
    for i in (1..n).rev() {
        let v = &matrix[i * n..i * n + i];
        let half = 0.5 * dot(v, v);
        if half == 0.0 {
            continue;
        }
        let rows = &mut carried[..i * columns];
        for first in (0..columns).step_by(PANEL) {
            let width = PANEL.min(columns - first);
            let mut along = [0.0; PANEL];
            for (row, v) in rows.chunks_exact(columns).zip(v) {
                add(*v, &row[first..first + width], &mut along);
            }
            for (row, v) in rows.chunks_exact_mut(columns).zip(v) {
                add(-v / half, &along[..width], &mut row[first..first + width]);
            }
        }
    }
}

/// Whether all elements beside the diagonal became negligible.
fn ql(d: &mut [f64], e: &mut [f64], carried: &mut [f64]) -> bool {
    let n = d.len();
    for first in 0..n {
        for step in 0.. {
            let negligible = |k: &usize| {
                let k = *k;
                k + 1 >= n || e[k].abs() <= f64::EPSILON * (d[k].abs() + d[k + 1].abs())
            };
            let Some(last) = (first..n).find(negligible).filter(|last| *last > first) else {
                break;
            };
            if step == STEPS {
                return false;
            }
            sweep(d, e, (first, last), carried);
        }
    }
    true
}

/// Mixes rows `i` and `i + 1`.
fn mix(carried: &mut [f64], columns: usize, i: usize, (sine, cosine): (f64, f64)) {
    let (upper, lower) = carried[i * columns..(i + 2) * columns].split_at_mut(columns);
    for (a, b) in upper.iter_mut().zip(lower) {
        (*a, *b) = (cosine * *a - sine * *b, sine * *a + cosine * *b);
    }
}

/// One implicit QL step on the rows `first` to `last`, shifted by the eigenvalue of the first two that is nearer to the
/// first.
fn sweep(d: &mut [f64], e: &mut [f64], (first, last): (usize, usize), carried: &mut [f64]) {
    let columns = carried.len() / d.len();
    let ratio = (d[first + 1] - d[first]) / (2.0 * e[first]);
    let mut g = d[last] - d[first] + e[first] / (ratio + (ratio * ratio + 1.0).sqrt().copysign(ratio));
    let (mut sine, mut cosine, mut p) = (1.0, 1.0, 0.0);
    for i in (first..last).rev() {
        let (f, b) = (sine * e[i], cosine * e[i]);
        let r = (f * f + g * g).sqrt();
        e[i + 1] = r;
        if r == 0.0 {
            d[i + 1] -= p;
            e[last] = 0.0;
            return;
        }
        (sine, cosine) = (f / r, g / r);
        g = d[i + 1] - p;
        let r = (d[i] - g) * sine + 2.0 * cosine * b;
        p = sine * r;
        d[i + 1] = g + p;
        g = cosine * r - b;
        if columns > 0 {
            mix(carried, columns, i, (sine, cosine));
        }
    }
    d[first] -= p;
    e[first] = g;
    e[last] = 0.0;
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::eigenproblem::diagonalise;

    fn sorted(values: &[f64]) -> Vec<f64> {
        let mut values = values.to_vec();
        values.sort_by(f64::total_cmp);
        values
    }

    /// Against rotations, for random matrices, those with many zeros, and equal eigenvalues.
    #[test]
    fn eigenvalues_are_those_of_rotations() {
        let mut state = 1_u64;
        let mut random = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (state >> 33) as f64 / f64::from(1 << 30) - 1.0
        };
        for n in [1, 2, 3, 5, 8, 13, 40] {
            for kind in 0..6 {
                let mut matrix = vec![0.0; n * n];
                for i in 0..n {
                    for j in 0..=i {
                        let value = match kind {
                            0 => random(),
                            1 if i - j < 2 => random(),
                            2 if i == j => 3.0,
                            3 => 1.0,
                            4 => (random() * 2.0).round() * 1e-160,
                            5 => (random() * 40.0).exp() * random(),
                            _ => 0.0,
                        };
                        matrix[i * n + j] = value;
                        matrix[j * n + i] = value;
                    }
                }
                let size = matrix.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
                let mut rotated = matrix.clone();
                diagonalise(&mut rotated, n, &mut []);
                let expected: Vec<f64> = (0..n).map(|i| rotated[i * n + i]).collect();
                let mut room = Tridiagonal::new(n);
                let sorted_values = room.eigenvalues(&mut matrix).map(sorted);
                let eigenvalues = sorted_values.unwrap_or_default();
                assert_eq!(eigenvalues.len(), n);
                for (a, b) in eigenvalues.iter().zip(sorted(&expected)) {
                    assert!((a - b).abs() <= 1e-13 * size * n as f64, "{n} {kind}: {a} {b}");
                }
            }
        }
    }

    /// What is carried along are the eigenvectors: orthonormal, and `A v = lambda v`. Also where no reflection is needed
    /// (diagonal and tridiagonal matrices), where elements are so small that their squares vanish, and where all
    /// eigenvalues are equal.
    #[test]
    fn carried_vectors_diagonalise() {
        for n in [1_usize, 2, 3, 8, 9, 40] {
            for kind in 0..6 {
                let element = |i: usize, j: usize| match kind {
                    0 => ((i + 1) as f64 * (j + 1) as f64).sin(),
                    1 if i.abs_diff(j) < 2 => (i + j) as f64 - 3.0,
                    2 if i == j => i as f64 - 2.0,
                    3 => 1.0,
                    4 if i == j => 1.0 + i as f64,
                    4 => [1e-140, 1e-150, 1e-162][(i + j) % 3],
                    5 if i == j => 2.0,
                    _ => 0.0,
                };
                let matrix: Vec<f64> = (0..n * n).map(|k| element(k / n, k % n)).collect();
                let size = matrix.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
                let mut vectors = vec![0.0; n * n];
                vectors.iter_mut().step_by(n + 1).for_each(|x| *x = 1.0);
                let (mut values, mut beside, mut product) = (vec![0.0; n], vec![0.0; n], vec![0.0; n]);
                let room = [&mut values[..], &mut beside, &mut product];
                assert!(decompose(&mut matrix.clone(), &mut vectors, room));
                let rows = || vectors.chunks_exact(n);
                for (r, (v, value)) in rows().zip(&values).enumerate() {
                    for (s, w) in rows().enumerate() {
                        let expected = if r == s { 1.0 } else { 0.0 };
                        assert!((dot(v, w) - expected).abs() < 1e-14 * (n + 4) as f64);
                    }
                    for (row, x) in matrix.chunks_exact(n).zip(v) {
                        let rest = dot(row, v) - value * x;
                        assert!(rest.abs() <= 1e-14 * size * (n + 4) as f64, "{n} {kind}: {rest:e}");
                    }
                }
            }
        }
    }

    #[test]
    fn the_second_differences_of_a_string_have_known_eigenvalues() {
        let n = 50;
        let mut matrix = vec![0.0; n * n];
        for i in 0..n {
            matrix[i * n + i] = 2.0;
            if i > 0 {
                matrix[i * n + i - 1] = -1.0;
            }
        }
        let mut room = Tridiagonal::new(n);
        let eigenvalues = room.eigenvalues(&mut matrix).map(sorted).unwrap_or_default();
        for (k, value) in eigenvalues.iter().enumerate() {
            let angle = std::f64::consts::PI * (k + 1) as f64 / (2.0 * (n + 1) as f64);
            assert!((value - (2.0 * angle.sin()).powi(2)).abs() < 1e-13);
        }
    }
}
