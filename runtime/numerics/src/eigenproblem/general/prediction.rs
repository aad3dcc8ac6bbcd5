//! Predicts eigenvalues from the pairs of a nearby problem.

use num_complex::Complex64;

use super::scaled_pencil::Eigenproblem;
use crate::linear::Linear;

/// Longest relative step that nearby vectors can predict.
const NEAR: f64 = 0.1;

/// An eigenvalue of a nearby problem, `Im s >= 0`, with its vectors.
#[derive(Clone, Copy)]
pub struct ApproximatePair<'a> {
    pub s: Complex64,
    pub right: &'a [Complex64],
    pub left: &'a [Complex64],
}

/// Predicts all eigenvalues in units of `rate`, conjugates included, by a Newton step on the Rayleigh functional
/// `psi^T Q(s) phi`: the error is of second order in the distance of the problems. `false` if the problems are too far
/// apart, or some eigenvalue has no nearby counterpart.
pub(super) fn predict(problem: Eigenproblem, near: &[ApproximatePair], rate: f64, values: &mut [Complex64]) -> bool {
    let Eigenproblem::Quadratic(linear) = problem else {
        return false;
    };
    let mut filled = 0;
    for pair in near {
        let Some(s) = improved(linear, pair) else {
            return false;
        };
        let s = s / rate;
        for value in [s, s.conj()].into_iter().take(1 + usize::from(s.im > 0.0)) {
            let Some(slot) = values.get_mut(filled) else {
                return false;
            };
            *slot = value;
            filled += 1;
        }
    }
    filled == values.len()
}

fn improved(linear: &Linear, pair: &ApproximatePair) -> Option<Complex64> {
    let (s, n) = (pair.s, linear.mass.row_count());
    if pair.right.len() != n || pair.left.len() != n {
        return None;
    }
    let (mut value, mut slope) = (Complex64::ZERO, Complex64::ZERO);
    for (i, left) in pair.left.iter().enumerate() {
        let rows = linear.mass[i].iter().zip(&linear.damping[i]);
        let rows = rows.zip(&linear.stiffness[i]).zip(pair.right);
        let (mut m, mut c, mut k) = (Complex64::ZERO, Complex64::ZERO, Complex64::ZERO);
        for (((mass, damping), stiffness), x) in rows {
            m += x * mass;
            c += x * damping;
            k += x * stiffness;
        }
        value += left * (s * (s * m + c) + k);
        slope += left * (2.0 * s * m + c);
    }
    let step = value / slope;
    // Real eigenvalues stay real; those that meet on the way are found by the solver from scratch.
    let next = if s.im > 0.0 { s - step } else { Complex64::new((s - step).re, 0.0) };
    let stays = (s.im > 0.0) == (next.im > 0.0);
    (stays && step.norm() <= NEAR * s.norm()).then_some(next)
}
