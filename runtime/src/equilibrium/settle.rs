//! From a start value to an equilibrium that is finished: solved to rounding, judged, its reactions determined.

use super::convergence::{ACCEPTED, relative_residual};
use super::descent;
use super::end::{Found, Measured};
use super::prediction::confirmed;
use super::problem::{Failure, Problem};
use super::regularity::{constraint_state, unbalanced};
use super::{Equilibrium, Policy, assembly, newton, quick, space, stability};
use crate::algebra::{Cholesky, Vector, add_scaled, add_to, dot};
use crate::constraints::{Structure, Tangent, all_rows, placed};
use crate::error::NotFound;
use crate::kernels::Linear;
use crate::rounding::Place;
use crate::{DampingKind, Stability};

/// As [`equilibrium`](super::equilibrium), for values already checked.
pub(crate) fn settle(
    problem: &Problem<'_>,
    start: &[f64],
    policy: Policy,
) -> Result<Equilibrium, Failure> {
    let mut state = problem.blank_state();
    settle_into(problem, start, policy, &mut state)?;
    Ok(state)
}

/// As [`settle`]: writes over a state of the same mechanism at these inputs and design variables.
pub(crate) fn settle_into(
    problem: &Problem<'_>,
    start: &[f64],
    policy: Policy,
    state: &mut Equilibrium,
) -> Result<(), Failure> {
    if policy == Policy::Stable && has_open_potential(problem) {
        match quick::quick(problem, start, state) {
            Ok(()) => return judge(problem, state),
            Err(place) => *state = from_afar(problem, start, &place)?,
        }
    } else {
        *state = settle_slowly(problem, start, policy)?;
    }
    Ok(())
}

/// Whether stable states are minima of a potential of coordinates that no constraint holds.
fn has_open_potential(problem: &Problem<'_>) -> bool {
    problem.description.symmetric_stiffness && problem.structure.open()
}

/// As [`settle`], for mechanisms with constraints and for those without a potential.
fn settle_slowly(
    problem: &Problem<'_>,
    start: &[f64],
    policy: Policy,
) -> Result<Equilibrium, Failure> {
    let structure = problem.structure;
    let closed;
    let start = if structure.open() {
        start
    } else {
        closed = assembly::closed(problem, start, &vec![false; problem.size()])?.0;
        &closed
    };
    let potential = problem.description.symmetric_stiffness && structure.holonomic();
    if policy == Policy::Nearest || !potential {
        return nearest(problem, start).and_then(|found| finish(problem, found));
    }
    let mut found = from_afar(problem, start, &descent::Place::first(start));
    for _ in 0..descent::MAX_DEPARTURES {
        let Err(Failure::Unbalanced {
            coordinates,
            downhill,
            ..
        }) = found
        else {
            return found;
        };
        let start = departed(problem, &coordinates, &downhill)?;
        found =
            from_afar(problem, &start, &descent::Place::first(&start)).map(|state| Equilibrium {
                left_unstable_region: true,
                ..state
            });
    }
    found
}

/// Beside a singular configuration, on the way that the forces take there.
#[cold]
fn departed(problem: &Problem<'_>, from: &[f64], downhill: &[f64]) -> Result<Vector, Failure> {
    let beside = add_scaled(from, descent::DEPARTURE, downhill);
    assembly::closed(problem, &beside, &vec![false; problem.size()]).map(|(start, _)| start)
}

/// The stable equilibrium next to a predicted state, `last` the one before it; `None` unless a straight way leads there and
/// it is what was predicted. For mechanisms with a potential and without constraints.
pub(crate) fn settle_from_prediction(
    problem: &Problem<'_>,
    last: &[f64],
    predicted: &[f64],
) -> Option<Equilibrium> {
    if !has_open_potential(problem) {
        return None;
    }
    let mut state = problem.blank_state();
    quick::quick(problem, predicted, &mut state).ok()?;
    if !confirmed(&state.coordinates, predicted, last) {
        return None;
    }
    judge(problem, &mut state).ok()?;
    Some(state)
}

/// As [`settle`], for a stable equilibrium to which no straight way leads; the search goes on at `place`.
#[cold]
fn from_afar(
    problem: &Problem<'_>,
    start: &[f64],
    place: &descent::Place,
) -> Result<Equilibrium, Failure> {
    let structure = problem.structure;
    if let Some(state) = held(problem, start) {
        return Ok(state);
    }
    let found = if structure.open() {
        descent::stable::<space::Whole>(problem, start, place)
    } else {
        descent::stable::<space::Constrained>(problem, start, place)
            .and_then(|found| polished(problem, found))
    };
    found
        .or_else(|failure| match failure {
            Failure::SingularMass(_) | Failure::Mode { .. } => Err(failure),
            _ => nearest(problem, start).map_err(|_| failure),
        })
        .and_then(|found| finish(problem, found))
        .map_err(|failure| match failure {
            Failure::NotFound {
                ref coordinates, ..
            } if !structure.open() => unbalanced(problem, coordinates).unwrap_or(failure),
            _ => failure,
        })
}

/// The equilibrium nearest to `start`, which meets the constraints: along the positions that do where these are all there is
/// to it, else on all unknowns together.
fn nearest(problem: &Problem<'_>, start: &[f64]) -> Result<Found, Failure> {
    let structure = problem.structure;
    let whole = || {
        let independent = problem.without_redundant(start);
        newton::nearest::<space::Whole>(&independent, start)
    };
    if structure.open() || !structure.holonomic() {
        return whole();
    }
    newton::nearest::<space::Constrained>(problem, start)
        .and_then(|found| polished(problem, found))
        .or_else(|failure| whole().map_err(|_| failure))
}

/// The last steps on coordinates and reactions together.
fn polished(problem: &Problem<'_>, found: Found) -> Result<Found, Failure> {
    let independent = problem.without_redundant(&found.coordinates);
    let last = newton::nearest::<space::Whole>(&independent, &found.coordinates)?;
    Ok(Found {
        iterations: found.iterations + last.iterations,
        left_unstable_region: found.left_unstable_region,
        ..last
    })
}

/// The equilibrium nearest to `start` if that is a saddle which gyroscopic forces hold; descent would leave it.
fn held(problem: &Problem<'_>, start: &[f64]) -> Option<Equilibrium> {
    if problem.description.damping == DampingKind::Zero {
        return None;
    }
    let structure = problem.structure;
    let stiffness = if structure.open() {
        problem.evaluate(start)?.1
    } else {
        let linear = problem.linear(start).ok()?;
        Tangent::new(&linear, structure).reduce(&linear.stiffness)
    };
    if Cholesky::new(&stiffness).is_ok() {
        return None;
    }
    let found = nearest(problem, start).ok()?;
    let state = finish(problem, found).ok()?;
    matches!(state.stability, Stability::GyroscopicallyStabilised { .. }).then_some(state)
}

fn finish(problem: &Problem<'_>, mut found: Found) -> Result<Equilibrium, Failure> {
    let Measured {
        linear,
        relative_residual: relative,
    } = match found.measured.take() {
        Some(measured) => measured,
        None => measure(problem, &mut found)?,
    };
    if relative.is_nan() || relative > ACCEPTED {
        return Err(Failure::NotFound {
            reason: NotFound::Inaccurate,
            coordinates: found.coordinates.into(),
            iterations: found.iterations,
            relative,
        });
    }
    let constraints = constraint_state(problem, &found.coordinates, &found.residual, &linear)?;
    let mut state = Equilibrium {
        coordinates: found.coordinates,
        linear,
        constraints,
        residual: found.residual,
        relative_residual: relative,
        iterations: found.iterations,
        left_unstable_region: found.left_unstable_region,
        ..problem.blank_state()
    };
    judge(problem, &mut state)?;
    Ok(state)
}

/// What a solved state is: its stability, and how far joints are from singular poses.
fn judge(problem: &Problem<'_>, state: &mut Equilibrium) -> Result<(), Failure> {
    (state.stability, state.rounding) = if state.constraints.singular {
        (Stability::Undecided, 0.0)
    } else if at_rest_by_stiffness(problem) && stability::clearly_stable(&state.linear) {
        (Stability::Stable, 0.0)
    } else {
        let place = Place {
            coordinates: &state.coordinates,
            inputs: problem.inputs,
            design: problem.design,
            residual: &state.residual,
        };
        stability::judge(problem.mechanism, &place, &state.linear)?
    };
    state.pose = problem
        .mechanism
        .pose_margin(&state.coordinates, problem.inputs, problem.design);
    Ok(())
}

/// Determines the reactions of a state and measures it.
fn measure(problem: &Problem<'_>, found: &mut Found) -> Result<Measured, Failure> {
    let mut linear = problem.linear(&found.coordinates)?;
    if problem.structure.constraints() > 1 {
        if let Some(least) = least_reactions(&found.coordinates, &linear, problem.structure) {
            linear = problem.linear(&least)?;
            found.coordinates = least;
        }
        // With the gaps of constraints that were left out.
        found.residual = problem.residual(&found.coordinates);
    }
    let (q, residual) = (&found.coordinates, &found.residual);
    Ok(Measured {
        relative_residual: relative_residual(problem, q, residual, &linear.stiffness),
        linear,
    })
}

/// Whether positive masses and stiffnesses alone make a state stable.
fn at_rest_by_stiffness(problem: &Problem<'_>) -> bool {
    let undamped = problem.description.damping == DampingKind::Zero;
    undamped && problem.description.symmetric_stiffness && problem.structure.open()
}

/// The state with the least of the reactions that redundant constraints leave undetermined; `None` where they leave nothing.
fn least_reactions(x: &[f64], linear: &Linear, structure: Structure) -> Option<Vector> {
    let rows = all_rows(&linear.stiffness, structure);
    let mut least = Vector::from(x);
    for k in 0..rows.dependent() {
        let along = placed(structure, &rows.null_left(k));
        let amount = dot(x, &placed(structure, &rows.null_left_scaled(k)));
        add_to(&mut least, -amount, &along);
    }
    (rows.dependent() > 0).then_some(least)
}
