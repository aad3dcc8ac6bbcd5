//! Following an equilibrium from value to value of an input: side by side in the vectors of the processor where the way is
//! smooth, one by one elsewhere.

use super::SweepPoint;
use super::track::{Tracked, Tracker, even};
use crate::batched::Block;
use crate::lanes::WIDTH;
use crate::sensitivity::{Method, sensitivities};
use crate::{Error, Mechanism, Sensitivities};

/// What is known at one value.
pub(crate) struct Station<const N: usize, const U: usize, const P: usize> {
    pub(crate) point: SweepPoint<N, U, P>,
    /// Derivatives of the modes, if they are wanted.
    pub(crate) slopes: Option<Result<Sensitivities<N, U, P>, Error>>,
    /// No critical state lies between it and the value before.
    pub(crate) smooth: bool,
}

/// Goes on to each of `values`; `each` sees what is there, in order. With `SLOPES`, modes have derivatives: known when a user's
/// code is compiled, so that who does not ask for them does not compile them.
pub(crate) fn follow<
    const SLOPES: bool,
    M,
    const N: usize,
    const U: usize,
    const P: usize,
    const O: usize,
>(
    tracker: &mut Tracker<'_, M, N, U, P>,
    values: &[f64],
    mut each: impl FnMut(&Station<N, U, P>),
) where
    M: Mechanism<N, U, P, O>,
{
    let (mut block, mut rest) = (None, values);
    // Values to be solved one by one before a block is tried again; three tell a way.
    let mut alone = 3;
    while let Some((&value, behind)) = rest.split_first() {
        if const { Block::<N, U, P>::possible::<M, O>() } && alone == 0 && !behind.is_empty() {
            let block = block.get_or_insert_with(|| tracker.block());
            let number = tracker.ahead::<SLOPES, O>(block, rest);
            if let (Some(last), true) = (&tracker.last, number > 0) {
                let mut station = Station::shared(last, SLOPES);
                for lane in 0..number {
                    station.go(tracker, block, lane);
                    each(&station);
                }
                tracker.arrive(&station.point, block, number);
            }
            rest = &rest[number..];
            // Where the way bends too much for a whole block, so it does a little farther on.
            alone = WIDTH - number;
            continue;
        }
        alone = alone.saturating_sub(1);
        each(&solve::<SLOPES, M, N, U, P, O>(tracker, value));
        rest = behind;
    }
}

/// One value alone.
fn solve<const SLOPES: bool, M, const N: usize, const U: usize, const P: usize, const O: usize>(
    tracker: &mut Tracker<'_, M, N, U, P>,
    value: f64,
) -> Station<N, U, P>
where
    M: Mechanism<N, U, P, O>,
{
    let (equilibrium, modes) = match tracker.advance(value) {
        Ok((state, modes)) => (Ok(state), modes),
        Err(error) => (Err(error.clone()), Err(error)),
    };
    let slopes = if const { SLOPES } {
        Some(match (&equilibrium, &modes) {
            (Ok(state), Ok(modes)) => sensitivities(tracker.mechanism, state, modes),
            (_, Err(error)) | (Err(error), _) => Err(error.clone()),
        })
    } else {
        None
    };
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

impl<const N: usize, const U: usize, const P: usize> Station<N, U, P> {
    /// What states side by side share with the one before them.
    fn shared(last: &Tracked<N, U, P>, slopes: bool) -> Self {
        Self {
            point: SweepPoint {
                value: last.value,
                equilibrium: Ok(last.equilibrium),
                modes: Ok(last.modes),
            },
            slopes: slopes.then(|| Ok(Sensitivities::blank(&last.modes, Method::Adjoint))),
            smooth: true,
        }
    }

    /// Goes on to a lane of a block.
    fn go<M, const O: usize>(
        &mut self,
        tracker: &Tracker<'_, M, N, U, P>,
        block: &Block<N, U, P>,
        lane: usize,
    ) where
        M: Mechanism<N, U, P, O>,
    {
        let SweepPoint {
            value,
            equilibrium,
            modes,
        } = &mut self.point;
        *value = block.values.0[lane];
        if let (Ok(state), Ok(modes)) = (equilibrium, modes) {
            state.inputs = tracker.inputs_at(*value);
            block.read_state(lane, tracker.mechanism, state);
            let before = modes.least_lambda();
            block.read_modes(lane, modes);
            self.smooth = even(before, modes.least_lambda());
            if let Some(Ok(slopes)) = &mut self.slopes {
                block.read_slopes(lane, modes, slopes);
            }
        }
    }
}
