//! Eigenproblems and their scaling.

use super::pencil::{Degree, Pencil};
use super::scaling::{largest, scale, scale_first_order};
use super::scratch::take;
use crate::algebra::Matrix;
use crate::eigenproblem::symmetric::{EigenproblemError, not_found};
use crate::linear::Linear;

/// An eigenproblem.
#[derive(Clone, Copy)]
pub enum Eigenproblem<'a> {
    /// `(s^2 mass + s damping + stiffness) phi = 0`.
    Quadratic(&'a Linear),
    /// `matrix phi = s phi`.
    FirstOrder(&'a Matrix),
}

impl Eigenproblem<'_> {
    pub(crate) fn size(&self) -> usize {
        match self {
            Self::Quadratic(linear) => linear.mass.row_count(),
            Self::FirstOrder(matrix) => matrix.row_count(),
        }
    }
}

/// A pencil in its own units.
pub(crate) struct Scaled<'a> {
    pub(crate) pencil: Pencil<'a>,
    /// Units of right and of left vectors.
    pub(crate) right: &'a mut [f64],
    pub(crate) left: &'a mut [f64],
    /// Unit of the eigenvalues.
    pub(crate) rate: f64,
}

pub(crate) fn scaled<'a>(problem: Eigenproblem, store: &mut &'a mut [f64]) -> Result<Scaled<'a>, EigenproblemError> {
    let n = problem.size();
    let mass = take(store, n * n);
    let damping = take(store, n * n);
    let stiffness = take(store, n * n);
    let (right, left) = (take(store, n), take(store, n));
    let (degree, rate) = match problem {
        Eigenproblem::Quadratic(linear) => {
            mass.copy_from_slice(linear.mass.as_flattened());
            damping.copy_from_slice(linear.damping.as_flattened());
            stiffness.copy_from_slice(linear.stiffness.as_flattened());
            for i in 0..n {
                let diagonal = mass[i * n + i];
                if !(diagonal >= f64::MIN_POSITIVE && diagonal.is_finite()) {
                    return Err(EigenproblemError::SingularMass(i));
                }
            }
            let rate = scale(n, mass, damping, stiffness, right);
            left.copy_from_slice(right);
            (Degree::Two, rate)
        }
        Eigenproblem::FirstOrder(matrix) => {
            stiffness.copy_from_slice(matrix.as_flattened());
            if largest(stiffness).is_infinite() {
                return Err(not_found());
            }
            let rate = scale_first_order(n, damping, stiffness, right, left);
            (Degree::One, rate)
        }
    };
    if [&*mass, damping, stiffness].iter().any(|matrix| largest(matrix).is_infinite()) {
        return Err(not_found());
    }
    let transposed = [&*mass, damping, stiffness].map(|matrix| {
        let columns = take(store, n * n);
        for (j, column) in columns.chunks_exact_mut(n).enumerate() {
            for (i, element) in column.iter_mut().enumerate() {
                *element = matrix[i * n + j];
            }
        }
        &*columns
    });
    let pencil =
        Pencil { n, degree, transposed, largest: [&*mass, damping, stiffness].map(largest), mass, damping, stiffness };
    Ok(Scaled { pencil, right, left, rate })
}
