//! Families of steady motions: which member is meant, and which unknowns hold it.
//!
//! A wheel may roll in a circle of any size at any speed: the equations have more unknowns than independent rows. As
//! many unknowns as the family has parameters are held at a value. Preferred are those that the user holds, then those
//! with a declared value, then those with a start value, then the speeds of coasting coordinates. With `H y = c` for
//! the held unknowns and columns `B` not orthogonal to the left null space, the bordered equations `g(y) + B mu = 0`,
//! `H y = c` are regular. On a family they have a solution with `mu = 0` for every `c` nearby; at an equilibrium where
//! the stiffness only happens to be singular they do not.
//!
//! # Families of steady motions
//!
//! If `Khat` has more null vectors than free directions, and neighbours along them are steady motions too, the state is
//! a member of a family: a coin that rolls in a circle of any size. Which unknowns are held picks the member and what a
//! derivative means, so it is part of the result (`FreeDirections::held`): those that the user or the declaration
//! holds, then those with a start value, then speeds of coasting coordinates (`equilibrium/member.rs`). Values that a
//! declaration gives (`steady`) are evaluated in dual numbers, so they need no kernels for their derivatives
//! (`free/declared.rs`). Along a branch the border of its first state is kept (`Curve::place`): at a critical state the
//! stiffness alone cannot tell the critical direction from the others.

use super::convergence::{StepsLeft, TOLERANCE, last, relative_residual};
use super::finish::{SolvedState, finished};
use super::operating_point::{Failure, OperatingPoint};
use super::scaling::units;
use super::stability::judge_member;

use crate::algebra::{Lu, Matrix, Vector, add_scaled, dot, largest};
use crate::error::NotFound;
use crate::free::{FreeDirections, Held, NullSpace};
use crate::state::Note;

const MAX_ITERATIONS: usize = 40;
/// Steps on the way to held values that Newton's method does not reach at once.
const STAGES: usize = 16;
/// Change of the held values, in their units, over which a family must exist.
const REACH: f64 = 1e-2;
/// Smallest share of a direction that an unknown may have to hold the member along it.
const INDEPENDENT: f64 = 1e-8;
/// Difference, relative to an unknown or in its unit, that counts as another value.
const DIFFERENT: f64 = 1e-9;

/// Moves a steady motion found from `start` to the requested member of its family, and notes what holds it there.
/// Leaves a steady motion that belongs to no family as it is.
pub(super) fn select_member(
    point: &OperatingPoint<'_>,
    start: &[f64],
    solved_state: SolvedState,
) -> Result<SolvedState, Failure> {
    let q = &solved_state.state.coordinates;
    let choice = choice(point, start, q)?;
    let unit = units_of(point, q)?;
    let family = choice.filter(|held| newton(point, q, &perturbed(held, q, &unit)).is_some());
    let Some(mut held) = family else {
        return refuse_held(point).map(|()| solved_state);
    };
    let differs = |unknown: usize, a: f64, b: f64| (a - b).abs() > DIFFERENT * (a.abs() + b.abs() + unit[unknown]);
    let moves = |held: &Held| differs(held.unknown, q[held.unknown], held.value);
    let mut settled =
        if held.iter().any(moves) { finished(point, continued_to(point, start, q, &held)?)? } else { solved_state };
    let state = &mut settled.state;
    let dimension = held.len();
    for coordinate in &mut held {
        coordinate.value = state.coordinates[coordinate.unknown];
    }
    state.free = FreeDirections::of_member(&state.linear.stiffness, point.free(), held);
    if !point.structure.holonomic() {
        let verdict = judge_member(state);
        (state.stability, state.rounding) = (verdict.stability, verdict.rounding);
    }
    state.notes.push(Note::Member { dimension });
    for unknown in point.named() {
        let (asked, coordinate) = (start[unknown], state.coordinates[unknown]);
        if differs(unknown, asked, coordinate) {
            state.notes.push(Note::OtherValue { unknown, asked, found: coordinate });
        }
    }
    Ok(settled)
}

/// Where a steady motion belongs to no family, nothing can hold a member of it.
pub(super) fn refuse_held(point: &OperatingPoint<'_>) -> Result<(), Failure> {
    if point.held.is_empty() { Ok(()) } else { Err(refused(point, 0)) }
}

fn refused(point: &OperatingPoint<'_>, dimension: usize) -> Failure {
    Failure::Held { unknowns: point.held.iter().map(|held| held.unknown).collect(), dimension }
}

/// The unknowns that hold a member of the family that `q` belongs to, with the values they are to have; `None` where the
/// stiffness is regular, and the steady motion the only one nearby.
fn choice(point: &OperatingPoint<'_>, start: &[f64], q: &[f64]) -> Result<Option<Vec<Held>>, Failure> {
    let Some((_, stiffness)) = point.evaluate(q) else {
        return Ok(None);
    };
    let space = NullSpace::of(&stiffness, 0);
    let dimension = space.right.len();
    if dimension == 0 {
        return Ok(None);
    }
    let mut chosen = Independent::new(&space.basis);
    let mut held: Vec<Held> = Vec::new();
    for hold in &point.held {
        if held.len() < dimension && chosen.take(hold.unknown) {
            held.push(hold.clone());
        } else if hold.declared.is_none() || held.iter().all(|other| other.declared.is_some()) {
            return Err(refused(point, dimension));
        }
    }
    let plain = |unknown, value| Held { unknown, value, ..Held::default() };
    let structure = point.structure;
    let named = point.named().map(|unknown| plain(unknown, start[unknown]));
    let others = structure.speed_range().chain(0..structure.coordinates);
    for hold in named.chain(others.map(|unknown| plain(unknown, q[unknown]))) {
        if held.len() < dimension && chosen.take(hold.unknown) {
            held.push(hold);
        }
    }
    Ok((held.len() == dimension).then_some(held))
}

/// Unknowns that move independently along the directions of a null space.
struct Independent<'a> {
    basis: &'a [Vector],
    taken: Vec<Vector>,
}

impl<'a> Independent<'a> {
    fn new(basis: &'a [Vector]) -> Self {
        Self { basis, taken: Vec::new() }
    }

    /// Takes an unknown if it moves along a direction that those taken before do not fix.
    fn take(&mut self, unknown: usize) -> bool {
        let mut row: Vector = self.basis.iter().map(|x| x[unknown]).collect();
        let size = dot(&row, &row).sqrt();
        for other in &self.taken {
            let along = dot(&row, other);
            row = add_scaled(&row, -along, other);
        }
        let left = dot(&row, &row).sqrt();
        if left.is_nan() || size <= INDEPENDENT || left <= INDEPENDENT * size {
            return false;
        }
        row.iter_mut().for_each(|value| *value /= left);
        self.taken.push(row);
        true
    }
}

/// One unit of every unknown: of coordinates and speeds as for first steps, of reactions their largest.
fn units_of(point: &OperatingPoint<'_>, q: &[f64]) -> Result<Vector, Failure> {
    let motions = units(point, q)?;
    let reaction = largest(&q[point.motions()..]);
    Ok(Vector::from_fn(q.len(), |i| motions.get(i).copied().unwrap_or(reaction)))
}

/// The held unknowns, each perturbed slightly from its value at `q`.
fn perturbed(held: &[Held], q: &[f64], unit: &[f64]) -> Vec<Held> {
    let moved = |held: &Held| {
        let here = q[held.unknown];
        Held { value: here + REACH * (here.abs() + unit[held.unknown]), ..held.clone() }
    };
    held.iter().map(moved).collect()
}

/// The member with these held values: from the start, from the motion found there, or from the latter by stages.
fn continued_to(point: &OperatingPoint<'_>, start: &[f64], values: &[f64], held: &[Held]) -> Result<Vector, Failure> {
    let direct = newton(point, start, held).or_else(|| newton(point, values, held));
    let by_stages = || {
        (1..=STAGES).try_fold(Vector::from(values), |q, stage| {
            let share = stage as f64 / STAGES as f64;
            let on_the_way = |held: &Held| Held {
                value: values[held.unknown] + share * (held.value - values[held.unknown]),
                ..held.clone()
            };
            newton(point, &q, &held.iter().map(on_the_way).collect::<Vec<_>>())
        })
    };
    direct.or_else(by_stages).ok_or_else(|| Failure::NotFound {
        reason: NotFound::NoMember,
        coordinates: start.into(),
        iterations: MAX_ITERATIONS,
        relative: f64::INFINITY,
    })
}

/// Solves the bordered equations from `from`; `None` if they have no solution with `mu = 0`.
fn newton(point: &OperatingPoint<'_>, from: &[f64], held: &[Held]) -> Option<Vector> {
    let n = from.len();
    let mut q = Vector::from(from);
    for _ in 0..MAX_ITERATIONS {
        let (residual, stiffness) = point.evaluate(&q)?;
        let space = NullSpace::of(&stiffness, held.len());
        let size = n + held.len();
        let whole = Matrix::from_fn(size, size, |i, j| match (i < n, j < n) {
            (true, true) => stiffness[i][j],
            (true, false) => space.columns[j - n][i],
            (false, true) if held[i - n].unknown == j => 1.0,
            _ => 0.0,
        });
        let right =
            Vector::from_fn(size, |i| if i < n { -residual[i] } else { held[i - n].value - q[held[i - n].unknown] });
        let step = Lu::of(whole)?.solve(&right);
        let step = &step[..n];
        q = add_scaled(&q, 1.0, step);
        if last(step, &q, point.motions()) == StepsLeft::Reached {
            break;
        }
    }
    let (residual, stiffness) = point.evaluate(&q)?;
    let there = held.iter().all(|held| {
        let value = q[held.unknown];
        (value - held.value).abs() <= DIFFERENT * (value.abs() + held.value.abs())
    });
    (there && relative_residual(point, &q, &residual, &stiffness) <= TOLERANCE).then_some(q)
}
