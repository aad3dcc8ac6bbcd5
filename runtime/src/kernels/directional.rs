//! Derivatives of kernels along a direction: the kernels in dual numbers. Second derivatives need them.

use super::{Gradient, Kernels, Linear};

/// The kernels that have a derivative along a direction.
pub trait DirectionalKernels: Kernels {
    /// [`Mechanism::linear_along`](crate::Mechanism::linear_along); `direction` is `dq`, `du`, `db`.
    fn linear_along_into(
        &self,
        q: &[f64],
        u: &[f64],
        b: &[f64],
        direction: [&[f64]; 3],
        linear: &mut Linear,
    );

    /// [`Mechanism::mode_gradient_along`](crate::Mechanism::mode_gradient_along); `direction` is `dq`, `du`, `db`, `dphi`.
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

    /// [`Mechanism::pencil_gradient_along`](crate::Mechanism::pencil_gradient_along); `direction` is `dq`, `du`, `db`, and
    /// `changes` that of `vectors`.
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

    /// [`Mechanism::residual_gradient_along`](crate::Mechanism::residual_gradient_along); `direction` is `dq`, `du`, `db`, `dw`.
    fn residual_gradient_along_into(
        &self,
        q: &[f64],
        u: &[f64],
        b: &[f64],
        w: &[f64],
        direction: [&[f64]; 4],
        gradient: &mut Gradient,
    );
}

impl dyn DirectionalKernels + '_ {
    /// Derivative of `Mhat`, `Chat` and `Khat` along `dq`, `du`, `db`.
    pub fn linear_along(&self, q: &[f64], u: &[f64], b: &[f64], direction: [&[f64]; 3]) -> Linear {
        let mut linear = Linear::zeros(q.len());
        self.linear_along_into(q, u, b, direction, &mut linear);
        linear
    }

    /// Derivative of [`Kernels::mode_gradient_into`] along `dq`, `du`, `db`, `dphi` and `dlambda`.
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

    /// Derivative of [`Kernels::pencil_gradient_into`] along `dq`, `du`, `db`, and `changes` of the vectors.
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
