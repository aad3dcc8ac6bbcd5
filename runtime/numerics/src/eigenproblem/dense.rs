//! Kernels on dense matrices, row by row, for sizes that are not small: loops over contiguous numbers, which the
//! compiler turns into vector instructions. Every sum has a fixed order, so instructions do not change the bits.

use crate::scalar::Real;

/// Numbers summed side by side.
const PARTS: usize = 8;
/// Rows and columns of a product that are formed together, in registers.
const ROWS: usize = 2;

/// `x . y`.
#[inline(always)]
pub(crate) fn dot(x: &[f64], y: &[f64]) -> f64 {
    sum_of(
        x,
        y,
        #[inline(always)]
        |product| product,
    )
}

/// The sum of the absolute terms in `x . y`.
#[inline(always)]
pub(super) fn dot_sizes(x: &[f64], y: &[f64]) -> f64 {
    sum_of(x, y, f64::abs)
}

/// The sum of what is taken of each product.
#[inline(always)]
fn sum_of(x: &[f64], y: &[f64], of: impl Fn(f64) -> f64) -> f64 {
    let (mut sums, mut rest) = ([0.0; PARTS], 0.0);
    let (x, x_rest) = x.as_chunks::<PARTS>();
    let (y, y_rest) = y.as_chunks::<PARTS>();
    for (x, y) in x.iter().zip(y) {
        for k in 0..PARTS {
            sums[k] += of(x[k] * y[k]);
        }
    }
    for (x, y) in x_rest.iter().zip(y_rest) {
        rest += of(x * y);
    }
    ((sums[0] + sums[4]) + (sums[1] + sums[5])) + ((sums[2] + sums[6]) + (sums[3] + sums[7])) + rest
}

/// `y += factor x`.
#[inline(always)]
pub(super) fn add(factor: f64, x: &[f64], y: &mut [f64]) {
    for (y, x) in y.iter_mut().zip(x) {
        *y += factor * x;
    }
}

/// `A B` for `A` with rows of length `inner` and `B` with rows of length `columns`.
pub(super) fn multiply(inner: usize, columns: usize, a: &[f64], b: &[f64], into: &mut [f64]) {
    f64::run(
        #[inline(always)]
        || {
            let rows = a.chunks(ROWS * inner);
            for (a, into) in rows.zip(into.chunks_mut(ROWS * columns)) {
                match a.len() / inner {
                    ROWS => multiply_rows::<ROWS>(inner, columns, a, b, into),
                    _ => multiply_rows::<1>(inner, columns, a, b, into),
                }
            }
        },
    );
}

#[inline(always)]
fn multiply_rows<const R: usize>(inner: usize, columns: usize, a: &[f64], b: &[f64], into: &mut [f64]) {
    let whole = columns - columns % PARTS;
    for from in (0..whole).step_by(PARTS) {
        let mut sums = [[0.0; PARTS]; R];
        for (k, b) in b.chunks_exact(columns).enumerate() {
            let b = &b[from..from + PARTS];
            for (r, sums) in sums.iter_mut().enumerate() {
                let a = a[r * inner + k];
                for (sum, b) in sums.iter_mut().zip(b) {
                    *sum += a * b;
                }
            }
        }
        for (r, sums) in sums.iter().enumerate() {
            into[r * columns + from..r * columns + from + PARTS].copy_from_slice(sums);
        }
    }
    for j in whole..columns {
        for r in 0..R {
            let row = &a[r * inner..(r + 1) * inner];
            let column = b.chunks_exact(columns).map(|b| b[j]);
            into[r * columns + j] = row.iter().zip(column).fold(0.0, |sum, (a, b)| sum + a * b);
        }
    }
}

/// `L^-1 X` in place, for `X` with rows of length `columns`.
pub(super) fn solve_lower(n: usize, lower: &[f64], columns: usize, x: &mut [f64]) {
    f64::run(
        #[inline(always)]
        || {
            for i in 0..n {
                let (done, rest) = x.split_at_mut(i * columns);
                let (factors, pivot) = (&lower[i * n..i * (n + 1)], lower[i * (n + 1)]);
                if columns == 1 {
                    rest[0] = (rest[0] - dot(factors, done)) / pivot;
                    continue;
                }
                let row = &mut rest[..columns];
                for (k, &factor) in factors.iter().enumerate() {
                    add(-factor, &done[k * columns..(k + 1) * columns], row);
                }
                row.iter_mut().for_each(|x| *x /= pivot);
            }
        },
    );
}

/// `L^-T X` in place, for `X` with rows of length `columns`.
pub(super) fn solve_lower_transposed(n: usize, lower: &[f64], columns: usize, x: &mut [f64]) {
    f64::run(
        #[inline(always)]
        || {
            for i in (0..n).rev() {
                let (rest, done) = x.split_at_mut(i * columns);
                let (factors, pivot) = (&lower[i * n..i * (n + 1)], lower[i * (n + 1)]);
                let row = &mut done[..columns];
                row.iter_mut().for_each(|x| *x /= pivot);
                if columns == 1 {
                    add(-row[0], factors, rest);
                    continue;
                }
                for (k, &factor) in factors.iter().enumerate() {
                    add(-factor, row, &mut rest[k * columns..(k + 1) * columns]);
                }
            }
        },
    );
}

/// The Cholesky factor of the symmetric `matrix`, zero above the diagonal; `Err` names the first row whose pivot is not
/// above rounding.
pub(super) fn cholesky(n: usize, matrix: &[f64], lower: &mut [f64]) -> Result<(), usize> {
    let threshold = 8.0 * n as f64 * f64::EPSILON;
    f64::run(
        #[inline(always)]
        || {
            lower.fill(0.0);
            for i in 0..n {
                let (above, row) = lower.split_at_mut(i * n);
                for j in 0..i {
                    let other = &above[j * n..j * n + j + 1];
                    row[j] = (matrix[i * n + j] - dot(&row[..j], &other[..j])) / other[j];
                }
                let pivot = matrix[i * n + i] - dot(&row[..i], &row[..i]);
                if !(pivot > threshold * matrix[i * n + i].abs() && pivot.is_finite()) {
                    return Err(i);
                }
                row[i] = pivot.sqrt();
            }
            Ok(())
        },
    )
}

/// Transposes a square matrix in place.
#[inline]
pub(super) fn transpose(n: usize, matrix: &mut [f64]) {
    for i in 0..n {
        for j in 0..i {
            matrix.swap(i * n + j, j * n + i);
        }
    }
}
