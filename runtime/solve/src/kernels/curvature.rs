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

    /// [`Mechanism::mode_gradient_along`](eigentol_contract::Mechanism::mode_gradient_along); `direction` is `dq`,
    /// `du`, `db`, `dphi`.
    #[allow(clippy::too_many_arguments)]
    fn mode_gradient_along_into(
        &self,
        q: &[f64],
        u: &[f64],
        b: &[f64],
        phi: &[f64],
        lambda: f64,
        [dq, du, db, dphi]: [&[f64]; 4],
        dlambda: f64,
        gradient: &mut Gradient,
    ) {
        self.evaluate_curvature(
            Curvature::ModeGradient,
            &[q, u, b, phi, &[lambda]],
            &[dq, du, db, dphi, &[dlambda]],
            &mut gradient_results(gradient),
        );
    }

    /// [`Self::mode_gradient_along_into`] along several directions, each with its own change of `lambda`, with the same
    /// results as one by one.
    #[allow(clippy::too_many_arguments)]
    fn mode_gradients_along_into(
        &self,
        q: &[f64],
        u: &[f64],
        b: &[f64],
        phi: &[f64],
        lambda: f64,
        directions: &[([&[f64]; 4], f64)],
        gradients: &mut [Gradient],
    ) {
        for ((direction, rate), gradient) in directions.iter().zip(gradients) {
            self.mode_gradient_along_into(q, u, b, phi, lambda, *direction, *rate, gradient);
        }
    }

    /// [`Mechanism::pencil_gradient_along`](eigentol_contract::Mechanism::pencil_gradient_along); the direction is `dq`,
    /// `du`, `db`, and `changes` is the change of `vectors`.
    #[allow(clippy::too_many_arguments)]
    fn pencil_gradient_along_into(
        &self,
        q: &[f64],
        u: &[f64],
        b: &[f64],
        vectors: [&[f64]; 4],
        [dq, du, db]: [&[f64]; 3],
        changes: [&[f64]; 4],
        gradient: &mut Gradient,
    ) {
        let lists = |[q, u, b]: [_; 3], [l, a, v, x]: [_; 4]| -> [&[f64]; 7] { [q, u, b, l, a, v, x] };
        self.evaluate_curvature(
            Curvature::PencilGradient,
            &lists([q, u, b], vectors),
            &lists([dq, du, db], changes),
            &mut gradient_results(gradient),
        );
    }

    /// [`Self::pencil_gradient_along_into`] at several points, with the same results as one by one.
    fn pencil_gradients_along_into(
        &self,
        q: &[f64],
        u: &[f64],
        b: &[f64],
        points: &[PencilAlong<'_>],
        gradients: &mut [Gradient],
    ) {
        for (&PencilAlong { vectors, direction, changes }, gradient) in points.iter().zip(gradients) {
            self.pencil_gradient_along_into(q, u, b, vectors, direction, changes, gradient);
        }
    }

    /// [`Mechanism::output_partials_along`](eigentol_contract::Mechanism::output_partials_along); `direction` is `dq`,
    /// `du`, `db`.
    fn output_partials_along_into(
        &self,
        q: &[f64],
        u: &[f64],
        b: &[f64],
        direction: [&[f64]; 3],
        partials: [&mut Matrix; 3],
    ) {
        let results = &mut matrix_results(partials);
        self.evaluate_curvature(Curvature::OutputPartials, &[q, u, b], &direction, results);
    }
}

/// A point at which the derivative of a gradient of the pencil is wanted, along a direction of its own.
#[derive(Clone, Copy, Debug)]
pub struct PencilAlong<'a> {
    /// The left vector, accelerations, velocities and positions.
    pub vectors: [&'a [f64]; 4],
    /// `dq`, `du`, `db`.
    pub direction: [&'a [f64]; 3],
    /// The change of the vectors.
    pub changes: [&'a [f64]; 4],
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
        direction: [&[f64]; 4],
        dlambda: f64,
    ) -> Gradient {
        let mut gradient = Gradient::zeros(self.sizes());
        self.mode_gradient_along_into(q, u, b, phi, lambda, direction, dlambda, &mut gradient);
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
        self.pencil_gradient_along_into(q, u, b, vectors, direction, changes, &mut gradient);
        gradient
    }
    /// Derivatives of [`Kernels::output_partials_into`](crate::Kernels::output_partials_into) along `dq`, `du`, `db`.
    pub fn output_partials_along(&self, q: &[f64], u: &[f64], b: &[f64], direction: [&[f64]; 3]) -> [Matrix; 3] {
        let mut partials = output_partials_zeros(self.sizes());
        self.output_partials_along_into(q, u, b, direction, partials.each_mut());
        partials
    }
}
