//! Closing the loops: finds coordinates that meet the constraints, from values that do not.
//!
//! Gauss-Newton steps of least motion (least kinetic energy, each coordinate taken alone), damped (Levenberg,
//! Marquardt) where constraints are about to become dependent.

mod gaps;
mod step;

use super::convergence::{TOLERANCE, largest_of};
use super::operating_point::{Failure, OperatingPoint};
use crate::algebra::{Matrix, Vector, add_to, dot};
use crate::constraints::{Rows, Structure, inertias};
use crate::error::NotClosed;
pub(super) use gaps::{free, gaps};

use gaps::Gaps;
use step::{Aim, FIRST_RADIUS, LEAST_DAMPING, damped, plain, scaled, without_dependent};

const MAX_ITERATIONS: usize = 200;
/// A gap that keeps this share in a step has stopped falling.
const STALLED: f64 = 0.5;
/// How often, and by how much (rad or m), a state from which the loops cannot close is kicked.
const KICKS: usize = 4;
const KICK: f64 = 0.02;
/// A kick is accepted if it leaves no more than this share of the gaps.
const BETTER: f64 = 0.9;

/// Moves the coordinates that are not held until the constraints on positions are met; returns the state and the number
/// of iterations.
///
/// A start in which no small motion closes the gaps, such as a mechanism laid out straight or in one point, is left by
/// a kick.
pub(super) fn close(point: &OperatingPoint<'_>, start: &[f64], held: &[bool]) -> Result<(Vector, usize), Failure> {
    let first = match close_from(point, start, held) {
        Err(failure @ (Failure::NotAssembled { .. } | Failure::OutsideDomain { .. })) => failure,
        other => return other,
    };
    let mut best = first;
    for kick in 1..=KICKS {
        let from = match &best {
            Failure::NotAssembled { coordinates, .. } => coordinates,
            _ => start,
        };
        let from = kicked(from, held, kick, point.structure);
        match close_from(point, &from, held) {
            Ok(closed) => return Ok(closed),
            Err(next) if open_by(&next) < BETTER * open_by(&best) => best = next,
            Err(_) => {}
        }
    }
    Err(best)
}

/// A displacement without symmetry.
fn kicked(x: &[f64], held: &[bool], kick: usize, structure: Structure) -> Vector {
    Vector::from_fn(x.len(), |j| {
        if held[j] || j >= structure.coordinates {
            x[j]
        } else {
            x[j] + KICK * (1.0 + 1.7 * j as f64 + 2.3 * kick as f64).sin()
        }
    })
}

fn open_by(failure: &Failure) -> f64 {
    match failure {
        Failure::NotAssembled { gaps, .. } => largest_of(gaps),
        _ => f64::INFINITY,
    }
}

fn close_from(point: &OperatingPoint<'_>, start: &[f64], held: &[bool]) -> Result<(Vector, usize), Failure> {
    let structure = point.structure;
    let mut x = Vector::from(start);
    let mut at =
        gaps(point, &x).ok_or_else(|| Failure::OutsideDomain { what: "the constraints", coordinates: start.into() })?;
    let metric = metric(point, &x);
    let mut radius = FIRST_RADIUS;
    let mut damping = LEAST_DAMPING;
    let mut last = f64::INFINITY;
    let mut dependent_at_start = 0;
    for iterations in 0..MAX_ITERATIONS {
        if at.relative <= TOLERANCE && at.relative >= STALLED * last {
            return Ok((x, iterations));
        }
        last = at.relative;
        let rows = Rows::new(free(&at.rows, held), metric.clone());
        if iterations == 0 {
            dependent_at_start = rows.dependent();
        }
        let aim = Aim::new(&at, &rows);
        let next = if aim.minimal() {
            None
        } else {
            without_dependent(point, &x, &at, held, &metric)
                .or_else(|| plain(point, &x, &aim, &mut radius))
                .or_else(|| damped(point, &x, &aim, (&mut radius, &mut damping)))
        };
        match next {
            Some((coordinates, there)) => (x, at) = (coordinates, there),
            None if at.relative <= TOLERANCE => return Ok((x, iterations)),
            None => {
                let reason = reason(&at, dependent_at_start, held);
                return Err(not_assembled(structure, &x, &at, reason, iterations));
            }
        }
    }
    let reason = NotClosed::IterationLimit;
    Err(not_assembled(structure, &x, &at, reason, MAX_ITERATIONS))
}

/// Makes motions comparable: the square roots of the masses that move.
fn metric(point: &OperatingPoint<'_>, x: &[f64]) -> Vector {
    let linear = point.mechanism.linear(x, point.inputs, point.design);
    inertias(&linear, point.structure).map(f64::sqrt)
}

/// Why the gaps do not close.
fn reason(at: &Gaps, dependent_at_start: usize, held: &[bool]) -> NotClosed {
    let all = Rows::balanced(at.rows.clone());
    let slope = all.descent(&scaled(&at.gaps, &all));
    let gaps = scaled(&at.gaps, &all);
    if held.contains(&true) && dot(&slope, &slope) > 1e-8 * dot(&gaps, &gaps) {
        NotClosed::Held
    } else if dependent_at_start > 0 {
        NotClosed::Contradiction
    } else {
        NotClosed::Minimum
    }
}

fn not_assembled(structure: Structure, x: &[f64], at: &Gaps, reason: NotClosed, iterations: usize) -> Failure {
    let first = structure.position_rows().start;
    let mut left = Vector::zeros(x.len());
    for k in 0..structure.position_constraints {
        if at.each[k] > TOLERANCE {
            left[first + k] = at.gaps[k];
        }
    }
    Failure::NotAssembled { reason, coordinates: x.into(), gaps: left.into(), worst: first + at.worst, iterations }
}

/// Speeds that meet the constraints on velocities as far as speeds can, by the smallest change and with the held ones
/// fixed.
pub(super) fn close_speeds(point: &OperatingPoint<'_>, start: &[f64], held: &[bool]) -> Option<Vector> {
    let structure = point.structure;
    let places = structure.velocity_rows();
    let mut x = Vector::from(start);
    // The constraints are linear in the speeds: the second pass removes rounding.
    for _ in 0..2 {
        let (residual, stiffness) = point.evaluate_plain(&x)?;
        let rows = Rows::balanced(Matrix::from_fn(places.len(), x.len(), |k, j| {
            if structure.speed_range().contains(&j) && !held[j] { stiffness[places.start + k][j] } else { 0.0 }
        }));
        add_to(&mut x, -1.0, &rows.shortest(&residual[places.clone()]));
    }
    Some(x)
}
