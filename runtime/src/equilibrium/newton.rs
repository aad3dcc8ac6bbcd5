//! The equilibrium nearest to a start value, whatever its stability: Newton's method with a line search on the residual.

use super::convergence::{Progress, TOLERANCE, Watch, escaped, largest_of, relative_residual};
use super::problem::{Failure, Problem};
use super::{Found, last_step};
use crate::array::{Cholesky, Lu, Square, add_scaled, times, transpose};
use crate::constraints::inertias;
use crate::{Linear, Mechanism};

const MAX_ITERATIONS: usize = 300;
/// Greatest change of a coordinate or speed in the first step, SI; grows while steps succeed.
const FIRST_RADIUS: f64 = 1.0;

/// Solves `g = 0` from `start`.
pub(super) fn nearest<M, const N: usize, const U: usize, const P: usize, const O: usize>(
    problem: &Problem<'_, M, N, U, P, O>,
    start: &[f64; N],
) -> Result<Found<N>, Failure<N>>
where
    M: Mechanism<N, U, P, O>,
{
    let mut q = *start;
    let (mut residual, mut stiffness) = problem.evaluate_start(&q)?;
    let weight = weights::<M, N, U, P, O>(&q, &problem.linear(&q)?)?;
    let motions = Problem::<M, N, U, P, O>::MOTIONS;
    let mut radius = FIRST_RADIUS;
    let mut watch = Watch::new(&q);
    for iterations in 0..MAX_ITERATIONS {
        let found = Found {
            coordinates: q,
            residual,
            iterations,
            left_unstable_region: false,
        };
        let newton = Lu::new(&stiffness).map(|lu| lu.solve(&residual).map(|value| -value));
        let progress = watch.judge(problem, &q, (&residual, &stiffness), newton.as_ref());
        if progress == Progress::Finished {
            return Ok(found);
        }
        let mut step = newton.unwrap_or_else(|| damped_step(&residual, &stiffness, &weight));
        if progress == Progress::LastStep
            && let Some((coordinates, residual)) =
                last_step(problem, &q, (&residual, &stiffness), &step)
        {
            return Ok(Found {
                coordinates,
                residual,
                iterations: iterations + 1,
                ..found
            });
        }
        let size = largest_of(&step[..motions]);
        let limited = size > radius;
        if limited {
            step = step.map(|value| value * radius / size);
        }
        let Some((next, length)) = search(problem, &q, &residual, &step, &weight) else {
            let relative = relative_residual(problem, &q, &residual, &stiffness);
            if relative <= TOLERANCE {
                return Ok(found);
            }
            let reason = "the residual has a minimum that is not zero";
            return Err(Failure::NotFound {
                reason,
                coordinates: q,
                iterations,
                relative,
            });
        };
        if length < 1.0 {
            radius = radius.min(2.0 * length * largest_of(&step[..motions]));
        } else if limited {
            radius *= 2.0;
        }
        (q, residual, stiffness) = next;
        if escaped(&q[..motions], &start[..motions]) {
            break;
        }
    }
    let relative = relative_residual(problem, &q, &residual, &stiffness);
    let reason = if escaped(&q[..motions], &start[..motions]) {
        "the coordinates escape to infinity"
    } else {
        "too many iterations"
    };
    Err(Failure::NotFound {
        reason,
        coordinates: q,
        iterations: MAX_ITERATIONS,
        relative,
    })
}

/// Inverse generalised masses: they make the squares of forces and of moments comparable. The gap of a constraint counts
/// as the force with which the greatest stiffness of the mechanism would resist the motion that closes it; a reaction is the
/// stiffness against a motion of one unit, for mechanisms that have no other.
fn weights<M, const N: usize, const U: usize, const P: usize, const O: usize>(
    q: &[f64; N],
    linear: &Linear<f64, N>,
) -> Result<[f64; N], Failure<N>>
where
    M: Mechanism<N, U, P, O>,
{
    let structure = Problem::<M, N, U, P, O>::STRUCTURE;
    let mut weight = [0.0; N];
    if structure.open() {
        for i in 0..N {
            let mass = linear.mass[i][i];
            if mass.is_nan() || mass <= 0.0 {
                return Err(Failure::SingularMass(i));
            }
            weight[i] = 1.0 / mass;
        }
        return Ok(weight);
    }
    let mass = inertias(linear, structure);
    let motions = structure.motions();
    let stiffest = (0..motions).fold(0.0, |most: f64, i| {
        let row = &linear.stiffness[i];
        let reactions = (motions..N).fold(0.0, |most: f64, j| most.max((row[j] * q[j]).abs()));
        most.max(row[i].abs().max(reactions) / mass[i])
    });
    let stiffest = if stiffest > 0.0 { stiffest } else { 1.0 };
    for i in 0..motions {
        weight[i] = 1.0 / mass[i];
    }
    for i in structure.constraint_rows() {
        let row = &linear.stiffness[i];
        let mobility = (0..motions).fold(0.0, |sum, j| sum + row[j] * row[j] / mass[j]);
        if mobility > 0.0 {
            weight[i] = stiffest * stiffest / mobility;
        } else {
            // Nothing closes it from here; what it weighs is no matter as long as it is seen.
            weight[i] =
                stiffest * stiffest * mass[..motions].iter().fold(0.0, |a: f64, &b| a.max(b));
        }
    }
    if weight.iter().all(|value| value.is_finite()) {
        Ok(weight)
    } else {
        Err(Failure::OutsideDomain {
            what: "the mass matrix",
            coordinates: *q,
        })
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

type Evaluated<const N: usize> = ([f64; N], [f64; N], Square<N>);

fn search<M, const N: usize, const U: usize, const P: usize, const O: usize>(
    problem: &Problem<'_, M, N, U, P, O>,
    q: &[f64; N],
    residual: &[f64; N],
    step: &[f64; N],
    weight: &[f64; N],
) -> Option<(Evaluated<N>, f64)>
where
    M: Mechanism<N, U, P, O>,
{
    let before = merit(residual, weight);
    let mut length = 1.0;
    for _ in 0..40 {
        let trial = add_scaled(q, length, step);
        if let Some((residual, stiffness)) = problem.evaluate(&trial)
            && merit(&residual, weight) <= before * (1.0 - 1e-4 * length)
        {
            return Some(((trial, residual, stiffness), length));
        }
        length *= 0.5;
    }
    None
}
