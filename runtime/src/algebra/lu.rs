//! Triangular factorisation of a general matrix.

use super::for_size;
use super::matrix::Matrix;
use super::vector::Vector;
use crate::Complex;

/// Scalars of a linear system: real or complex numbers.
pub(crate) trait Field:
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

/// Factors with row exchanges.
#[derive(Clone, Debug)]
pub(crate) struct Lu<T = f64> {
    factors: Matrix<T>,
    order: Vector<usize>,
    odd: bool,
}

impl<T: Field> Lu<T> {
    /// Factors `matrix`; `None` if a pivot does not exceed the rounding of its own row.
    pub(crate) fn new(matrix: &Matrix<T>) -> Option<Self> {
        Self::of(matrix.clone())
    }

    /// Like [`Self::new`], in place.
    pub(crate) fn of(matrix: Matrix<T>) -> Option<Self> {
        let n = matrix.row_count();
        let mut lu = Self {
            factors: matrix,
            order: (0..n).collect(),
            odd: false,
        };
        let regular = for_size(
            n,
            #[inline(always)]
            |n| lu.factor(n),
        );
        regular.then_some(lu)
    }

    /// Factors, in place, the matrix of size `n`; see [`for_size`]. Returns whether it is regular.
    #[inline(always)]
    fn factor(&mut self, n: usize) -> bool {
        let threshold = 8.0 * n as f64 * f64::EPSILON;
        let factors = &mut self.factors.as_flattened_mut()[..n * n];
        let order = &mut self.order[..n];
        let mut size = Vector::zeros(n);
        let size = &mut size[..n];
        for i in 0..n {
            let row = factors[i * n..(i + 1) * n].iter();
            size[i] = row.fold(0.0, |most: f64, value| most.max(value.size()));
        }
        for k in 0..n {
            let mut best = k;
            let mut most = -1.0;
            for i in k..n {
                let relative = factors[i * n + k].size() / size[i];
                if relative > most {
                    best = i;
                    most = relative;
                }
            }
            if most <= threshold || !most.is_finite() {
                return false;
            }
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

    pub(crate) fn solve(&self, right: &[T]) -> Vector<T> {
        let mut x = Vector::zeros(right.len());
        for_size(
            right.len(),
            #[inline(always)]
            |n| self.solve_into(n, right, &mut x),
        );
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
}

impl Lu<f64> {
    /// Whether the determinant is negative.
    pub(crate) fn negative_determinant(&self) -> bool {
        (0..self.order.len()).fold(self.odd, |negative, i| {
            negative != (self.factors[i][i] < 0.0)
        })
    }

    /// Solves with the transposed matrix.
    pub(crate) fn solve_transposed(&self, right: &[f64]) -> Vector {
        let n = right.len();
        let mut y = Vector::from(right);
        for i in 0..n {
            for k in 0..i {
                y[i] -= self.factors[k][i] * y[k];
            }
            y[i] /= self.factors[i][i];
        }
        for i in (0..n).rev() {
            for k in i + 1..n {
                y[i] -= self.factors[k][i] * y[k];
            }
        }
        let mut x = Vector::zeros(n);
        for (&place, value) in self.order.iter().zip(y) {
            x[place] = value;
        }
        x
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
        let Some(lu) = Lu::new(&matrix) else {
            panic!("regular")
        };
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

    #[test]
    fn sign_of_determinant_follows_exchanges() {
        let Some(swap) = Lu::new(&Matrix::from([[0.0, 1.0], [1.0, 0.0]])) else {
            panic!("regular")
        };
        assert!(swap.negative_determinant());
    }
}
