//! One eigenvalue and its two vectors, found from the pencil itself: the triangular factors of a singular matrix reveal
//! its null vectors, and Newton's method on the Rayleigh functional removes the rounding of the linearisation from the
//! eigenvalue.
//!
//! # A pencil near a known one
//!
//! Damped modes of a sample are found one by one, starting from the nominal ones: a Newton step on the Rayleigh
//! functional predicts each eigenvalue, and inverse iteration with the nominal vectors improves both, to third order
//! (`eigenproblem/general/pair.rs`). The sum of all eigenvalues reveals when two converged to the same one. The same
//! modes judge the stability. QR is the fallback.

use num_complex::Complex64;

use super::lu::Lu;
use super::measure::{Pair, ZERO, normalise};
use super::pencil::modulus;
use super::solver::PairSolver;

/// Maximum number of improvements per pair.
const STEPS: usize = 8;
/// Condition number above which vectors may belong to another eigenvalue.
const MODERATE: f64 = 1e8;
/// Relative step from which the vectors are computed again.
const SMALL: f64 = 1e-6;
/// Residual above which the vectors are improved.
pub(crate) const INACCURATE: f64 = 1e-13;

impl PairSolver<'_> {
    /// Relative rounding error of a component of `Q(s) x`.
    pub(super) fn relative(&self) -> f64 {
        (self.pencil.n as f64 + 4.0) * f64::EPSILON
    }

    /// Rounding error of an eigenvalue of the linearisation, given its condition number.
    pub(super) fn noise(&self, condition: f64) -> f64 {
        self.linearisation.noise() * condition
    }

    /// The pair found from the start `s`, at a distance `gap` from the next eigenvalue; `near` means that the vectors
    /// are already close to those of the eigenvalue.
    pub(super) fn pair(
        &mut self,
        start: Complex64,
        gap: f64,
        near: bool,
        right: &mut [Complex64],
        left: &mut [Complex64],
    ) -> Pair {
        let mut s = start;
        let mut pair = Pair::NONE;
        let (mut moved, mut last) = (0.0, f64::INFINITY);
        for count in 0..=STEPS {
            let neighbour = self.vectors(s, near, right, left);
            pair = self.examine(s, right, left);
            pair.second = pair.second_order(neighbour);
            let step = modulus(pair.newton);
            if !step.is_finite() || count == STEPS {
                break;
            }
            let doubt = pair.doubt();
            if step <= doubt && doubt > 1e-3 * gap {
                // Almost multiple: the step is rounding, and the mean value from the linearisation is better.
                break;
            }
            moved += step;
            if moved > 0.25 * gap {
                pair.condition = self.condition(&pair, right, left);
                let explained = pair.condition <= MODERATE && moved <= self.noise(pair.condition);
                if !explained || doubt > 0.125 * step || step > 0.5 * last {
                    break;
                }
            }
            let mut next = s - pair.newton;
            if start.im == 0.0 {
                next.im = 0.0;
            } else if next.im <= 0.0 {
                break;
            }
            s = next;
            last = step;
            let settled = pair.is_settled();
            if settled || near && step <= SMALL * modulus(s) {
                // The existing vectors may be good enough for the improved eigenvalue.
                let moved = self.measure(s, left);
                if (settled || moved.is_settled()) && moved.residual <= INACCURATE {
                    pair = Pair { second: pair.second, ..moved };
                    break;
                }
            }
        }
        if start.im == 0.0 {
            pair = self.or_zero(pair, left);
        }
        if pair.residual > INACCURATE {
            pair = self.inverse_iteration(pair, right, left);
        }
        if start.im > 0.0 {
            pair.conjugate = true;
        }
        pair.condition = self.condition(&pair, right, left);
        pair
    }

    /// The pair, or exactly zero with the same vectors if that is close and better.
    pub(super) fn or_zero(&self, pair: Pair, left: &[Complex64]) -> Pair {
        if pair.s.norm_sqr() < ZERO * ZERO && pair.s != Complex64::ZERO {
            let zero = self.measure(Complex64::ZERO, left);
            if zero.residual < pair.residual {
                return Pair { second: pair.second, ..zero };
            }
        }
        pair
    }

    /// Vectors of the eigenvalue next to `s`, and the smallest pivot apart from the vanishing one.
    ///
    /// Vectors that are already close are improved by inverse iteration, which multiplies their error by the distance
    /// of `s`. The convergence of `s` is then of third order, instead of second order with null vectors (Schreiber,
    /// "Nonlinear eigenvalue problems: Newton-type methods and nonlinear Rayleigh functionals", 2008).
    fn vectors(&mut self, s: Complex64, near: bool, right: &mut [Complex64], left: &mut [Complex64]) -> f64 {
        let n = self.pencil.n;
        self.pencil.at(s, self.q);
        let lu = Lu::new(n, self.q, self.order);
        if near {
            let (slope, work) = (&mut self.basis_right[..n], &mut self.cross[..n]);
            self.pencil.slope_times(s, right, false, slope);
            lu.solve(slope, right, work);
            self.pencil.slope_times(s, left, true, slope);
            lu.solve_transposed(slope, left, work);
        } else {
            lu.null_right(1, 0, right);
            lu.null_left(1, 0, left);
        }
        if n < 2 { f64::INFINITY } else { lu.pivot(n - 2) * lu.unit }
    }

    /// One step of inverse iteration for both vectors; keeps the better ones.
    #[cold]
    fn inverse_iteration(&mut self, pair: Pair, right: &mut [Complex64], left: &mut [Complex64]) -> Pair {
        let n = self.pencil.n;
        self.examine(pair.s, right, left);
        self.pencil.at(pair.s, self.q);
        let lu = Lu::new(n, self.q, self.order);
        let (new_right, new_left) = (&mut self.basis_right[..n], &mut self.basis_left[..n]);
        let weighed = self.pencil.weighed(&self.of_right);
        lu.solve(weighed, new_right, &mut self.cross[..n]);
        let weighed = self.pencil.weighed(&self.of_left);
        lu.solve_transposed(weighed, new_left, &mut self.cross[..n]);
        self.pencil.multiply(new_right, false, &mut self.of_right);
        normalise(&self.pencil, new_right, &mut self.of_right);
        self.pencil.multiply(new_left, true, &mut self.of_left);
        normalise(&self.pencil, new_left, &mut self.of_left);
        let improved = self.measure(pair.s, &self.basis_left[..n]);
        if improved.residual < pair.residual {
            right.copy_from_slice(&self.basis_right[..n]);
            left.copy_from_slice(&self.basis_left[..n]);
            Pair { second: pair.second, ..improved }
        } else {
            pair
        }
    }
}
