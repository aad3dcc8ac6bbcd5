//! The equilibrium nearest to a start value, regardless of its stability: Newton's method with a line search on the
//! residual.

use super::acceptance::{Candidate, UnjudgedResult, last_step};
use super::convergence::{Progress, ResidualMonitor, TOLERANCE, horizon, largest_of, relative_residual};
use super::descent::DEPARTURE;
use super::operating_point::{Failure, OperatingPoint};
use super::scaling::units;
use super::search_space::{Base, SearchSpace, Trial};
use crate::algebra::{Cholesky, Lu, Matrix, Vector, greater, largest, times};
use crate::error::NotFound;

const MAX_ITERATIONS: usize = 300;
/// Largest change of a coordinate or speed in the first step, in [`units`]; grows while steps succeed.
const FIRST_RADIUS: f64 = 1.0;
/// Share of a diagonal element that is added to it where the stiffness is singular.
const DAMPING: f64 = 1e-8;
/// Enough to find the direction with the least stiffness where it has hardly any.
const INVERSE_ITERATIONS: usize = 4;

/// Solves `g = 0` from `start`, which lies in the space.
pub(super) fn damped_newton<S>(point: &OperatingPoint<'_>, start: &[f64]) -> Result<UnjudgedResult, Failure>
where
    S: SearchSpace,
{
    let motions = point.motions();
    let mut base: Base<S> = S::base(point, start)?;
    // Where the start is all but solved, neither is needed.
    let mut scales = None;
    let mut radius = FIRST_RADIUS;
    let mut watch = ResidualMonitor::new(&base.q);
    let escaped = horizon(&start[..motions]);
    let mut trial = Trial::blank(point.size());
    for iterations in 0..MAX_ITERATIONS {
        let at = (&base.residual[..], &base.stiffness);
        let slopes = base.space.slopes(&base.residual);
        let stiffness = base.space.reduced(&base.stiffness);
        let factors = Lu::new(&stiffness);
        let displacement = |lu: &Lu, slopes: &[f64]| base.space.lift(lu.solve(slopes).map(|value| -value));
        let newton = factors.as_ref().map(|lu| displacement(lu, &slopes));
        let progress = watch.judge(point, &base.q, at, newton.as_deref());
        if progress == Progress::Finished {
            return Ok(found(base, iterations));
        }
        if progress == Progress::LastStep
            && let (Some(lu), Some(step)) = (&factors, &newton)
            && let Some(end) = last_step(point, &base.q, at, step, |rest| displacement(lu, &base.space.slopes(rest)))
        {
            return Ok(UnjudgedResult::new(end, iterations + 1));
        }
        let (weight, units) = match &mut scales {
            Some(scales) => &*scales,
            none => none.insert((S::weights(point, &base.q)?, units(point, &base.q)?)),
        };
        let damped = || base.space.lift(damped_step(&slopes, &stiffness, weight));
        let has_newton = newton.is_some();
        let mut step = newton.unwrap_or_else(damped);
        let mut share = limit(&mut step, units, radius);
        let mut length = search(point, &base, &slopes, (&step, share), weight, &mut trial);
        if length.is_none() && has_newton {
            // Next to a singular stiffness Newton's step is mostly along the direction without stiffness.
            step = damped();
            share = limit(&mut step, units, radius);
            length = search(point, &base, &slopes, (&step, share), weight, &mut trial);
        }
        let Some(length) = length else {
            let relative = relative_residual(point, &base.q, at.0, at.1);
            if relative <= TOLERANCE {
                return Ok(found(base, iterations));
            }
            let reason = NotFound::Minimum;
            return Err(failure(reason, &base.q, iterations, relative));
        };
        if length < 1.0 {
            radius = radius.min(2.0 * length * size_in(units, &step));
        } else if share < 1.0 {
            radius *= 2.0;
        }
        S::arrive(point, &mut trial, &mut base)?;
        if largest_of(&base.q[..motions]) > escaped {
            break;
        }
    }
    let relative = relative_residual(point, &base.q, &base.residual, &base.stiffness);
    let reason = if largest_of(&base.q[..motions]) > escaped { NotFound::Escape } else { NotFound::IterationLimit };
    Err(failure(reason, &base.q, MAX_ITERATIONS, relative))
}

/// The largest motion of a step in these units.
fn size_in(units: &[f64], step: &[f64]) -> f64 {
    step.iter().zip(units).fold(0.0, |most, (step, unit)| greater(most, (step / unit).abs()))
}

/// Shortens a step whose motions are larger than `radius`; returns the share of it that is left.
fn limit(step: &mut Vector, units: &[f64], radius: f64) -> f64 {
    let size = size_in(units, step);
    if size <= radius {
        return 1.0;
    }
    step.iter_mut().for_each(|value| *value = *value * radius / size);
    radius / size
}

/// The states on either side of `q` along the direction with the least stiffness, as far as the residual is smaller
/// there: where a stiffness is singular, what looks like a minimum of the residual may not be one.
#[cold]
pub(super) fn along_softest_direction<S>(point: &OperatingPoint<'_>, q: &[f64]) -> Option<Vec<Vector>>
where
    S: SearchSpace,
{
    let base: Base<S> = S::base(point, q).ok()?;
    let weight = S::weights(point, &base.q).ok()?;
    let slopes = base.space.slopes(&base.residual);
    let stiffness = base.space.reduced(&base.stiffness);
    let factors = Cholesky::new(&normal_matrix(&stiffness, &weight)).ok()?;
    let mut direction = Vector::from_fn(slopes.len(), |i| 1.0 + 0.1 * i as f64);
    for _ in 0..INVERSE_ITERATIONS {
        direction = factors.solve(&direction);
        let size = largest(&direction);
        direction.iter_mut().for_each(|value| *value /= size);
    }
    let direction = base.space.lift(direction);
    let motions = &direction[..point.motions()];
    let lead = (0..motions.len()).max_by(|&i, &j| motions[i].abs().total_cmp(&motions[j].abs()))?;
    let share = DEPARTURE * (point.description.large(lead) + base.q[lead].abs()) / direction[lead].abs();
    let before = merit(&slopes, &weight);
    let mut trial = Trial::blank(point.size());
    let mut side = |share: f64| {
        let exists = base.space.trial(point, &base.q, (&direction, share), &mut trial);
        let falls = exists && merit(&base.space.slopes(&trial.residual), &weight) < before;
        falls.then(|| trial.q.clone())
    };
    Some([side(share), side(-share)].into_iter().flatten().collect())
}

/// Converts a base to the result.
fn found<S>(base: Base<S>, iterations: usize) -> UnjudgedResult {
    let end = Candidate { coordinates: base.q, residual: base.residual, measured: None };
    UnjudgedResult::new(end, iterations)
}

fn failure(reason: NotFound, q: &[f64], iterations: usize, relative: f64) -> Failure {
    Failure::NotFound { reason, coordinates: q.into(), iterations, relative }
}

fn merit(residual: &[f64], weight: &[f64]) -> f64 {
    residual.iter().zip(weight).fold(0.0, |sum, (residual, weight)| sum + weight * residual * residual)
}

/// A damped least-squares step, used where `Khat` is singular.
fn damped_step(residual: &[f64], stiffness: &Matrix, weight: &[f64]) -> Vector {
    let n = residual.len();
    let weighted = Vector::from_fn(n, |i| -weight[i] * residual[i]);
    let right = times(&stiffness.transpose(), &weighted);
    match Cholesky::new(&normal_matrix(stiffness, weight)) {
        Ok(factors) => factors.solve(&right),
        Err(_) => right,
    }
}

/// `Khat^T W Khat`, damped by a share of each diagonal element, so that unknowns of different units are damped alike.
fn normal_matrix(stiffness: &Matrix, weight: &[f64]) -> Matrix {
    let n = stiffness.row_count();
    let columns = stiffness.transpose();
    let mut normal =
        Matrix::from_fn(n, n, |i, j| (0..n).fold(0.0, |sum, k| sum + columns[i][k] * (columns[j][k] * weight[k])));
    let trace = (0..n).fold(0.0, |sum, i| sum + normal[i][i]);
    for (i, row) in normal.iter_mut().enumerate() {
        row[i] += DAMPING * row[i].max(DAMPING * trace) + f64::MIN_POSITIVE;
    }
    normal
}

/// Finds the length of a step, itself a share of a full one, that reduces the residual, and writes its end to `trial`.
/// The reduction asked for is a small part of what the step promises.
fn search<S>(
    point: &OperatingPoint<'_>,
    base: &Base<S>,
    slopes: &[f64],
    (step, share): (&[f64], f64),
    weight: &[f64],
    trial: &mut Trial,
) -> Option<f64>
where
    S: SearchSpace,
{
    let before = merit(slopes, weight);
    let mut length = 1.0;
    for _ in 0..40 {
        if base.space.trial(point, &base.q, (step, length), trial)
            && merit(&base.space.slopes(&trial.residual), weight) <= before * (1.0 - 1e-4 * share * length)
        {
            return Some(length);
        }
        length *= 0.5;
    }
    None
}
