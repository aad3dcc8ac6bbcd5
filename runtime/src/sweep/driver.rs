//! Following an equilibrium from value to value of an input: side by side in the vectors of the processor where the way is
//! smooth, one by one elsewhere.

use core::ops::ControlFlow;

use super::points::SweepPoint;
use super::track::{Tracker, even};
use crate::batched::Block;
use crate::kernels::BatchKernels;
use crate::scalar::WIDTH;
use crate::sensitivity::{Adjoint, Method};
use crate::{Error, Sensitivities};

/// What is known at one value.
pub(crate) struct Station<'a> {
    pub(crate) point: &'a SweepPoint,
    /// Derivatives of the modes, if they are wanted.
    pub(crate) slopes: Option<&'a Result<Sensitivities, Error>>,
    /// No critical state lies between it and the value before.
    pub(crate) smooth: bool,
}

/// Goes on to each of `values` until `each` breaks off; it sees what is there, in order, with derivatives of the modes if they are
/// wanted.
pub(crate) fn follow(
    tracker: &mut Tracker<'_>,
    kernels: &dyn BatchKernels,
    values: &[f64],
    with_slopes: bool,
    mut each: impl FnMut(Station<'_>) -> ControlFlow<()>,
) {
    let mut rest = values;
    let mut memory = Vec::new();
    let mut workspace =
        (tracker.side_by_side()).then(|| tracker.workspace(&mut memory, with_slopes));
    let mut adjoint = with_slopes.then(|| Adjoint::new(tracker.mechanism, tracker.family()));
    let mut slopes = None;
    // Values to be solved one by one before a block is tried again; three tell a way.
    let mut alone = 3;
    while let Some((&value, behind)) = rest.split_first() {
        if let Some(workspace) = &mut workspace
            && alone == 0
            && !behind.is_empty()
        {
            let number = tracker.solve_block(kernels, workspace, rest);
            let block = &workspace.block;
            if show(tracker, block, number, slopes.as_mut(), &mut each).is_break() {
                return;
            }
            tracker.commit(block, number);
            rest = &rest[number..];
            // Where the way bends too much for a whole block, so it does a little farther on.
            alone = WIDTH - number;
            continue;
        }
        alone = alone.saturating_sub(1);
        let failed = tracker.advance(value);
        if let Some(point) = failed.as_ref().or(tracker.last.as_deref()) {
            if let Some(adjoint) = &mut adjoint {
                slopes = Some(slopes_at(point, adjoint, slopes.take()));
            }
            let shown = each(Station {
                point,
                slopes: slopes.as_ref(),
                smooth: tracker.smooth && failed.is_none(),
            });
            if shown.is_break() {
                return;
            }
        }
        rest = behind;
    }
}

/// The derivatives at a point, written over those at another where there are any.
fn slopes_at(
    point: &SweepPoint,
    adjoint: &mut Adjoint<'_>,
    over: Option<Result<Sensitivities, Error>>,
) -> Result<Sensitivities, Error> {
    let (state, modes) = point.solved().map_err(Error::clone)?;
    let blank = || Sensitivities::blank(state, modes, Method::Adjoint);
    let mut slopes = over.and_then(Result::ok).unwrap_or_else(blank);
    adjoint.sensitivities_into(state, modes, &mut slopes)?;
    Ok(slopes)
}

/// The first states of a block, each written over the one before.
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
    let mut before = None;
    for lane in 0..number {
        let Ok((state, modes)) = point.solved_mut() else {
            return ControlFlow::Continue(());
        };
        let value = block.values.0[lane];
        state.inputs[input] = value;
        modes.inputs[input] = value;
        let last = before.unwrap_or_else(|| modes.least_lambda());
        block.read_state(lane, mechanism, state);
        block.read_modes(lane, modes);
        let least = modes.least_lambda();
        before = Some(least);
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
        each(Station {
            point,
            slopes: slopes.as_deref(),
            smooth: even(last, least),
        })?;
    }
    ControlFlow::Continue(())
}
