//! The equilibrium nearest to a start value, whatever its stability: Newton's method with a line search on the residual.

use super::convergence::{Progress, TOLERANCE, Watch, horizon, largest_of, relative_residual};
use super::end::{Found, last_step};
use super::problem::{Failure, Problem};
use super::space::{Base, Space, Trial};
use crate::Mechanism;
use crate::array::{Cholesky, Lu, Square, times, transpose};

const MAX_ITERATIONS: usize = 300;
/// Greatest change of a coordinate or speed in the first step, SI; grows while steps succeed.
const FIRST_RADIUS: f64 = 1.0;

/// Solves `g = 0` from `start`, which lies in the space.
pub(super) fn nearest<S, M, const N: usize, const U: usize, const P: usize, const O: usize>(
    problem: &Problem<'_, M, N, U, P, O>,
    start: &[f64; N],
) -> Result<Found<N>, Failure<N>>
where
    S: Space<N>,
    M: Mechanism<N, U, P, O>,
{
    let motions = Problem::<M, N, U, P, O>::MOTIONS;
    let mut base: Base<N, S> = S::base(problem, start)?;
    let weight = S::weights(problem, &base.q)?;
    let mut radius = FIRST_RADIUS;
    let mut watch = Watch::new(&base.q);
    let escaped = horizon(&start[..motions]);
    for iterations in 0..MAX_ITERATIONS {
        let found = Found {
            coordinates: base.q,
            residual: base.residual,
            measured: None,
            iterations,
            left_unstable_region: false,
        };
        let at = (&base.residual, &base.stiffness);
        let slopes = base.space.slopes(&base.residual);
        let stiffness = base.space.stiffness(&base.stiffness);
        let factors = Lu::new(&stiffness);
        let displacement = |lu: &Lu<f64, N>, slopes: &[f64; N]| {
            base.space.lift(&lu.solve(slopes).map(|value| -value))
        };
        let newton = factors.as_ref().map(|lu| displacement(lu, &slopes));
        let progress = watch.judge(problem, &base.q, at, newton.as_ref());
        if progress == Progress::Finished {
            return Ok(found);
        }
        let mut step =
            newton.unwrap_or_else(|| base.space.lift(&damped_step(&slopes, &stiffness, &weight)));
        if progress == Progress::LastStep
            && let Some(lu) = &factors
            && let Some(end) = last_step(problem, &base.q, at, &step, |rest| {
                displacement(lu, &base.space.slopes(rest))
            })
        {
            return Ok(Found {
                coordinates: end.coordinates,
                residual: end.residual,
                measured: end.measured,
                iterations: iterations + 1,
                ..found
            });
        }
        let size = largest_of(&step[..motions]);
        let limited = size > radius;
        if limited {
            step = step.map(|value| value * radius / size);
        }
        let Some((next, length)) = search(problem, &base, &slopes, &step, &weight) else {
            let relative = relative_residual(problem, &base.q, at.0, at.1);
            if relative <= TOLERANCE {
                return Ok(found);
            }
            let reason = "the residual has a minimum that is not zero";
            return Err(failure(reason, &base.q, iterations, relative));
        };
        if length < 1.0 {
            radius = radius.min(2.0 * length * largest_of(&step[..motions]));
        } else if limited {
            radius *= 2.0;
        }
        base = S::arrive(problem, next)?;
        if largest_of(&base.q[..motions]) > escaped {
            break;
        }
    }
    let relative = relative_residual(problem, &base.q, &base.residual, &base.stiffness);
    let reason = if largest_of(&base.q[..motions]) > escaped {
        "the coordinates escape to infinity"
    } else {
        "too many iterations"
    };
    Err(failure(reason, &base.q, MAX_ITERATIONS, relative))
}

fn failure<const N: usize>(
    reason: &'static str,
    q: &[f64; N],
    iterations: usize,
    relative: f64,
) -> Failure<N> {
    Failure::NotFound {
        reason,
        coordinates: *q,
        iterations,
        relative,
    }
}

fn merit<const N: usize>(residual: &[f64; N], weight: &[f64; N]) -> f64 {
    (0..N).fold(0.0, |sum, i| sum + weight[i] * residual[i] * residual[i])
}

/// A damped least-squares step, for where `Khat` is singular.
fn damped_step<const N: usize>(
    residual: &[f64; N],
    stiffness: &Square<N>,
    weight: &[f64; N],
) -> [f64; N] {
    let weighted: Square<N> = core::array::from_fn(|i| stiffness[i].map(|value| value * weight[i]));
    let right = times(&transpose(&weighted), residual).map(|value| -value);
    let columns = transpose(stiffness);
    let mut normal: Square<N> = core::array::from_fn(|i| {
        core::array::from_fn(|j| (0..N).fold(0.0, |sum, k| sum + columns[i][k] * weighted[k][j]))
    });
    let trace = (0..N).fold(0.0, |sum, i| sum + normal[i][i]);
    for (i, row) in normal.iter_mut().enumerate() {
        row[i] += 1e-8 * trace + f64::MIN_POSITIVE;
    }
    Cholesky::new(&normal).map_or(right, |cholesky| cholesky.solve(&right))
}

fn search<S, M, const N: usize, const U: usize, const P: usize, const O: usize>(
    problem: &Problem<'_, M, N, U, P, O>,
    base: &Base<N, S>,
    slopes: &[f64; N],
    step: &[f64; N],
    weight: &[f64; N],
) -> Option<(Trial<N>, f64)>
where
    S: Space<N>,
    M: Mechanism<N, U, P, O>,
{
    let before = merit(slopes, weight);
    let mut length = 1.0;
    for _ in 0..40 {
        if let Some(trial) = base.space.trial(problem, &base.q, step, length)
            && merit(&base.space.slopes(&trial.residual), weight) <= before * (1.0 - 1e-4 * length)
        {
            return Some((trial, length));
        }
        length *= 0.5;
    }
    None
}
