//! One lane of a block in the words of a state that was solved alone.

use super::block::Block;
use crate::algebra::{Matrix, Vector};
use crate::kernels::Kernels;
use crate::scalar::{Batch, WIDTH};
use crate::{Equilibrium, Modes, Sensitivities, Stability};

impl Block {
    /// The coordinates.
    pub(crate) fn state_of(&self, lane: usize) -> Vector {
        self.coordinates.iter().map(|batch| batch.0[lane]).collect()
    }

    /// The equilibrium; inputs and design are already there.
    pub(crate) fn read_state(&self, lane: usize, kernels: &dyn Kernels, state: &mut Equilibrium) {
        read(&self.coordinates, lane, &mut state.coordinates);
        state.stability = Stability::Stable;
        state.rounding = 0.0;
        read_matrix(&self.linear.mass, lane, &mut state.linear.mass);
        read_matrix(&self.linear.stiffness, lane, &mut state.linear.stiffness);
        state.linear.damping.as_flattened_mut().fill(0.0);
        read(&self.residual, lane, &mut state.residual);
        state.relative_residual = self.relative_residual.0[lane];
        state.iterations = self.iterations.0[lane] as usize;
        state.pose = kernels.pose_margin(&state.coordinates, &state.inputs, &state.design);
        state.left_unstable_region = false;
    }

    /// The modes, in the order and with the labels that these have.
    pub(crate) fn read_modes(&self, lane: usize, modes: &mut Modes) {
        for (r, mode) in modes.modes.iter_mut().enumerate() {
            let lambda = (self.lambda[r].0[lane], self.mode_errors[r].0[lane]);
            let shape = self.shapes[r].iter().map(|batch| batch.0[lane % WIDTH]);
            let residual = self.mode_residuals[r].0[lane];
            mode.set_undamped(mode.label, lambda, shape, residual);
        }
    }

    /// The derivatives of these modes.
    pub(crate) fn read_slopes(&self, lane: usize, modes: &Modes, slopes: &mut Sensitivities) {
        for (r, (own, mode)) in slopes.modes.iter_mut().zip(&modes.modes).enumerate() {
            let by_input = self.by_input[r].iter().map(|batch| batch.0[lane % WIDTH]);
            let by_design = self.by_design[r].iter().map(|batch| batch.0[lane % WIDTH]);
            own.set_undamped(mode, by_input, by_design);
        }
    }
}

#[inline]
fn read(batches: &[Batch], lane: usize, to: &mut [f64]) {
    let lane = lane % WIDTH;
    for (to, batch) in to.iter_mut().zip(batches) {
        *to = batch.0[lane];
    }
}

fn read_matrix(batches: &Matrix<Batch>, lane: usize, to: &mut Matrix) {
    read(batches.as_flattened(), lane, to.as_flattened_mut());
}
