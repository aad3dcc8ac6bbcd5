//! The solver against closed forms, exactly known spectra, another solver and hard random pencils.

mod checks;
mod closed_forms;
mod conservative;
mod families;
mod hard;
mod known;
pub(crate) mod near;
mod parts;
mod scale;
mod stored;
pub(crate) mod torture;

use num_complex::Complex64;

use super::{Root, solve};
use crate::algebra::{Matrix, Vector};
use crate::eigenproblem::symmetric::Trouble;
use crate::linear::Linear;

fn linear(
    mass: impl Into<Matrix>,
    damping: impl Into<Matrix>,
    stiffness: impl Into<Matrix>,
) -> Linear {
    Linear {
        mass: mass.into(),
        damping: damping.into(),
        stiffness: stiffness.into(),
    }
}

fn zeros(n: usize) -> Matrix {
    Matrix::zeros(n, n)
}

fn identity(n: usize) -> Matrix {
    diagonal(&vec![1.0; n])
}

fn diagonal(elements: &[f64]) -> Matrix {
    let n = elements.len();
    Matrix::from_fn(n, n, |i, j| if i == j { elements[i] } else { 0.0 })
}

/// All roots, including conjugates.
fn all(roots: &[Root]) -> Vec<Complex64> {
    let mut values = Vec::new();
    for root in roots {
        values.push(root.s);
        if root.s.im > 0.0 {
            values.push(root.s.conj());
        }
    }
    values
}
