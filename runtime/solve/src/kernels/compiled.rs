//! The kernel table of a compiled mechanism.
//!
//! # What one compilation costs
//!
//! When the solvers were compiled for each mechanism, kernel and solver were one function with its numbers in
//! registers; through the table they pass in memory. For the double pendulum on one core (AVX2), relative to then: an
//! equilibrium takes 26 % longer from a distant start and 36 % from a near one, with first-order spreads 33 and 67 %, a
//! state of a sweep with derivatives 33 % in vectors and 20 % alone, a sample 37 % in vectors, a seventh of it for quantiles
//! and higher moments that were not gathered then, and 10 % alone.

use super::batch::evaluate_batch;
use super::interval::Interval;
use super::{
    Costs, Curvature, CurvatureKernels, Directional, DirectionalKernels, Gradient, Kernel, Kernels, Linear,
    MotionKernel, MotionKernels, PartialMatrices, PictureKernels, ResidualPartials, RestParts, Second, Sizes,
    entries_of, gradient_results, linear_results,
};
use crate::algebra::Vector;
use crate::mechanism::{
    Array, Description, ForcingOf, GradientOf, Mechanism, PartialsOf, PictureInfo, PoseMargin, Shared, Square,
    Violation, few_partials,
};
use crate::scalar::{Batch, Dual};
use crate::{Real, mechanism};

/// Number of unknowns up to which two kernels in one function pay: the code grows long beyond that.
const FEW_COORDINATES: usize = 4;

/// Largest size, bytes, of the partial derivatives of the matrices that are passed by value; larger ones would fill the
/// stack.
const ON_STACK: usize = 1 << 16;

#[inline(always)]
fn copy_linear<M: Mechanism>(from: &mechanism::Linear<Square<M, f64>>, to: &mut [&mut [f64]]) {
    copy_rows(&from.mass, to[0]);
    copy_rows(&from.damping, to[1]);
    copy_rows(&from.stiffness, to[2]);
}

#[inline(always)]
fn copy_rows<A: Array<R>, R: Array<f64>>(from: &A, to: &mut [f64]) {
    let to = &mut to[..A::LEN * R::LEN];
    for (to, from) in to.chunks_exact_mut(R::LEN.max(1)).zip(from.as_ref()) {
        copy_array(from, to);
    }
}

/// Copies one by one: a few numbers go straight from registers to memory.
#[inline(always)]
fn copy_array<A: Array<f64>>(from: &A, to: &mut [f64]) {
    for (to, from) in to[..A::LEN].iter_mut().zip(from.as_ref()) {
        *to = *from;
    }
}

/// Copies the changes of the matrices with several variables.
#[inline(always)]
fn copy_changes<M: Mechanism>(from: &[mechanism::Linear<Square<M, f64>>], to: &mut [f64]) {
    let n = M::Coordinates::<f64>::LEN;
    let (each, size) = (entries_of(n), n * n);
    let to = &mut to[..each * from.len()];
    for (from, to) in from.iter().zip(to.chunks_exact_mut(each.max(1))) {
        copy_rows(&from.mass, &mut to[..size]);
        copy_rows(&from.damping, &mut to[size..2 * size]);
        copy_rows(&from.stiffness, &mut to[2 * size..]);
    }
}

#[inline(always)]
fn copy_partials<M: Mechanism>(from: &PartialsOf<M, f64>, to: &mut PartialMatrices) {
    let [by_coordinate, by_input, by_design] = to.lists_mut();
    copy_changes::<M>(from.by_coordinate.as_ref(), by_coordinate);
    copy_changes::<M>(from.by_input.as_ref(), by_input);
    copy_changes::<M>(from.by_design.as_ref(), by_design);
}

fn copy_gradient<M: Mechanism>(from: &GradientOf<M, f64>, to: &mut [&mut [f64]]) {
    to[0].copy_from_slice(from.coordinates.as_ref());
    to[1].copy_from_slice(from.inputs.as_ref());
    to[2].copy_from_slice(from.design.as_ref());
}

/// Copies three matrices: derivatives of the outputs by unknowns, inputs and design variables, or by motion.
fn copy_three<A, B, C, R: Array<f64>, S: Array<f64>, T: Array<f64>>(from: &(A, B, C), to: &mut [&mut [f64]])
where
    A: Array<R>,
    B: Array<S>,
    C: Array<T>,
{
    copy_rows(&from.0, to[0]);
    copy_rows(&from.1, to[1]);
    copy_rows(&from.2, to[2]);
}

fn copy_forcing<M: Mechanism>(from: &ForcingOf<M, f64>, to: &mut [&mut [f64]]) {
    copy_rows(&from.cosine, to[0]);
    copy_array(&from.frequency, to[1]);
    copy_rows(&from.direct_cosine, to[2]);
    copy_rows(&from.sine, to[3]);
    copy_rows(&from.direct_sine, to[4]);
}

/// [`Mechanism::forced_gradient`] of lists of numbers, or of duals.
fn forced_gradient<M: Mechanism, T: Real>(mechanism: &M, lists: &[&[T]]) -> GradientOf<M, T> {
    let coordinates = |k: usize| Array::view(lists[k]);
    let outputs = |k: usize| Array::view(lists[k]);
    let excitations = |k: usize| Array::view(lists[k]);
    Mechanism::forced_gradient(
        mechanism,
        Array::view(lists[0]),
        Array::view(lists[1]),
        Array::view(lists[2]),
        outputs(3),
        coordinates(4),
        coordinates(5),
        coordinates(6),
        excitations(7),
        coordinates(8),
        coordinates(9),
        outputs(10),
        outputs(11),
        excitations(12),
    )
}

/// Unknowns, inputs and design variables as the mechanism takes them.
#[allow(clippy::type_complexity)]
#[inline(always)]
fn point<'a, M: Mechanism>(
    q: &'a [f64],
    u: &'a [f64],
    b: &'a [f64],
) -> (&'a M::Coordinates<f64>, &'a M::Inputs<f64>, &'a M::Design<f64>) {
    (Array::view(q), Array::view(u), Array::view(b))
}

fn partials_by_direction(
    mechanism: &dyn DirectionalKernels,
    q: &[f64],
    u: &[f64],
    b: &[f64],
    partials: &mut PartialMatrices,
) {
    let mut change = Linear::zeros(q.len());
    let mut to = partials.iter_mut();
    for kind in 0..3 {
        let mut direction = [q, u, b].map(|values| Vector::zeros(values.len()));
        for k in 0..direction[kind].len() {
            direction[kind][k] = 1.0;
            let along = direction.each_ref().map(|values| &**values);
            mechanism.linear_along_into(q, u, b, along, &mut change);
            direction[kind][k] = 0.0;
            if let Some(to) = to.next() {
                to.mass.copy_from_slice(change.mass.as_flattened());
                to.damping.copy_from_slice(change.damping.as_flattened());
                to.stiffness.copy_from_slice(change.stiffness.as_flattened());
            }
        }
    }
}

impl<M: Mechanism> Kernels for M {
    fn description(&self) -> Shared<Description> {
        Shared::Static(const { &M::DESCRIPTION })
    }

    fn costs(&self) -> Costs {
        const { Costs::of_constant(const { &M::DESCRIPTION }) }
    }

    fn sizes(&self) -> Sizes {
        Sizes {
            coordinates: M::Coordinates::<f64>::LEN,
            inputs: M::Inputs::<f64>::LEN,
            design: M::Design::<f64>::LEN,
            outputs: M::Outputs::<f64>::LEN,
            excitations: M::Excitations::<f64>::LEN,
        }
    }

    fn evaluate(&self, kernel: Kernel, arguments: &[&[f64]], results: &mut [&mut [f64]]) {
        let (q, u, b) = point::<M>(arguments[0], arguments[1], arguments[2]);
        let vector = |k: usize| Array::view(arguments[k]);
        match kernel {
            Kernel::Residual => {
                copy_array(&Mechanism::residual(self, q, u, b), results[0]);
            }
            Kernel::ResidualParts => {
                let parts = Mechanism::residual_parts(self, q, u, b);
                copy_array(&parts.inertia, results[0]);
                copy_array(&parts.applied, results[1]);
            }
            Kernel::ResidualAndStiffness => {
                let (residual, stiffness) = Mechanism::residual_and_stiffness(self, q, u, b);
                copy_array(&residual, results[0]);
                copy_rows(&stiffness, results[1]);
            }
            Kernel::Linear => copy_linear::<M>(&Mechanism::linear(self, q, u, b), results),
            Kernel::ResidualPartials => {
                let (by_input, by_design) = Mechanism::residual_partials(self, q, u, b);
                copy_rows(&by_input, results[0]);
                copy_rows(&by_design, results[1]);
            }
            Kernel::ModeGradient => {
                let (phi, lambda) = (vector(3), arguments[4][0]);
                copy_gradient::<M>(&Mechanism::mode_gradient(self, q, u, b, phi, lambda), results);
            }
            Kernel::PencilGradient => {
                let [left, acceleration, velocity, position] = [3, 4, 5, 6].map(vector);
                let gradient = Mechanism::pencil_gradient(self, q, u, b, left, acceleration, velocity, position);
                copy_gradient::<M>(&gradient, results);
            }
            Kernel::ResidualGradient => {
                let gradient = Mechanism::residual_gradient(self, q, u, b, vector(3));
                copy_gradient::<M>(&gradient, results);
            }
            Kernel::Whirl => {
                let whirl = Mechanism::whirl(self, q, u, b, vector(3), vector(4));
                results[0].copy_from_slice(&whirl);
            }
            Kernel::Outputs => copy_array(&Mechanism::outputs(self, q, u, b), results[0]),
            Kernel::OutputPartials => {
                copy_three(&Mechanism::output_partials(self, q, u, b), results);
            }
            Kernel::Forcing => copy_forcing::<M>(&Mechanism::forcing(self, q, u, b), results),
            Kernel::OutputMotion => {
                copy_three(&Mechanism::output_motion(self, q, u, b), results);
            }
            Kernel::ForcedGradient => {
                copy_gradient::<M>(&forced_gradient(self, arguments), results);
            }
        }
    }

    fn evaluate_batch(&self, kernel: Kernel, arguments: &[&[Batch]], results: &mut [&mut [Batch]]) {
        evaluate_batch(self, kernel, arguments, results);
    }

    fn residual_and_stiffness_into(
        &self,
        q: &[f64],
        u: &[f64],
        b: &[f64],
        residual: &mut [f64],
        stiffness: &mut [f64],
    ) {
        let (q, u, b) = point::<M>(q, u, b);
        if const { M::Coordinates::<f64>::LEN > FEW_COORDINATES } {
            let computed = Mechanism::residual_and_stiffness(self, q, u, b);
            copy_array(&computed.0, residual);
            copy_rows(&computed.1, stiffness);
            return;
        }
        // A few results go straight from registers to memory.
        let computed = self.residual_and_stiffness_inlined(q, u, b);
        copy_array(&computed.0, residual);
        copy_rows(&computed.1, stiffness);
    }

    fn parts_and_linear_into(&self, q: &[f64], u: &[f64], b: &[f64], parts: &mut RestParts, linear: &mut Linear) {
        if const { M::Coordinates::<f64>::LEN > FEW_COORDINATES } {
            self.residual_parts_into(q, u, b, parts);
            self.linear_into(q, u, b, linear);
            return;
        }
        let (q, u, b) = point::<M>(q, u, b);
        let computed = self.residual_parts_inlined(q, u, b);
        copy_array(&computed.inertia, &mut parts.inertia);
        copy_array(&computed.applied, &mut parts.applied);
        copy_linear::<M>(&self.linear_inlined(q, u, b), &mut linear_results(linear));
    }

    fn linear_partials_into(&self, q: &[f64], u: &[f64], b: &[f64], partials: &mut PartialMatrices) {
        if const { size_of::<PartialsOf<M, f64>>() > ON_STACK } {
            partials_by_direction(self, q, u, b, partials);
            return;
        }
        let (q, u, b) = point::<M>(q, u, b);
        copy_partials::<M>(&Mechanism::linear_partials(self, q, u, b), partials);
    }

    fn partials_into(
        &self,
        q: &[f64],
        u: &[f64],
        b: &[f64],
        matrices: &mut PartialMatrices,
        residual: &mut ResidualPartials,
    ) {
        if const { size_of::<PartialsOf<M, f64>>() > ON_STACK } {
            Kernels::linear_partials_into(self, q, u, b, matrices);
            self.residual_partials_into(q, u, b, residual);
            return;
        }
        let (q, u, b) = point::<M>(q, u, b);
        if const { !few_partials::<M>() } {
            copy_partials::<M>(&Mechanism::linear_partials(self, q, u, b), matrices);
            let computed = Mechanism::residual_partials(self, q, u, b);
            copy_rows(&computed.0, residual.0.as_flattened_mut());
            copy_rows(&computed.1, residual.1.as_flattened_mut());
            return;
        }
        <f64 as Real>::run(
            #[inline(always)]
            || {
                copy_partials::<M>(&self.linear_partials_inlined(q, u, b), matrices);
                let computed = self.residual_partials_inlined(q, u, b);
                copy_rows(&computed.0, residual.0.as_flattened_mut());
                copy_rows(&computed.1, residual.1.as_flattened_mut());
            },
        );
    }

    fn mode_gradient_into(&self, q: &[f64], u: &[f64], b: &[f64], phi: &[f64], lambda: f64, gradient: &mut Gradient) {
        let (q, u, b) = point::<M>(q, u, b);
        let computed = Mechanism::mode_gradient(self, q, u, b, Array::view(phi), lambda);
        copy_gradient::<M>(&computed, &mut gradient_results(gradient));
    }

    fn violation(&self, u: &[f64], b: &[f64]) -> Option<Violation<f64>> {
        Mechanism::violation(self, Array::view(u), Array::view(b))
    }

    fn possible_within(&self, u: &[f64], b: &[f64], reach: &[f64]) -> bool {
        let inputs = Array::from_fn(|i| Interval::constant(u[i]));
        let design = Array::from_fn(|i| Interval::about(b[i], reach[i]));
        Mechanism::violation(self, &inputs, &design).is_none()
    }

    fn pose_margin(&self, q: &[f64], u: &[f64], b: &[f64]) -> Option<PoseMargin<f64>> {
        let (q, u, b) = point::<M>(q, u, b);
        Mechanism::pose_margin(self, q, u, b)
    }

    fn held_values_into(&self, u: &[Second], b: &[Second], values: &mut [Second]) {
        Mechanism::held_values(self, Array::view(u), Array::view(b), values);
    }

    fn spans_into(&self, u: &[Second], b: &[Second], numbers: &mut [Second]) {
        Mechanism::spans(self, Array::view(u), Array::view(b), numbers);
    }
}

impl<M: Mechanism> DirectionalKernels for M {
    fn evaluate_along(
        &self,
        kernel: Directional,
        arguments: &[&[f64]],
        direction: &[&[f64]],
        results: &mut [&mut [f64]],
    ) {
        let (q, u, b) = point::<M>(arguments[0], arguments[1], arguments[2]);
        let (dq, du, db) = point::<M>(direction[0], direction[1], direction[2]);
        match kernel {
            Directional::Linear => {
                let change = Mechanism::linear_along(self, q, u, b, dq, du, db);
                copy_linear::<M>(&change, results);
            }
            Directional::ResidualGradient => {
                let (w, dw) = (Array::view(arguments[3]), Array::view(direction[3]));
                let change = Mechanism::residual_gradient_along(self, q, u, b, w, dq, du, db, dw);
                copy_gradient::<M>(&change, results);
            }
        }
    }
}

impl<M: Mechanism> CurvatureKernels for M {
    fn evaluate_curvature(
        &self,
        kernel: Curvature,
        arguments: &[&[f64]],
        direction: &[&[f64]],
        results: &mut [&mut [f64]],
    ) {
        let (q, u, b) = point::<M>(arguments[0], arguments[1], arguments[2]);
        let (dq, du, db) = point::<M>(direction[0], direction[1], direction[2]);
        let vector = |k: usize| Array::view(arguments[k]);
        let change = |k: usize| Array::view(direction[k]);
        match kernel {
            Curvature::ModeGradient => {
                let gradient = Mechanism::mode_gradient_along(
                    self,
                    q,
                    u,
                    b,
                    vector(3),
                    arguments[4][0],
                    dq,
                    du,
                    db,
                    change(3),
                    direction[4][0],
                );
                copy_gradient::<M>(&gradient, results);
            }
            Curvature::PencilGradient => {
                let gradient = Mechanism::pencil_gradient_along(
                    self,
                    q,
                    u,
                    b,
                    vector(3),
                    vector(4),
                    vector(5),
                    vector(6),
                    dq,
                    du,
                    db,
                    change(3),
                    change(4),
                    change(5),
                    change(6),
                );
                copy_gradient::<M>(&gradient, results);
            }
            Curvature::OutputPartials => {
                let partials = Mechanism::output_partials_along(self, q, u, b, dq, du, db);
                copy_three(&partials, results);
            }
            Curvature::Forcing => {
                let change = Mechanism::forcing_along(self, q, u, b, dq, du, db);
                copy_forcing::<M>(&change, results);
            }
            Curvature::OutputMotion => {
                let change = Mechanism::output_motion_along(self, q, u, b, dq, du, db);
                copy_three(&change, results);
            }
            Curvature::ForcedGradient => {
                let moved: Vec<Vec<Dual<f64>>> = arguments
                    .iter()
                    .zip(direction)
                    .map(|(values, slopes)| {
                        values.iter().zip(*slopes).map(|(&value, &slope)| Dual { value, slope }).collect()
                    })
                    .collect();
                let moved: Vec<&[Dual<f64>]> = moved.iter().map(Vec::as_slice).collect();
                let gradient = forced_gradient(self, &moved);
                let parts = [gradient.coordinates.as_ref(), gradient.inputs.as_ref(), gradient.design.as_ref()];
                for (to, from) in results.iter_mut().zip(parts) {
                    for (to, from) in to.iter_mut().zip(from) {
                        *to = from.slope;
                    }
                }
            }
        }
    }
}

impl<M: Mechanism> MotionKernels for M {
    fn evaluate_motion(&self, kernel: MotionKernel, arguments: &[&[f64]], results: &mut [&mut [f64]]) {
        let (before, at) = arguments.split_at(arguments.len() - 3);
        let (q, u, b) = point::<M>(at[0], at[1], at[2]);
        let vector = |k: usize| Array::view(before[k]);
        match kernel {
            MotionKernel::Residual => {
                let residual = Mechanism::motion_residual(self, vector(0), vector(1), q, u, b);
                copy_array(&residual, results[0]);
            }
            MotionKernel::Motion => {
                let (mass, right) = Mechanism::motion(self, vector(0), q, u, b);
                copy_rows(&mass, results[0]);
                copy_array(&right, results[1]);
            }
            MotionKernel::Linear => {
                let linear = Mechanism::motion_linear(self, vector(0), vector(1), q, u, b);
                copy_linear::<M>(&linear, results);
            }
        }
    }
}

impl<M: Mechanism> PictureKernels for M {
    fn picture_info(&self) -> Shared<PictureInfo> {
        Shared::Static(const { &M::PICTURE })
    }

    fn picture_into(&self, q: &[f64], u: &[f64], b: &[f64], computed: &mut [f64]) {
        let (q, u, b) = point::<M>(q, u, b);
        computed.copy_from_slice(Mechanism::picture(self, q, u, b).as_ref());
    }
}
