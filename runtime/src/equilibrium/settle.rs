//! From a start value to an equilibrium that is finished: solved to rounding, judged, its reactions determined.

use super::convergence::{ACCEPTED, relative_residual};
use super::descent;
use super::end::{Found, Measured};
use super::prediction::confirmed;
use super::problem::{Failure, Problem};
use super::regularity::{constraint_state, unbalanced};
use super::{Equilibrium, Policy, assembly, newton, quick, space, stability};
use crate::array::{Cholesky, add_scaled, dot};
use crate::constraints::{Structure, Tangent, all_rows, placed};
use crate::rounding::Place;
use crate::{DampingKind, Description, Linear, Mechanism, Stability};

/// As [`equilibrium`], for values already checked; a failure owns nothing.
pub(crate) fn settle<M, const N: usize, const U: usize, const P: usize, const O: usize>(
    problem: &Problem<'_, M, N, U, P, O>,
    start: &[f64; N],
    policy: Policy,
) -> Result<Equilibrium<N, U, P>, Failure<N>>
where
    M: Mechanism<N, U, P, O>,
{
    let structure = const { Structure::of(&M::DESCRIPTION) };
    let closed;
    let start = if structure.open() {
        start
    } else {
        closed = assembly::closed(problem, start, &[false; N])?.0;
        &closed
    };
    let potential = M::DESCRIPTION.symmetric_stiffness && structure.holonomic();
    if policy == Policy::Nearest || !potential {
        return nearest(problem, start).and_then(|found| finish(problem, found));
    }
    if const { Structure::of(&M::DESCRIPTION).open() } {
        return match quick::quick(problem, start) {
            Ok(found) => finish(problem, found),
            Err(place) => from_afar(problem, start, &place),
        };
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
fn departed<M, const N: usize, const U: usize, const P: usize, const O: usize>(
    problem: &Problem<'_, M, N, U, P, O>,
    from: &[f64; N],
    downhill: &[f64; N],
) -> Result<[f64; N], Failure<N>>
where
    M: Mechanism<N, U, P, O>,
{
    let beside = add_scaled(from, descent::DEPARTURE, downhill);
    assembly::closed(problem, &beside, &[false; N]).map(|(start, _)| start)
}

/// The stable equilibrium next to a predicted state, `last` the one before it; `None` unless a straight way leads there and
/// it is what was predicted. For mechanisms with a potential and without constraints.
pub(super) fn settle_from_prediction<
    M,
    const N: usize,
    const U: usize,
    const P: usize,
    const O: usize,
>(
    problem: &Problem<'_, M, N, U, P, O>,
    last: &[f64; N],
    predicted: &[f64; N],
) -> Option<Equilibrium<N, U, P>>
where
    M: Mechanism<N, U, P, O>,
{
    if const { !(M::DESCRIPTION.symmetric_stiffness && Structure::of(&M::DESCRIPTION).open()) } {
        return None;
    }
    let found = quick::quick(problem, predicted).ok()?;
    if !confirmed(&found.coordinates, predicted, last) {
        return None;
    }
    finish(problem, found).ok()
}

/// As [`settle`], for a stable equilibrium to which no straight way leads; the search goes on at `place`.
#[cold]
fn from_afar<M, const N: usize, const U: usize, const P: usize, const O: usize>(
    problem: &Problem<'_, M, N, U, P, O>,
    start: &[f64; N],
    place: &descent::Place<N>,
) -> Result<Equilibrium<N, U, P>, Failure<N>>
where
    M: Mechanism<N, U, P, O>,
{
    let structure = const { Structure::of(&M::DESCRIPTION) };
    if let Some(state) = held(problem, start) {
        return Ok(state);
    }
    let found = if structure.open() {
        descent::stable::<space::Whole, _, N, U, P, O>(problem, start, place)
    } else {
        descent::stable::<space::Constrained<N>, _, N, U, P, O>(problem, start, place)
            .and_then(|found| polished(problem, found))
    };
    found
        .or_else(|failure| match failure {
            Failure::SingularMass(_) | Failure::Mode { .. } => Err(failure),
            _ => nearest(problem, start).map_err(|_| failure),
        })
        .and_then(|found| finish(problem, found))
        .map_err(|failure| match failure {
            Failure::NotFound { coordinates, .. } if !structure.open() => {
                unbalanced(problem, &coordinates).unwrap_or(failure)
            }
            _ => failure,
        })
}

/// The equilibrium nearest to `start`, which meets the constraints: along the positions that do where these are all there is
/// to it, else on all unknowns together.
fn nearest<M, const N: usize, const U: usize, const P: usize, const O: usize>(
    problem: &Problem<'_, M, N, U, P, O>,
    start: &[f64; N],
) -> Result<Found<N>, Failure<N>>
where
    M: Mechanism<N, U, P, O>,
{
    let structure = const { Structure::of(&M::DESCRIPTION) };
    let whole = || {
        let independent = problem.without_redundant(start);
        newton::nearest::<space::Whole, _, N, U, P, O>(&independent, start)
    };
    if structure.open() || !structure.holonomic() {
        return whole();
    }
    newton::nearest::<space::Constrained<N>, _, N, U, P, O>(problem, start)
        .and_then(|found| polished(problem, found))
        .or_else(|failure| whole().map_err(|_| failure))
}

/// The last steps on coordinates and reactions together.
fn polished<M, const N: usize, const U: usize, const P: usize, const O: usize>(
    problem: &Problem<'_, M, N, U, P, O>,
    found: Found<N>,
) -> Result<Found<N>, Failure<N>>
where
    M: Mechanism<N, U, P, O>,
{
    let independent = problem.without_redundant(&found.coordinates);
    let last = newton::nearest::<space::Whole, _, N, U, P, O>(&independent, &found.coordinates)?;
    Ok(Found {
        iterations: found.iterations + last.iterations,
        left_unstable_region: found.left_unstable_region,
        ..last
    })
}

/// The equilibrium nearest to `start` if that is a saddle which gyroscopic forces hold; descent would leave it.
fn held<M, const N: usize, const U: usize, const P: usize, const O: usize>(
    problem: &Problem<'_, M, N, U, P, O>,
    start: &[f64; N],
) -> Option<Equilibrium<N, U, P>>
where
    M: Mechanism<N, U, P, O>,
{
    if M::DESCRIPTION.damping == DampingKind::Zero {
        return None;
    }
    let structure = const { Structure::of(&M::DESCRIPTION) };
    let stiffness = if structure.open() {
        problem.evaluate(start)?.1
    } else {
        let linear = problem.linear(start).ok()?;
        Tangent::new(&linear, structure).reduce_stiffness(&linear.stiffness)
    };
    if Cholesky::new(&stiffness).is_ok() {
        return None;
    }
    let found = nearest(problem, start).ok()?;
    let state = finish(problem, found).ok()?;
    matches!(state.stability, Stability::GyroscopicallyStabilised { .. }).then_some(state)
}

fn finish<M, const N: usize, const U: usize, const P: usize, const O: usize>(
    problem: &Problem<'_, M, N, U, P, O>,
    mut found: Found<N>,
) -> Result<Equilibrium<N, U, P>, Failure<N>>
where
    M: Mechanism<N, U, P, O>,
{
    let Measured {
        linear,
        relative_residual: relative,
    } = match found.measured.take() {
        Some(measured) => measured,
        None => measure(problem, &mut found)?,
    };
    if relative.is_nan() || relative > ACCEPTED {
        return Err(Failure::NotFound {
            reason: "the residual stays larger than rounding explains",
            coordinates: found.coordinates,
            iterations: found.iterations,
            relative,
        });
    }
    let constraints = constraint_state(problem, &found.coordinates, &found.residual, &linear)?;
    let (stability, rounding) = if constraints.singular {
        (Stability::Undecided, 0.0)
    } else if const { at_rest_by_stiffness(&M::DESCRIPTION) }
        && Cholesky::new(&linear.mass).is_ok()
        && stability::clearly_definite(&linear)
    {
        (Stability::Stable, 0.0)
    } else {
        let place = Place {
            coordinates: &found.coordinates,
            inputs: problem.inputs,
            design: problem.design,
            residual: &found.residual,
        };
        stability::judge(problem.mechanism, &place, &linear)?
    };
    Ok(Equilibrium {
        coordinates: found.coordinates,
        inputs: *problem.inputs,
        design: *problem.design,
        stability,
        rounding,
        linear,
        constraints,
        residual: found.residual,
        relative_residual: relative,
        pose: problem
            .mechanism
            .pose_margin(&found.coordinates, problem.inputs, problem.design),
        iterations: found.iterations,
        left_unstable_region: found.left_unstable_region,
        description: problem.description(),
    })
}

/// Determines the reactions of a state and measures it.
fn measure<M, const N: usize, const U: usize, const P: usize, const O: usize>(
    problem: &Problem<'_, M, N, U, P, O>,
    found: &mut Found<N>,
) -> Result<Measured<N>, Failure<N>>
where
    M: Mechanism<N, U, P, O>,
{
    let mut linear = problem.linear(&found.coordinates)?;
    if const { Structure::of(&M::DESCRIPTION).constraints() > 1 } {
        if let Some(least) = least_reactions(&found.coordinates, &linear, M::DESCRIPTION) {
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
const fn at_rest_by_stiffness(description: &Description) -> bool {
    let undamped = matches!(description.damping, DampingKind::Zero);
    undamped && description.symmetric_stiffness && Structure::of(description).open()
}

/// The state with the least of the reactions that redundant constraints leave undetermined; `None` where they leave nothing.
fn least_reactions<const N: usize>(
    x: &[f64; N],
    linear: &Linear<f64, N>,
    description: Description,
) -> Option<[f64; N]> {
    let structure = Structure::of(&description);
    let rows = all_rows(&linear.stiffness, structure);
    let mut least = *x;
    for k in 0..rows.dependent() {
        let along = placed(structure, &rows.null_left(k));
        let amount = dot(x, &placed(structure, &rows.null_left_scaled(k)));
        least = add_scaled(&least, -amount, &along);
    }
    (rows.dependent() > 0).then_some(least)
}
