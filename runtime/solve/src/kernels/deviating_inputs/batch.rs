//! The kernels for several states at once.

use super::DeviatingInputs;
use super::deviations::Deviations;
use crate::kernels::{BatchKernels, BatchLinear, BatchPartials, BatchParts, BatchPoint, Kernel};
use crate::scalar::{Batch, Instructions};

fn sum(a: Batch, b: Batch) -> Batch {
    Batch::from_fn(|state| a.0[state] + b.0[state])
}

impl<K: BatchKernels + ?Sized> BatchKernels for DeviatingInputs<'_, K> {
    fn evaluate_states(
        &self,
        instructions: Instructions,
        kernel: Kernel,
        arguments: &[&[Batch]],
        results: &mut [&mut [Batch]],
    ) {
        let shape = (kernel.arguments(), kernel.results());
        self.deviations.evaluated(sum, [arguments], shape, results, |[arguments], results| {
            self.kernels.evaluate_states(instructions, kernel, arguments, results);
        });
    }

    fn parts_and_linear_batch(
        &self,
        instructions: Instructions,
        at: BatchPoint<'_>,
        parts: &mut BatchParts<'_>,
        linear: &mut BatchLinear<'_>,
    ) {
        let (u, b) = self.deviations.applied(at.u, at.b, sum);
        self.kernels.parts_and_linear_batch(instructions, BatchPoint { q: at.q, u: &u, b }, parts, linear);
    }

    fn partials_batch(
        &self,
        instructions: Instructions,
        at: BatchPoint<'_>,
        matrices: &mut BatchPartials<'_>,
        [by_input, by_design]: [&mut [Batch]; 2],
    ) {
        let n = at.q.len();
        let (u, b) = self.deviations.applied(at.u, at.b, sum);
        let mut residual: Vec<Batch> = self.deviations.narrow(by_design.len());
        self.deviations.batch_partials(n * n, matrices, |matrices| {
            let residual = [&mut *by_input, &mut residual[..]];
            self.kernels.partials_batch(instructions, BatchPoint { q: at.q, u: &u, b }, matrices, residual);
        });
        self.deviations.join_rows(by_design, by_input, &residual);
    }
}

impl Deviations {
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
