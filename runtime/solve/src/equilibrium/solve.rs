//! Finds an equilibrium from a start value, with the method that suits the mechanism.
//!
//! # What a start value means
//!
//! A start value given by the user expresses an intention; a default does not. If the other coordinates relax about the
//! given ones and those balance too, that equilibrium is the answer whatever its stability, and a note says so
//! (`Note::Stays`); a default never keeps a mechanism upright that the user forgot. `Study::stay` asks for the nearest
//! equilibrium of any kind. Designs near an unstable nominal state start from its shifted position and use Newton's
//! method without descent. Conservative, rolling and coasting mechanisms are treated alike.

use super::acceptance::{Measured, UnjudgedResult};
use super::convergence::{SMALL_MOTION, relative_residual};
use super::descent;
use super::finish::{SolvedState, finish, judge};
use super::operating_point::{Failure, OperatingPoint};
use super::prediction::confirmed;
use super::regularity::unbalanced;
use super::{Equilibrium, Policy, assembly, member, newton, newton_fast_path, search_space};
use crate::algebra::{Cholesky, Vector, add_scaled};
use crate::constraints::Tangent;
use crate::error::NotFound;
use crate::state::Note;
use crate::{DampingKind, Mode, Stability};

/// Like [`equilibrium`](super::equilibrium), for validated values.
pub fn solve(point: &OperatingPoint<'_>, start: &[f64], policy: Policy) -> Result<SolvedState, Failure> {
    let mut state = point.blank_state();
    let modes = solve_into(point, start, policy, &mut state)?;
    Ok(SolvedState { state, modes })
}

/// Like [`solve`], but overwrites a state of the same mechanism at these inputs and design variables, and returns
/// [`SolvedState::modes`].
///
/// That directions are free is a claim of the compiler, with a margin for rounding. Where something resists in them
/// after all, they are solved for like others.
pub fn solve_into(
    point: &OperatingPoint<'_>,
    start: &[f64],
    policy: Policy,
    state: &mut Equilibrium,
) -> Result<Vec<Mode>, Failure> {
    let solved = solve_as_claimed(point, start, policy, state);
    let end = match &solved {
        Ok(_) => &state.coordinates[..],
        Err(Failure::NotFound { coordinates, .. }) => coordinates,
        Err(_) => return solved,
    };
    let Some(resisted) = point.resisted(end) else {
        return solved;
    };
    let mut other = point.blank_state();
    match solve_as_claimed(&resisted, start, policy, &mut other) {
        Ok(modes) => {
            *state = other;
            Ok(modes)
        }
        Err(_) => solved,
    }
}

fn solve_as_claimed(
    point: &OperatingPoint<'_>,
    start: &[f64],
    policy: Policy,
    state: &mut Equilibrium,
) -> Result<Vec<Mode>, Failure> {
    if point.structure.holonomic() {
        member::refuse_held(point)?;
    }
    let solved = if policy == Policy::Stable && has_open_potential(point) {
        let mut progress = descent::SearchState::first(start);
        if newton_fast_path::newton_fast_path(point, &mut progress, state) {
            return judge(point, state);
        }
        solve_by_descent(point, start, &progress)?
    } else {
        solve_slowly(point, start, policy)?
    };
    *state = solved.state;
    Ok(solved.modes)
}

/// Whether stable states are minima of a potential in coordinates that no constraint restricts.
fn has_open_potential(point: &OperatingPoint<'_>) -> bool {
    point.description.symmetric_stiffness && point.structure.open() && point.free() == 0
}

/// Like [`solve`], for mechanisms with constraints or without a potential.
fn solve_slowly(point: &OperatingPoint<'_>, start: &[f64], policy: Policy) -> Result<SolvedState, Failure> {
    let structure = point.structure;
    let closed;
    let start = if structure.open() {
        start
    } else {
        closed = assembly::closed(point, start, &vec![false; point.size()])?.0;
        &closed
    };
    let potential = point.description.symmetric_stiffness && structure.holonomic();
    if policy == Policy::Nearest || !potential {
        let mut solved_state = nearest_beside(point, start)?;
        if !structure.holonomic() {
            solved_state = member::select_member(point, start, solved_state)?;
        }
        if policy == Policy::Nearest {
            solved_state.state.notes.extend(far(point, start, &solved_state.state.coordinates, point.named()));
        }
        return Ok(solved_state);
    }
    let mut solved_state = solve_by_descent(point, start, &descent::SearchState::first(start));
    for _ in 0..descent::MAX_DEPARTURES {
        let Err(Failure::Unbalanced { coordinates, downhill, .. }) = solved_state else {
            return solved_state;
        };
        let start = departed(point, &coordinates, &downhill)?;
        solved_state = solve_by_descent(point, &start, &descent::SearchState::first(&start));
        if let Ok(found) = &mut solved_state {
            found.state.left_unstable_region = true;
        }
    }
    solved_state
}

/// What to say if the nearest equilibrium is far from the start values of some unknowns.
pub(super) fn far(
    point: &OperatingPoint<'_>,
    start: &[f64],
    q: &[f64],
    unknowns: impl Iterator<Item = usize>,
) -> Option<Note> {
    let away = |unknown: usize| (start[unknown] - q[unknown]).abs();
    let share = |unknown: usize| away(unknown) / point.description.large(unknown);
    let unknown = unknowns.max_by(|a, b| share(*a).total_cmp(&share(*b)))?;
    let distance = away(unknown);
    (share(unknown) > FAR).then_some(Note::Far { unknown, distance })
}

/// Distance from a start value, relative to a large change, that is worth a note.
const FAR: f64 = 0.1;

/// Leaves a singular configuration in the direction in which the forces drive.
#[cold]
fn departed(point: &OperatingPoint<'_>, from: &[f64], downhill: &[f64]) -> Result<Vector, Failure> {
    let beside = add_scaled(from, descent::DEPARTURE, downhill);
    assembly::closed(point, &beside, &vec![false; point.size()]).map(|(start, _)| start)
}

/// Like [`solve_into`], for the stable equilibrium next to a predicted state; `last` is the one before it.
///
/// `None` unless the fast path leads to a state that confirms the prediction. For mechanisms with a potential and
/// without constraints.
pub fn solve_from_prediction(
    point: &OperatingPoint<'_>,
    last: &[f64],
    predicted: &[f64],
    state: &mut Equilibrium,
) -> Option<Vec<Mode>> {
    if !has_open_potential(point) {
        return None;
    }
    let mut progress = descent::SearchState::first(predicted);
    if !newton_fast_path::newton_fast_path(point, &mut progress, state)
        || !confirmed(&state.coordinates, predicted, last)
    {
        return None;
    }
    judge(point, state).ok()
}

/// Like [`solve`], for a stable equilibrium that the fast path does not reach; the search continues at `progress`.
#[cold]
fn solve_by_descent(
    point: &OperatingPoint<'_>,
    start: &[f64],
    progress: &descent::SearchState,
) -> Result<SolvedState, Failure> {
    let structure = point.structure;
    if let Some(named) = stays(point, start) {
        return Ok(named);
    }
    if let Some(held) = gyroscopically_stabilised(point, start) {
        return Ok(held);
    }
    let minimum = if structure.open() {
        descent::minimise_potential::<search_space::Unconstrained>(point, start, progress, |progress| {
            straight(point, progress)
        })
    } else {
        descent::minimise_potential::<search_space::ConstraintManifold>(point, start, progress, |_| None)
            .and_then(|unjudged| polished(point, unjudged))
    };
    minimum
        .or_else(|failure| match failure {
            Failure::SingularMass(_) | Failure::Mode { .. } => Err(failure),
            _ => nearest(point, start).map_err(|_| failure),
        })
        .and_then(|candidate| bounded(point, candidate))
        .and_then(|candidate| finish(point, candidate))
        .map_err(|failure| match failure {
            Failure::NotFound { ref coordinates, .. } if !structure.open() => {
                unbalanced(point, coordinates).unwrap_or(failure)
            }
            _ => failure,
        })
}

/// Refuses a state next to a pole of the forces.
fn bounded(point: &OperatingPoint<'_>, unjudged: UnjudgedResult) -> Result<UnjudgedResult, Failure> {
    let q = &unjudged.coordinates;
    if !descent::grows_without_bound(point, q) {
        return Ok(unjudged);
    }
    let relative = point
        .evaluate(q)
        .map_or(f64::INFINITY, |(residual, stiffness)| relative_residual(point, q, &residual, &stiffness));
    Err(Failure::NotFound {
        reason: NotFound::Unbounded,
        iterations: unjudged.iterations,
        relative,
        coordinates: unjudged.coordinates.to_vec(),
    })
}

/// The equilibrium whose coordinates are the start values that were given, if these are those of one: it is the answer
/// whatever its stability. Coordinates without a given value are free to adapt.
#[cold]
fn stays(point: &OperatingPoint<'_>, start: &[f64]) -> Option<SolvedState> {
    let count = point.named().count();
    if count == 0 {
        return None;
    }
    if point.structure.open() && count == point.size() {
        let (residual, stiffness) = point.evaluate(start)?;
        if relative_residual(point, start, &residual, &stiffness) > NAMED {
            return None;
        }
    }
    let candidate = nearest(point, start).ok()?;
    let is_there = |unknown: usize| {
        let (asked, coordinate) = (start[unknown], candidate.coordinates[unknown]);
        (asked - coordinate).abs() <= NAMED * (asked.abs() + SMALL_MOTION)
    };
    if !point.named().all(is_there) {
        return None;
    }
    let mut judged = finish(&point.judged(), candidate).ok()?;
    if !judged.state.stability.holds() {
        judged.state.notes.push(Note::Stays);
    }
    Some(judged)
}

/// Residual at start values, and change of them, relative to forces and coordinates, up to which they are those of an
/// equilibrium.
const NAMED: f64 = 1e-8;

/// The minimum that the fast path finds from `progress`.
fn straight(point: &OperatingPoint<'_>, mut progress: descent::SearchState) -> Option<UnjudgedResult> {
    let mut state = point.blank_state();
    newton_fast_path::newton_fast_path(point, &mut progress, &mut state).then_some(UnjudgedResult {
        coordinates: state.coordinates,
        residual: state.residual,
        measured: Some(Measured { linear: state.linear, relative_residual: state.relative_residual }),
        iterations: state.iterations,
        left_unstable_region: false,
    })
}

/// Like [`nearest`], also where the search comes to rest at a state whose stiffness is singular, as from a critical state:
/// it goes on from either side of it. Of two results, one that is stable is preferred.
fn nearest_beside(point: &OperatingPoint<'_>, start: &[f64]) -> Result<SolvedState, Failure> {
    let search = |point: &_, start: &[f64]| nearest(point, start).and_then(|candidate| finish(point, candidate));
    search(point, start).or_else(|failure| {
        let Failure::NotFound { reason: NotFound::Minimum, coordinates, .. } = &failure else {
            return Err(failure);
        };
        let structure = point.structure;
        let sides = if structure.open() || !structure.holonomic() {
            let independent = point.without_redundant(coordinates);
            newton::along_softest_direction::<search_space::Unconstrained>(&independent, coordinates)
        } else {
            newton::along_softest_direction::<search_space::ConstraintManifold>(point, coordinates)
        };
        let sides = sides.unwrap_or_default().into_iter();
        let judged = point.judged();
        let solutions = sides.filter_map(|side| search(&judged, &side).ok());
        let best = solutions.reduce(|first, second| {
            if second.state.stability.holds() && !first.state.stability.holds() { second } else { first }
        });
        best.ok_or(failure)
    })
}

/// The equilibrium nearest to `start`, a state that meets the constraints. Searches along the positions that meet them
/// if there are only constraints on positions, otherwise over all unknowns together.
fn nearest(point: &OperatingPoint<'_>, start: &[f64]) -> Result<UnjudgedResult, Failure> {
    let structure = point.structure;
    let whole = || {
        let independent = point.without_redundant(start);
        newton::damped_newton::<search_space::Unconstrained>(&independent, start)
    };
    if structure.open() || !structure.holonomic() {
        return whole();
    }
    newton::damped_newton::<search_space::ConstraintManifold>(point, start)
        .and_then(|unjudged| polished(point, unjudged))
        .or_else(|failure| whole().map_err(|_| failure))
}

/// Takes the last steps in coordinates and reactions together.
fn polished(point: &OperatingPoint<'_>, unjudged: UnjudgedResult) -> Result<UnjudgedResult, Failure> {
    let independent = point.without_redundant(&unjudged.coordinates);
    let last = newton::damped_newton::<search_space::Unconstrained>(&independent, &unjudged.coordinates)?;
    Ok(UnjudgedResult {
        iterations: unjudged.iterations + last.iterations,
        left_unstable_region: unjudged.left_unstable_region,
        ..last
    })
}

/// The equilibrium nearest to `start` if it is a saddle held by gyroscopic forces; descent would leave it.
fn gyroscopically_stabilised(point: &OperatingPoint<'_>, start: &[f64]) -> Option<SolvedState> {
    if point.description.damping == DampingKind::Zero {
        return None;
    }
    let structure = point.structure;
    let stiffness = if structure.open() {
        point.evaluate(start)?.1
    } else {
        let linear = point.linear(start).ok()?;
        Tangent::new(&linear, structure).reduce(&linear.stiffness)
    };
    if Cholesky::new(&stiffness).is_ok() {
        return None;
    }
    let candidate = nearest(point, start).ok()?;
    let judged = finish(&point.judged(), candidate).ok()?;
    let stability = judged.state.stability;
    matches!(stability, Stability::GyroscopicallyStabilised { .. }).then_some(judged)
}
