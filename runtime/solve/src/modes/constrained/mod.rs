//! Modes of mechanisms with constraints and speeds.
//!
//! The bordered pencil `s^2 Mhat + s Chat + Khat` has a singular `Mhat` and as many finite eigenvalues as there are
//! motions that the constraints leave free. They are the eigenvalues of a smaller problem in coordinates `y`,
//! `delta q = P y`, along the null space of the constraints. That problem is symmetric ([`pairs`]), quadratic
//! ([`quadratic`]) or, with speeds or constraints on velocities, of first order in positions and independent velocities
//! ([`first_order`]). Its vectors are completed with the reactions; every pair is measured, and its eigenvalue
//! improved, on the bordered pencil itself ([`measure`]).
//!
//! # Modes with constraints
//!
//! Sensitivities work on the bordered matrices as they are; only the eigenproblem is reduced to the motions that
//! constraints leave free (`modes/constrained`). Its vectors are completed by the reactions, left and right; every pair
//! is measured, and its eigenvalue improved, on the bordered pencil itself. With speeds or constraints on velocities
//! the reduced problem is of first order; the solver of the quadratic pencil takes it as the pencil `s I - F`, so
//! clusters, defective roots and errors are treated alike. A mode may then move only speeds, or no mass at all: such
//! modes are normalised by their largest component and compared by kinetic energy.

mod first_order;
mod measure;
#[cfg(test)]
mod measure_tests;
mod pairs;
mod quadratic;
mod system;

#[doc(hidden)]
pub use pairs::free_pairs;
pub(crate) use pairs::free_pairs_into;

use super::deflation;
use super::normalisation::{Normalisation, normalise};
use super::pencil::pencil_times;
use crate::Complex;
use crate::algebra::{Matrix, Vector, dot, times};
use crate::constraints::{Structure, Tangent};
use crate::eigenproblem::{EigenproblemError, Root};
use crate::kernels::Linear;
use measure::Measure;

/// All roots of the bordered pencil with `Im s >= 0`.
///
/// Those of `free` directions come first; if some of these motions drift faster and faster, the roots are those of the
/// first-order system.
pub(super) fn general_roots(
    linear: &Linear,
    structure: Structure,
    (free, accelerates): (usize, bool),
) -> Result<Vec<Root>, EigenproblemError> {
    let tangent = Tangent::new(linear, structure);
    if structure.holonomic() && !accelerates {
        quadratic::roots(linear, &tangent, free)
    } else {
        first_order::roots(linear, &tangent, free)
    }
}

/// Roots of an open mechanism without its zeros, measured on the pencil with them: elements of the smaller one are what is
/// left of greater terms.
pub(super) fn measured(linear: &Linear, structure: Structure, reduced: &[Root]) -> Vec<Root> {
    let mut gathered = Gathered::new(linear, structure, Normalisation::Mass);
    for (i, root) in reduced.iter().enumerate() {
        let (right, left) = (root.right.clone(), root.left.clone());
        if deflation::is_standing(root) {
            gathered.keep(root.clone(), right, left)
        } else {
            gathered.add(root, is_shared(reduced, i), right, left)
        }
    }
    gathered.roots
}

/// Completes the motion of a vector with its reactions: `x` with `P(s) x = 0` by coordinate and speed.
fn with_reactions(linear: &Linear, tangent: &Tangent, s: Complex, motion: &[Complex]) -> Vector<Complex> {
    let force = pencil_times(linear, s, motion).map(|value| -value);
    let re = tangent.multipliers(&force.map(|value| value.re));
    let im = tangent.multipliers(&force.map(|value| value.im));
    let motions = tangent.structure.motions();
    Vector::from_fn(motion.len(), |i| if i < motions { motion[i] } else { Complex::new(re[i], im[i]) })
}

/// `P y`, by coordinate.
fn lift(tangent: &Tangent, y: &[Complex]) -> Vector<Complex> {
    let mut x = Vector::zeros(tangent.structure.size());
    for (y, direction) in y.iter().zip(&tangent.basis) {
        for (x, along) in x.iter_mut().zip(direction) {
            *x += y * along;
        }
    }
    x
}

/// `P^T matrix P`.
fn projected(matrix: &Matrix, tangent: &Tangent) -> Matrix {
    let images: Vec<_> = tangent.basis.iter().map(|x| times(matrix, x)).collect();
    Matrix::from_fn(tangent.freedom, tangent.freedom, |i, j| dot(&tangent.basis[i], &images[j]))
}

/// Collects roots: measures each pair on the bordered pencil and improves its eigenvalue.
struct Gathered<'a> {
    linear: &'a Linear,
    structure: Structure,
    size: Normalisation,
    roots: Vec<Root>,
}

impl<'a> Gathered<'a> {
    fn new(linear: &'a Linear, structure: Structure, size: Normalisation) -> Self {
        Self { linear, structure, size, roots: Vec::new() }
    }

    /// Normalises vectors.
    fn settle(&self, right: &mut [Complex], left: &mut [Complex]) -> bool {
        let motions = self.structure.motions();
        // A left vector may consist of reactions only.
        let left_leading = match self.size {
            Normalisation::Mass => motions,
            Normalisation::Largest => left.len(),
        };
        normalise(right, &self.linear.mass, self.size, motions)
            && normalise(left, &self.linear.mass, self.size, left_leading)
    }

    /// Adds a root as it is.
    fn keep(&mut self, root: Root, mut right: Vector<Complex>, mut left: Vector<Complex>) {
        self.settle(&mut right, &mut left);
        self.roots.push(Root { right, left, ..root });
    }

    /// Adds the pair obtained from a root of the smaller problem. `shared` eigenvalues belong to several vectors and
    /// stay equal.
    fn add(&mut self, reduced: &Root, shared: bool, mut right: Vector<Complex>, mut left: Vector<Complex>) {
        let motions = self.structure.motions();
        let settle = |right: &mut [Complex], left: &mut [Complex]| self.settle(right, left);
        if !settle(&mut right, &mut left) {
            // The eigenvalue is that of the smaller problem; without vectors it has no derivative.
            let numbers = |x: Vector<Complex>| if x.iter().all(|x| x.is_finite()) { x } else { Vector::zeros(x.len()) };
            let (right, left) = (numbers(right), numbers(left));
            let (s, error) = (reduced.s, reduced.error);
            let (residual, condition) = (f64::INFINITY, f64::INFINITY);
            return self.roots.push(Root { s, right, left, residual, error, condition });
        }
        let mut s = reduced.s;
        let mut measure = Measure::new(self.linear, motions, s, &right, &left);
        let simple = !shared && reduced.condition.is_finite();
        if simple {
            let unimproved = (s, right.clone(), left.clone(), measure);
            for _ in 0..2 {
                // A step this long is not rounding of the smaller problem.
                let next = s - measure.newton;
                let near = measure.newton.norm() <= 1e-6 * (s.norm() + reduced.error);
                if !near || (s.im > 0.0) != (next.im > 0.0) {
                    break;
                }
                s = next;
                measure = Measure::new(self.linear, motions, s, &right, &left);
                if measure.residual <= measure::INACCURATE {
                    break;
                }
                let improved = measure::inverse_iteration(self.linear, s, &right, &left);
                let Some((mut new_right, mut new_left)) = improved else {
                    break;
                };
                if !settle(&mut new_right, &mut new_left) {
                    break;
                }
                let better = Measure::new(self.linear, motions, s, &new_right, &new_left);
                if better.residual < measure.residual {
                    (right, left, measure) = (new_right, new_left, better);
                }
            }
            // Next to a double root the step is a quotient of two rounding errors.
            if measure.residual > measure::INACCURATE.max(unimproved.3.residual) {
                (s, right, left, measure) = unimproved;
            }
        }
        let mut condition = reduced.condition;
        if measure.residual.is_nan() || measure.residual > measure::ACCEPTED {
            if measure.rounding_only {
                measure.residual = measure::ROUNDING
            } else {
                (s, condition) = (reduced.s, f64::INFINITY)
            }
        }
        let estimate = measure.doubt + 2.0 * measure.newton.norm() + f64::EPSILON * s.norm();
        let error =
            if condition.is_finite() && estimate.is_finite() { reduced.error.max(estimate) } else { reduced.error };
        self.roots.push(Root { s, right, left, residual: measure.residual, error, condition });
    }
}

/// Whether an eigenvalue occurs more than once in a list.
fn is_shared(roots: &[Root], i: usize) -> bool {
    roots.iter().enumerate().filter(|(j, _)| *j != i).map(|(_, other)| other.s).any(|s| s == roots[i].s)
}
