//! Converts one lane of a block to a state, as if it had been solved alone.

use super::block::Block;
use crate::algebra::for_size;
use crate::kernels::Kernels;
use crate::scalar::{Batch, WIDTH};
use crate::{Equilibrium, Modes, Sensitivities, Stability};

impl Block<'_> {
    /// The coordinates.
    pub fn state_of(&self, lane: usize) -> impl ExactSizeIterator<Item = f64> + Clone {
        of(self.coordinates, lane)
    }

    /// Writes the equilibrium over another of the same mechanism; inputs and design are already set, and there is no
    /// damping.
    pub fn read_state(&self, lane: usize, kernels: &dyn Kernels, state: &mut Equilibrium) {
        for_size(
            self.coordinates.len(),
            #[inline(always)]
            |n| {
                read_of(n, self.coordinates, lane, &mut state.coordinates);
                read_of(n, self.residual, lane, &mut state.residual);
                let mass = state.linear.mass.as_flattened_mut();
                read_of(n * n, self.linear.mass, lane, mass);
                let stiffness = state.linear.stiffness.as_flattened_mut();
                read_of(n * n, self.linear.stiffness, lane, stiffness);
            },
        );
        state.stability = Stability::Stable;
        state.rounding = 0.0;
        state.relative_residual = self.relative_residual.0[lane];
        state.iterations = self.iterations.0[lane] as usize;
        if state.pose.is_some() {
            state.pose = kernels.pose_margin(&state.coordinates, &state.inputs, &state.design);
        }
        state.left_unstable_region = false;
    }

    /// Writes the modes, keeping order and labels.
    pub fn read_modes(&self, lane: usize, modes: &mut Modes) {
        let lane = lane % WIDTH;
        for_size(
            self.lambda.len(),
            #[inline(always)]
            |n| {
                for (r, mode) in modes.modes.iter_mut().enumerate() {
                    let (lambda, rate) = (self.lambda[r].0[lane], self.rates[r].0[lane]);
                    let (residual, error) = (self.mode_residuals[r].0[lane], self.mode_errors[r].0[lane]);
                    mode.set_oscillating(mode.label, lambda, rate, residual, error);
                    let from = &self.shapes[r * n..][..n];
                    let shape = &mut mode.shape.make_room(n)[..n];
                    for i in 0..n {
                        shape[i] = from[i].0[lane].into();
                    }
                }
            },
        );
    }

    /// Writes the derivatives of these modes.
    pub fn read_slopes(&self, lane: usize, modes: &Modes, slopes: &mut Sensitivities) {
        let (inputs, design) = (self.inputs.len(), self.design.len());
        for_size(
            design,
            #[inline(always)]
            |design| {
                for (r, (sensitivity, mode)) in slopes.modes.iter_mut().zip(&modes.modes).enumerate() {
                    let [by_input, by_design] = sensitivity.make_undamped(mode, inputs, design);
                    read(inputs, &self.by_input[r * inputs..], lane, by_input);
                    read_of(design, &self.by_design[r * design..], lane, by_design);
                }
            },
        );
    }
}

/// All numbers of a lane.
#[inline]
fn of(batches: &[Batch], lane: usize) -> impl ExactSizeIterator<Item = f64> + Clone {
    let lane = lane % WIDTH;
    batches.iter().map(move |batch| batch.0[lane])
}

/// Reads the first numbers of a lane.
#[inline(always)]
fn read(count: usize, from: &[Batch], lane: usize, to: &mut [f64]) {
    for_size(
        count,
        #[inline(always)]
        |count| read_of(count, from, lane, to),
    );
}

/// The same for a number of them that may be constant; see [`for_size`].
#[inline(always)]
fn read_of(count: usize, from: &[Batch], lane: usize, to: &mut [f64]) {
    let (lane, from, to) = (lane % WIDTH, &from[..count], &mut to[..count]);
    for k in 0..count {
        to[k] = from[k].0[lane];
    }
}
