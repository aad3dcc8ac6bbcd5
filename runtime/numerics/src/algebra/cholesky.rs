//! Factorisation of a symmetric positive definite matrix.

use super::for_size;
use super::matrix::Matrix;
use super::vector::Vector;

/// `matrix = L D L^T`: Cholesky factors without square roots.
#[derive(Clone, Debug, Default)]
pub struct Cholesky {
    /// `L` below the diagonal, which is one.
    lower: Matrix,
    /// The diagonal of `D`.
    pivots: Vector,
}

impl Cholesky {
    /// Factors `matrix`; `Err` names the first row whose pivot is not above rounding.
    #[inline]
    pub fn new(matrix: &Matrix) -> Result<Self, usize> {
        let mut factors = Self::default();
        factors.factor(matrix)?;
        Ok(factors)
    }

    /// Overwrites the factors with those of `matrix`; `Err` as in [`Self::new`].
    #[inline]
    pub fn factor(&mut self, matrix: &Matrix) -> Result<(), usize> {
        for_size(
            matrix.row_count(),
            #[inline(always)]
            |n| {
                let (lower, pivots) = self.room(n);
                factor_rows(n, matrix.as_flattened(), lower, pivots)
            },
        )
    }

    /// Makes room for the entries of `L`, row by row, and for the pivots; the contents are unspecified.
    #[inline(always)]
    pub fn room(&mut self, n: usize) -> (&mut [f64], &mut [f64]) {
        (self.lower.make_room(n, n), self.pivots.make_room(n))
    }

    /// The diagonal of `D`.
    #[inline]
    pub fn pivots(&self) -> &[f64] {
        &self.pivots
    }

    /// Orthonormalises vectors `x_i` whose products form `matrix`: `sum_j x_j L^-T D^-1/2`.
    pub fn orthonormalise(&self, vectors: &mut [Vector]) {
        for i in 0..vectors.len() {
            let (before, rest) = vectors.split_at_mut(i);
            let vector = &mut rest[0];
            for (k, other) in before.iter().enumerate() {
                let factor = -self.lower[i][k];
                for (value, other) in vector.iter_mut().zip(other) {
                    *value += factor * other;
                }
            }
        }
        for (vector, pivot) in vectors.iter_mut().zip(&self.pivots) {
            let size = pivot.sqrt();
            vector.iter_mut().for_each(|value| *value /= size);
        }
    }

    #[inline]
    pub fn solve(&self, right: &[f64]) -> Vector {
        let mut x = Vector::from(right);
        self.solve_in_place(&mut x);
        x
    }

    /// Overwrites the right-hand side with the solution.
    #[inline]
    pub(crate) fn solve_in_place(&self, x: &mut [f64]) {
        for_size(
            x.len(),
            #[inline(always)]
            |n| self.solve_of(n, x),
        );
    }

    /// Like [`Self::solve_in_place`], for `n` unknowns; see [`for_size`].
    #[inline(always)]
    pub fn solve_of(&self, n: usize, x: &mut [f64]) {
        solve_rows(n, self.lower.as_flattened(), &self.pivots, x);
    }
}

/// [`Cholesky::factor`] for matrices of size `n` given row by row; see [`for_size`].
#[inline(always)]
pub fn factor_rows(n: usize, matrix: &[f64], lower: &mut [f64], pivots: &mut [f64]) -> Result<(), usize> {
    let threshold = 8.0 * n as f64 * f64::EPSILON;
    let (matrix, lower, pivots) = (&matrix[..n * n], &mut lower[..n * n], &mut pivots[..n]);
    for i in 0..n {
        let row = &matrix[i * n..(i + 1) * n];
        let (above, rest) = lower.split_at_mut(i * n);
        let lower_row = &mut rest[..n];
        let mut pivot = row[i];
        for j in 0..i {
            let mut sum = row[j];
            let other = &above[j * n..j * n + j];
            for k in 0..j {
                sum -= lower_row[k] * other[k];
            }
            // Scaled by its pivot until the row is complete.
            lower_row[j] = sum;
        }
        for j in 0..i {
            let scaled = lower_row[j];
            lower_row[j] = scaled / pivots[j];
            pivot -= scaled * lower_row[j];
        }
        if pivot > threshold * row[i].abs() && pivot < f64::INFINITY {
            pivots[i] = pivot;
        } else {
            return Err(i);
        }
    }
    Ok(())
}

/// [`Cholesky::solve_of`] with factors given row by row.
#[inline(always)]
pub fn solve_rows(n: usize, lower: &[f64], pivots: &[f64], x: &mut [f64]) {
    let (lower, pivots, x) = (&lower[..n * n], &pivots[..n], &mut x[..n]);
    for i in 0..n {
        for k in 0..i {
            x[i] -= lower[i * n + k] * x[k];
        }
    }
    for i in (0..n).rev() {
        x[i] /= pivots[i];
        for k in i + 1..n {
            x[i] -= lower[k * n + i] * x[k];
        }
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
        let Ok(factors) = Cholesky::new(&matrix) else { panic!("positive definite") };
        let solution = factors.solve(&times(&matrix, &x));
        assert!(largest(&add_scaled(&solution, -1.0, &x)) < 1e-14);
    }

    #[test]
    fn singular_matrices_are_refused() {
        let singular = Matrix::from([[1.0, 2.0], [2.0, 4.0]]);
        assert_eq!(Cholesky::new(&singular).err(), Some(1));
    }
}
