//! Derivatives of kernels along a direction, for second derivatives: the kernels in dual numbers.

use super::{Directional, Gradient, Kernels, Linear, gradient_results, linear_results};

/// The kernels with a derivative along a direction.
pub trait DirectionalKernels: Kernels {
    /// Derivative of the results of a kernel along a direction, which has a list for each argument.
    fn evaluate_along(
        &self,
        kernel: Directional,
        arguments: &[&[f64]],
        direction: &[&[f64]],
        results: &mut [&mut [f64]],
    );

    /// [`Mechanism::linear_along`](eigentol_contract::Mechanism::linear_along); `direction` is `dq`, `du`, `db`.
    fn linear_along_into(&self, q: &[f64], u: &[f64], b: &[f64], direction: [&[f64]; 3], linear: &mut Linear) {
        let results = &mut linear_results(linear);
        self.evaluate_along(Directional::Linear, &[q, u, b], &direction, results);
    }

    /// [`Mechanism::residual_gradient_along`](eigentol_contract::Mechanism::residual_gradient_along); `direction` is
    /// `dq`, `du`,
    /// `db`, `dw`.
    fn residual_gradient_along_into(
        &self,
        q: &[f64],
        u: &[f64],
        b: &[f64],
        w: &[f64],
        direction: [&[f64]; 4],
        gradient: &mut Gradient,
    ) {
        let results = &mut gradient_results(gradient);
        let kernel = Directional::ResidualGradient;
        self.evaluate_along(kernel, &[q, u, b, w], &direction, results);
    }

    /// [`Self::evaluate_along`] of a gradient at several points with a direction each, with the same results as one by one.
    fn evaluate_along_each(&self, kernel: Directional, points: &[[&[&[f64]]; 2]], gradients: &mut [Gradient]) {
        for ([arguments, direction], gradient) in points.iter().zip(gradients) {
            self.evaluate_along(kernel, arguments, direction, &mut gradient_results(gradient));
        }
    }
}

impl dyn DirectionalKernels + '_ {
    /// Derivative of `Mhat`, `Chat` and `Khat` along `dq`, `du`, `db`.
    pub fn linear_along(&self, q: &[f64], u: &[f64], b: &[f64], direction: [&[f64]; 3]) -> Linear {
        let mut linear = Linear::zeros(q.len());
        self.linear_along_into(q, u, b, direction, &mut linear);
        linear
    }

    /// Derivative of [`Kernels::residual_gradient_into`] along `dq`, `du`, `db`, `dw`.
    pub fn residual_gradient_along(
        &self,
        q: &[f64],
        u: &[f64],
        b: &[f64],
        w: &[f64],
        direction: [&[f64]; 4],
    ) -> Gradient {
        let mut gradient = Gradient::zeros(self.sizes());
        self.residual_gradient_along_into(q, u, b, w, direction, &mut gradient);
        gradient
    }
}
