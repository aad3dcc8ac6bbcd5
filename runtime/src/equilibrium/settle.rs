//! From a start value to an equilibrium that is finished: solved to rounding, judged, its reactions determined.

use super::convergence::{
    ACCEPTED, TOLERANCE, is_rounding, relative_residual, relative_to, settled,
};
use super::descent::Place;
use super::prediction::confirmed;
use super::problem::{Failure, Problem};
use super::{Equilibrium, Policy, assembly, descent, newton, quick, space, stability};
use crate::array::{Cholesky, Square, add_scaled, all_finite, dot, largest};
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
    if const { Structure::of(&M::DESCRIPTION).open() } {
        return match quick::quick(problem, start) {
            Ok(found) => finish(problem, found),
            Err(place) => from_afar(problem, start, &place),
        };
    }
    from_afar(problem, start, &Place::first(start))
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
    place: &Place<N>,
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
    /// Where it is known.
    pub(crate) measured: Option<Measured<N>>,
    pub(crate) iterations: usize,
    pub(crate) left_unstable_region: bool,
}

/// What is asked of a state that may be the result.
pub(crate) struct Measured<const N: usize> {
    linear: Linear<f64, N>,
    /// Infinite unless all is finite.
    relative_residual: f64,
}

/// A state that may be the result.
pub(super) struct End<const N: usize> {
    pub(super) coordinates: [f64; N],
    pub(super) residual: [f64; N],
    /// Without constraints.
    pub(super) measured: Option<Measured<N>>,
}

impl<const N: usize> End<N> {
    /// The state at `q`. Without constraints the parts of the residual, with which a result is measured, are the residual as well.
    #[inline]
    pub(super) fn at<M, const U: usize, const P: usize, const O: usize>(
        problem: &Problem<'_, M, N, U, P, O>,
        q: &[f64; N],
    ) -> Self
    where
        M: Mechanism<N, U, P, O>,
    {
        if const { !Structure::of(&M::DESCRIPTION).open() } {
            return Self {
                coordinates: *q,
                residual: problem.residual(q),
                measured: None,
            };
        }
        let (parts, linear) = problem.parts_and_linear(q);
        let residual = add_scaled(&parts.inertia, -1.0, &parts.applied);
        let finite = all_finite(&residual) && problem.check(q, &linear).is_ok();
        let relative_residual = if finite {
            relative_to(problem, &parts, q, &residual, &linear.stiffness)
        } else {
            f64::INFINITY
        };
        Self {
            coordinates: *q,
            residual,
            measured: Some(Measured {
                linear,
                relative_residual,
            }),
        }
    }

    /// Whether the relative residual is finite and within `tolerance`; `stiffness` is near to that of the state.
    #[inline]
    pub(super) fn is_solved<M, const U: usize, const P: usize, const O: usize>(
        &self,
        problem: &Problem<'_, M, N, U, P, O>,
        stiffness: &Square<N>,
        tolerance: f64,
    ) -> bool
    where
        M: Mechanism<N, U, P, O>,
    {
        match &self.measured {
            Some(measured) => measured.relative_residual <= tolerance,
            None => {
                let (q, residual) = (&self.coordinates, &self.residual);
                all_finite(residual) && settled(problem, q, residual, stiffness, tolerance)
            }
        }
    }
}

/// The last Newton step; the stiffness is not needed again, only that the residual fell to rounding: to a small share, or to
/// what `displacement`, from a residual to the Newton step it asks for, says is nothing.
#[inline]
pub(super) fn last_step<M, const N: usize, const U: usize, const P: usize, const O: usize>(
    problem: &Problem<'_, M, N, U, P, O>,
    q: &[f64; N],
    (residual, stiffness): (&[f64; N], &Square<N>),
    step: &[f64; N],
    displacement: impl FnOnce(&[f64; N]) -> [f64; N],
) -> Option<End<N>>
where
    M: Mechanism<N, U, P, O>,
{
    let motions = Problem::<M, N, U, P, O>::MOTIONS;
    let end = End::at(problem, &add_scaled(q, 1.0, step));
    let fell = largest(&end.residual) <= 1e-3 * largest(residual)
        || is_rounding(&displacement(&end.residual), &end.coordinates, motions);
    (fell && end.is_solved(problem, stiffness, TOLERANCE)).then_some(end)
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
    let place = (&found.coordinates, problem.inputs, problem.design);
    let constraints = ConstraintState::new(problem.mechanism, place, &linear);
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
    } else if const { at_rest_by_stiffness(&M::DESCRIPTION) }
        && Cholesky::new(&linear.mass).is_ok()
        && Cholesky::new(&linear.stiffness).is_ok()
    {
        Stability::Stable
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
