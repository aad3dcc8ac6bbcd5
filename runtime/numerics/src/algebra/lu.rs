//! Triangular factorisation of a general matrix.

use super::for_size;
use super::matrix::{Matrix, combine_rows};
use super::vector::Vector;
use crate::Complex;
use eigentol_contract::Real;

/// Scalars of a linear system: real or complex numbers.
pub trait Field:
    Copy
    + Default
    + PartialEq
    + core::ops::Add<Output = Self>
    + core::ops::Sub<Output = Self>
    + core::ops::Mul<Output = Self>
    + core::ops::Div<Output = Self>
{
    /// A magnitude within a factor of two of the absolute value.
    fn size(self) -> f64;
}

impl Field for f64 {
    #[inline]
    fn size(self) -> f64 {
        self.abs()
    }
}

impl Field for Complex {
    #[inline]
    fn size(self) -> f64 {
        self.l1_norm()
    }
}

/// Size from which rows are long enough for the vectors of the processor, which do not change the bits.
const LARGE: usize = 16;

/// Factors with row exchanges.
#[derive(Clone, Debug)]
pub struct Lu<T = f64> {
    factors: Matrix<T>,
    order: Vector<usize>,
    odd: bool,
}

impl<T: Field> Lu<T> {
    /// Factors `matrix`; `None` if it is singular up to rounding: if nothing but the rounding of what has been
    /// subtracted is left of the elements that could be a pivot. This depends neither on the units of rows nor on those
    /// of columns.
    pub fn new(matrix: &Matrix<T>) -> Option<Self> {
        Self::of(matrix.clone())
    }

    /// Like [`Self::new`], in place.
    pub fn of(matrix: Matrix<T>) -> Option<Self> {
        let n = matrix.row_count();
        let mut lu = Self { factors: matrix, order: (0..n).collect(), odd: false };
        let regular = if n < LARGE {
            for_size(
                n,
                #[inline(always)]
                |n| lu.factor(n),
            )
        } else {
            f64::run(
                #[inline(always)]
                || lu.factor(n),
            )
        };
        regular.then_some(lu)
    }

    /// Factors, in place, the matrix of size `n`; see [`for_size`]. Returns whether it is regular.
    #[inline(always)]
    fn factor(&mut self, n: usize) -> bool {
        let factors = &mut self.factors.as_flattened_mut()[..n * n];
        let order = &mut self.order[..n];
        let mut size = Vector::zeros(n);
        let size = &mut size[..n];
        for i in 0..n {
            size[i] = factors[i * n..(i + 1) * n].iter().fold(0.0, |most: f64, value| most.max(value.size()));
        }
        for k in 0..n {
            let Some(best) = pivot_row(n, k, factors, size) else {
                return false;
            };
            if best != k {
                for j in 0..n {
                    factors.swap(k * n + j, best * n + j);
                }
                order.swap(k, best);
                size.swap(k, best);
                self.odd = !self.odd;
            }
            let (above, below) = factors.split_at_mut((k + 1) * n);
            let pivot = &above[k * n..];
            for row in below.chunks_exact_mut(n) {
                let factor = row[k] / pivot[k];
                row[k] = factor;
                for j in k + 1..n {
                    row[j] = row[j] - factor * pivot[j];
                }
            }
        }
        true
    }

    pub fn solve(&self, right: &[T]) -> Vector<T> {
        let mut x = Vector::zeros(right.len());
        for_size(
            right.len(),
            #[inline(always)]
            |n| self.solve_into(n, right, &mut x),
        );
        x
    }

    /// Solves for several right-hand sides at once, the columns of a matrix; each has the bits of [`Self::solve`].
    #[inline(always)]
    pub fn solve_columns(&self, right: &Matrix<T>) -> Matrix<T> {
        let (n, count) = (right.row_count(), right.column_count());
        let (factors, order) = (&self.factors.as_flattened()[..n * n], &self.order[..n]);
        let mut x = Matrix::from_fn(n, count, |i, j| right[order[i]][j]);
        let entries = x.as_flattened_mut();
        for i in 0..n {
            let (done, rest) = entries.split_at_mut(i * count);
            let factor = |k: usize| factors[i * n + k];
            combine_rows(&mut rest[..count], (done, i), factor, minus);
        }
        for i in (0..n).rev() {
            let (open, done) = entries.split_at_mut((i + 1) * count);
            let row = &mut open[i * count..];
            let factor = |k: usize| factors[i * n + i + 1 + k];
            combine_rows(row, (done, n - i - 1), factor, minus);
            let pivot = factors[i * n + i];
            row.iter_mut().for_each(|value| *value = *value / pivot);
        }
        x
    }

    #[inline(always)]
    fn solve_into(&self, n: usize, right: &[T], x: &mut [T]) {
        let (factors, order) = (&self.factors.as_flattened()[..n * n], &self.order[..n]);
        let (right, x) = (&right[..n], &mut x[..n]);
        for i in 0..n {
            x[i] = right[order[i]];
        }
        for i in 0..n {
            for k in 0..i {
                x[i] = x[i] - factors[i * n + k] * x[k];
            }
        }
        for i in (0..n).rev() {
            for k in i + 1..n {
                x[i] = x[i] - factors[i * n + k] * x[k];
            }
            x[i] = x[i] / factors[i * n + i];
        }
    }

    /// Solves with the transposed matrix.
    pub fn solve_transposed(&self, right: &[T]) -> Vector<T> {
        let n = right.len();
        let mut y = Vector::from(right);
        for i in 0..n {
            for k in 0..i {
                y[i] = y[i] - self.factors[k][i] * y[k];
            }
            y[i] = y[i] / self.factors[i][i];
        }
        for i in (0..n).rev() {
            for k in i + 1..n {
                y[i] = y[i] - self.factors[k][i] * y[k];
            }
        }
        let mut x = Vector::zeros(n);
        for (&index, value) in self.order.iter().zip(y) {
            x[index] = value;
        }
        x
    }

    /// Solves with the transposed matrix for several right-hand sides at once, the columns of a matrix; each has the bits
    /// of [`Self::solve_transposed`].
    #[inline(always)]
    pub fn solve_transposed_columns(&self, right: &Matrix<T>) -> Matrix<T> {
        let (n, count) = (right.row_count(), right.column_count());
        let factors = &self.factors.as_flattened()[..n * n];
        let mut y = right.clone();
        let entries = y.as_flattened_mut();
        for i in 0..n {
            let (done, rest) = entries.split_at_mut(i * count);
            let row = &mut rest[..count];
            combine_rows(row, (done, i), |k| factors[k * n + i], minus);
            let pivot = factors[i * n + i];
            row.iter_mut().for_each(|value| *value = *value / pivot);
        }
        for i in (0..n).rev() {
            let (open, done) = entries.split_at_mut((i + 1) * count);
            let factor = |k: usize| factors[(i + 1 + k) * n + i];
            combine_rows(&mut open[i * count..], (done, n - i - 1), factor, minus);
        }
        let mut x = Matrix::zeros(n, count);
        for (&index, row) in self.order.iter().zip(y.iter()) {
            x[index].copy_from_slice(row);
        }
        x
    }
}

#[inline(always)]
fn minus<T: Field>(sum: T, factor: T, value: T) -> T {
    sum - factor * value
}

/// The row with the largest element in column `k`, relative to its own size, that is not just the rounding of what has
/// been subtracted; `None` if there is none.
#[inline(always)]
fn pivot_row<T: Field>(n: usize, k: usize, factors: &[T], size: &[f64]) -> Option<usize> {
    let threshold = 8.0 * n as f64 * f64::EPSILON;
    let known = |i: usize| {
        let subtracted = (0..k).fold(0.0, |sum, m| sum + factors[i * n + m].size() * factors[m * n + k].size());
        factors[i * n + k].size() > threshold * subtracted
    };
    let (mut best, mut most) = (k, 0.0);
    for i in k..n {
        let relative = factors[i * n + k].size() / size[i];
        if relative > most {
            (best, most) = (i, relative);
        }
    }
    if most == 0.0 || most == f64::INFINITY {
        return None;
    }
    if known(best) {
        return Some(best);
    }
    (k..n).filter(|&i| known(i)).max_by(|&a, &b| {
        let relative = |i: usize| factors[i * n + k].size() / size[i];
        relative(a).total_cmp(&relative(b))
    })
}

impl Lu<f64> {
    /// The determinant, of a small matrix: that of a large one may leave the range of numbers.
    pub fn determinant(&self) -> f64 {
        let sign = if self.odd { -1.0 } else { 1.0 };
        (0..self.order.len()).fold(sign, |product, i| product * self.factors[i][i])
    }

    /// Whether the determinant is negative.
    pub fn negative_determinant(&self) -> bool {
        (0..self.order.len()).fold(self.odd, |negative, i| negative != (self.factors[i][i] < 0.0))
    }
}

impl Lu<Complex> {
    /// The determinant over its modulus.
    pub fn phase_of_determinant(&self) -> Complex {
        let sign = Complex::new(if self.odd { -1.0 } else { 1.0 }, 0.0);
        (0..self.order.len()).fold(sign, |product, i| product * self.factors[i][i] / self.factors[i][i].norm())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::algebra::matrix::times;
    use crate::algebra::vector::{add_scaled, largest};

    #[test]
    fn it_solves() {
        let matrix = Matrix::from([[4.0, 1.0, 0.5], [1.0, 3.0, -1.0], [0.5, -1.0, 5.0]]);
        let x = [1.0, -2.0, 3.0];
        let Some(lu) = Lu::new(&matrix) else { panic!("regular") };
        let solution = lu.solve(&times(&matrix, &x));
        assert!(largest(&add_scaled(&solution, -1.0, &x)) < 1e-14);
        assert!(!lu.negative_determinant());
    }

    #[test]
    fn singular_matrices_are_refused() {
        assert!(Lu::new(&Matrix::from([[1.0, 2.0], [2.0, 4.0]])).is_none());
        assert!(Lu::new(&Matrix::from([[0.0; 2]; 2])).is_none());
        assert!(Lu::new(&Matrix::from([[f64::NAN; 2]; 2])).is_none());
    }

    /// Two springs on coordinates that a constraint ties together.
    fn tied(first: f64, second: f64) -> Matrix {
        Matrix::from([[first, 0.0, 1.0], [0.0, second, 1.0], [1.0, 1.0, 0.0]])
    }

    #[test]
    fn units_do_not_make_a_matrix_singular() {
        for exponent in [-200, -60, 0, 60, 200] {
            let unit = 2f64.powi(exponent);
            let matrix = tied(unit, 3.0 * unit);
            let Some(lu) = Lu::new(&matrix) else { panic!("regular at {exponent}") };
            let x = [1.0, -1.0, unit];
            let solution = lu.solve(&times(&matrix, &x));
            for (solved, expected) in solution.iter().zip(x) {
                assert!((solved / expected - 1.0).abs() < 1e-14, "{solution:?}");
            }
            // What is left of two springs that cancel is rounding, at any size.
            assert!(Lu::new(&tied(unit, -unit)).is_none());
            assert!(Lu::new(&tied(unit, -unit * (1.0 - 1e-15))).is_none());
        }
    }

    #[test]
    fn a_pivot_of_rounding_gives_way_to_a_small_one() {
        // What is left at the second place of the second row is rounding, yet it is the larger share of its row.
        let small = 2f64.powi(-80);
        let matrix =
            Matrix::from([[1.0, 1.0, 0.0], [1.0, 1.0 + f64::EPSILON, 0.5 * f64::EPSILON], [0.0, small, 2f64.powi(40)]]);
        let Some(lu) = Lu::new(&matrix) else { panic!("regular") };
        assert_eq!(&lu.order[..], [0, 2, 1]);
    }

    #[test]
    fn sign_of_determinant_follows_exchanges() {
        let Some(swap) = Lu::new(&Matrix::from([[0.0, 1.0], [1.0, 0.0]])) else { panic!("regular") };
        assert!(swap.negative_determinant());
    }
}
