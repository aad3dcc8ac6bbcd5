//! Derivatives of the gradients of modes and outputs along a direction, as needed for second derivatives. They are
//! long, and few callers need them: only those that do compile them.

use super::{Curvature, DirectionalKernels, Gradient, gradient_results, matrix_results, output_partials_zeros};
use crate::algebra::Matrix;

/// Gradients of modes and outputs in dual numbers.
pub trait CurvatureKernels: DirectionalKernels {
    /// Derivative of the results of a kernel along a direction, which has a list for each argument.
    fn evaluate_curvature(
        &self,
        kernel: Curvature,
        arguments: &[&[f64]],
        direction: &[&[f64]],
        results: &mut [&mut [f64]],
    );

    /// [`Self::evaluate_curvature`] of a gradient at several points with a direction each, with the same results as one by
    /// one.
    fn evaluate_curvature_each(&self, kernel: Curvature, points: &[[&[&[f64]]; 2]], gradients: &mut [Gradient]) {
        for ([arguments, direction], gradient) in points.iter().zip(gradients) {
            self.evaluate_curvature(kernel, arguments, direction, &mut gradient_results(gradient));
        }
    }
}

impl dyn CurvatureKernels + '_ {
    /// Derivative of [`Kernels::mode_gradient_into`](crate::Kernels::mode_gradient_into) along `dq`, `du`, `db`, `dphi`
    /// and `dlambda`.
    #[allow(clippy::too_many_arguments)]
    pub fn mode_gradient_along(
        &self,
        q: &[f64],
        u: &[f64],
        b: &[f64],
        phi: &[f64],
        lambda: f64,
        [dq, du, db, dphi]: [&[f64]; 4],
        dlambda: f64,
    ) -> Gradient {
        let mut gradient = Gradient::zeros(self.sizes());
        let (arguments, direction) = ([q, u, b, phi, &[lambda]], [dq, du, db, dphi, &[dlambda]]);
        let results = &mut gradient_results(&mut gradient);
        self.evaluate_curvature(Curvature::ModeGradient, &arguments, &direction, results);
        gradient
    }

    /// Derivative of [`Kernels::pencil_gradient_into`](crate::Kernels::pencil_gradient_into) along `dq`, `du`, `db`,
    /// and `changes` of the vectors.
    pub fn pencil_gradient_along(
        &self,
        q: &[f64],
        u: &[f64],
        b: &[f64],
        vectors: [&[f64]; 4],
        direction: [&[f64]; 3],
        changes: [&[f64]; 4],
    ) -> Gradient {
        let mut gradient = Gradient::zeros(self.sizes());
        let lists = |[q, u, b]: [_; 3], [l, a, v, x]: [_; 4]| -> [&[f64]; 7] { [q, u, b, l, a, v, x] };
        let (arguments, direction) = (lists([q, u, b], vectors), lists(direction, changes));
        let results = &mut gradient_results(&mut gradient);
        self.evaluate_curvature(Curvature::PencilGradient, &arguments, &direction, results);
        gradient
    }

    /// Derivatives of [`Kernels::output_partials_into`](crate::Kernels::output_partials_into) along `dq`, `du`, `db`.
    pub fn output_partials_along(&self, q: &[f64], u: &[f64], b: &[f64], direction: [&[f64]; 3]) -> [Matrix; 3] {
        let mut partials = output_partials_zeros(self.sizes());
        let results = &mut matrix_results(partials.each_mut());
        self.evaluate_curvature(Curvature::OutputPartials, &[q, u, b], &direction, results);
        partials
    }
}
