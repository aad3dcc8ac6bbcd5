//! A state that may be the result of a solve: the last Newton step, and what is asked of the state where it ends.

use super::convergence::{TOLERANCE, is_rounding, relative_to, settled};
use super::problem::Problem;
use crate::array::{Square, add_scaled, all_finite, largest};
use crate::constraints::Structure;
use crate::{Linear, Mechanism};

/// What a solver found, before its stability is judged.
pub(super) struct Found<const N: usize> {
    pub(super) coordinates: [f64; N],
    pub(super) residual: [f64; N],
    /// Where it is known.
    pub(super) measured: Option<Measured<N>>,
    pub(super) iterations: usize,
    pub(super) left_unstable_region: bool,
}

/// What is asked of a state that may be the result.
pub(super) struct Measured<const N: usize> {
    pub(super) linear: Linear<f64, N>,
    /// Infinite unless all is finite.
    pub(super) relative_residual: f64,
}

/// A state that may be the result.
pub(super) struct End<const N: usize> {
    pub(super) coordinates: [f64; N],
    pub(super) residual: [f64; N],
    /// Without constraints.
    pub(super) measured: Option<Measured<N>>,
}

impl<const N: usize> End<N> {
    /// The state at `q`. Without constraints the parts of the residual, with which a result is measured, are the residual as well.
    #[inline]
    pub(super) fn at<M, const U: usize, const P: usize, const O: usize>(
        problem: &Problem<'_, M, N, U, P, O>,
        q: &[f64; N],
    ) -> Self
    where
        M: Mechanism<N, U, P, O>,
    {
        if const { !Structure::of(&M::DESCRIPTION).open() } {
            return Self {
                coordinates: *q,
                residual: problem.residual(q),
                measured: None,
            };
        }
        let (parts, linear) = problem.parts_and_linear(q);
        let residual = add_scaled(&parts.inertia, -1.0, &parts.applied);
        let finite = all_finite(&residual) && problem.check(q, &linear).is_ok();
        let relative_residual = if finite {
            relative_to(problem, &parts, q, &residual, &linear.stiffness)
        } else {
            f64::INFINITY
        };
        Self {
            coordinates: *q,
            residual,
            measured: Some(Measured {
                linear,
                relative_residual,
            }),
        }
    }

    /// Whether the relative residual is finite and within `tolerance`; `stiffness` is near to that of the state.
    #[inline]
    pub(super) fn is_solved<M, const U: usize, const P: usize, const O: usize>(
        &self,
        problem: &Problem<'_, M, N, U, P, O>,
        stiffness: &Square<N>,
        tolerance: f64,
    ) -> bool
    where
        M: Mechanism<N, U, P, O>,
    {
        match &self.measured {
            Some(measured) => measured.relative_residual <= tolerance,
            None => {
                let (q, residual) = (&self.coordinates, &self.residual);
                all_finite(residual) && settled(problem, q, residual, stiffness, tolerance)
            }
        }
    }
}

/// The last Newton step; the stiffness is not needed again, only that the residual fell to rounding: to a small share, or to
/// what `displacement`, from a residual to the Newton step it asks for, says is nothing.
#[inline]
pub(super) fn last_step<M, const N: usize, const U: usize, const P: usize, const O: usize>(
    problem: &Problem<'_, M, N, U, P, O>,
    q: &[f64; N],
    (residual, stiffness): (&[f64; N], &Square<N>),
    step: &[f64; N],
    displacement: impl FnOnce(&[f64; N]) -> [f64; N],
) -> Option<End<N>>
where
    M: Mechanism<N, U, P, O>,
{
    let motions = Problem::<M, N, U, P, O>::MOTIONS;
    let end = End::at(problem, &add_scaled(q, 1.0, step));
    let fell = largest(&end.residual) <= 1e-3 * largest(residual)
        || is_rounding(&displacement(&end.residual), &end.coordinates, motions);
    (fell && end.is_solved(problem, stiffness, TOLERANCE)).then_some(end)
}
