//! On which side of the imaginary axis the eigenvalues lie, without their vectors.

use num_complex::Complex64;

use super::hessenberg;
use super::iteration::Iteration;
use super::linearisation::Linearisation;
use super::scaled_pencil::{Eigenproblem, scaled};
use super::schur;
use super::scratch::{Work, take};
use crate::linear::Linear;

/// Numbers of eigenvalues to the right of the imaginary axis.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Growing {
    /// Real ones.
    pub real: usize,
    /// Conjugate pairs.
    pub pairs: usize,
}

/// Errors of first order by which an eigenvalue is off the axis beyond doubt.
const MARGIN: f64 = 64.0;
/// Condition number up to which an eigenvalue is far from a defective one.
const SIMPLE: f64 = 1e4;

/// Counts the eigenvalues to the right of the imaginary axis; `None` if one of them is so close to it that its sign may be
/// rounding.
///
/// The eigenvalues are those of the linearisation, in error by its rounding times their condition numbers at most. Next to a
/// defective one that is no bound, and the roots with their own errors decide.
pub fn growing(linear: &Linear) -> Option<Growing> {
    let n = linear.mass.row_count();
    let mut work = Work::new(n);
    let mut real = &mut work.real[..];
    let pencil = scaled(Eigenproblem::Quadratic(linear), &mut real).ok()?.pencil;
    let count = pencil.degree.eigenvalues(n);
    let companion = take(&mut real, count * count);
    let reflections = take(&mut real, count * count);
    let vector = take(&mut real, count);
    let linearisation = Linearisation::new(&pencil, companion, take(&mut real, 3 * n * n + 2 * n)).ok()?;
    let rounding = |s: Complex64| MARGIN * linearisation.noise_of_masses(s);
    let form = hessenberg::reduce_graded(count, companion, reflections, vector);
    let mut values = vec![Complex64::ZERO; count];
    schur::eigenvalues(count, &mut form.h.to_vec(), &mut values)?;
    if values.iter().any(|&s| s.re.abs() <= rounding(s)) {
        return None;
    }
    let mut iteration = Iteration::new(form, &linearisation);
    let mut found = Growing::default();
    for s in values.into_iter().filter(|s| s.im >= 0.0) {
        let condition = iteration.condition(s);
        let clear = condition <= SIMPLE && s.re.abs() > rounding(s) * condition;
        if !clear {
            return None;
        }
        match s.im == 0.0 {
            _ if s.re < 0.0 => {}
            true => found.real += 1,
            false => found.pairs += 1,
        }
    }
    Some(found)
}
