//! The equilibrium nearest to a start value, regardless of its stability: Newton's method with a line search on the
//! residual.

use super::acceptance::{Candidate, Found, last_step};
use super::convergence::{Progress, TOLERANCE, Watch, horizon, largest_of, relative_residual};
use super::operating_point::{Failure, OperatingPoint};
use super::search_space::{Base, SearchSpace, Trial};
use crate::algebra::{Cholesky, Lu, Matrix, Vector, times};
use crate::error::NotFound;

const MAX_ITERATIONS: usize = 300;
/// Largest change of a coordinate or speed in the first step, SI; grows while steps succeed.
const FIRST_RADIUS: f64 = 1.0;

/// Solves `g = 0` from `start`, which lies in the space.
pub(super) fn nearest<S>(point: &OperatingPoint<'_>, start: &[f64]) -> Result<Found, Failure>
where
    S: SearchSpace,
{
    let motions = point.motions();
    let mut base: Base<S> = S::base(point, start)?;
    let weight = S::weights(point, &base.q)?;
    let mut radius = FIRST_RADIUS;
    let mut watch = Watch::new(&base.q);
    let escaped = horizon(&start[..motions]);
    let mut trial = Trial::blank(point.size());
    for iterations in 0..MAX_ITERATIONS {
        let at = (&base.residual[..], &base.stiffness);
        let slopes = base.space.slopes(&base.residual);
        let stiffness = base.space.reduced(&base.stiffness);
        let factors = Lu::new(&stiffness);
        let displacement =
            |lu: &Lu, slopes: &[f64]| base.space.lift(lu.solve(slopes).map(|value| -value));
        let newton = factors.as_ref().map(|lu| displacement(lu, &slopes));
        let progress = watch.judge(point, &base.q, at, newton.as_deref());
        if progress == Progress::Finished {
            return Ok(found(base, iterations));
        }
        let mut step =
            newton.unwrap_or_else(|| base.space.lift(damped_step(&slopes, &stiffness, &weight)));
        if progress == Progress::LastStep
            && let Some(lu) = &factors
            && let Some(end) = last_step(point, &base.q, at, &step, |rest| {
                displacement(lu, &base.space.slopes(rest))
            })
        {
            return Ok(Found::new(end, iterations + 1));
        }
        let size = largest_of(&step[..motions]);
        let limited = size > radius;
        if limited {
            step = step.map(|value| value * radius / size);
        }
        let Some(length) = search(point, &base, &slopes, (&step, &weight), &mut trial) else {
            let relative = relative_residual(point, &base.q, at.0, at.1);
            if relative <= TOLERANCE {
                return Ok(found(base, iterations));
            }
            let reason = NotFound::Minimum;
            return Err(failure(reason, &base.q, iterations, relative));
        };
        if length < 1.0 {
            radius = radius.min(2.0 * length * largest_of(&step[..motions]));
        } else if limited {
            radius *= 2.0;
        }
        S::arrive(point, &mut trial, &mut base)?;
        if largest_of(&base.q[..motions]) > escaped {
            break;
        }
    }
    let relative = relative_residual(point, &base.q, &base.residual, &base.stiffness);
    let reason = if largest_of(&base.q[..motions]) > escaped {
        NotFound::Escape
    } else {
        NotFound::IterationLimit
    };
    Err(failure(reason, &base.q, MAX_ITERATIONS, relative))
}

/// Converts a base to the result.
fn found<S>(base: Base<S>, iterations: usize) -> Found {
    let end = Candidate {
        coordinates: base.q,
        residual: base.residual,
        measured: None,
    };
    Found::new(end, iterations)
}

fn failure(reason: NotFound, q: &[f64], iterations: usize, relative: f64) -> Failure {
    Failure::NotFound {
        reason,
        coordinates: q.into(),
        iterations,
        relative,
    }
}

fn merit(residual: &[f64], weight: &[f64]) -> f64 {
    let pairs = residual.iter().zip(weight);
    pairs.fold(0.0, |sum, (residual, weight)| {
        sum + weight * residual * residual
    })
}

/// A damped least-squares step, used where `Khat` is singular.
fn damped_step(residual: &[f64], stiffness: &Matrix, weight: &[f64]) -> Vector {
    let n = residual.len();
    let weighted = Matrix::from_fn(n, n, |i, j| stiffness[i][j] * weight[i]);
    let right = times(&weighted.transpose(), residual).map(|value| -value);
    let columns = stiffness.transpose();
    let mut normal = Matrix::from_fn(n, n, |i, j| {
        (0..n).fold(0.0, |sum, k| sum + columns[i][k] * weighted[k][j])
    });
    let trace = (0..n).fold(0.0, |sum, i| sum + normal[i][i]);
    for (i, row) in normal.iter_mut().enumerate() {
        row[i] += 1e-8 * trace + f64::MIN_POSITIVE;
    }
    match Cholesky::new(&normal) {
        Ok(factors) => factors.solve(&right),
        Err(_) => right,
    }
}

/// Finds the share of a step that reduces the residual, and writes its end to `trial`.
fn search<S>(
    point: &OperatingPoint<'_>,
    base: &Base<S>,
    slopes: &[f64],
    (step, weight): (&[f64], &[f64]),
    trial: &mut Trial,
) -> Option<f64>
where
    S: SearchSpace,
{
    let before = merit(slopes, weight);
    let mut length = 1.0;
    for _ in 0..40 {
        if base.space.trial(point, &base.q, (step, length), trial)
            && merit(&base.space.slopes(&trial.residual), weight) <= before * (1.0 - 1e-4 * length)
        {
            return Some(length);
        }
        length *= 0.5;
    }
    None
}
