//! Following an equilibrium from value to value of an input: side by side in the vectors of the processor where the way is
//! smooth, one by one elsewhere.

use super::SweepPoint;
use super::track::{Tracker, even};
use crate::batched::Block;
use crate::lanes::{Batch, WIDTH};
use crate::modes::{neutral_threshold, undamped_mode};
use crate::sensitivity::sensitivities;
use crate::{Equilibrium, Error, Linear, Mechanism, Modes, Sensitivities, Stability};

/// What is known at one value.
pub(crate) struct Station<const N: usize, const U: usize, const P: usize> {
    pub(crate) point: SweepPoint<N, U, P>,
    /// Derivatives of the modes, if they are wanted.
    pub(crate) slopes: Option<Result<Sensitivities<N, U, P>, Error>>,
    /// No critical state lies between it and the value before.
    pub(crate) smooth: bool,
}

/// Goes on to each of `values`; `each` sees what is there, in order. With `slopes`, modes have derivatives.
pub(crate) fn follow<M, const N: usize, const U: usize, const P: usize, const O: usize>(
    tracker: &mut Tracker<'_, M, N, U, P>,
    values: &[f64],
    slopes: bool,
    mut each: impl FnMut(&Station<N, U, P>),
) where
    M: Mechanism<N, U, P, O>,
{
    let possible = const { Block::<N, U, P>::possible::<M, O>() };
    let mut block = (possible && values.len() > WIDTH).then(|| tracker.block());
    let mut rest = values;
    // Values to be solved one by one before a block is tried again.
    let mut alone = 3;
    while let Some((&value, behind)) = rest.split_first() {
        if let (Some(block), 0) = (&mut block, alone) {
            let number = tracker.ahead(block, rest, slopes);
            if let Some(mut station) = tracker.here(slopes).filter(|_| number > 0) {
                for lane in 0..number {
                    station.read(tracker, block, lane);
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
        each(&solve(tracker, value, slopes));
        rest = behind;
    }
}

/// One value alone.
fn solve<M, const N: usize, const U: usize, const P: usize, const O: usize>(
    tracker: &mut Tracker<'_, M, N, U, P>,
    value: f64,
    slopes: bool,
) -> Station<N, U, P>
where
    M: Mechanism<N, U, P, O>,
{
    let (equilibrium, modes) = match tracker.advance(value) {
        Ok((state, modes)) => (Ok(state), modes),
        Err(error) => (Err(error.clone()), Err(error)),
    };
    let slopes = slopes.then(|| match (&equilibrium, &modes) {
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

impl<const N: usize, const U: usize, const P: usize> Station<N, U, P> {
    /// Goes to a lane of a block from where the way led before, a state that was followed itself.
    fn read<M, const O: usize>(
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
        if let Ok(state) = equilibrium {
            read_state(state, block, lane);
            state.inputs = tracker.inputs_at(*value);
            let (q, u, b) = (&state.coordinates, &state.inputs, &state.design);
            state.pose = tracker.mechanism.pose_margin(q, u, b);
        }
        let Ok(modes) = modes else { return };
        let before = least(modes);
        read_modes(modes, block, lane);
        self.smooth = even(before, least(modes));
        if let Some(Ok(slopes)) = &mut self.slopes {
            for (r, (own, mode)) in slopes.modes.iter_mut().zip(modes.modes.iter()).enumerate() {
                let by_input = at(&block.by_input[r], lane);
                own.set_undamped(mode, by_input, at(&block.by_design[r], lane));
            }
        }
    }
}

fn read_state<const N: usize, const U: usize, const P: usize>(
    state: &mut Equilibrium<N, U, P>,
    block: &Block<N, U, P>,
    lane: usize,
) {
    state.coordinates = at(&block.coordinates, lane);
    state.stability = Stability::Stable;
    let Linear {
        mass,
        damping,
        stiffness,
    } = &block.linear;
    state.linear = Linear {
        mass: core::array::from_fn(|i| at(&mass[i], lane)),
        damping: core::array::from_fn(|i| at(&damping[i], lane)),
        stiffness: core::array::from_fn(|i| at(&stiffness[i], lane)),
    };
    state.residual = at(&block.residual, lane);
    state.relative_residual = block.relative_residual.0[lane];
    state.iterations = block.iterations.0[lane] as usize;
    state.left_unstable_region = false;
}

/// In the order and with the labels that they have.
fn read_modes<const N: usize, const U: usize, const P: usize>(
    modes: &mut Modes<N>,
    block: &Block<N, U, P>,
    lane: usize,
) {
    let lambda = at(&block.lambda, lane);
    let threshold = neutral_threshold(&lambda);
    for (r, mode) in modes.modes.iter_mut().enumerate() {
        let label = mode.label;
        let shape = at(&block.shapes[r], lane);
        let residual = block.mode_residuals[r].0[lane];
        *mode = undamped_mode(label, lambda[r], &shape, residual, threshold);
    }
}

/// Least `lambda`.
pub(super) fn least<const N: usize>(modes: &Modes<N>) -> f64 {
    let lambda = modes.modes.iter().map(|mode| mode.lambda);
    lambda.fold(f64::INFINITY, f64::min)
}

/// The numbers of one lane.
pub(super) fn at<const K: usize>(batches: &[Batch; K], lane: usize) -> [f64; K] {
    core::array::from_fn(|k| batches[k].0[lane])
}
