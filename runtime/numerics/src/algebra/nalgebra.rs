//! Conversions to and from nalgebra. Matrices are stored row by row here and column by column there; rows stay rows.

use nalgebra::{DMatrix, DVector, Scalar};

use super::{Matrix, Vector};

impl<T: Scalar> From<&Matrix<T>> for DMatrix<T> {
    /// Element `(i, j)` is `matrix[i][j]`.
    fn from(matrix: &Matrix<T>) -> Self {
        let (rows, columns) = (matrix.row_count(), matrix.column_count());
        DMatrix::from_row_slice(rows, columns, matrix.as_flattened())
    }
}

impl<T: Scalar> From<Matrix<T>> for DMatrix<T> {
    fn from(matrix: Matrix<T>) -> Self {
        Self::from(&matrix)
    }
}

impl<T: Scalar + Copy + Default> From<&DMatrix<T>> for Matrix<T> {
    /// Element `[i][j]` is `matrix[(i, j)]`.
    fn from(matrix: &DMatrix<T>) -> Self {
        Self::from_fn(matrix.nrows(), matrix.ncols(), |i, j| matrix[(i, j)])
    }
}

impl<T: Scalar + Copy + Default> From<DMatrix<T>> for Matrix<T> {
    fn from(matrix: DMatrix<T>) -> Self {
        Self::from(&matrix)
    }
}

impl<T: Scalar> From<&Vector<T>> for DVector<T> {
    fn from(vector: &Vector<T>) -> Self {
        Self::from_column_slice(vector)
    }
}

impl<T: Scalar + Copy> From<Vector<T>> for DVector<T> {
    fn from(vector: Vector<T>) -> Self {
        Self::from_vec(vector.into())
    }
}

impl<T: Scalar + Copy + Default> From<&DVector<T>> for Vector<T> {
    fn from(vector: &DVector<T>) -> Self {
        Self::from(vector.as_slice())
    }
}

impl<T: Scalar + Copy + Default> From<DVector<T>> for Vector<T> {
    fn from(vector: DVector<T>) -> Self {
        Self::from(&vector)
    }
}
