//! Candidate solutions: the last Newton step, and the acceptance tests of the state it reaches.

use super::convergence::{TOLERANCE, is_rounding, relative_residual, relative_to_parts};
use super::operating_point::OperatingPoint;
use crate::algebra::{Matrix, Vector, add_scaled, all_finite, largest};
use crate::kernels::Linear;

/// The result of a solver, before its stability is judged.
pub(crate) struct UnjudgedResult {
    pub(crate) coordinates: Vector,
    pub(crate) residual: Vector,
    /// The measurement, if already made.
    pub(crate) measured: Option<Measured>,
    pub(crate) iterations: usize,
    pub(crate) left_unstable_region: bool,
}

impl UnjudgedResult {
    /// A result reached without passing through an unstable region.
    pub(crate) fn new(end: Candidate, iterations: usize) -> Self {
        Self {
            coordinates: end.coordinates,
            residual: end.residual,
            measured: end.measured,
            iterations,
            left_unstable_region: false,
        }
    }
}

/// The values by which a possible result is accepted.
pub(crate) struct Measured {
    pub(crate) linear: Linear,
    /// Infinite unless everything is finite.
    pub(crate) relative_residual: f64,
}

/// A state that may become the result.
pub(crate) struct Candidate {
    pub(crate) coordinates: Vector,
    pub(crate) residual: Vector,
    /// Only without constraints.
    pub(crate) measured: Option<Measured>,
}

impl Candidate {
    /// The state at `q`. Without constraints, the parts of the residual that measure a result also give the residual
    /// itself.
    #[inline]
    pub(crate) fn at(point: &OperatingPoint<'_>, q: Vector) -> Self {
        if !point.structure.open() {
            return Self { residual: point.residual(&q), coordinates: q, measured: None };
        }
        let (parts, linear) = point.parts_and_linear(&q);
        let residual = add_scaled(&parts.inertia, -1.0, &parts.applied);
        let finite = all_finite(&residual) && point.check(&q, &linear).is_ok();
        let relative_residual =
            if finite { relative_to_parts(point, &parts, &q, &residual, &linear.stiffness) } else { f64::INFINITY };
        Self { coordinates: q, residual, measured: Some(Measured { linear, relative_residual }) }
    }

    /// Whether the relative residual is finite and within `tolerance`; `stiffness` is that of a nearby state.
    #[inline]
    pub(crate) fn is_solved(&self, point: &OperatingPoint<'_>, stiffness: &Matrix, tolerance: f64) -> bool {
        match &self.measured {
            Some(measured) => measured.relative_residual <= tolerance,
            None => {
                let (q, residual) = (&self.coordinates, &self.residual);
                all_finite(residual) && relative_residual(point, q, residual, stiffness) <= tolerance
            }
        }
    }
}

/// Takes the last Newton step. The stiffness is not evaluated again; the residual must only have fallen to a small
/// share, or to rounding as judged by `displacement`, which maps a residual to its Newton step.
#[inline]
pub(crate) fn last_step(
    point: &OperatingPoint<'_>,
    q: &[f64],
    (residual, stiffness): (&[f64], &Matrix),
    step: &[f64],
    displacement: impl FnOnce(&Vector) -> Vector,
) -> Option<Candidate> {
    let motions = point.motions();
    let end = Candidate::at(point, add_scaled(q, 1.0, step));
    let fell = largest(&end.residual) <= 1e-3 * largest(residual)
        || is_rounding(&displacement(&end.residual), &end.coordinates, motions);
    (fell && end.is_solved(point, stiffness, TOLERANCE)).then_some(end)
}
