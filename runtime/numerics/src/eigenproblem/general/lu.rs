//! Triangular factors of a small complex matrix with complete pivoting, which reveals its rank: null vectors come from
//! the last rows and columns.

use num_complex::Complex64;

use super::census;
use super::pencil::bound;
use crate::algebra::for_size;
use crate::scalar::Real;

pub(crate) struct Lu<'a> {
    n: usize,
    /// `L` below the diagonal (with a unit diagonal), `U` above, with rows and columns exchanged.
    factors: &'a [Complex64],
    /// The row and the column of the matrix at position `i`.
    rows: &'a [usize],
    columns: &'a [usize],
    /// Divisor that was applied to the matrix.
    pub(super) unit: f64,
}

impl<'a> Lu<'a> {
    /// Factors `matrix` in place; `order` needs `2 n` indices.
    pub(super) fn new(n: usize, matrix: &'a mut [Complex64], order: &'a mut [usize]) -> Self {
        census::note(|census| census.factors += 1);
        let (rows, columns) = order.split_at_mut(n);
        let unit = f64::run(
            #[inline(always)]
            || {
                for_size(
                    n,
                    #[inline(always)]
                    |n| eliminate(n, &mut matrix[..n * n], &mut rows[..n], &mut columns[..n]),
                )
            },
        );
        Self { n, factors: matrix, rows, columns, unit }
    }

    /// Size of pivot `k` relative to the largest element of the matrix.
    pub(super) fn pivot(&self, k: usize) -> f64 {
        bound(self.factors[k * self.n + k])
    }

    /// Number of last pivots that do not exceed `threshold`, at least one.
    pub(super) fn nullity(&self, threshold: f64) -> usize {
        (self.n - (0..self.n).take_while(|&k| self.pivot(k) > threshold).count()).max(1)
    }

    /// Vector `k` of the `nullity` vectors that the matrix, without its last pivots, maps to zero.
    pub(super) fn null_right(&self, nullity: usize, k: usize, x: &mut [Complex64]) {
        let (n, rank) = (self.n, self.n - nullity);
        x.fill(Complex64::ZERO);
        x[self.columns[rank + k]] = Complex64::ONE;
        for i in (0..rank).rev() {
            let mut sum = -self.factors[i * n + rank + k];
            for j in i + 1..rank {
                sum -= self.factors[i * n + j] * x[self.columns[j]];
            }
            x[self.columns[i]] = sum / pivot(self.factors[i * n + i]);
        }
    }

    /// Vector `k` of the `nullity` vectors for which `x^T matrix`, without the last pivots, is zero.
    pub(super) fn null_left(&self, nullity: usize, k: usize, x: &mut [Complex64]) {
        let (n, rank) = (self.n, self.n - nullity);
        x.fill(Complex64::ZERO);
        x[self.rows[rank + k]] = Complex64::ONE;
        for i in (0..rank).rev() {
            let mut sum = -self.factors[(rank + k) * n + i];
            for j in i + 1..rank {
                sum -= self.factors[j * n + i] * x[self.rows[j]];
            }
            x[self.rows[i]] = sum;
        }
    }

    /// Solves `matrix x = b`; zero pivots are replaced by something tiny. `work` needs `n` numbers.
    pub(crate) fn solve(&self, b: &[Complex64], x: &mut [Complex64], work: &mut [Complex64]) {
        for_size(
            self.n,
            #[inline(always)]
            |n| self.solve_sized(n, b, &mut x[..n], &mut work[..n]),
        );
    }

    #[inline(always)]
    fn solve_sized(&self, n: usize, b: &[Complex64], x: &mut [Complex64], work: &mut [Complex64]) {
        for i in 0..n {
            let mut sum = b[self.rows[i]] / self.unit;
            for j in 0..i {
                sum -= self.factors[i * n + j] * work[j];
            }
            work[i] = sum;
        }
        for i in (0..n).rev() {
            let mut sum = work[i];
            for j in i + 1..n {
                sum -= self.factors[i * n + j] * x[self.columns[j]];
            }
            x[self.columns[i]] = sum / pivot(self.factors[i * n + i]);
        }
    }

    /// The trace of `matrix^-1 right`, given row by row; `work` needs `n^2` numbers.
    pub(super) fn trace_of_quotient(&self, right: &[Complex64], work: &mut [Complex64]) -> Complex64 {
        let n = self.n;
        for (row, &from) in work.chunks_exact_mut(n).zip(self.rows) {
            for (x, b) in row.iter_mut().zip(&right[from * n..]) {
                *x = b / self.unit;
            }
        }
        for i in 0..n {
            let (done, row) = work.split_at_mut(i * n);
            for (done, &factor) in done.chunks_exact(n).zip(&self.factors[i * n..]) {
                subtract(&mut row[..n], factor, done);
            }
        }
        for i in (0..n).rev() {
            let (row, done) = work[i * n..].split_at_mut(n);
            let factors = &self.factors[i * (n + 1)..(i + 1) * n];
            for (done, &factor) in done.chunks_exact(n).zip(&factors[1..]) {
                subtract(row, factor, done);
            }
            let pivot = pivot(factors[0]);
            row.iter_mut().for_each(|x| *x /= pivot);
        }
        let mut trace = Complex64::ZERO;
        for column in 0..n {
            let row = self.columns.iter().position(|&position| position == column);
            trace += row.map_or(Complex64::ZERO, |row| work[row * n + column]);
        }
        trace
    }

    /// Solves `matrix^T x = b` in the same way.
    pub(super) fn solve_transposed(&self, b: &[Complex64], x: &mut [Complex64], work: &mut [Complex64]) {
        for_size(
            self.n,
            #[inline(always)]
            |n| self.solve_transposed_sized(n, b, &mut x[..n], &mut work[..n]),
        );
    }

    #[inline(always)]
    fn solve_transposed_sized(&self, n: usize, b: &[Complex64], x: &mut [Complex64], work: &mut [Complex64]) {
        for i in 0..n {
            let mut sum = b[self.columns[i]] / self.unit;
            for j in 0..i {
                sum -= self.factors[j * n + i] * work[j];
            }
            work[i] = sum / pivot(self.factors[i * n + i]);
        }
        for i in (0..n).rev() {
            let mut sum = work[i];
            for j in i + 1..n {
                sum -= self.factors[j * n + i] * x[self.rows[j]];
            }
            x[self.rows[i]] = sum;
        }
    }
}

/// Overwrites `matrix` with its factors and records the exchanges in `rows` and `columns`; returns the divisor applied
/// to the matrix.
#[inline(always)]
fn eliminate(n: usize, matrix: &mut [Complex64], rows: &mut [usize], columns: &mut [usize]) -> f64 {
    for (i, (row, column)) in rows.iter_mut().zip(columns.iter_mut()).enumerate() {
        (*row, *column) = (i, i);
    }
    let (size, mut entry) = largest(n, 0, matrix);
    let unit = if size > NOTHING { size } else { 1.0 };
    let inverse = 1.0 / unit;
    matrix.iter_mut().for_each(|x| *x *= inverse);
    for k in 0..n {
        let (row, column) = entry;
        if row != k {
            rows.swap(k, row);
            for j in 0..n {
                matrix.swap(k * n + j, row * n + j);
            }
        }
        if column != k {
            columns.swap(k, column);
            for i in 0..n {
                matrix.swap(i * n + k, i * n + column);
            }
        }
        if k + 1 == n {
            break;
        }
        let (above, below) = matrix.split_at_mut((k + 1) * n);
        let pivot_row = &above[k * n..];
        let inverse = 1.0 / pivot(pivot_row[k]);
        for row in below.chunks_exact_mut(n) {
            let factor = row[k] * inverse;
            row[k] = factor;
            if factor != Complex64::ZERO {
                subtract(&mut row[k + 1..], factor, &pivot_row[k + 1..]);
            }
        }
        (_, entry) = largest(n, k + 1, matrix);
    }
    unit
}

#[inline(always)]
fn subtract(from: &mut [Complex64], factor: Complex64, row: &[Complex64]) {
    for (x, y) in from.iter_mut().zip(row) {
        *x -= factor * y;
    }
}

/// The largest element from row and column `k` on, the first of equal ones, and its place.
#[inline(always)]
fn largest(n: usize, k: usize, matrix: &[Complex64]) -> (f64, (usize, usize)) {
    let (mut most, mut entry) = (-1.0, (k, k));
    for (i, row) in matrix.chunks_exact(n).enumerate().skip(k) {
        let mut greatest = -1.0;
        for z in &row[k..] {
            let size = bound(*z);
            greatest = if size > greatest { size } else { greatest };
        }
        if greatest > most {
            (most, entry) = (greatest, (i, k + row[k..].iter().position(|&z| bound(z) == greatest).unwrap_or(0)));
        }
    }
    (most, entry)
}

/// A matrix without larger elements counts as zero.
const NOTHING: f64 = 1e-290;
/// Replaces a vanishing pivot; its square and the square of its inverse are within range.
const TINY: f64 = 1e-100;

fn pivot(z: Complex64) -> Complex64 {
    if bound(z) < TINY { Complex64::new(TINY, 0.0) } else { z }
}
