//! From a start value to an equilibrium that is finished: solved to rounding, judged, its reactions determined.

use super::convergence::{ACCEPTED, TOLERANCE, relative_residual, settled};
use super::problem::{Failure, Problem};
use super::{Equilibrium, Policy, assembly, descent, newton, space, stability};
use crate::array::{Cholesky, add_scaled, all_finite, dot, largest};
use crate::constraints::{ConstraintState, Structure, Tangent, all_rows, placed};
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
    if let Some(state) = held(problem, start) {
        return Ok(state);
    }
    let found = if structure.open() {
        descent::stable::<space::Whole, _, N, U, P, O>(problem, start)
    } else {
        descent::stable::<space::Constrained<N>, _, N, U, P, O>(problem, start)
            .and_then(|found| polished(problem, found))
    };
    found
        .or_else(|failure| match failure {
            Failure::SingularMass(_) | Failure::Mode { .. } => Err(failure),
            _ => nearest(problem, start).map_err(|_| failure),
        })
        .and_then(|found| finish(problem, found))
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

/// What a solver found, before its stability is judged.
pub(crate) struct Found<const N: usize> {
    pub(crate) coordinates: [f64; N],
    pub(crate) residual: [f64; N],
    pub(crate) iterations: usize,
    pub(crate) left_unstable_region: bool,
}

/// The last Newton step; the stiffness is not needed again, only that the residual fell to rounding.
pub(super) fn last_step<M, const N: usize, const U: usize, const P: usize, const O: usize>(
    problem: &Problem<'_, M, N, U, P, O>,
    q: &[f64; N],
    (residual, stiffness): (&[f64; N], &[[f64; N]; N]),
    step: &[f64; N],
) -> Option<([f64; N], [f64; N])>
where
    M: Mechanism<N, U, P, O>,
{
    let end = add_scaled(q, 1.0, step);
    let rest = problem.residual(&end);
    let reached = all_finite(&rest)
        && largest(&rest) <= 1e-3 * largest(residual)
        && settled(problem, &end, &rest, stiffness, TOLERANCE);
    reached.then_some((end, rest))
}

fn finish<M, const N: usize, const U: usize, const P: usize, const O: usize>(
    problem: &Problem<'_, M, N, U, P, O>,
    mut found: Found<N>,
) -> Result<Equilibrium<N, U, P>, Failure<N>>
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
    let at = (&found.coordinates, problem.inputs, problem.design);
    let constraints = ConstraintState::new(problem.mechanism, at, &linear);
    let relative = relative_residual(
        problem,
        &found.coordinates,
        &found.residual,
        &linear.stiffness,
    );
    if relative.is_nan() || relative > ACCEPTED {
        return Err(Failure::NotFound {
            reason: "the residual stays larger than rounding explains",
            coordinates: found.coordinates,
            iterations: found.iterations,
            relative,
        });
    }
    let stability = if constraints.singular {
        Stability::Undecided
    } else {
        stability::judge(problem.description(), &linear)?
    };
    Ok(Equilibrium {
        coordinates: found.coordinates,
        inputs: *problem.inputs,
        design: *problem.design,
        stability,
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
