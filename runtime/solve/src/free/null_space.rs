//! Null vectors of a square matrix, right and left, by elimination with complete pivoting.
#![allow(clippy::needless_range_loop, reason = "index loops read as the formulas they are")]

use crate::algebra::{Matrix, Vector, add_to, dot, greater, is_symmetric, largest};

/// Share of the terms of an element below which what elimination leaves of it counts as zero.
const NEGLIGIBLE: f64 = 1e-10;
/// Size of the terms that elements are taken to have at least, in the units of the elimination: what is left of an
/// element that vanishes exactly, but for rounding, is none of its own terms.
const SMALL: f64 = 1e-9;
/// Sweeps that make the largest element of every row and column about one.
const SWEEPS: usize = 6;

/// Bases of the right and left null spaces of a matrix `K`, in units in which its elements are of order one.
///
/// The units are powers of two, found from the matrix itself, so that neither those of rows nor those of columns
/// matter.
#[derive(Clone, Debug)]
pub(crate) struct NullSpace {
    /// `K right_k = 0`.
    pub(crate) right: Vec<Vector>,
    /// `left_k^T K = 0`.
    pub(crate) left: Vec<Vector>,
    /// The covectors of `right`: `rows_i . right_k` is one for `i = k` and zero otherwise.
    pub(crate) rows: Vec<Vector>,
    /// The same of `left`, in the units of `K x`.
    pub(crate) columns: Vec<Vector>,
    /// `right` in the units in which it is orthonormal.
    pub(crate) basis: Vec<Vector>,
    /// What elimination left of the matrix, relative to the terms in it: small if the vectors are null vectors.
    pub(crate) remainder: f64,
}

impl NullSpace {
    /// The null space of `matrix`, which has at least the dimension `least`: elimination ends before the last `least`
    /// pivots, or where nothing but rounding remains.
    pub(crate) fn of(matrix: &Matrix, least: usize) -> Self {
        let (row, column) = units(matrix);
        let mut elimination = Elimination::new(matrix, &row, &column);
        elimination.run(least);
        let vectors = |basis: &[Vector], unit: &[f64]| -> (Vec<Vector>, Vec<Vector>) {
            let times = |x: &Vector| x.iter().zip(unit).map(|(x, unit)| x * unit).collect();
            let over = |x: &Vector| x.iter().zip(unit).map(|(x, unit)| x / unit).collect();
            (basis.iter().map(times).collect(), basis.iter().map(over).collect())
        };
        let basis = orthonormal(elimination.right());
        let (right, rows) = vectors(&basis, &column);
        // Of a symmetric matrix exactly the same, so that what is built from both stays symmetric.
        let (left, columns) = if is_symmetric(matrix) {
            (right.clone(), rows.clone())
        } else {
            vectors(&orthonormal(elimination.left()), &row)
        };
        Self { right, left, rows, columns, basis, remainder: elimination.remainder() }
    }

    /// The rank of a matrix.
    pub(crate) fn rank(matrix: &Matrix) -> usize {
        matrix.row_count() - Self::of(matrix, 0).right.len()
    }
}

/// Units of rows and columns in which the largest element of each is about one (Ruiz 2001); the same for both if the
/// matrix is symmetric.
fn units(matrix: &Matrix) -> (Vector, Vector) {
    let n = matrix.row_count();
    let (mut row, mut column) = (Vector::filled(n, 1.0), Vector::filled(n, 1.0));
    for _ in 0..SWEEPS {
        let (mut by_row, mut by_column) = (Vector::zeros(n), Vector::zeros(n));
        for i in 0..n {
            for j in 0..n {
                let size = (matrix[i][j] * row[i] * column[j]).abs();
                by_row[i] = greater(by_row[i], size);
                by_column[j] = greater(by_column[j], size);
            }
        }
        for (unit, size) in [(&mut row, by_row), (&mut column, by_column)] {
            for (unit, size) in unit.iter_mut().zip(&size) {
                if *size > 0.0 && size.is_finite() {
                    *unit /= (0.5 * size.log2()).round().exp2();
                }
            }
        }
    }
    (row, column)
}

/// Gaussian elimination with complete pivoting, stopped before the pivots that vanish.
struct Elimination {
    /// Rows and columns in the order of the pivots; multipliers below the diagonal.
    factors: Matrix,
    /// Sums of the absolute terms of each element.
    terms: Matrix,
    row_order: Vec<usize>,
    column_order: Vec<usize>,
    rank: usize,
}

impl Elimination {
    fn new(matrix: &Matrix, row: &[f64], column: &[f64]) -> Self {
        let n = matrix.row_count();
        let factors = Matrix::from_fn(n, n, |i, j| matrix[i][j] * row[i] * column[j]);
        Self {
            terms: factors.map(|entry| greater(entry.abs(), SMALL)),
            factors,
            row_order: (0..n).collect(),
            column_order: (0..n).collect(),
            rank: 0,
        }
    }

    fn run(&mut self, least: usize) {
        let n = self.row_order.len();
        while self.rank + least < n {
            let k = self.rank;
            let (mut best, mut most) = ((k, k), 0.0);
            for i in k..n {
                for j in k..n {
                    let size = self.factors[i][j].abs();
                    if size > most && size > NEGLIGIBLE * self.terms[i][j] {
                        (best, most) = ((i, j), size);
                    }
                }
            }
            if most == 0.0 {
                return;
            }
            self.exchange(k, best);
            for i in k + 1..n {
                let factor = self.factors[i][k] / self.factors[k][k];
                self.factors[i][k] = factor;
                for j in k + 1..n {
                    let product = factor * self.factors[k][j];
                    self.factors[i][j] -= product;
                    self.terms[i][j] += product.abs();
                }
            }
            self.rank += 1;
        }
    }

    fn exchange(&mut self, k: usize, (i, j): (usize, usize)) {
        self.row_order.swap(k, i);
        self.column_order.swap(k, j);
        for matrix in [&mut self.factors, &mut self.terms] {
            matrix.swap(k, i);
            for row in matrix.iter_mut() {
                row.swap(k, j);
            }
        }
    }

    /// The largest element that is left, relative to its terms.
    fn remainder(&self) -> f64 {
        let n = self.row_order.len();
        let mut most = 0.0;
        for i in self.rank..n {
            for j in self.rank..n {
                let (left, terms) = (self.factors[i][j].abs(), self.terms[i][j]);
                most = greater(most, if terms > 0.0 { left / terms } else { 0.0 });
            }
        }
        most
    }

    /// Vectors with `U x = 0`, one for each column without a pivot.
    fn right(&self) -> Vec<Vector> {
        let n = self.row_order.len();
        let vector = |free: usize| {
            let mut x = Vector::zeros(n);
            x[free] = 1.0;
            for i in (0..self.rank).rev() {
                let sum = (i + 1..n).fold(0.0, |sum, j| sum + self.factors[i][j] * x[j]);
                x[i] = -sum / self.factors[i][i];
            }
            placed(&x, &self.column_order)
        };
        (self.rank..n).map(vector).collect()
    }

    /// Vectors with `y^T L = 0` over the rows with a pivot, one for each row without one.
    fn left(&self) -> Vec<Vector> {
        let n = self.row_order.len();
        let vector = |free: usize| {
            let mut y = Vector::zeros(n);
            y[free] = 1.0;
            for k in (0..self.rank).rev() {
                let sum = (k + 1..self.rank).fold(self.factors[free][k], |sum, i| sum + y[i] * self.factors[i][k]);
                y[k] = -sum;
            }
            placed(&y, &self.row_order)
        };
        (self.rank..n).map(vector).collect()
    }
}

fn placed(x: &[f64], order: &[usize]) -> Vector {
    let mut vector = Vector::zeros(x.len());
    for (value, &index) in x.iter().zip(order) {
        vector[index] = *value;
    }
    vector
}

/// An orthonormal basis of the space that independent vectors span.
fn orthonormal(mut vectors: Vec<Vector>) -> Vec<Vector> {
    for k in 0..vectors.len() {
        for _ in 0..2 {
            for i in 0..k {
                let (before, rest) = vectors.split_at_mut(k);
                let along = dot(&before[i], &rest[0]);
                add_to(&mut rest[0], -along, &before[i]);
            }
            let most = largest(&vectors[k]);
            vectors[k].iter_mut().for_each(|value| *value /= most);
            let size = dot(&vectors[k], &vectors[k]).sqrt();
            vectors[k].iter_mut().for_each(|value| *value /= size);
        }
    }
    vectors
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::algebra::times;

    /// Springs between neighbours of a free chain, in the units `unit_i`.
    fn chain(unit: &[f64]) -> Matrix {
        let n = unit.len();
        let plain = |i: usize, j: usize| match i.abs_diff(j) {
            0 if i == 0 || i == n - 1 => 1.0,
            0 => 2.0,
            1 => -1.0,
            _ => 0.0,
        };
        Matrix::from_fn(n, n, |i, j| plain(i, j) * unit[i] * unit[j])
    }

    #[test]
    fn the_null_vector_of_a_chain_is_found_in_any_units() {
        for unit in [[1.0; 4], [1.0, 1e-9, 3e5, 0.2], [1e8, 1e-8, 1e8, 1e-8]] {
            for least in [0, 1] {
                let matrix = chain(&unit);
                let null_space = NullSpace::of(&matrix, least);
                assert_eq!(null_space.right.len(), 1);
                assert!(null_space.remainder < 1e-14);
                let x = &null_space.right[0];
                for (value, scale) in x.iter().zip(unit) {
                    assert!((value * scale / (x[0] * unit[0]) - 1.0).abs() < 1e-12);
                }
                assert_eq!(null_space.left, null_space.right);
                assert!((dot(&null_space.rows[0], x) - 1.0).abs() < 1e-14);
            }
        }
    }

    #[test]
    fn left_and_right_null_vectors_differ_without_symmetry() {
        let matrix = Matrix::from([[1.0, 2.0, 3.0], [2.0, 4.0, 6.0], [0.0, 1.0, -1.0]]);
        let null_space = NullSpace::of(&matrix, 0);
        assert_eq!((null_space.right.len(), null_space.left.len()), (1, 1));
        assert!(largest(&times(&matrix, &null_space.right[0])) < 1e-14);
        assert!(largest(&times(&matrix.transpose(), &null_space.left[0])) < 1e-14);
        assert!(NullSpace::of(&Matrix::from([[2.0, 1.0], [1.0, 1.0]]), 0).right.is_empty());
        assert_eq!(NullSpace::of(&Matrix::zeros(3, 3), 0).right.len(), 3);
    }

    #[test]
    fn a_regular_matrix_gives_its_least_resisted_direction() {
        let matrix = Matrix::from([[1.0, 0.0], [0.0, 1e-6]]);
        assert_eq!(NullSpace::of(&matrix, 0).right.len(), 0);
        let null_space = NullSpace::of(&matrix, 1);
        assert_eq!(null_space.right.len(), 1);
    }
}
