//! Results as numpy arrays.

use eigentol::{Complex, Matrix};
use numpy::{Element, PyArray, PyArray1, PyArray2, PyArray3, PyArrayMethods};
use pyo3::prelude::*;

pub(crate) type Array1<'py, T = f64> = Bound<'py, PyArray1<T>>;
pub(crate) type Array2<'py, T = f64> = Bound<'py, PyArray2<T>>;
pub(crate) type Array3<'py, T = f64> = Bound<'py, PyArray3<T>>;

/// A complex number that is missing.
pub(crate) const NONE: Complex = Complex::new(f64::NAN, f64::NAN);

pub(crate) fn vector<'py, T: Element>(py: Python<'py>, values: impl IntoIterator<Item = T>) -> Array1<'py, T> {
    PyArray::from_vec(py, values.into_iter().collect())
}

/// Numbers, with NaN for missing ones.
pub(crate) fn optional<'py>(py: Python<'py>, values: impl IntoIterator<Item = Option<f64>>) -> Array1<'py> {
    vector(py, values.into_iter().map(or_nan))
}

pub(crate) fn or_nan(value: Option<f64>) -> f64 {
    value.unwrap_or(f64::NAN)
}

pub(crate) fn matrix<'py, T: Element + Copy>(py: Python<'py>, matrix: &Matrix<T>) -> PyResult<Array2<'py, T>> {
    let shape = [matrix.row_count(), matrix.column_count()];
    vector(py, matrix.as_flattened().iter().copied()).reshape(shape)
}

/// Rows of length `columns`, which must be given because there may be no rows.
pub(crate) fn rows<'py, T: Element>(
    py: Python<'py>,
    columns: usize,
    rows: impl IntoIterator<Item = Vec<T>>,
) -> PyResult<Array2<'py, T>> {
    let mut count = 0;
    let mut all = Vec::new();
    for row in rows {
        all.extend(row);
        count += 1;
    }
    vector(py, all).reshape([count, columns])
}

/// Rows that may be missing, which become NaN.
pub(crate) fn optional_rows<'py>(
    py: Python<'py>,
    columns: usize,
    all: impl IntoIterator<Item = Option<Vec<f64>>>,
) -> PyResult<Array2<'py>> {
    rows(py, columns, all.into_iter().map(|row: Option<Vec<f64>>| row.unwrap_or_else(|| vec![f64::NAN; columns])))
}

/// Derivatives of a square matrix of `size` rows, one for each variable, which comes last in the array.
pub(crate) fn slopes<'py>(py: Python<'py>, size: usize, all: &[&Matrix]) -> PyResult<Array3<'py>> {
    let entry = |k: usize| all.iter().map(move |x| x.as_flattened()[k]);
    vector(py, (0..size * size).flat_map(entry)).reshape([size, size, all.len()])
}
