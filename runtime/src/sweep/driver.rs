//! Following an equilibrium from value to value of an input: side by side in the vectors of the processor where the way is
//! smooth, one by one elsewhere.

use super::points::SweepPoint;
use super::track::{Tracked, Tracker, even};
use crate::batched::Block;
use crate::kernels::BatchKernels;
use crate::scalar::WIDTH;
use crate::sensitivity::{Method, sensitivities};
use crate::{Error, Sensitivities};

/// What is known at one value.
pub(crate) struct Station {
    pub(crate) point: SweepPoint,
    /// Derivatives of the modes, if they are wanted.
    pub(crate) slopes: Option<Result<Sensitivities, Error>>,
    /// No critical state lies between it and the value before.
    pub(crate) smooth: bool,
}

/// Goes on to each of `values`; `each` sees what is there, in order, with derivatives of the modes if they are wanted.
pub(crate) fn follow(
    tracker: &mut Tracker<'_>,
    kernels: &dyn BatchKernels,
    values: &[f64],
    with_slopes: bool,
    mut each: impl FnMut(&Station),
) {
    let mut rest = values;
    let mut memory = Vec::new();
    let mut workspace =
        (tracker.side_by_side()).then(|| tracker.workspace(&mut memory, with_slopes));
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
            if number > 0
                && let Some(last) = tracker.last.take()
            {
                let blank = || {
                    Ok(Sensitivities::blank(
                        &last.equilibrium,
                        &last.modes,
                        Method::Adjoint,
                    ))
                };
                let slopes_here = slopes.take().or_else(|| with_slopes.then(blank));
                let mut station = Station::at(last, slopes_here);
                for lane in 0..number {
                    station.go(tracker, block, lane);
                    each(&station);
                }
                slopes = station.slopes;
                tracker.commit(station.point, block, number);
            }
            rest = &rest[number..];
            // Where the way bends too much for a whole block, so it does a little farther on.
            alone = WIDTH - number;
            continue;
        }
        alone = alone.saturating_sub(1);
        let station = solve(tracker, value, with_slopes);
        each(&station);
        tracker.put_back(station.point);
        rest = behind;
    }
}

/// One value alone.
fn solve(tracker: &mut Tracker<'_>, value: f64, with_slopes: bool) -> Station {
    let (equilibrium, modes) = match tracker.go(value) {
        Ok(Ok(last)) => (Ok(last.equilibrium), Ok(last.modes)),
        Ok(Err((state, error))) => (Ok(*state), Err(error)),
        Err(error) => (Err(error.clone()), Err(error)),
    };
    let slopes = with_slopes.then(|| match (&equilibrium, &modes) {
        (Ok(state), Ok(modes)) => sensitivities(tracker.mechanism, state, modes),
        (_, Err(error)) | (Err(error), _) => Err(error.clone()),
    });
    Station {
        smooth: tracker.smooth && modes.is_ok(),
        point: SweepPoint {
            value,
            equilibrium,
            modes,
        },
        slopes,
    }
}

impl Station {
    /// The last state, over which those that were solved side by side are written.
    fn at(last: Tracked, slopes: Option<Result<Sensitivities, Error>>) -> Self {
        Self {
            point: SweepPoint {
                value: last.value,
                equilibrium: Ok(last.equilibrium),
                modes: Ok(last.modes),
            },
            slopes,
            smooth: true,
        }
    }

    /// Goes on to a lane of a block.
    fn go(&mut self, tracker: &Tracker<'_>, block: &Block<'_>, lane: usize) {
        let SweepPoint {
            value,
            equilibrium,
            modes,
        } = &mut self.point;
        *value = block.values.0[lane];
        if let (Ok(state), Ok(modes)) = (equilibrium, modes) {
            let input = tracker.input.index();
            state.inputs[input] = *value;
            modes.inputs[input] = *value;
            block.read_state(lane, tracker.mechanism, state);
            let before = modes.least_lambda();
            block.read_modes(lane, modes);
            self.smooth = even(before, modes.least_lambda());
            if let Some(Ok(slopes)) = &mut self.slopes {
                slopes.inputs[input] = *value;
                block.read_slopes(lane, modes, slopes);
            }
        }
    }
}
