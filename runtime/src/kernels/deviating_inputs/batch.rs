//! The kernels for several states at once.

use super::DeviatingInputs;
use crate::algebra::{Matrix, Vector};
use crate::kernels::{
    BatchKernels, BatchPoint, Gradient, Linear, LinearPartials, ResidualPartials, RestParts,
};
use crate::scalar::{Batch, Instructions};

/// What the mechanism gets.
struct Applied<'a> {
    q: &'a [Batch],
    u: Vector<Batch>,
    b: &'a [Batch],
}

impl Applied<'_> {
    fn point(&self) -> BatchPoint<'_> {
        BatchPoint {
            q: self.q,
            u: &self.u,
            b: self.b,
        }
    }
}

impl<K: ?Sized> DeviatingInputs<'_, K> {
    fn applied_batch<'a>(&self, at: BatchPoint<'a>) -> Applied<'a> {
        let sum = |a: Batch, b: Batch| Batch::from_fn(|state| a.0[state] + b.0[state]);
        let (u, b) = self.deviations.applied(at.u, at.b, sum);
        Applied { q: at.q, u, b }
    }
}

impl<K: BatchKernels + ?Sized> BatchKernels for DeviatingInputs<'_, K> {
    fn residual_and_stiffness_batch(
        &self,
        instructions: Instructions,
        at: BatchPoint<'_>,
        residual: &mut [Batch],
        stiffness: &mut Matrix<Batch>,
    ) {
        let at = self.applied_batch(at);
        self.kernels
            .residual_and_stiffness_batch(instructions, at.point(), residual, stiffness);
    }

    fn linear_batch(
        &self,
        instructions: Instructions,
        at: BatchPoint<'_>,
        linear: &mut Linear<Batch>,
    ) {
        let at = self.applied_batch(at);
        self.kernels.linear_batch(instructions, at.point(), linear);
    }

    fn parts_and_linear_batch(
        &self,
        instructions: Instructions,
        at: BatchPoint<'_>,
        parts: &mut RestParts<Batch>,
        linear: &mut Linear<Batch>,
    ) {
        let at = self.applied_batch(at);
        self.kernels
            .parts_and_linear_batch(instructions, at.point(), parts, linear);
    }

    fn partials_batch(
        &self,
        instructions: Instructions,
        at: BatchPoint<'_>,
        matrices: &mut LinearPartials<Batch>,
        residual: &mut ResidualPartials<Batch>,
    ) {
        let at = self.applied_batch(at);
        self.deviations.linear_partials(matrices, |matrices| {
            self.deviations.residual_partials(residual, |residual| {
                self.kernels
                    .partials_batch(instructions, at.point(), matrices, residual);
            });
        });
    }

    fn mode_gradient_batch(
        &self,
        instructions: Instructions,
        at: BatchPoint<'_>,
        phi: &[Batch],
        lambda: &Batch,
        gradient: &mut Gradient<Batch>,
    ) {
        let at = self.applied_batch(at);
        self.deviations.gradient(gradient, |gradient| {
            self.kernels
                .mode_gradient_batch(instructions, at.point(), phi, lambda, gradient);
        });
    }

    fn residual_gradient_batch(
        &self,
        instructions: Instructions,
        at: BatchPoint<'_>,
        w: &[Batch],
        gradient: &mut Gradient<Batch>,
    ) {
        let at = self.applied_batch(at);
        self.deviations.gradient(gradient, |gradient| {
            self.kernels
                .residual_gradient_batch(instructions, at.point(), w, gradient);
        });
    }
}
