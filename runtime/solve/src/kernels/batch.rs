//! The kernels at several states at once, with the processor's vector instructions.
//!
//! A [`Batch`] holds one number for each of [`WIDTH`] states, so that a list of `N` batches is `WIDTH` sets of
//! unknowns. Every result is, bit for bit, what the kernel gives for that state alone, whatever the processor: the
//! operations are the same, each is rounded once, and none are fused.

use core::slice;

use super::lanes::{self, LaneKernel, damped, operations};
use super::{DirectionalKernels, Kernel, Kernels};
use crate::mechanism::{Array, Gradient, Linear, LinearPartials, Mechanism, RestParts};
use crate::scalar::{Batch, Instructions, WIDTH};

/// Unknowns, inputs and design variables of a batch of states.
#[derive(Clone, Copy, Debug)]
pub struct BatchPoint<'a> {
    /// Unknowns.
    pub q: &'a [Batch],
    /// Inputs.
    pub u: &'a [Batch],
    /// Design variables.
    pub b: &'a [Batch],
}

/// Buffers for the residual in two parts.
pub type BatchParts<'a> = RestParts<&'a mut [Batch]>;
/// Buffers for mass, damping and stiffness, row by row. A damping matrix that is always zero is not written: its buffer
/// may be empty.
pub type BatchLinear<'a> = Linear<&'a mut [Batch]>;
/// Buffers for derivatives of the three matrices: of each matrix with respect to one variable after the other.
pub type BatchPartials<'a> = LinearPartials<BatchLinear<'a>>;
/// Buffers for derivatives of one number.
pub type BatchGradient<'a> = Gradient<&'a mut [Batch]>;

/// The kernels that sweeps and Monte Carlo need, evaluated at every state of a batch. Results are written to slices of
/// exactly their length, matrices row by row.
pub trait BatchKernels: DirectionalKernels {
    /// [`Kernels::evaluate`](super::Kernels::evaluate) at every state with these instructions.
    fn evaluate_states(
        &self,
        instructions: Instructions,
        kernel: Kernel,
        arguments: &[&[Batch]],
        results: &mut [&mut [Batch]],
    );

    /// [`Kernels::partials_into`](super::Kernels::partials_into); `residual` holds the derivatives with respect to
    /// inputs and to design variables.
    fn partials_batch(
        &self,
        instructions: Instructions,
        at: BatchPoint<'_>,
        matrices: &mut BatchPartials<'_>,
        residual: [&mut [Batch]; 2],
    );

    /// [`Kernels::parts_and_linear_into`](super::Kernels::parts_and_linear_into).
    fn parts_and_linear_batch(
        &self,
        instructions: Instructions,
        at: BatchPoint<'_>,
        parts: &mut BatchParts<'_>,
        linear: &mut BatchLinear<'_>,
    ) {
        let results = &mut [&mut *parts.inertia, &mut *parts.applied];
        self.evaluate_states(instructions, Kernel::ResidualParts, &at.lists(), results);
        self.linear_batch(instructions, at, linear);
    }

    /// [`Kernels::residual_and_stiffness_into`](super::Kernels::residual_and_stiffness_into).
    fn residual_and_stiffness_batch(
        &self,
        instructions: Instructions,
        at: BatchPoint<'_>,
        residual: &mut [Batch],
        stiffness: &mut [Batch],
    ) {
        let results = &mut [residual, stiffness];
        self.evaluate_states(instructions, Kernel::ResidualAndStiffness, &at.lists(), results);
    }

    /// [`Kernels::linear_into`](super::Kernels::linear_into).
    fn linear_batch(&self, instructions: Instructions, at: BatchPoint<'_>, linear: &mut BatchLinear<'_>) {
        self.evaluate_states(instructions, Kernel::Linear, &at.lists(), &mut linear_results(linear));
    }

    /// [`Kernels::mode_gradient_into`](super::Kernels::mode_gradient_into), with a separate mode for each state.
    fn mode_gradient_batch(
        &self,
        instructions: Instructions,
        at: BatchPoint<'_>,
        phi: &[Batch],
        lambda: &Batch,
        gradient: &mut BatchGradient<'_>,
    ) {
        let arguments = [at.q, at.u, at.b, phi, slice::from_ref(lambda)];
        self.evaluate_states(instructions, Kernel::ModeGradient, &arguments, &mut results(gradient));
    }

    /// [`Kernels::residual_gradient_into`](super::Kernels::residual_gradient_into).
    fn residual_gradient_batch(
        &self,
        instructions: Instructions,
        at: BatchPoint<'_>,
        w: &[Batch],
        gradient: &mut BatchGradient<'_>,
    ) {
        let arguments = [at.q, at.u, at.b, w];
        self.evaluate_states(instructions, Kernel::ResidualGradient, &arguments, &mut results(gradient));
    }
}

/// The three matrices as results.
fn linear_results<'a>(linear: &'a mut BatchLinear<'_>) -> [&'a mut [Batch]; 3] {
    [&mut *linear.mass, &mut *linear.damping, &mut *linear.stiffness]
}

/// A gradient as results.
fn results<'a>(gradient: &'a mut BatchGradient<'_>) -> [&'a mut [Batch]; 3] {
    [&mut *gradient.coordinates, &mut *gradient.inputs, &mut *gradient.design]
}

impl<'a> BatchPoint<'a> {
    fn lists(&self) -> [&'a [Batch]; 3] {
        [self.q, self.u, self.b]
    }
}

/// [`Kernels::evaluate_batch`](super::Kernels::evaluate_batch) of a compiled mechanism: in vectors the two gradients that
/// forced vibration takes by the dozen, lane by lane everything else.
pub(super) fn evaluate_batch<M: Mechanism>(
    mechanism: &M,
    kernel: Kernel,
    arguments: &[&[Batch]],
    results: &mut [&mut [Batch]],
) {
    if const { forced_in_vectors::<M>() } {
        let instructions = Instructions::best();
        match kernel {
            Kernel::PencilGradient => {
                return lanes::evaluate(lanes::PencilGradient, mechanism, instructions, arguments, results);
            }
            Kernel::ForcedGradient => {
                return lanes::evaluate(lanes::ForcedGradient, mechanism, instructions, arguments, results);
            }
            _ => {}
        }
    }
    lane_by_lane(arguments, results, |arguments, results| {
        mechanism.evaluate(kernel, arguments, results);
    });
}

/// Operations up to which rustc compiles a kernel for each kind of vector in no time.
const SHORT: usize = 2000;

const fn forced_in_vectors<M: Mechanism>() -> bool {
    M::Excitations::<f64>::LEN > 0
        && operations::<M>("pencil_gradient") <= SHORT
        && operations::<M>("forced_gradient") <= SHORT
}

/// Evaluates a kernel of plain numbers for each lane.
pub fn lane_by_lane(
    arguments: &[&[Batch]],
    results: &mut [&mut [Batch]],
    mut evaluate: impl FnMut(&[&[f64]], &mut [&mut [f64]]),
) {
    for lane in 0..WIDTH {
        let lane_of = |list: &&[Batch]| list.iter().map(|value| value.0[lane]).collect();
        let lists: Vec<Vec<f64>> = arguments.iter().map(lane_of).collect();
        let mut values: Vec<Vec<f64>> = results.iter().map(|to| vec![0.0; to.len()]).collect();
        let lists: Vec<&[f64]> = lists.iter().map(Vec::as_slice).collect();
        let mut to: Vec<&mut [f64]> = values.iter_mut().map(Vec::as_mut_slice).collect();
        evaluate(&lists, &mut to);
        for (to, numbers) in results.iter_mut().zip(&values) {
            for (to, value) in to.iter_mut().zip(numbers) {
                to.0[lane] = *value;
            }
        }
    }
}

/// Whether vectors pay. For larger mechanisms rustc takes minutes per vector type, and the solvers take other
/// mechanisms one state at a time.
const fn pays<M: Mechanism>() -> bool {
    let description = const { &M::DESCRIPTION };
    let conservative = !damped(description) && description.symmetric_stiffness;
    M::Coordinates::<f64>::LEN <= 16 && conservative
}

/// Evaluates a kernel, state by state if vectors do not pay.
#[inline]
fn evaluate<K: LaneKernel, M: Mechanism>(
    kernel: K,
    mechanism: &M,
    instructions: Instructions,
    arguments: &[&[Batch]],
    results: &mut [&mut [Batch]],
) {
    if const { pays::<M>() } {
        lanes::evaluate(kernel, mechanism, instructions, arguments, results);
    } else {
        lanes::one_by_one(kernel, mechanism, arguments, results);
    }
}

impl<M: Mechanism> BatchKernels for M {
    fn evaluate_states(
        &self,
        instructions: Instructions,
        kernel: Kernel,
        arguments: &[&[Batch]],
        results: &mut [&mut [Batch]],
    ) {
        match kernel {
            Kernel::ResidualAndStiffness => {
                evaluate(lanes::ResidualAndStiffness, self, instructions, arguments, results);
            }
            Kernel::Linear => evaluate(lanes::Linear, self, instructions, arguments, results),
            Kernel::ModeGradient => evaluate(lanes::ModeGradient, self, instructions, arguments, results),
            Kernel::ResidualGradient => evaluate(lanes::ResidualGradient, self, instructions, arguments, results),
            _ => lane_by_lane(arguments, results, |arguments, results| {
                self.evaluate(kernel, arguments, results);
            }),
        }
    }

    fn parts_and_linear_batch(
        &self,
        instructions: Instructions,
        at: BatchPoint<'_>,
        parts: &mut BatchParts<'_>,
        linear: &mut BatchLinear<'_>,
    ) {
        let [mass, damping, stiffness] = linear_results(linear);
        let results = &mut [&mut *parts.inertia, &mut *parts.applied, mass, damping, stiffness];
        evaluate(lanes::PartsAndLinear, self, instructions, &at.lists(), results);
    }

    fn partials_batch(
        &self,
        instructions: Instructions,
        at: BatchPoint<'_>,
        matrices: &mut BatchPartials<'_>,
        [by_input, by_design]: [&mut [Batch]; 2],
    ) {
        let [m0, c0, k0] = linear_results(&mut matrices.by_coordinate);
        let [m1, c1, k1] = linear_results(&mut matrices.by_input);
        let [m2, c2, k2] = linear_results(&mut matrices.by_design);
        let results = &mut [m0, c0, k0, m1, c1, k1, m2, c2, k2, by_input, by_design];
        evaluate(lanes::Partials, self, instructions, &at.lists(), results);
    }
}
