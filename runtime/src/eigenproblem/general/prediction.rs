//! Eigenvalues by the pairs of a problem near by.

use num_complex::Complex64;

use super::scaled_pencil::Eigenproblem;
use crate::kernels::Linear;

/// A farther step is none that vectors near by predict.
const NEAR: f64 = 0.1;

/// An eigenvalue of a problem near by, `Im s >= 0`, with its vectors.
#[derive(Clone, Copy)]
pub(crate) struct Near<'a> {
    pub(crate) s: Complex64,
    pub(crate) right: &'a [Complex64],
    pub(crate) left: &'a [Complex64],
}

/// Writes all eigenvalues in units of `rate`, conjugates included, as a step of Newton's method on the Rayleigh functional
/// `psi^T Q(s) phi` predicts them: the error is of second order in the distance of the problems. `false` where these are too
/// far apart, or some eigenvalue has none near by.
pub(super) fn predict(
    problem: Eigenproblem,
    near: &[Near],
    rate: f64,
    values: &mut [Complex64],
) -> bool {
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
            let Some(place) = values.get_mut(filled) else {
                return false;
            };
            *place = value;
            filled += 1;
        }
    }
    filled == values.len()
}

fn improved(linear: &Linear, pair: &Near) -> Option<Complex64> {
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
    // Real eigenvalues stay real: those that meet on the way are found by the solver from nothing.
    let next = if s.im > 0.0 {
        s - step
    } else {
        Complex64::new((s - step).re, 0.0)
    };
    let stays = (s.im > 0.0) == (next.im > 0.0);
    (stays && step.norm() <= NEAR * s.norm()).then_some(next)
}
