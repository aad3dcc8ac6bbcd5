//! When a residual is small: measured against the forces in it, and against what moving the coordinates would change.

use super::problem::Problem;
use crate::Mechanism;
use crate::array::{Square, largest};

/// A residual this small in relative terms is a solution; iteration goes on while it still falls.
pub(super) const TOLERANCE: f64 = 1e-10;
/// A residual this small cannot be improved.
const FLOOR: f64 = 2.0 * f64::EPSILON;
/// Displacement (rad or m) whose restoring force a residual is compared with where all forces vanish.
const SMALL_MOTION: f64 = 1e-3;

/// From here on one more Newton step reaches rounding.
const LAST_STEP: f64 = 1e-8;

/// How far a solve has come.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Progress {
    /// Go on.
    Underway,
    /// One more Newton step reaches rounding.
    LastStep,
    /// Solved to rounding.
    Finished,
}

/// Watches a residual fall and tells when it has reached rounding.
pub(super) struct Watch {
    previous: f64,
}

impl Watch {
    pub(super) fn new() -> Self {
        Self {
            previous: f64::INFINITY,
        }
    }

    /// Judges a state. Forces are looked at only where the stiffness alone does not decide.
    pub(super) fn judge<M, const N: usize, const U: usize, const P: usize, const O: usize>(
        &mut self,
        problem: &Problem<'_, M, N, U, P, O>,
        q: &[f64; N],
        residual: &[f64; N],
        stiffness: &Square<N>,
    ) -> Progress
    where
        M: Mechanism<N, U, P, O>,
    {
        let relative = by_stiffness(q, residual, stiffness);
        let stalled = relative >= 0.25 * self.previous;
        self.previous = if relative <= 1e4 * TOLERANCE {
            relative
        } else {
            f64::INFINITY
        };
        if relative <= FLOOR || (relative <= TOLERANCE && stalled) {
            Progress::Finished
        } else if relative <= LAST_STEP && !stalled {
            Progress::LastStep
        } else if stalled && relative_residual(problem, q, residual, stiffness) <= TOLERANCE {
            Progress::Finished
        } else {
            Progress::Underway
        }
    }
}

/// Greatest residual relative to its parts (inertia, applied forces) plus the restoring force of a small motion.
pub(crate) fn relative_residual<M, const N: usize, const U: usize, const P: usize, const O: usize>(
    problem: &Problem<'_, M, N, U, P, O>,
    q: &[f64; N],
    residual: &[f64; N],
    stiffness: &Square<N>,
) -> f64
where
    M: Mechanism<N, U, P, O>,
{
    let parts = problem
        .mechanism
        .residual_parts(q, problem.inputs, problem.design);
    let mut most = 0.0_f64;
    for i in 0..N {
        let force = parts.inertia[i].abs().max(parts.applied[i].abs());
        let force = if force.is_finite() { force } else { 0.0 };
        most = most.max(ratio(residual[i], force + restoring(q, &stiffness[i])));
    }
    most
}

fn by_stiffness<const N: usize>(q: &[f64; N], residual: &[f64; N], stiffness: &Square<N>) -> f64 {
    (0..N).fold(0.0, |most: f64, i| {
        most.max(ratio(residual[i], restoring(q, &stiffness[i])))
    })
}

fn restoring<const N: usize>(q: &[f64; N], row: &[f64; N]) -> f64 {
    (0..N).fold(0.0, |sum, j| {
        sum + row[j].abs() * (q[j].abs() + SMALL_MOTION)
    })
}

fn ratio(residual: f64, scale: f64) -> f64 {
    if residual == 0.0 {
        0.0
    } else if scale > 0.0 {
        residual.abs() / scale
    } else {
        f64::INFINITY
    }
}

/// Coordinates beyond this are taken as an escape to infinity.
pub(super) fn escaped<const N: usize>(q: &[f64; N], start: &[f64; N]) -> bool {
    largest(q) > 1e12 * (1.0 + largest(start))
}
