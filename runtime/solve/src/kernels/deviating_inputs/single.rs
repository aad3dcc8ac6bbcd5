//! The kernels for a single state.

use core::ops::Add;

use super::DeviatingInputs;
use crate::algebra::{Matrix, Vector};
use crate::kernels::{
    Costs, CurvatureKernels, DirectionalKernels, Gradient, Kernels, Linear, MotionKernels,
    PartialMatrices, PictureKernels, ResidualPartials, RestParts, Second, Sizes,
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
        Sizes {
            design: self.description.design.len(),
            ..self.kernels.sizes()
        }
    }

    fn input_of_deviation(&self, design: usize) -> Option<usize> {
        match design.checked_sub(self.deviations.design()) {
            Some(deviation) => self.deviations.inputs().get(deviation).copied(),
            None => self.kernels.input_of_deviation(design),
        }
    }

    fn residual_into(&self, q: &[f64], u: &[f64], b: &[f64], residual: &mut [f64]) {
        let (u, b) = self.applied(u, b);
        self.kernels.residual_into(q, &u, b, residual);
    }

    fn residual_parts_into(&self, q: &[f64], u: &[f64], b: &[f64], parts: &mut RestParts) {
        let (u, b) = self.applied(u, b);
        self.kernels.residual_parts_into(q, &u, b, parts);
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
        self.kernels
            .residual_and_stiffness_into(q, &u, b, residual, stiffness);
    }

    fn linear_into(&self, q: &[f64], u: &[f64], b: &[f64], linear: &mut Linear) {
        let (u, b) = self.applied(u, b);
        self.kernels.linear_into(q, &u, b, linear);
    }

    fn parts_and_linear_into(
        &self,
        q: &[f64],
        u: &[f64],
        b: &[f64],
        parts: &mut RestParts,
        linear: &mut Linear,
    ) {
        let (u, b) = self.applied(u, b);
        self.kernels.parts_and_linear_into(q, &u, b, parts, linear);
    }

    fn residual_partials_into(
        &self,
        q: &[f64],
        u: &[f64],
        b: &[f64],
        partials: &mut ResidualPartials,
    ) {
        let (u, b) = self.applied(u, b);
        self.deviations.residual_partials(partials, |partials| {
            self.kernels.residual_partials_into(q, &u, b, partials);
        });
    }

    fn linear_partials_into(
        &self,
        q: &[f64],
        u: &[f64],
        b: &[f64],
        partials: &mut PartialMatrices,
    ) {
        let (u, b) = self.applied(u, b);
        let mut own = PartialMatrices::zeros(self.kernels.sizes());
        self.kernels.linear_partials_into(q, &u, b, &mut own);
        self.deviations.partial_matrices(&own, partials);
    }

    fn partials_into(
        &self,
        q: &[f64],
        u: &[f64],
        b: &[f64],
        matrices: &mut PartialMatrices,
        residual: &mut ResidualPartials,
    ) {
        let (u, b) = self.applied(u, b);
        let mut own = PartialMatrices::zeros(self.kernels.sizes());
        self.deviations.residual_partials(residual, |residual| {
            self.kernels.partials_into(q, &u, b, &mut own, residual);
        });
        self.deviations.partial_matrices(&own, matrices);
    }

    fn mode_gradient_into(
        &self,
        q: &[f64],
        u: &[f64],
        b: &[f64],
        phi: &[f64],
        lambda: f64,
        gradient: &mut Gradient,
    ) {
        let (u, b) = self.applied(u, b);
        self.deviations.gradient(gradient, |gradient| {
            self.kernels
                .mode_gradient_into(q, &u, b, phi, lambda, gradient);
        });
    }

    fn pencil_gradient_into(
        &self,
        q: &[f64],
        u: &[f64],
        b: &[f64],
        vectors: [&[f64]; 4],
        gradient: &mut Gradient,
    ) {
        let (u, b) = self.applied(u, b);
        self.deviations.gradient(gradient, |gradient| {
            self.kernels
                .pencil_gradient_into(q, &u, b, vectors, gradient);
        });
    }

    fn residual_gradient_into(
        &self,
        q: &[f64],
        u: &[f64],
        b: &[f64],
        w: &[f64],
        gradient: &mut Gradient,
    ) {
        let (u, b) = self.applied(u, b);
        self.deviations.gradient(gradient, |gradient| {
            self.kernels.residual_gradient_into(q, &u, b, w, gradient);
        });
    }

    fn whirl(&self, q: &[f64], u: &[f64], b: &[f64], real: &[f64], imaginary: &[f64]) -> [f64; 2] {
        let (u, b) = self.applied(u, b);
        self.kernels.whirl(q, &u, b, real, imaginary)
    }

    fn violation(&self, u: &[f64], b: &[f64]) -> Option<Violation<f64>> {
        let (u, b) = self.applied(u, b);
        self.kernels.violation(&u, b)
    }

    /// The mechanism only knows ranges of its design variables, so nothing can be said if an input varies.
    fn possible_within(&self, u: &[f64], b: &[f64], reach: &[f64]) -> bool {
        let (u, b) = self.applied(u, b);
        let (own, of_deviations) = self.deviations.split(reach);
        of_deviations.iter().all(|reach| *reach == 0.0) && self.kernels.possible_within(&u, b, own)
    }

    fn pose_margin(&self, q: &[f64], u: &[f64], b: &[f64]) -> Option<PoseMargin<f64>> {
        let (u, b) = self.applied(u, b);
        self.kernels.pose_margin(q, &u, b)
    }

    fn held_values_into(&self, u: &[Second], b: &[Second], values: &mut [Second]) {
        let (u, b) = self.deviations.applied(u, b, Second::add);
        self.kernels.held_values_into(&u, b, values);
    }

    fn outputs_into(&self, q: &[f64], u: &[f64], b: &[f64], outputs: &mut [f64]) {
        let (u, b) = self.applied(u, b);
        self.kernels.outputs_into(q, &u, b, outputs);
    }

    fn output_partials_into(&self, q: &[f64], u: &[f64], b: &[f64], partials: [&mut Matrix; 3]) {
        let (u, b) = self.applied(u, b);
        self.deviations.output_partials(partials, |partials| {
            self.kernels.output_partials_into(q, &u, b, partials);
        });
    }
}

impl<K: DirectionalKernels + ?Sized> DirectionalKernels for DeviatingInputs<'_, K> {
    fn linear_along_into(
        &self,
        q: &[f64],
        u: &[f64],
        b: &[f64],
        direction: [&[f64]; 3],
        linear: &mut Linear,
    ) {
        let (u, b) = self.applied(u, b);
        let [dq, du, db] = direction;
        let (du, db) = self.applied(du, db);
        self.kernels
            .linear_along_into(q, &u, b, [dq, &du, db], linear);
    }

    fn residual_gradient_along_into(
        &self,
        q: &[f64],
        u: &[f64],
        b: &[f64],
        w: &[f64],
        direction: [&[f64]; 4],
        gradient: &mut Gradient,
    ) {
        let (u, b) = self.applied(u, b);
        let [dq, du, db, dw] = direction;
        let (du, db) = self.applied(du, db);
        self.deviations.gradient(gradient, |gradient| {
            let direction = [dq, &du, db, dw];
            self.kernels
                .residual_gradient_along_into(q, &u, b, w, direction, gradient);
        });
    }
}

impl<K: CurvatureKernels + ?Sized> CurvatureKernels for DeviatingInputs<'_, K> {
    fn mode_gradient_along_into(
        &self,
        q: &[f64],
        u: &[f64],
        b: &[f64],
        phi: &[f64],
        lambda: f64,
        direction: [&[f64]; 4],
        dlambda: f64,
        gradient: &mut Gradient,
    ) {
        let (u, b) = self.applied(u, b);
        let [dq, du, db, dphi] = direction;
        let (du, db) = self.applied(du, db);
        self.deviations.gradient(gradient, |gradient| {
            let direction = [dq, &du, db, dphi];
            self.kernels
                .mode_gradient_along_into(q, &u, b, phi, lambda, direction, dlambda, gradient);
        });
    }

    fn pencil_gradient_along_into(
        &self,
        q: &[f64],
        u: &[f64],
        b: &[f64],
        vectors: [&[f64]; 4],
        direction: [&[f64]; 3],
        changes: [&[f64]; 4],
        gradient: &mut Gradient,
    ) {
        let (u, b) = self.applied(u, b);
        let [dq, du, db] = direction;
        let (du, db) = self.applied(du, db);
        self.deviations.gradient(gradient, |gradient| {
            let direction = [dq, &du, db];
            self.kernels
                .pencil_gradient_along_into(q, &u, b, vectors, direction, changes, gradient);
        });
    }

    fn output_partials_along_into(
        &self,
        q: &[f64],
        u: &[f64],
        b: &[f64],
        direction: [&[f64]; 3],
        partials: [&mut Matrix; 3],
    ) {
        let (u, b) = self.applied(u, b);
        let [dq, du, db] = direction;
        let (du, db) = self.applied(du, db);
        self.deviations.output_partials(partials, |partials| {
            self.kernels
                .output_partials_along_into(q, &u, b, [dq, &du, db], partials);
        });
    }
}

impl<K: MotionKernels + ?Sized> MotionKernels for DeviatingInputs<'_, K> {
    fn motion_residual_into(
        &self,
        acceleration: &[f64],
        velocity: &[f64],
        q: &[f64],
        u: &[f64],
        b: &[f64],
        residual: &mut [f64],
    ) {
        let (u, b) = self.applied(u, b);
        self.kernels
            .motion_residual_into(acceleration, velocity, q, &u, b, residual);
    }

    fn motion_into(
        &self,
        velocity: &[f64],
        q: &[f64],
        u: &[f64],
        b: &[f64],
        mass: &mut Matrix,
        right: &mut [f64],
    ) {
        let (u, b) = self.applied(u, b);
        self.kernels.motion_into(velocity, q, &u, b, mass, right);
    }

    fn motion_linear_into(
        &self,
        acceleration: &[f64],
        velocity: &[f64],
        q: &[f64],
        u: &[f64],
        b: &[f64],
        linear: &mut Linear,
    ) {
        let (u, b) = self.applied(u, b);
        self.kernels
            .motion_linear_into(acceleration, velocity, q, &u, b, linear);
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
