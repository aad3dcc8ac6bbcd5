//! The kernels for several states at once.

use super::DeviatingInputs;
use super::deviations::Deviations;
use crate::algebra::Vector;
use crate::kernels::{BatchGradient, BatchKernels, BatchLinear, BatchPartials, BatchParts, BatchPoint};
use crate::scalar::{Batch, Instructions};

/// The arguments passed to the mechanism.
struct Applied<'a> {
    q: &'a [Batch],
    u: Vector<Batch>,
    b: &'a [Batch],
}

impl Applied<'_> {
    fn point(&self) -> BatchPoint<'_> {
        BatchPoint { q: self.q, u: &self.u, b: self.b }
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
        stiffness: &mut [Batch],
    ) {
        let at = self.applied_batch(at);
        self.kernels.residual_and_stiffness_batch(instructions, at.point(), residual, stiffness);
    }

    fn linear_batch(&self, instructions: Instructions, at: BatchPoint<'_>, linear: &mut BatchLinear<'_>) {
        let at = self.applied_batch(at);
        self.kernels.linear_batch(instructions, at.point(), linear);
    }

    fn parts_and_linear_batch(
        &self,
        instructions: Instructions,
        at: BatchPoint<'_>,
        parts: &mut BatchParts<'_>,
        linear: &mut BatchLinear<'_>,
    ) {
        let at = self.applied_batch(at);
        self.kernels.parts_and_linear_batch(instructions, at.point(), parts, linear);
    }

    fn partials_batch(
        &self,
        instructions: Instructions,
        at: BatchPoint<'_>,
        matrices: &mut BatchPartials<'_>,
        [by_input, by_design]: [&mut [Batch]; 2],
    ) {
        let n = at.q.len();
        let at = self.applied_batch(at);
        let mut residual: Vec<Batch> = self.deviations.narrow(by_design.len());
        self.deviations.batch_partials(n * n, matrices, |matrices| {
            let residual = [&mut *by_input, &mut residual[..]];
            self.kernels.partials_batch(instructions, at.point(), matrices, residual);
        });
        self.deviations.join_rows(by_design, by_input, &residual);
    }

    fn mode_gradient_batch(
        &self,
        instructions: Instructions,
        at: BatchPoint<'_>,
        phi: &[Batch],
        lambda: &Batch,
        gradient: &mut BatchGradient<'_>,
    ) {
        let at = self.applied_batch(at);
        self.deviations.batch_gradient(gradient, |gradient| {
            self.kernels.mode_gradient_batch(instructions, at.point(), phi, lambda, gradient);
        });
    }

    fn residual_gradient_batch(
        &self,
        instructions: Instructions,
        at: BatchPoint<'_>,
        w: &[Batch],
        gradient: &mut BatchGradient<'_>,
    ) {
        let at = self.applied_batch(at);
        self.deviations.batch_gradient(gradient, |gradient| {
            self.kernels.residual_gradient_batch(instructions, at.point(), w, gradient);
        });
    }
}

impl Deviations {
    /// Converts a gradient of the mechanism.
    fn batch_gradient(&self, gradient: &mut BatchGradient<'_>, kernel: impl FnOnce(&mut BatchGradient<'_>)) {
        let (by_design, deviations) = gradient.design.split_at_mut(self.design());
        kernel(&mut BatchGradient {
            coordinates: &mut *gradient.coordinates,
            inputs: &mut *gradient.inputs,
            design: by_design,
        });
        for (to, &input) in deviations.iter_mut().zip(self.inputs()) {
            *to = gradient.inputs[input];
        }
    }

    /// Converts derivatives of matrices with the given number of entries.
    fn batch_partials(
        &self,
        entries: usize,
        partials: &mut BatchPartials<'_>,
        kernel: impl FnOnce(&mut BatchPartials<'_>),
    ) {
        fn again<'b>(of: &'b mut BatchLinear<'_>) -> BatchLinear<'b> {
            BatchLinear { mass: &mut *of.mass, damping: &mut *of.damping, stiffness: &mut *of.stiffness }
        }
        let design = self.design() * entries;
        let by_design = &mut partials.by_design;
        let (mass, mass_deviations) = by_design.mass.split_at_mut(design);
        let (stiffness, stiffness_deviations) = by_design.stiffness.split_at_mut(design);
        // A damping matrix that is always zero has no buffer.
        let damping = design.min(by_design.damping.len());
        let (damping, damping_deviations) = by_design.damping.split_at_mut(damping);
        kernel(&mut BatchPartials {
            by_coordinate: again(&mut partials.by_coordinate),
            by_input: again(&mut partials.by_input),
            by_design: BatchLinear { mass, damping, stiffness },
        });
        let by_input = &partials.by_input;
        for (to, from) in [
            (mass_deviations, &*by_input.mass),
            (damping_deviations, &*by_input.damping),
            (stiffness_deviations, &*by_input.stiffness),
        ] {
            for (to, &input) in to.chunks_exact_mut(entries.max(1)).zip(self.inputs()) {
                to.copy_from_slice(&from[input * entries..][..entries]);
            }
        }
    }
}
