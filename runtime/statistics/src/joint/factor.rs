//! Factorisation of correlation matrices.

use crate::Error;

/// Tolerance for rounding errors in a correlation.
const ROUNDING: f64 = 1e-10;

/// Lower triangular factor (row by row) of a correlation matrix of `size` rows (row by row).
///
/// A variable that is a combination of the preceding ones has a zero pivot.
///
/// # Errors
/// [`Error::WrongLength`] for a wrong number of entries, [`Error::Setting`] if the matrix is not symmetric and positive
/// semidefinite with ones on its diagonal.
pub fn semidefinite_factor(matrix: &[f64], size: usize) -> Result<Vec<f64>, Error> {
    if matrix.len() != size * size {
        return Err(Error::WrongLength {
            kind: "entries of a correlation matrix",
            found: matrix.len(),
            expected: size * size,
        });
    }
    let wrong = |reason: String| Err(Error::setting("correlation matrix", reason));
    let indefinite = || wrong("it is not positive semidefinite".to_owned());
    let at = |i: usize, j: usize| i * size + j;
    let mut lower = vec![0.0; size * size];
    for i in 0..size {
        let diagonal = matrix[at(i, i)];
        if (diagonal - 1.0).abs() > ROUNDING || diagonal.is_nan() {
            return wrong(format!("element ({i}, {i}) is {diagonal} and must be 1"));
        }
        for j in 0..=i {
            let (here, mirrored) = (matrix[at(i, j)], matrix[at(j, i)]);
            if here.is_nan() || (here - mirrored).abs() > ROUNDING || mirrored.is_nan() {
                return wrong(format!("elements ({i}, {j}) and ({j}, {i}) differ"));
            }
            let rest = (0..j).fold(here, |sum, k| sum - lower[at(i, k)] * lower[at(j, k)]);
            if i == j {
                if rest < -ROUNDING {
                    return indefinite();
                }
                lower[at(i, i)] = if rest > ROUNDING { rest.sqrt() } else { 0.0 };
            } else if lower[at(j, j)] > 0.0 {
                lower[at(i, j)] = rest / lower[at(j, j)];
            } else if rest.abs() > ROUNDING.sqrt() {
                return indefinite();
            }
        }
    }
    Ok(lower)
}
