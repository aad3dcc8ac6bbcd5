//! Balancing and Hessenberg form of a real square matrix.

use super::powers::{exponent, power_of_two};
use super::shifted::Parts;
use crate::eigenproblem::dense::{add, dot};
use crate::scalar::Real;

/// Maximum number of balancing sweeps; the remaining imbalance is small.
const SWEEPS: usize = 8;
/// Scales stay within powers of two whose products are finite.
const GREATEST_EXPONENT: i32 = 300;

/// Scales `a` to `D^-1 A D` with rows and columns of similar size (Parlett and Reinsch 1969, with the diagonal included
/// in the sums as recommended by James, Langou and Lowery 2014). The diagonal of `D`, powers of two, is written to
/// `scales`.
pub(super) fn balance(n: usize, a: &mut [f64], scales: &mut [f64]) {
    scales.fill(1.0);
    for _ in 0..SWEEPS {
        let mut settled = true;
        for i in 0..n {
            let (mut column, mut row) = (0.0, 0.0);
            for j in 0..n {
                column += a[j * n + i].abs();
                row += a[i * n + j].abs();
            }
            if column == 0.0 || row == 0.0 {
                continue;
            }
            let shift = (exponent(row) - exponent(column)) / 2;
            let reached = exponent(scales[i]) + shift;
            if shift == 0 || reached.abs() > GREATEST_EXPONENT {
                continue;
            }
            let factor = power_of_two(shift);
            if column * factor + row / factor < 0.95 * (column + row) {
                settled = false;
                scales[i] *= factor;
                for j in 0..n {
                    a[j * n + i] *= factor;
                    a[i * n + j] /= factor;
                }
            }
        }
        if settled {
            break;
        }
    }
}

/// `H = Q^T A Q` in Hessenberg form.
pub(super) struct Hessenberg<'a> {
    pub(super) n: usize,
    pub(super) h: &'a [f64],
    /// Row `k` holds the reflection `I - tau v v^T` that zeroed column `k`: `tau` in place `k`, `v` behind it.
    reflections: &'a [f64],
    /// The row and column of `A` at each place.
    order: Vec<usize>,
}

/// Rows whose products with a vector are formed side by side.
const ROWS: usize = 4;

/// Reduces `a` to Hessenberg form by reflections, which take `n^2` numbers. `work` needs `n`.
pub(super) fn reduce<'a>(n: usize, a: &'a mut [f64], reflections: &'a mut [f64], work: &mut [f64]) -> Hessenberg<'a> {
    f64::run(
        #[inline(always)]
        || {
            for (k, v) in reflections.chunks_exact_mut(n).enumerate() {
                reflect_column(n, k, a, v, work);
            }
        },
    );
    Hessenberg { n, h: a, reflections, order: (0..n).collect() }
}

/// Like [`reduce`], with rows and columns sorted by size before.
pub(super) fn reduce_graded<'a>(
    n: usize,
    a: &'a mut [f64],
    reflections: &'a mut [f64],
    work: &mut [f64],
) -> Hessenberg<'a> {
    let order = by_size(n, a);
    let sorted: Vec<f64> = (0..n * n).map(|k| a[order[k / n] * n + order[k % n]]).collect();
    a.copy_from_slice(&sorted);
    Hessenberg { order, ..reduce(n, a, reflections, work) }
}

/// The places of rows and columns by their size, great ones first: QR then finds small eigenvalues of graded
/// matrices to their own accuracy (G. W. Stewart, Matrix Algorithms II, section 2.4). Empty columns, whose
/// eigenvalues are known, come before all others.
fn by_size(n: usize, matrix: &[f64]) -> Vec<usize> {
    /// Sizes within this factor of the largest are in the first class, and so on.
    const CLASS: f64 = 1.0 / 256.0;
    let size = |i: usize| {
        let (row, column) = (&matrix[i * n..(i + 1) * n], matrix.iter().skip(i).step_by(n));
        row.iter().chain(column).map(|x| x.abs()).fold(0.0, f64::max)
    };
    let sizes: Vec<f64> = (0..n).map(size).collect();
    let most = sizes.iter().copied().fold(0.0, f64::max);
    let class = |i: usize| (sizes[i] / most).log(CLASS) as i32;
    let empty = |i: usize| (0..n).all(|j| j == i || matrix[j * n + i] == 0.0);
    let keys: Vec<_> = (0..n).map(|i| (!empty(i), class(i))).collect();
    let mut order: Vec<usize> = (0..n).collect();
    order.sort_by_key(|&i| keys[i]);
    order
}

/// Zeros column `k` below the subdiagonal.
#[inline(always)]
fn reflect_column(n: usize, k: usize, a: &mut [f64], v: &mut [f64], work: &mut [f64]) {
    v[k] = 0.0;
    let mut size = 0.0_f64;
    for i in k + 2..n {
        size = size.max(a[i * n + k].abs());
    }
    if size == 0.0 {
        return;
    }
    let size = size.max(a[(k + 1) * n + k].abs());
    let mut square = 0.0;
    for i in k + 1..n {
        v[i] = a[i * n + k] / size;
        square += v[i] * v[i];
    }
    let norm = square.sqrt().copysign(v[k + 1]);
    a[(k + 1) * n + k] = -norm * size;
    for i in k + 2..n {
        a[i * n + k] = 0.0;
    }
    let tau = 1.0 / (square + norm * v[k + 1]);
    v[k + 1] += norm;
    v[k] = tau;
    let (v, sums) = (&v[k + 1..], &mut work[k + 1..n]);
    sums.fill(0.0);
    for (row, v) in a[(k + 1) * n..].chunks_exact(n).zip(v) {
        add(*v, &row[k + 1..], sums);
    }
    sums.iter_mut().for_each(|sum| *sum *= tau);
    for (row, v) in a[(k + 1) * n..].chunks_exact_mut(n).zip(v) {
        add(-v, sums, &mut row[k + 1..]);
    }
    let mut blocks = a.chunks_exact_mut(ROWS * n);
    for rows in &mut blocks {
        reflect_rows::<ROWS>(n, tau, v, rows);
    }
    for row in blocks.into_remainder().chunks_exact_mut(n) {
        reflect_rows::<1>(n, tau, v, row);
    }
}

/// Applies a reflection to the last columns of `R` rows.
#[inline(always)]
fn reflect_rows<const R: usize>(n: usize, tau: f64, v: &[f64], rows: &mut [f64]) {
    let first = n - v.len();
    let mut sums = [0.0; R];
    for (j, v) in v.iter().enumerate() {
        for r in 0..R {
            sums[r] += rows[r * n + first + j] * v;
        }
    }
    for (row, sum) in rows.chunks_exact_mut(n).zip(sums) {
        add(-(sum * tau), v, &mut row[first..]);
    }
}

impl Hessenberg<'_> {
    fn reflection(&self, k: usize) -> (f64, &[f64]) {
        let row = &self.reflections[k * self.n..(k + 1) * self.n];
        (row[k], &row[k + 1..])
    }

    /// `Q X` in place, for `X` with rows of length `columns`. `sums` needs as many numbers.
    pub(super) fn rotate_columns(&self, columns: usize, x: &mut [f64], sums: &mut [f64]) {
        f64::run(
            #[inline(always)]
            || {
                for k in (0..self.n).rev() {
                    let (tau, v) = self.reflection(k);
                    if tau == 0.0 {
                        continue;
                    }
                    let x = &mut x[(k + 1) * columns..];
                    sums.fill(0.0);
                    for (row, v) in x.chunks_exact(columns).zip(v) {
                        add(*v, row, sums);
                    }
                    for (row, v) in x.chunks_exact_mut(columns).zip(v) {
                        add(-tau * v, sums, row);
                    }
                }
            },
        );
        let sorted = x.to_vec();
        for (row, &index) in sorted.chunks_exact(columns).zip(&self.order) {
            x[index * columns..(index + 1) * columns].copy_from_slice(row);
        }
    }

    /// `Q x` in place.
    pub(super) fn rotate(&self, x: &mut Parts) {
        f64::run(
            #[inline(always)]
            || (0..self.n).rev().for_each(|k| self.reflect(k, x)),
        );
        for part in x.both() {
            let sorted = part.to_vec();
            for (&index, x) in self.order.iter().zip(sorted) {
                part[index] = x;
            }
        }
    }

    /// `Q^T x` in place.
    pub(super) fn rotate_back(&self, x: &mut Parts) {
        for part in x.both() {
            let sorted: Vec<f64> = self.order.iter().map(|&index| part[index]).collect();
            part.copy_from_slice(&sorted);
        }
        f64::run(
            #[inline(always)]
            || (0..self.n).for_each(|k| self.reflect(k, x)),
        );
    }

    #[inline(always)]
    fn reflect(&self, k: usize, x: &mut Parts) {
        let (tau, v) = self.reflection(k);
        if tau != 0.0 {
            for part in [&mut x.re[k + 1..], &mut x.im[k + 1..]] {
                add(-tau * dot(v, part), v, part);
            }
        }
    }
}
