//! Decides what is zero up to rounding.

use crate::algebra::Matrix;

/// The sign of a value with a known error.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sign {
    /// Below zero by more than the error.
    Negative,
    /// Within the error.
    Zero,
    /// Above zero by more than the error.
    Positive,
}

/// The sign of `value`, as far as `error` allows it to be determined.
#[inline]
pub fn sign(value: f64, error: f64) -> Sign {
    if value > error {
        Sign::Positive
    } else if value < -error {
        Sign::Negative
    } else {
        Sign::Zero
    }
}

/// Rounding of the elements of `n` by `n` matrices, relative to each element.
///
/// It is relative to each element and not to the largest one: a soft mode next to a stiff one is as well determined as
/// if it were alone (J. Barlow and J. Demmel, "Computing accurate eigensystems of scaled diagonally dominant matrices",
/// 1990).
#[inline]
pub const fn of_elements(n: usize) -> f64 {
    4.0 * n as f64 * f64::EPSILON
}

/// Change of `phi^T matrix phi` due to rounding of the matrix elements.
pub fn of_form(matrix: &Matrix, phi: &[f64]) -> f64 {
    let mut terms = 0.0;
    for (row, left) in matrix.iter().zip(phi) {
        for (element, right) in row.iter().zip(phi) {
            terms += (left * element * right).abs();
        }
    }
    of_elements(phi.len()) * terms
}
