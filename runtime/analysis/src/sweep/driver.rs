//! Follows an equilibrium through successive values of an input: in vectorised blocks where the path is smooth, one
//! value at a time elsewhere.

use core::ops::ControlFlow;

use super::points::SweepPoint;
use super::track::Tracker;
use crate::batched::Block;
use crate::kernels::BatchKernels;
use crate::scalar::WIDTH;
use crate::sensitivity::{Adjoint, Method};
use crate::{Error, Sensitivities};

/// The results at one value.
pub(crate) struct Station<'a> {
    pub(crate) point: &'a SweepPoint,
    /// Derivatives of the modes, if requested.
    pub(crate) slopes: Option<&'a Result<Sensitivities, Error>>,
}

/// Advances through `values` until `each` breaks off. `each` receives the results in order, with derivatives of the
/// modes if requested.
pub(crate) fn follow(
    tracker: &mut Tracker<'_>,
    kernels: &dyn BatchKernels,
    values: &[f64],
    with_slopes: bool,
    mut each: impl FnMut(Station<'_>) -> ControlFlow<()>,
) {
    let mut rest = values;
    let mut memory = Vec::new();
    let mut workspace = (tracker.side_by_side()).then(|| tracker.workspace(&mut memory, with_slopes));
    let mut adjoint = with_slopes.then(|| Adjoint::new(tracker.mechanism, tracker.family()));
    let mut slopes = None;
    // Number of values to solve one by one before the next block.
    let mut alone = 1;
    while let Some((&value, behind)) = rest.split_first() {
        if let Some(workspace) = &mut workspace
            && alone == 0
            && !behind.is_empty()
            && !tracker.is_unchanged()
        {
            let begins = tracker.begins();
            let number = tracker.solve_block(kernels, workspace, rest);
            let block = &workspace.block;
            if show(tracker, block, number, slopes.as_mut(), &mut each).is_break() {
                return;
            }
            tracker.commit(block, number);
            rest = &rest[number..];
            // Three states define a path. Where it bends too much for a whole block, it will do so a little farther on as
            // well.
            alone = if begins && number == 0 { 2 } else { WIDTH - number };
            continue;
        }
        alone = alone.saturating_sub(1);
        let failed = tracker.advance(value);
        if let Some(point) = failed.as_ref().or(tracker.last.as_deref()) {
            if let Some(adjoint) = &mut adjoint {
                set_slopes(point, adjoint, &mut slopes);
            }
            let shown = each(Station { point, slopes: slopes.as_ref() });
            if shown.is_break() {
                return;
            }
        }
        rest = behind;
    }
}

/// Overwrites derivatives with those at a point.
fn set_slopes(point: &SweepPoint, adjoint: &mut Adjoint<'_>, slopes: &mut Option<Result<Sensitivities, Error>>) {
    let set = point.solved().map_err(Error::clone).and_then(|(state, modes)| {
        if !matches!(slopes, Some(Ok(_))) {
            *slopes = Some(Ok(Sensitivities::blank(state, modes, Method::Adjoint)));
        }
        match slopes {
            Some(Ok(slopes)) => adjoint.sensitivities_into(state, modes, slopes),
            _ => Ok(()),
        }
    });
    if let Err(error) = set {
        *slopes = Some(Err(error));
    }
}

/// Passes the first states of a block to `each`, each overwriting the one before.
fn show(
    tracker: &mut Tracker<'_>,
    block: &Block<'_>,
    number: usize,
    mut slopes: Option<&mut Result<Sensitivities, Error>>,
    each: &mut impl FnMut(Station<'_>) -> ControlFlow<()>,
) -> ControlFlow<()> {
    let (mechanism, input) = (tracker.mechanism, tracker.input.index());
    let Some(point) = &mut tracker.last else {
        return ControlFlow::Continue(());
    };
    for lane in 0..number {
        let Ok((state, modes)) = point.solved_mut() else {
            return ControlFlow::Continue(());
        };
        let value = block.values.0[lane];
        state.inputs[input] = value;
        modes.inputs[input] = value;
        block.read_state(lane, mechanism, state);
        block.read_modes(lane, modes);
        if let Some(slopes) = &mut slopes {
            if slopes.is_err() {
                **slopes = Ok(Sensitivities::blank(state, modes, Method::Adjoint));
            }
            if let Ok(slopes) = slopes {
                slopes.inputs[input] = value;
                block.read_slopes(lane, modes, slopes);
            }
        }
        point.value = value;
        each(Station { point, slopes: slopes.as_deref() })?;
    }
    ControlFlow::Continue(())
}
