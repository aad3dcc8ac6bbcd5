//! Derivatives of the gradients of modes and outputs along a direction, as needed for second derivatives. They are
//! long, and few callers need them: only those that do compile them.

use super::{DirectionalKernels, Gradient, output_partials_zeros};
use crate::algebra::Matrix;

/// Gradients of modes and outputs in dual numbers.
pub trait CurvatureKernels: DirectionalKernels {
    /// [`Mechanism::mode_gradient_along`](eigentol_contract::Mechanism::mode_gradient_along); `direction` is `dq`,
    /// `du`, `db`,
    /// `dphi`.
    #[allow(clippy::too_many_arguments)]
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
    );

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

    /// [`Mechanism::pencil_gradient_along`](eigentol_contract::Mechanism::pencil_gradient_along); `direction` is `dq`,
    /// `du`, `db`, and `changes` is the change of `vectors`.
    #[allow(clippy::too_many_arguments)]
    fn pencil_gradient_along_into(
        &self,
        q: &[f64],
        u: &[f64],
        b: &[f64],
        vectors: [&[f64]; 4],
        direction: [&[f64]; 3],
        changes: [&[f64]; 4],
        gradient: &mut Gradient,
    );

    /// [`Mechanism::output_partials_along`](eigentol_contract::Mechanism::output_partials_along); `direction` is `dq`,
    /// `du`, `db`.
    fn output_partials_along_into(
        &self,
        q: &[f64],
        u: &[f64],
        b: &[f64],
        direction: [&[f64]; 3],
        partials: [&mut Matrix; 3],
    );
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
    pub fn output_partials_along(
        &self,
        q: &[f64],
        u: &[f64],
        b: &[f64],
        direction: [&[f64]; 3],
    ) -> [Matrix; 3] {
        let mut partials = output_partials_zeros(self.sizes());
        self.output_partials_along_into(q, u, b, direction, partials.each_mut());
        partials
    }
}
