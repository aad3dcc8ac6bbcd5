//! The usual case of a stable equilibrium: a start in the valley of the answer, from which full Newton steps lead to it.
//! Every step passes the tests of [`descent`](super::descent) at once; as soon as one does not, descent starts again with
//! all that it has for hard cases.

use super::convergence::{ACCEPTED, Last, last};
use super::problem::Problem;
use super::settle::{End, Found, last_step};
use crate::Mechanism;
use crate::array::{Cholesky, add_scaled, dot, form, largest};

/// Newton's method doubles the digits: a start in the valley takes few steps.
const MAX_ITERATIONS: usize = 8;
/// Greatest change of a coordinate in a step, rad or m.
const RADIUS: f64 = 1.0;

/// The minimum of the amended potential to which full Newton steps lead from `start`, all of them through states where it is
/// convex; otherwise the last such state, or the start. For mechanisms without constraints.
#[inline]
pub(super) fn quick<M, const N: usize, const U: usize, const P: usize, const O: usize>(
    problem: &Problem<'_, M, N, U, P, O>,
    start: &[f64; N],
) -> Result<Found<N>, [f64; N]>
where
    M: Mechanism<N, U, P, O>,
{
    let evaluate = |q: &[f64; N]| {
        let (inputs, design) = (problem.inputs, problem.design);
        problem.mechanism.residual_and_stiffness(q, inputs, design)
    };
    let mut q = *start;
    let (mut residual, mut stiffness) = evaluate(&q);
    for iterations in 0..MAX_ITERATIONS {
        let Ok(factors) = Cholesky::new(&stiffness) else {
            return Err(q);
        };
        let step = factors.solve(&residual).map(|value| -value);
        let found = |end: End<N>, iterations| Found {
            coordinates: end.coordinates,
            residual: end.residual,
            parts: end.parts,
            iterations,
            left_unstable_region: false,
        };
        match last(&step, &q, N) {
            Last::Reached => {
                let end = End::at(problem, &q);
                let solved = end.is_solved(problem, &stiffness, ACCEPTED);
                return if solved {
                    Ok(found(end, iterations))
                } else {
                    Err(q)
                };
            }
            Last::OneMore => {
                let rest = |rest: &[f64; N]| factors.solve(rest);
                return last_step(problem, &q, (&residual, &stiffness), &step, rest)
                    .map(|end| found(end, iterations + 1))
                    .ok_or(q);
            }
            Last::More => {}
        }
        if largest(&step) > RADIUS {
            return Err(q);
        }
        let before = dot(&step, &residual);
        let next = add_scaled(&q, 1.0, &step);
        (residual, stiffness) = evaluate(&next);
        // NaN, infinite and overflowing values fail one of the two.
        let slope = dot(&step, &residual);
        let curvature = form(&step, &stiffness, &step);
        if !(slope.abs() <= 0.5 * before.abs() && (0.0..f64::INFINITY).contains(&curvature)) {
            return Err(q);
        }
        q = next;
    }
    Err(q)
}
