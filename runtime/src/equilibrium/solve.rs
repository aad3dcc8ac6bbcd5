//! From a start value to a finished equilibrium: solved to rounding, stability judged, reactions determined.

use super::acceptance::{Found, Measured};
use super::convergence::{ACCEPTED, relative_residual};
use super::descent;
use super::operating_point::{Failure, OperatingPoint};
use super::prediction::confirmed;
use super::regularity::{constraint_state, unbalanced};
use super::stability::Verdict;
use super::{Equilibrium, Policy, assembly, newton, newton_fast_path, search_space, stability};
use crate::algebra::{Cholesky, Vector, add_scaled, add_to, dot};
use crate::constraints::{Structure, Tangent, all_rows, placed};
use crate::error::NotFound;
use crate::free::FreeDirections;
use crate::kernels::Linear;
use crate::rounding::CheckedState;
use crate::{DampingKind, Mode, Stability};

/// A finished state.
pub(crate) struct Judged {
    pub(crate) state: Equilibrium,
    /// Its general modes if they were needed to judge its stability; empty otherwise.
    pub(crate) modes: Vec<Mode>,
}

/// Like [`equilibrium`](super::equilibrium), for validated values.
pub(crate) fn solve(
    point: &OperatingPoint<'_>,
    start: &[f64],
    policy: Policy,
) -> Result<Judged, Failure> {
    let mut state = point.blank_state();
    let modes = solve_into(point, start, policy, &mut state)?;
    Ok(Judged { state, modes })
}

/// Like [`solve`], but overwrites a state of the same mechanism at these inputs and design variables, and returns
/// [`Judged::modes`].
pub(crate) fn solve_into(
    point: &OperatingPoint<'_>,
    start: &[f64],
    policy: Policy,
    state: &mut Equilibrium,
) -> Result<Vec<Mode>, Failure> {
    let found = if policy == Policy::Stable && has_open_potential(point) {
        let place = descent::SearchState::first(start);
        match newton_fast_path::newton_fast_path(point, place, state) {
            Ok(()) => return judge(point, state),
            Err(place) => from_afar(point, start, &place)?,
        }
    } else {
        solve_slowly(point, start, policy)?
    };
    *state = found.state;
    Ok(found.modes)
}

/// Whether stable states are minima of a potential in coordinates that no constraint restricts.
fn has_open_potential(point: &OperatingPoint<'_>) -> bool {
    point.description.symmetric_stiffness && point.structure.open() && point.free() == 0
}

/// Like [`solve`], for mechanisms with constraints or without a potential.
fn solve_slowly(
    point: &OperatingPoint<'_>,
    start: &[f64],
    policy: Policy,
) -> Result<Judged, Failure> {
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
        return nearest_beside(point, start);
    }
    let mut found = from_afar(point, start, &descent::SearchState::first(start));
    for _ in 0..descent::MAX_DEPARTURES {
        let Err(Failure::Unbalanced {
            coordinates,
            downhill,
            ..
        }) = found
        else {
            return found;
        };
        let start = departed(point, &coordinates, &downhill)?;
        found = from_afar(point, &start, &descent::SearchState::first(&start));
        if let Ok(found) = &mut found {
            found.state.left_unstable_region = true;
        }
    }
    found
}

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
pub(crate) fn solve_from_prediction(
    point: &OperatingPoint<'_>,
    last: &[f64],
    predicted: &[f64],
    state: &mut Equilibrium,
) -> Option<Vec<Mode>> {
    if !has_open_potential(point) {
        return None;
    }
    let place = descent::SearchState::first(predicted);
    newton_fast_path::newton_fast_path(point, place, state).ok()?;
    if !confirmed(&state.coordinates, predicted, last) {
        return None;
    }
    judge(point, state).ok()
}

/// Like [`solve`], for a stable equilibrium that the fast path does not reach; the search continues at `place`.
#[cold]
fn from_afar(
    point: &OperatingPoint<'_>,
    start: &[f64],
    place: &descent::SearchState,
) -> Result<Judged, Failure> {
    let structure = point.structure;
    if let Some(held) = gyroscopically_stabilised(point, start) {
        return Ok(held);
    }
    let found = if structure.open() {
        descent::stable::<search_space::Unconstrained>(point, start, place, |place| {
            straight(point, place)
        })
    } else {
        descent::stable::<search_space::ConstraintManifold>(point, start, place, |_| None)
            .and_then(|found| polished(point, found))
    };
    found
        .or_else(|failure| match failure {
            Failure::SingularMass(_) | Failure::Mode { .. } => Err(failure),
            _ => nearest(point, start).map_err(|_| failure),
        })
        .and_then(|found| finish(point, found))
        .map_err(|failure| match failure {
            Failure::NotFound {
                ref coordinates, ..
            } if !structure.open() => unbalanced(point, coordinates).unwrap_or(failure),
            _ => failure,
        })
}

/// The minimum that the fast path finds from `place`.
fn straight(point: &OperatingPoint<'_>, place: descent::SearchState) -> Option<Found> {
    let mut state = point.blank_state();
    newton_fast_path::newton_fast_path(point, place, &mut state).ok()?;
    Some(Found {
        coordinates: state.coordinates,
        residual: state.residual,
        measured: Some(Measured {
            linear: state.linear,
            relative_residual: state.relative_residual,
        }),
        iterations: state.iterations,
        left_unstable_region: false,
    })
}

/// Like [`nearest`], also where the search comes to rest at a state whose stiffness is singular, as from a critical state:
/// it goes on from either side of it. Of two results, one that is stable is preferred.
fn nearest_beside(point: &OperatingPoint<'_>, start: &[f64]) -> Result<Judged, Failure> {
    let search = |start: &[f64]| nearest(point, start).and_then(|found| finish(point, found));
    search(start).or_else(|failure| {
        let Failure::NotFound {
            reason: NotFound::Minimum,
            coordinates,
            ..
        } = &failure
        else {
            return Err(failure);
        };
        let structure = point.structure;
        let sides = if structure.open() || !structure.holonomic() {
            let independent = point.without_redundant(coordinates);
            newton::beside::<search_space::Unconstrained>(&independent, coordinates)
        } else {
            newton::beside::<search_space::ConstraintManifold>(point, coordinates)
        };
        let sides = sides.unwrap_or_default().into_iter();
        let found = sides.filter_map(|side| search(&side).ok());
        let best = found.reduce(|first, second| {
            if second.state.stability.holds() && !first.state.stability.holds() {
                second
            } else {
                first
            }
        });
        best.ok_or(failure)
    })
}

/// The equilibrium nearest to `start`, a state that meets the constraints. Searches along the positions that meet them
/// if there are only constraints on positions, otherwise over all unknowns together.
fn nearest(point: &OperatingPoint<'_>, start: &[f64]) -> Result<Found, Failure> {
    let structure = point.structure;
    let whole = || {
        let independent = point.without_redundant(start);
        newton::nearest::<search_space::Unconstrained>(&independent, start)
    };
    if structure.open() || !structure.holonomic() {
        return whole();
    }
    newton::nearest::<search_space::ConstraintManifold>(point, start)
        .and_then(|found| polished(point, found))
        .or_else(|failure| whole().map_err(|_| failure))
}

/// Takes the last steps in coordinates and reactions together.
fn polished(point: &OperatingPoint<'_>, found: Found) -> Result<Found, Failure> {
    let independent = point.without_redundant(&found.coordinates);
    let last = newton::nearest::<search_space::Unconstrained>(&independent, &found.coordinates)?;
    Ok(Found {
        iterations: found.iterations + last.iterations,
        left_unstable_region: found.left_unstable_region,
        ..last
    })
}

/// The equilibrium nearest to `start` if it is a saddle held by gyroscopic forces; descent would leave it.
fn gyroscopically_stabilised(point: &OperatingPoint<'_>, start: &[f64]) -> Option<Judged> {
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
    let found = nearest(point, start).ok()?;
    let judged = finish(point, found).ok()?;
    let stability = judged.state.stability;
    matches!(stability, Stability::GyroscopicallyStabilised { .. }).then_some(judged)
}

fn finish(point: &OperatingPoint<'_>, mut found: Found) -> Result<Judged, Failure> {
    let Measured {
        linear,
        relative_residual: relative,
    } = match found.measured.take() {
        Some(measured) => measured,
        None => measure(point, &mut found)?,
    };
    if relative.is_nan() || relative > ACCEPTED {
        return Err(Failure::NotFound {
            reason: NotFound::Inaccurate,
            coordinates: found.coordinates.into(),
            iterations: found.iterations,
            relative,
        });
    }
    let constraints = constraint_state(point, &found.coordinates, &found.residual, &linear)?;
    let mut state = Equilibrium {
        coordinates: found.coordinates,
        inputs: point.inputs.into(),
        design: point.design.into(),
        stability: Stability::Undecided,
        rounding: 0.0,
        linear,
        residual: found.residual,
        relative_residual: relative,
        iterations: found.iterations,
        pose: None,
        constraints,
        free: FreeDirections::default(),
        left_unstable_region: found.left_unstable_region,
        description: point.description.clone(),
    };
    let modes = judge(point, &mut state)?;
    Ok(Judged { state, modes })
}

/// Judges a solved state: its stability, and how far joints are from singular poses. Returns [`Judged::modes`].
fn judge(point: &OperatingPoint<'_>, state: &mut Equilibrium) -> Result<Vec<Mode>, Failure> {
    state.free = FreeDirections::of(&state.linear.stiffness, point.free());
    let verdict = if state.constraints.singular {
        Verdict::undecided()
    } else if at_rest_by_stiffness(point) && stability::clearly_stable(&state.linear) {
        Verdict::without_modes(Stability::Stable, 0.0)
    } else {
        let place = CheckedState {
            coordinates: &state.coordinates,
            inputs: point.inputs,
            design: point.design,
            residual: &state.residual,
        };
        stability::judge(point.mechanism, &place, &state.linear, point.nearby)?
    };
    state.pose = point
        .mechanism
        .pose_margin(&state.coordinates, point.inputs, point.design);
    (state.stability, state.rounding) = (verdict.stability, verdict.rounding);
    Ok(verdict.modes)
}

/// Determines the reactions of a state, and measures the state.
fn measure(point: &OperatingPoint<'_>, found: &mut Found) -> Result<Measured, Failure> {
    let mut linear = point.linear(&found.coordinates)?;
    if point.structure.constraints() > 1 {
        if let Some(least) = least_reactions(&found.coordinates, &linear, point.structure) {
            linear = point.linear(&least)?;
            found.coordinates = least;
        }
        // Includes the gaps of constraints that were left out.
        found.residual = point.residual(&found.coordinates);
    }
    let (q, residual) = (&found.coordinates, &found.residual);
    Ok(Measured {
        relative_residual: relative_residual(point, q, residual, &linear.stiffness),
        linear,
    })
}

/// Whether positive masses and stiffnesses alone make a state stable.
fn at_rest_by_stiffness(point: &OperatingPoint<'_>) -> bool {
    let undamped = point.description.damping == DampingKind::Zero;
    undamped && point.description.symmetric_stiffness && point.structure.open()
}

/// The state with the smallest reactions among those that redundant constraints allow; `None` if the reactions are
/// determined.
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
