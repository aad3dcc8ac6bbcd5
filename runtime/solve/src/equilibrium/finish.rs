//! From a solution to a finished state: reactions determined, measured, stability judged.

use super::Needed;
use super::acceptance::{Candidate, Measured, UnjudgedResult};
use super::convergence::{ACCEPTED, relative_residual};
use super::operating_point::{Failure, OperatingPoint};
use super::regularity::constraint_state;
use super::stability::{self, Verdict};
use crate::algebra::{Vector, add_to, dot};
use crate::constraints::{Structure, all_rows, placed};
use crate::error::NotFound;
use crate::free::FreeDirections;
use crate::kernels::Linear;
use crate::modes::judge_shafts;
use crate::rounding::CheckedState;
use crate::{DampingKind, Equilibrium, Mode, Stability};

/// A finished state.
#[doc(hidden)]
pub struct SolvedState {
    #[doc(hidden)]
    pub state: Equilibrium,
    /// Its general modes if they were needed to judge its stability; empty otherwise.
    #[doc(hidden)]
    pub modes: Vec<Mode>,
}

/// The finished state at these coordinates and reactions.
pub(super) fn finished(point: &OperatingPoint<'_>, q: Vector) -> Result<SolvedState, Failure> {
    finish(point, UnjudgedResult::new(Candidate::at(point, q), 0))
}

pub(super) fn finish(point: &OperatingPoint<'_>, mut unjudged: UnjudgedResult) -> Result<SolvedState, Failure> {
    let Measured { linear, relative_residual: relative } = match unjudged.measured.take() {
        Some(measured) => measured,
        None => measure(point, &mut unjudged)?,
    };
    if relative.is_nan() || relative > ACCEPTED {
        return Err(Failure::NotFound {
            reason: NotFound::Inaccurate,
            coordinates: unjudged.coordinates.into(),
            iterations: unjudged.iterations,
            relative,
        });
    }
    let constraints = constraint_state(point, &unjudged.coordinates, &unjudged.residual, &linear)?;
    let mut state = Equilibrium {
        coordinates: unjudged.coordinates,
        inputs: point.inputs.into(),
        design: point.design.into(),
        stability: Stability::Undecided,
        rounding: 0.0,
        free: FreeDirections::of(&linear.stiffness, point.free()),
        spans: Vector::default(),
        linear,
        residual: unjudged.residual,
        relative_residual: relative,
        iterations: unjudged.iterations,
        pose: None,
        constraints,
        left_unstable_region: unjudged.left_unstable_region,
        kept: false,
        notes: Vec::new(),
        description: point.description.clone(),
    };
    let modes = judge(point, &mut state)?;
    Ok(SolvedState { state, modes })
}

/// Judges a solved state: its stability, and how far joints are from singular poses. Returns [`SolvedState::modes`].
pub(crate) fn judge(point: &OperatingPoint<'_>, state: &mut Equilibrium) -> Result<Vec<Mode>, Failure> {
    state.pose = point.mechanism.pose_margin(&state.coordinates, point.inputs, point.design);
    if let Some(pose) = state.pose.take_if(|pose| pose.margin < pose.least) {
        return Err(Failure::BentTooFar(pose));
    }
    if !state.description.spans.is_empty()
        && let Some((stability, modes)) =
            judge_shafts(point.mechanism, state, point.nearby, point.needed != Needed::State)
    {
        state.stability = stability;
        return Ok(modes);
    }
    let verdict = if state.constraints.singular {
        Verdict::undecided()
    } else if at_rest_by_stiffness(point) && stability::clearly_stable(&state.linear) {
        Verdict::without_modes(Stability::Stable, 0.0)
    } else if point.needed == Needed::State {
        Verdict::undecided()
    } else {
        let checked_state = CheckedState {
            coordinates: &state.coordinates,
            inputs: point.inputs,
            design: point.design,
            residual: &state.residual,
        };
        let nearby = (point.needed == Needed::Modes).then_some(point.nearby);
        stability::judge(point.mechanism, &checked_state, &state.linear, nearby)?
    };
    (state.stability, state.rounding) = (verdict.stability, verdict.rounding);
    Ok(verdict.modes)
}

/// Determines the reactions of a state, and measures the state.
fn measure(point: &OperatingPoint<'_>, unjudged: &mut UnjudgedResult) -> Result<Measured, Failure> {
    let mut linear = point.linear(&unjudged.coordinates)?;
    if point.structure.constraints() > 1 {
        if let Some(least) = least_reactions(&unjudged.coordinates, &linear, point.structure) {
            linear = point.linear(&least)?;
            unjudged.coordinates = least;
        }
        // Includes the gaps of constraints that were left out.
        unjudged.residual = point.residual(&unjudged.coordinates);
    }
    let (q, residual) = (&unjudged.coordinates, &unjudged.residual);
    Ok(Measured { relative_residual: relative_residual(point, q, residual, &linear.stiffness), linear })
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
