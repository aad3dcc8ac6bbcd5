//! One lane of a block in the words of a state that was solved alone.

use super::block::Block;
use crate::lanes::Batch;
use crate::modes::undamped_mode;
use crate::{Equilibrium, Linear, Mechanism, Modes, Sensitivities, Stability};

impl<const N: usize, const U: usize, const P: usize> Block<N, U, P> {
    /// The coordinates.
    pub(crate) fn state_of(&self, lane: usize) -> [f64; N] {
        of(&self.coordinates, lane)
    }

    /// The equilibrium; inputs and design are already there.
    pub(crate) fn read_state<M, const O: usize>(
        &self,
        lane: usize,
        mechanism: &M,
        state: &mut Equilibrium<N, U, P>,
    ) where
        M: Mechanism<N, U, P, O>,
    {
        let matrix = |rows: &[[Batch; N]; N]| core::array::from_fn(|i| of(&rows[i], lane));
        state.coordinates = self.state_of(lane);
        state.stability = Stability::Stable;
        state.rounding = 0.0;
        state.linear = Linear {
            mass: matrix(&self.linear.mass),
            damping: matrix(&self.linear.damping),
            stiffness: matrix(&self.linear.stiffness),
        };
        state.residual = of(&self.residual, lane);
        state.relative_residual = self.relative_residual.0[lane];
        state.iterations = self.iterations.0[lane] as usize;
        state.pose = mechanism.pose_margin(&state.coordinates, &state.inputs, &state.design);
        state.left_unstable_region = false;
    }

    /// The modes, in the order and with the labels that these have.
    pub(crate) fn read_modes(&self, lane: usize, modes: &mut Modes<N>) {
        let lambda = of(&self.lambda, lane);
        for (r, mode) in modes.modes.iter_mut().enumerate() {
            let shape = of(&self.shapes[r], lane);
            let residual = self.mode_residuals[r].0[lane];
            let error = self.mode_errors[r].0[lane];
            *mode = undamped_mode(mode.label, (lambda[r], error), &shape, residual);
        }
    }

    /// The derivatives of these modes.
    pub(crate) fn read_slopes(
        &self,
        lane: usize,
        modes: &Modes<N>,
        slopes: &mut Sensitivities<N, U, P>,
    ) {
        for (r, (own, mode)) in slopes.modes.iter_mut().zip(modes.modes.iter()).enumerate() {
            let (by_input, by_design) = (&self.by_input[r], &self.by_design[r]);
            own.set_undamped(mode, of(by_input, lane), of(by_design, lane));
        }
    }
}

fn of<const K: usize>(batches: &[Batch; K], lane: usize) -> [f64; K] {
    core::array::from_fn(|k| batches[k].0[lane])
}
