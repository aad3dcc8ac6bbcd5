//! Triangular factors of a general matrix.

use super::matrix::Matrix;
use super::vector::Vector;
use crate::Complex;

/// What a linear system is solved in: real or complex numbers.
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
    /// Factors `matrix`; `None` when a pivot does not rise above the rounding of its own row.
    pub(crate) fn new(matrix: &Matrix<T>) -> Option<Self> {
        let n = matrix.row_count();
        let threshold = 8.0 * n as f64 * f64::EPSILON;
        let mut factors = matrix.clone();
        let mut order: Vector<usize> = (0..n).collect();
        let mut size: Vector = matrix
            .iter()
            .map(|row| {
                row.iter()
                    .fold(0.0, |most: f64, value| most.max(value.size()))
            })
            .collect();
        let mut odd = false;
        for k in 0..n {
            let mut best = k;
            let mut most = -1.0;
            for i in k..n {
                let relative = factors[i][k].size() / size[i];
                if relative > most {
                    best = i;
                    most = relative;
                }
            }
            if most <= threshold || !most.is_finite() {
                return None;
            }
            if best != k {
                factors.swap(k, best);
                order.swap(k, best);
                size.swap(k, best);
                odd = !odd;
            }
            let (above, below) = factors.as_flattened_mut().split_at_mut((k + 1) * n);
            let pivot = &above[k * n..];
            for row in below.chunks_exact_mut(n) {
                let factor = row[k] / pivot[k];
                row[k] = factor;
                for j in k + 1..n {
                    row[j] = row[j] - factor * pivot[j];
                }
            }
        }
        Some(Self {
            factors,
            order,
            odd,
        })
    }

    pub(crate) fn solve(&self, right: &[T]) -> Vector<T> {
        let n = right.len();
        let mut x: Vector<T> = self.order.iter().map(|&i| right[i]).collect();
        for i in 0..n {
            let row = &self.factors[i];
            for k in 0..i {
                x[i] = x[i] - row[k] * x[k];
            }
        }
        for i in (0..n).rev() {
            let row = &self.factors[i];
            for k in i + 1..n {
                x[i] = x[i] - row[k] * x[k];
            }
            x[i] = x[i] / row[i];
        }
        x
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
