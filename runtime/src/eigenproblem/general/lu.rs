//! Triangular factors of a small complex matrix with complete pivoting, which reveals its rank: null vectors come from
//! the last rows and columns.

use num_complex::Complex64;

use super::pencil::bound;
use crate::algebra::for_size;

pub(super) struct Lu<'a> {
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
        let (rows, columns) = order.split_at_mut(n);
        let unit = for_size(
            n,
            #[inline(always)]
            |n| eliminate(n, &mut matrix[..n * n], &mut rows[..n], &mut columns[..n]),
        );
        Self {
            n,
            factors: matrix,
            rows,
            columns,
            unit,
        }
    }

    /// Size of pivot `k` relative to the largest element of the matrix.
    pub(super) fn pivot(&self, k: usize) -> f64 {
        bound(self.factors[k * self.n + k])
    }

    /// Number of last pivots that do not exceed `threshold`, at least one.
    pub(super) fn nullity(&self, threshold: f64) -> usize {
        let regular = (0..self.n).take_while(|&k| self.pivot(k) > threshold);
        (self.n - regular.count()).max(1)
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
    pub(super) fn solve(&self, b: &[Complex64], x: &mut [Complex64], work: &mut [Complex64]) {
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

    /// Solves `matrix^T x = b` in the same way.
    pub(super) fn solve_transposed(
        &self,
        b: &[Complex64],
        x: &mut [Complex64],
        work: &mut [Complex64],
    ) {
        for_size(
            self.n,
            #[inline(always)]
            |n| self.solve_transposed_sized(n, b, &mut x[..n], &mut work[..n]),
        );
    }

    #[inline(always)]
    fn solve_transposed_sized(
        &self,
        n: usize,
        b: &[Complex64],
        x: &mut [Complex64],
        work: &mut [Complex64],
    ) {
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
    let mut unit = 0.0;
    for k in 0..n {
        let (mut most, mut i_most, mut j_most) = (-1.0, k, k);
        for i in k..n {
            for j in k..n {
                let size = bound(matrix[i * n + j]);
                if size > most {
                    (most, i_most, j_most) = (size, i, j);
                }
            }
        }
        if k == 0 {
            unit = if most > NOTHING { most } else { 1.0 };
            let inverse = 1.0 / unit;
            matrix.iter_mut().for_each(|x| *x *= inverse);
        }
        if i_most != k {
            rows.swap(k, i_most);
            for j in 0..n {
                matrix.swap(k * n + j, i_most * n + j);
            }
        }
        if j_most != k {
            columns.swap(k, j_most);
            for i in 0..n {
                matrix.swap(i * n + k, i * n + j_most);
            }
        }
        if k + 1 == n {
            break;
        }
        let inverse = 1.0 / pivot(matrix[k * n + k]);
        for i in k + 1..n {
            let factor = matrix[i * n + k] * inverse;
            matrix[i * n + k] = factor;
            if factor != Complex64::ZERO {
                for j in k + 1..n {
                    let product = factor * matrix[k * n + j];
                    matrix[i * n + j] -= product;
                }
            }
        }
    }
    unit
}

/// A matrix without larger elements counts as zero.
const NOTHING: f64 = 1e-290;
/// Replaces a vanishing pivot; its square and the square of its inverse are within range.
const TINY: f64 = 1e-100;

fn pivot(z: Complex64) -> Complex64 {
    if bound(z) < TINY {
        Complex64::new(TINY, 0.0)
    } else {
        z
    }
}
