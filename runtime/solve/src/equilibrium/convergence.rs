//! When a solve is finished: its Newton step is small relative to the coordinates, or rounding keeps the residual from
//! falling further.
//!
//! The residual alone is no criterion near a critical state, where a small one hides a large displacement. A small step
//! alone is no criterion where stiffnesses of very different size meet. A finished state therefore passes both tests.
//! The gap of a constraint is measured by motions too, and a reaction relative to the largest one.

use super::balance::residual_without_rounding;
use super::operating_point::{OperatingPoint, gap_unit};
use crate::algebra::{Matrix, Vector, for_size, greater, largest, unless_finite};
use crate::kernels::RestParts;

/// Relative residual that counts as solved once it no longer falls.
pub const TOLERANCE: f64 = 1e-10;
/// Largest relative residual of a result; beyond it, a state is no equilibrium.
pub const ACCEPTED: f64 = 2.0 * TOLERANCE;
/// A step this small, relative to the coordinates, changes nothing.
pub(crate) const FLOOR: f64 = 2.0 * f64::EPSILON;
/// A displacement this small may be rounding of the residual.
pub const ROUNDING: f64 = 32.0 * f64::EPSILON;
/// A Newton step this small leaves a remainder at rounding.
pub const LAST_STEP: f64 = 1e-8;
/// A residual that keeps this share in a step has stopped falling: Newton steps leave less than 1/e of it even where
/// `Khat` is singular at the solution.
const STALLED: f64 = 0.5;
/// Displacement (rad or m) against which coordinates near zero are measured.
pub const SMALL_MOTION: f64 = 1e-3;
/// Share of a coordinate that counts as a displacement in the scale of a residual. Multiplied by [`TOLERANCE`] it is
/// about seven rounding units of the coordinate, the resolution of a large coordinate.
pub const ROUNDED: f64 = 1.5e-5;
/// Distance, relative to the state where the residual last fell, beyond which an unchanged residual means that the
/// state runs away.
const DRIFT: f64 = 1e3;

/// How far a solve has come.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Progress {
    /// Not finished.
    Underway,
    /// One more Newton step reaches rounding.
    LastStep,
    /// Solved to rounding.
    Finished,
}

/// Monitors a falling residual and detects when it has reached rounding.
pub(crate) struct ResidualMonitor {
    previous: f64,
    /// The state at which the residual last fell.
    fell_at: Vector,
    /// A buffer.
    parts: RestParts,
}

impl ResidualMonitor {
    pub(crate) fn new(start: &[f64]) -> Self {
        Self { previous: f64::INFINITY, fell_at: start.into(), parts: RestParts::zeros(start.len()) }
    }

    /// Judges a state by its residual and the full step that would come next; without a step, by the residual alone.
    #[inline]
    #[doc(hidden)]
    pub(crate) fn judge(
        &mut self,
        point: &OperatingPoint<'_>,
        q: &[f64],
        (residual, stiffness): (&[f64], &Matrix),
        step: Option<&[f64]>,
    ) -> Progress {
        let size = largest(residual);
        let stalled = size >= STALLED * self.previous;
        self.previous = size;
        if !stalled {
            self.fell_at.copy_from_slice(q);
        }
        let motions = point.motions();
        let last = step.map_or(StepsLeft::More, |step| last(step, q, motions));
        let drifts = stalled && self.drifts(&q[..motions]);
        let parts = &mut self.parts;
        let at = (residual, stiffness);
        let mut solved = |tolerance| relative_residual_into(point, q, at, parts) <= tolerance;
        if (last == StepsLeft::Reached && solved(ACCEPTED)) || (stalled && !drifts && solved(TOLERANCE)) {
            Progress::Finished
        } else if last == StepsLeft::More {
            Progress::Underway
        } else {
            Progress::LastStep
        }
    }

    /// Whether the state runs away while its residual stays the same: growing forces make the residual small only by
    /// comparison.
    fn drifts(&self, q: &[f64]) -> bool {
        q.iter().zip(&self.fell_at).any(|(now, then)| (now - then).abs() > DRIFT * (1.0 + then.abs()))
    }
}

/// Remaining Newton steps, judged from a full step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum StepsLeft {
    /// More than one step.
    More,
    /// This step reaches rounding.
    OneMore,
    /// None: the step changes nothing.
    Reached,
}

/// How many steps remain, judged from the next one at `q`.
#[inline(always)]
pub(crate) fn last(step: &[f64], q: &[f64], motions: usize) -> StepsLeft {
    if !within(LAST_STEP, step, q, motions) {
        StepsLeft::More
    } else if within(FLOOR, step, q, motions) {
        StepsLeft::Reached
    } else {
        StepsLeft::OneMore
    }
}

/// Whether a displacement of the unknowns is as small as rounding.
#[inline]
pub(crate) fn is_rounding(displacement: &[f64], q: &[f64], motions: usize) -> bool {
    within(ROUNDING, displacement, q, motions)
}

/// Whether every change of a coordinate is within `tolerance` of the coordinate or of a small motion, and every change
/// of a reaction within `tolerance` of that reaction or of the largest one.
#[inline(always)]
fn within(tolerance: f64, step: &[f64], q: &[f64], motions: usize) -> bool {
    let reaction = largest_of(&q[motions..]);
    let mut within = true;
    for (j, (step, q)) in step.iter().zip(q).enumerate() {
        let unit = if j < motions { 1.0 } else { reaction };
        within &= step.abs() <= tolerance * (q.abs() + SMALL_MOTION * unit);
    }
    within
}

/// The largest residual, each relative to its own scale.
///
/// The scale consists of the parts of the residual (inertia, applied forces) and of what a small motion of each
/// coordinate, or the rounding of a large one, restores in the same equation. Reactions count as forces, a reaction
/// that is pure rounding as a small share of the largest one. The gap of a constraint is relative to what those motions
/// open. A residual that is not small by this is compared with what the constraints pass on from other equations too:
/// where links carry no load, all of their own forces are rounding. Where nothing resists some motion, what is left then
/// is compared with what rounding of the data changes in it (see `balance`).
pub fn relative_residual(point: &OperatingPoint<'_>, q: &[f64], residual: &[f64], stiffness: &Matrix) -> f64 {
    let mut parts = RestParts::zeros(q.len());
    relative_residual_into(point, q, (residual, stiffness), &mut parts)
}

/// Like [`relative_residual`], with a buffer for the parts.
fn relative_residual_into(
    point: &OperatingPoint<'_>,
    q: &[f64],
    (residual, stiffness): (&[f64], &Matrix),
    parts: &mut RestParts,
) -> f64 {
    point.parts_into(q, parts);
    relative_to_parts(point, parts, q, residual, stiffness)
}

/// Like [`relative_residual`], with the parts of the residual at `q` given.
pub(crate) fn relative_to_parts(
    point: &OperatingPoint<'_>,
    parts: &RestParts,
    q: &[f64],
    residual: &[f64],
    stiffness: &Matrix,
) -> f64 {
    let relative = |residual: &[f64]| {
        let value = relative_to(point, parts, q, residual, stiffness);
        if value > TOLERANCE && point.motions() < q.len() {
            let forces = [&parts.inertia[..], &parts.applied];
            value.min(relative_to_passed_on(point, forces, q, residual, stiffness))
        } else {
            value
        }
    };
    let value = relative(residual);
    let unresisted = point.free() > 0 || point.of_family();
    let left = (value > TOLERANCE && unresisted).then(|| residual_without_rounding(&point.data(), q, residual));
    left.flatten().map_or(value, |left| relative(&left))
}

/// Like [`relative_residual`], where constraints pass on forces.
///
/// Forces of different equations are compared by their work over the small motion of their coordinate. A constraint
/// passes on the work of each equation by the share of the coordinate in the gap that all small motions open.
#[cold]
fn relative_to_passed_on(
    point: &OperatingPoint<'_>,
    forces: [&[f64]; 2],
    q: &[f64],
    residual: &[f64],
    stiffness: &Matrix,
) -> f64 {
    let (n, motions) = (q.len(), point.motions());
    let gaps = relative_gaps(point, q, residual, stiffness);
    let small: Vector = q.iter().map(|q| small_motion(*q)).collect();
    let reaction = largest_of(&q[motions..]);
    let mut work = Vector::from_fn(motions, |i| {
        let row = &stiffness[i];
        small[i] * scale(force(i, motions, forces, q, reaction, row), &small[..motions], row)
    });
    let opened = |i: usize, j: usize| stiffness[i][j].abs() * small[i];
    for _ in motions..n {
        for j in motions..n {
            let gap = (0..motions).fold(0.0, |sum, i| sum + opened(i, j));
            let most = (0..motions).fold(0.0, |most, i| greater(most, opened(i, j) * work[i]));
            for i in (0..motions).filter(|_| gap > 0.0) {
                work[i] = greater(work[i], opened(i, j) / gap * (most / gap));
            }
        }
    }
    (0..n).fold(0.0, |most, i| {
        let imbalance = if i < motions {
            ratio(residual[i] * small[i], work[i])
        } else if i < motions + gaps.len() {
            gaps[i - motions]
        } else {
            relative(residual[i], 0.0, &q[..motions], &stiffness[i])
        };
        greater(most, imbalance)
    })
}

/// Like [`relative_to_parts`], for forces that do not cancel.
#[inline]
fn relative_to(point: &OperatingPoint<'_>, parts: &RestParts, q: &[f64], residual: &[f64], stiffness: &Matrix) -> f64 {
    let forces = [&parts.inertia[..], &parts.applied];
    let stiffness = stiffness.as_flattened();
    if !point.structure.open() {
        return relative_of((q.len(), point.motions()), forces, q, residual, stiffness);
    }
    for_size(
        q.len(),
        #[inline(always)]
        |n| relative_of((n, n), forces, q, residual, stiffness),
    )
}

/// The relative residual for `n` unknowns, the first `motions` of which are motions; `forces` are inertia and applied
/// forces. See [`for_size`].
#[inline(always)]
pub(crate) fn relative_of(
    (n, motions): (usize, usize),
    [inertia, applied]: [&[f64]; 2],
    q: &[f64],
    residual: &[f64],
    stiffness: &[f64],
) -> f64 {
    let (q, residual, stiffness) = (&q[..n], &residual[..n], &stiffness[..n * n]);
    let (inertia, applied) = (&inertia[..n], &applied[..n]);
    let reaction = largest_of(&q[motions..]);
    let mut small = Vector::zeros(n);
    let small = &mut small[..n];
    for (small, q) in small.iter_mut().zip(q) {
        *small = small_motion(*q);
    }
    let mut most = 0.0;
    for i in 0..n {
        let row = &stiffness[i * n..(i + 1) * n];
        let force = if i < motions { force(i, motions, [inertia, applied], q, reaction, row) } else { 0.0 };
        let scale = scale(force, &small[..motions], row);
        let imbalance = if scale > 0.0 && unless_finite(scale) == 0.0 {
            residual[i].abs() / scale
        } else {
            let force = if force.is_finite() { force } else { 0.0 };
            relative(residual[i], force, &q[..motions], row)
        };
        most = greater(most, imbalance);
    }
    most
}

/// The largest force in equation `i`: inertia, applied forces and reactions, the largest of which is `reaction`.
#[inline(always)]
fn force(i: usize, motions: usize, [inertia, applied]: [&[f64]; 2], q: &[f64], reaction: f64, row: &[f64]) -> f64 {
    let mut force = greater(inertia[i].abs(), applied[i].abs());
    for j in motions..q.len() {
        let size = greater(SMALL_MOTION * reaction, q[j].abs());
        force = greater(force, row[j].abs() * size);
    }
    force
}

/// The scale of an equation: `force` and what small motions restore.
#[inline(always)]
fn scale(force: f64, small: &[f64], row: &[f64]) -> f64 {
    (0..small.len()).fold(force, |sum, j| sum + row[j].abs() * small[j])
}

/// The small motion of a coordinate: [`SMALL_MOTION`] plus a few rounding units.
#[inline]
fn small_motion(q: f64) -> f64 {
    SMALL_MOTION + ROUNDED * q.abs()
}

/// The gaps of the constraints on positions, each relative to what small motions open and to the rounding of the lengths
/// that it adds up: a beam that reaches straight across hardly opens its gap.
pub(crate) fn relative_gaps(point: &OperatingPoint<'_>, q: &[f64], residual: &[f64], stiffness: &Matrix) -> Vector {
    let (structure, unknowns) = (point.structure, &point.description.coordinates);
    let motions = &q[..structure.coordinates];
    let rows = structure.position_rows();
    // Lengths are in no coordinate; they are the arms at which rotations move what constraints compare.
    let arm = |row: usize| {
        let arms = motions.iter().zip(&stiffness[row]).enumerate();
        arms.fold(0.0, |most, (j, (q, slope))| {
            let turns = unknowns[j].unit.symbol == *"rad";
            let size = if turns { greater(1.0, q.abs()) } else { q.abs() };
            greater(most, slope.abs() * size)
        })
    };
    let kind = |row: usize| match gap_unit(&point.description, row) {
        "m" => 0,
        "rad" => 1,
        _ => 2,
    };
    let mut arms = [0.0; 3];
    for row in rows.clone() {
        arms[kind(row)] = greater(arms[kind(row)], arm(row));
    }
    let imbalance = |row: usize| {
        let rounded = ROUNDED * arms[kind(row)];
        relative(residual[row], rounded, motions, &stiffness[row])
    };
    rows.map(imbalance).collect()
}

/// One equation's residual relative to `force` and the row of stiffnesses times the motions `q`; a scale that overflows
/// is recomputed from smaller numbers.
#[inline]
fn relative(residual: f64, force: f64, q: &[f64], row: &[f64]) -> f64 {
    let scale =
        |unit: f64| q.iter().zip(row).fold(unit * force, |sum, (q, slope)| sum + unit * slope.abs() * small_motion(*q));
    let plain = scale(1.0);
    if plain.is_finite() {
        ratio(residual, plain)
    } else {
        let unit = f64::MIN_POSITIVE;
        ratio(unit * residual, scale(unit))
    }
}

#[inline]
fn ratio(residual: f64, scale: f64) -> f64 {
    if residual == 0.0 {
        0.0
    } else if scale > 0.0 {
        residual.abs() / scale
    } else {
        f64::INFINITY
    }
}

/// Limit beyond which coordinates and speeds count as escaping to infinity.
pub(crate) fn horizon(start: &[f64]) -> f64 {
    1e12 * (1.0 + largest_of(start))
}

/// Largest absolute value.
#[inline]
pub(crate) fn largest_of(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |most, value| greater(most, value.abs()))
}
