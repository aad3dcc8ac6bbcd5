//! One step towards closing the loops.

use super::super::convergence::largest_of;
use super::super::operating_point::OperatingPoint;
use super::gaps::{Gaps, free, gaps};
use crate::algebra::{Vector, add_scaled, dot};
use crate::constraints::Rows;

/// A step without dependent rows is accepted if it leaves no more than this share of the largest gap.
const FALLS: f64 = 0.1;
/// Share of the gaps that constraints must still be able to close; below it the gaps have a minimum.
const CLOSABLE: f64 = 1e-9;
/// Largest change of a coordinate in the first step, rad or m; grows while the linear model predicts well. It is small
/// because the path decides which assembly mode is found.
pub(super) const FIRST_RADIUS: f64 = 0.3;
/// Limits of the damping, relative to the constraints.
pub(super) const LEAST_DAMPING: f64 = 1e-6;
const MOST_DAMPING: f64 = 1e9;

/// The target of a step: the gaps divided by the sizes of their rows.
pub(super) struct Aim<'a> {
    at: &'a Gaps,
    rows: &'a Rows,
    scaled: Vector,
}

impl<'a> Aim<'a> {
    pub(super) fn new(at: &'a Gaps, rows: &'a Rows) -> Self {
        Self { at, rows, scaled: scaled(&at.gaps, rows) }
    }

    fn merit(&self) -> f64 {
        dot(&self.scaled, &self.scaled)
    }

    /// Whether no motion reduces the gaps to first order: they are orthogonal to everything that the rows can close.
    pub(super) fn minimal(&self) -> bool {
        let slope = self.rows.descent(&self.scaled);
        dot(&slope, &slope) <= CLOSABLE * CLOSABLE * self.merit()
    }

    /// Whether the gaps `there` are smaller by this share.
    fn improved(&self, there: &Gaps, share: f64) -> bool {
        let merit = scaled(&there.gaps, self.rows);
        dot(&merit, &merit) <= (1.0 - share) * self.merit()
    }
}

pub(super) fn scaled(gaps: &[f64], rows: &Rows) -> Vector {
    gaps.iter().zip(&rows.size).map(|(gap, size)| gap / size).collect()
}

/// A Gauss-Newton step without the rows that almost depend on the others, if it reduces every gap.
///
/// Redundant constraints are dependent only where they are met. Away from there, their differences close on their own
/// as the squares of the remaining gaps; keeping those rows would slow the steps down to halving and lose half of the
/// digits.
pub(super) fn without_dependent(
    point: &OperatingPoint<'_>,
    x: &[f64],
    at: &Gaps,
    held: &[bool],
    metric: &Vector,
) -> Option<(Vector, Gaps)> {
    let rows = Rows::nearly(free(&at.rows, held), metric.clone());
    if rows.dependent() == 0 {
        return None;
    }
    let step = rows.shortest_of_independent(&at.gaps);
    let trial = add_scaled(x, -1.0, &step);
    let there = gaps(point, &trial)?;
    let falls = largest_of(&step) <= FIRST_RADIUS && there.relative <= FALLS * at.relative;
    falls.then_some((trial, there))
}

/// A Gauss-Newton step of least motion, halved a few times if needed.
pub(super) fn plain(point: &OperatingPoint<'_>, x: &[f64], aim: &Aim<'_>, radius: &mut f64) -> Option<(Vector, Gaps)> {
    let step = aim.rows.shortest(&aim.at.gaps);
    let size = largest_of(&step);
    let limit = (*radius / size).min(1.0);
    let mut length = limit;
    for _ in 0..4 {
        let trial = add_scaled(x, -length, &step);
        if let Some(there) = gaps(point, &trial)
            && aim.improved(&there, 0.5 * length)
        {
            if length == limit && limit < 1.0 && aim.improved(&there, 1.5 * length) {
                *radius *= 2.0;
            }
            return Some((trial, there));
        }
        length *= 0.5;
    }
    None
}

/// A step with as much damping as needed.
pub(super) fn damped(
    point: &OperatingPoint<'_>,
    x: &[f64],
    aim: &Aim<'_>,
    (radius, damping): (&mut f64, &mut f64),
) -> Option<(Vector, Gaps)> {
    *damping = (*damping * 1e-2).max(LEAST_DAMPING);
    while *damping <= MOST_DAMPING {
        let mut step = aim.rows.damped(&aim.scaled, *damping)?;
        let size = largest_of(&step);
        if size > *radius {
            step = step.map(|value| value * *radius / size);
        }
        let trial = add_scaled(x, -1.0, &step);
        if let Some(there) = gaps(point, &trial)
            && aim.improved(&there, 1e-12)
        {
            return Some((trial, there));
        }
        *damping *= 4.0;
    }
    None
}
