//! When a solve is finished: its Newton step is small against the coordinates, or rounding lets the residual fall no
//! further. The residual alone cannot tell near a critical state, where a small one hides a large displacement.

use super::problem::Problem;
use crate::Mechanism;
use crate::array::{Square, largest};

/// Residual relative to its parts, or step relative to the coordinates, that counts as solved once neither falls.
pub(super) const TOLERANCE: f64 = 1e-10;
/// A step this small changes nothing.
const FLOOR: f64 = 2.0 * f64::EPSILON;
/// A Newton step this small leaves a remainder at rounding.
const LAST_STEP: f64 = 1e-8;
/// A residual that keeps this share in a step has stopped falling: even where `Khat` is singular at the solution, Newton
/// steps leave less than 1/e of it.
const STALLED: f64 = 0.5;
/// Displacement (rad or m) that coordinates near zero are compared with.
const SMALL_MOTION: f64 = 1e-3;

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

    /// Judges a state by its residual and by the full step that would come next; without a step only the residual
    /// counts.
    pub(super) fn judge<M, const N: usize, const U: usize, const P: usize, const O: usize>(
        &mut self,
        problem: &Problem<'_, M, N, U, P, O>,
        q: &[f64; N],
        (residual, stiffness): (&[f64; N], &Square<N>),
        step: Option<&[f64; N]>,
    ) -> Progress
    where
        M: Mechanism<N, U, P, O>,
    {
        let size = largest(residual);
        let stalled = size >= STALLED * self.previous;
        self.previous = size;
        let motion = step.map_or(f64::INFINITY, |step| {
            (0..N).fold(0.0, |most: f64, j| {
                most.max(ratio(step[j], q[j].abs() + SMALL_MOTION))
            })
        });
        let settled = |tolerance: f64| {
            motion <= tolerance || relative_residual(problem, q, residual, stiffness) <= tolerance
        };
        if motion <= FLOOR || (stalled && settled(TOLERANCE)) {
            Progress::Finished
        } else if motion <= LAST_STEP {
            Progress::LastStep
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
