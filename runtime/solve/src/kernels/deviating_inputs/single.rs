//! The kernels for a single state.

use core::ops::Add;

use super::DeviatingInputs;
use crate::algebra::Vector;
use crate::kernels::{
    Costs, Curvature, CurvatureKernels, Directional, DirectionalKernels, Kernel, Kernels, Linear, MotionKernel,
    MotionKernels, PartialMatrices, PictureKernels, RestParts, Second, Sizes,
};
use crate::mechanism::{Description, PictureInfo, PoseMargin, Shared, Violation};

impl<K: ?Sized> DeviatingInputs<'_, K> {
    fn applied<'b>(&self, u: &[f64], b: &'b [f64]) -> (Vector, &'b [f64]) {
        self.deviations.applied(u, b, f64::add)
    }
}

impl<K: Kernels + ?Sized> Kernels for DeviatingInputs<'_, K> {
    fn description(&self) -> Shared<Description> {
        self.description.clone()
    }

    fn costs(&self) -> Costs {
        self.kernels.costs()
    }

    fn sizes(&self) -> Sizes {
        Sizes { design: self.description.design.len(), ..self.kernels.sizes() }
    }

    fn input_of_deviation(&self, design: usize) -> Option<usize> {
        match design.checked_sub(self.deviations.design()) {
            Some(deviation) => self.deviations.inputs().get(deviation).copied(),
            None => self.kernels.input_of_deviation(design),
        }
    }

    fn evaluate(&self, kernel: Kernel, arguments: &[&[f64]], results: &mut [&mut [f64]]) {
        let shape = (kernel.arguments(), kernel.results());
        self.deviations.evaluated(f64::add, [arguments], shape, results, |[arguments], results| {
            self.kernels.evaluate(kernel, arguments, results);
        });
    }

    fn residual_and_stiffness_into(
        &self,
        q: &[f64],
        u: &[f64],
        b: &[f64],
        residual: &mut [f64],
        stiffness: &mut [f64],
    ) {
        let (u, b) = self.applied(u, b);
        self.kernels.residual_and_stiffness_into(q, &u, b, residual, stiffness);
    }

    fn parts_and_linear_into(&self, q: &[f64], u: &[f64], b: &[f64], parts: &mut RestParts, linear: &mut Linear) {
        let (u, b) = self.applied(u, b);
        self.kernels.parts_and_linear_into(q, &u, b, parts, linear);
    }

    fn linear_partials_into(&self, q: &[f64], u: &[f64], b: &[f64], partials: &mut PartialMatrices) {
        let (u, b) = self.applied(u, b);
        let mut partial_matrices = PartialMatrices::zeros(self.kernels.sizes());
        self.kernels.linear_partials_into(q, &u, b, &mut partial_matrices);
        self.deviations.partial_matrices(&partial_matrices, partials);
    }

    fn violation(&self, u: &[f64], b: &[f64]) -> Option<Violation<f64>> {
        let (u, b) = self.applied(u, b);
        self.kernels.violation(&u, b)
    }

    /// The mechanism only knows ranges of its design variables, so nothing can be said if an input varies.
    fn possible_within(&self, u: &[f64], b: &[f64], reach: &[f64]) -> bool {
        let (u, b) = self.applied(u, b);
        let (of_design, of_deviations) = self.deviations.split(reach);
        of_deviations.iter().all(|reach| *reach == 0.0) && self.kernels.possible_within(&u, b, of_design)
    }

    fn pose_margin(&self, q: &[f64], u: &[f64], b: &[f64]) -> Option<PoseMargin<f64>> {
        let (u, b) = self.applied(u, b);
        self.kernels.pose_margin(q, &u, b)
    }

    fn held_values_into(&self, u: &[Second], b: &[Second], values: &mut [Second]) {
        let (u, b) = self.deviations.applied(u, b, Second::add);
        self.kernels.held_values_into(&u, b, values);
    }

    fn spans_into(&self, u: &[Second], b: &[Second], numbers: &mut [Second]) {
        let (u, b) = self.deviations.applied(u, b, Second::add);
        self.kernels.spans_into(&u, b, numbers);
    }
}

impl<K: DirectionalKernels + ?Sized> DirectionalKernels for DeviatingInputs<'_, K> {
    fn evaluate_along(
        &self,
        kernel: Directional,
        arguments: &[&[f64]],
        direction: &[&[f64]],
        results: &mut [&mut [f64]],
    ) {
        let row = Kernel::from(kernel);
        let shape = (row.arguments(), row.results());
        self.deviations.evaluated(f64::add, [arguments, direction], shape, results, |[at, along], to| {
            self.kernels.evaluate_along(kernel, at, along, to);
        });
    }
}

impl<K: CurvatureKernels + ?Sized> CurvatureKernels for DeviatingInputs<'_, K> {
    fn evaluate_curvature(
        &self,
        kernel: Curvature,
        arguments: &[&[f64]],
        direction: &[&[f64]],
        results: &mut [&mut [f64]],
    ) {
        let row = Kernel::from(kernel);
        let shape = (row.arguments(), row.results());
        self.deviations.evaluated(f64::add, [arguments, direction], shape, results, |[at, along], to| {
            self.kernels.evaluate_curvature(kernel, at, along, to);
        });
    }
}

impl<K: MotionKernels + ?Sized> MotionKernels for DeviatingInputs<'_, K> {
    fn evaluate_motion(&self, kernel: MotionKernel, arguments: &[&[f64]], results: &mut [&mut [f64]]) {
        let shape = (kernel.arguments(), kernel.results());
        self.deviations.evaluated(f64::add, [arguments], shape, results, |[arguments], results| {
            self.kernels.evaluate_motion(kernel, arguments, results);
        });
    }
}

impl<K: PictureKernels + ?Sized> PictureKernels for DeviatingInputs<'_, K> {
    fn picture_info(&self) -> Shared<PictureInfo> {
        self.kernels.picture_info()
    }

    fn picture_into(&self, q: &[f64], u: &[f64], b: &[f64], computed: &mut [f64]) {
        let (u, b) = self.applied(u, b);
        self.kernels.picture_into(q, &u, b, computed);
    }
}
