//! Matrices whose size is known at run time.

use core::fmt;
use core::ops::{Index, IndexMut};
use core::slice;

use super::buffer::{Buffer, UpTo16};
use super::for_size;
use super::vector::{Vector, dot, greater, largest, unless_finite};
use crate::Complex;

/// Number of entries stored in the matrix itself.
const FEW: usize = 16;

/// A matrix: `matrix[i][j]` is the element in row `i` and column `j`. Stored row by row.
///
/// nalgebra stores column by column, so copying the numbers alone would give the transpose. Conversions in both
/// directions keep rows as rows:
///
/// ```
/// # use eigentol_numerics as eigentol;
/// use eigentol::{Matrix, Vector};
/// use nalgebra::{DMatrix, DVector};
///
/// let gyroscopic = Matrix::from([[0.0, 2.0], [-2.0, 0.0]]);
/// assert_eq!(gyroscopic[0][1], 2.0);
///
/// let other = DMatrix::from(&gyroscopic);
/// assert_eq!(other[(0, 1)], 2.0);
/// assert_eq!(Matrix::from(&other), gyroscopic);
///
/// let force = other * DVector::from(Vector::from([1.0, 0.0]));
/// assert_eq!(Vector::from(force), [0.0, -2.0]);
/// ```
#[derive(Clone)]
pub struct Matrix<T = f64> {
    rows: usize,
    columns: usize,
    entries: Buffer<T, UpTo16, FEW>,
}

impl<T: Copy + Default> Default for Matrix<T> {
    #[inline]
    fn default() -> Self {
        Self { rows: 0, columns: 0, entries: Buffer::default() }
    }
}

impl<T: Copy + Default> Matrix<T> {
    /// All zeros.
    #[must_use]
    #[inline]
    pub fn zeros(rows: usize, columns: usize) -> Self {
        Self { rows, columns, entries: Buffer::filled(rows * columns, T::default()) }
    }
}

impl<T: Copy + Default> Matrix<T> {
    /// Resizes the matrix in the same storage, to be overwritten; the contents are unspecified. Returns the entries,
    /// row by row.
    #[inline]
    pub(crate) fn make_room(&mut self, rows: usize, columns: usize) -> &mut [T] {
        (self.rows, self.columns) = (rows, columns);
        self.entries.make_room(rows * columns)
    }

    /// `value(i, j)` at row `i` and column `j`.
    #[inline]
    pub fn from_fn(rows: usize, columns: usize, mut value: impl FnMut(usize, usize) -> T) -> Self {
        let mut matrix = Self::zeros(rows, columns);
        for (i, row) in matrix.iter_mut().enumerate() {
            for (j, entry) in row.iter_mut().enumerate() {
                *entry = value(i, j);
            }
        }
        matrix
    }

    /// The matrix with the given entries, row by row, as many full rows as they make.
    #[must_use]
    pub fn from_rows(columns: usize, entries: Vec<T>) -> Self {
        Self { rows: entries.len().checked_div(columns).unwrap_or(0), columns, entries: entries.into() }
    }

    /// Applies `f` to every entry.
    pub fn map<R: Copy + Default>(&self, f: impl FnMut(T) -> R) -> Matrix<R> {
        Matrix { rows: self.rows, columns: self.columns, entries: self.entries.iter().copied().map(f).collect() }
    }

    /// The transposed matrix.
    #[must_use]
    pub fn transpose(&self) -> Self {
        Self::from_fn(self.columns, self.rows, |i, j| self[j][i])
    }

    /// Column `j`.
    pub fn column(&self, j: usize) -> Vector<T> {
        (0..self.rows).map(|i| self[i][j]).collect()
    }
}

impl<T> Matrix<T> {
    /// Number of rows.
    #[inline]
    pub fn row_count(&self) -> usize {
        self.rows
    }

    /// Number of columns.
    #[inline]
    pub fn column_count(&self) -> usize {
        self.columns
    }

    /// The rows.
    #[inline]
    pub fn iter(&self) -> impl ExactSizeIterator<Item = &[T]> + DoubleEndedIterator {
        (0..self.rows).map(|i| &self[i])
    }

    /// The entries, row by row.
    #[inline(always)]
    pub fn as_flattened(&self) -> &[T] {
        &self.entries
    }

    /// The entries, row by row.
    #[inline(always)]
    pub fn as_flattened_mut(&mut self) -> &mut [T] {
        &mut self.entries
    }

    /// The rows, mutable; the matrix must have columns.
    #[inline]
    pub fn iter_mut(&mut self) -> slice::ChunksExactMut<'_, T> {
        self.entries.chunks_exact_mut(self.columns.max(1))
    }

    /// Exchanges two rows.
    #[inline]
    pub fn swap(&mut self, i: usize, k: usize) {
        for j in 0..self.columns {
            self.entries.swap(i * self.columns + j, k * self.columns + j);
        }
    }
}

impl<T> Index<usize> for Matrix<T> {
    type Output = [T];

    #[inline(always)]
    fn index(&self, i: usize) -> &[T] {
        &self.entries[i * self.columns..(i + 1) * self.columns]
    }
}

impl<T> IndexMut<usize> for Matrix<T> {
    #[inline(always)]
    fn index_mut(&mut self, i: usize) -> &mut [T] {
        &mut self.entries[i * self.columns..(i + 1) * self.columns]
    }
}

impl<T: Copy + Default, const R: usize, const C: usize> From<[[T; C]; R]> for Matrix<T> {
    fn from(rows: [[T; C]; R]) -> Self {
        Self { rows: R, columns: C, entries: Buffer::from_slice(rows.as_flattened()) }
    }
}

impl<T: PartialEq> PartialEq for Matrix<T> {
    fn eq(&self, other: &Self) -> bool {
        (self.rows, self.columns) == (other.rows, other.columns) && *self.entries == *other.entries
    }
}

impl<T: PartialEq, const R: usize, const C: usize> PartialEq<[[T; C]; R]> for Matrix<T> {
    fn eq(&self, other: &[[T; C]; R]) -> bool {
        (self.rows, self.columns) == (R, C) && *self.entries == *other.as_flattened()
    }
}

impl<T: fmt::Debug> fmt::Debug for Matrix<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list().entries(self.iter()).finish()
    }
}

/// `matrix x`.
#[inline]
pub fn times(matrix: &Matrix, x: &[f64]) -> Vector {
    matrix.iter().map(|row| dot(row, x)).collect()
}

/// `matrix x` for several vectors at once, the columns of `x`; each has the bits of [`times`].
#[inline(always)]
pub fn times_columns(matrix: &Matrix, x: &Matrix) -> Matrix {
    product(matrix, x, -0.0)
}

/// The product of two complex matrices.
#[inline(always)]
pub fn product_complex(a: &Matrix<Complex>, b: &Matrix<Complex>) -> Matrix<Complex> {
    product(a, b, Complex::ZERO)
}

#[inline(always)]
fn product<T>(a: &Matrix<T>, b: &Matrix<T>, zero: T) -> Matrix<T>
where
    T: Copy + Default + core::ops::Add<Output = T> + core::ops::Mul<Output = T>,
{
    let mut product = Matrix::zeros(a.rows, b.columns);
    let rows = (b.as_flattened(), b.rows);
    for (factors, sums) in a.iter().zip(product.iter_mut()) {
        sums.fill(zero);
        combine_rows(sums, rows, |k| factors[k], |sum, a, b| sum + a * b);
    }
    product
}

/// Applies `sum = f(sum, factor(k), row k)` to every entry of a row, for each of the rows stored one after the other.
/// Sums stay in registers for as many entries as these hold.
#[inline(always)]
pub(super) fn combine_rows<T: Copy>(
    sums: &mut [T],
    (rows, count): (&[T], usize),
    factor: impl Fn(usize) -> T,
    f: impl Fn(T, T, T) -> T,
) {
    let places = (rows, count, sums.len());
    let (wide, rest) = sums.as_chunks_mut::<8>();
    let first = combine_chunks(wide, places, 0, &factor, &f);
    let (wide, rest) = rest.as_chunks_mut::<4>();
    let first = combine_chunks(wide, places, first, &factor, &f);
    let (wide, rest) = rest.as_chunks_mut::<2>();
    let first = combine_chunks(wide, places, first, &factor, &f);
    combine_chunks(rest.as_chunks_mut::<1>().0, places, first, &factor, &f);
}

/// [`combine_rows`] for chunks of a row that begin at column `first`; returns the column after them.
#[inline(always)]
fn combine_chunks<T: Copy, const W: usize>(
    chunks: &mut [[T; W]],
    (rows, count, columns): (&[T], usize, usize),
    mut first: usize,
    factor: &impl Fn(usize) -> T,
    f: &impl Fn(T, T, T) -> T,
) -> usize {
    for chunk in chunks {
        let mut sums = *chunk;
        for k in 0..count {
            let factor = factor(k);
            let values = &rows[k * columns + first..][..W];
            for j in 0..W {
                sums[j] = f(sums[j], factor, values[j]);
            }
        }
        *chunk = sums;
        first += W;
    }
    first
}

/// `matrix x` for a complex vector.
pub fn times_complex(matrix: &Matrix, x: &[Complex]) -> Vector<Complex> {
    matrix.iter().map(|row: &[f64]| row.iter().zip(x).fold(Complex::default(), |sum, (a, b)| sum + b * a)).collect()
}

/// Bilinear form `x^T matrix y` of vectors of one length; rows and columns of the matrix beyond it do not matter.
pub fn form(x: &[f64], matrix: &Matrix, y: &[f64]) -> f64 {
    let (columns, entries) = (matrix.columns, matrix.as_flattened());
    for_size(
        x.len(),
        #[inline(always)]
        |n| {
            let (x, y) = (&x[..n], &y[..n]);
            let mut sum = -0.0;
            for (i, x) in x.iter().enumerate() {
                sum += x * dot(&entries[i * columns..][..n], y);
            }
            sum
        },
    )
}

/// Largest absolute element.
pub fn largest_element(matrix: &Matrix) -> f64 {
    largest(matrix.as_flattened())
}

/// Whether no element is NaN or infinite.
#[inline]
pub fn all_finite_matrix(matrix: &Matrix) -> bool {
    matrix.as_flattened().iter().fold(0.0, |sum, value| sum + unless_finite(*value)) == 0.0
}

/// Whether mirrored elements are equal to the last bit.
pub fn is_symmetric(matrix: &Matrix) -> bool {
    (0..matrix.row_count()).all(|i| (0..i).all(|j| matrix[i][j] == matrix[j][i]))
}

/// Largest difference of mirrored elements, relative to the largest element.
pub fn asymmetry(matrix: &Matrix) -> f64 {
    let size = largest_element(matrix);
    let mut most = 0.0;
    for i in 0..matrix.row_count() {
        for j in 0..i {
            most = greater(most, (matrix[i][j] - matrix[j][i]).abs());
        }
    }
    if size > 0.0 { most / size } else { 0.0 }
}

impl<T: Copy + Default> eigentol_contract::Zeros for Matrix<T> {
    #[inline]
    fn zeros(n: usize) -> Self {
        Self::zeros(n, n)
    }
}
