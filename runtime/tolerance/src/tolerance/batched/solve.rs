//! Takes several batches of samples through each stage together.

use super::samples::SampleBatch;
use super::statics::Statics;
use super::{TaylorModel, equilibrium, modes, stages};
use crate::batched::algebra::for_size_up_to;
use crate::eigenproblem::Reference;
use crate::kernels::BatchPoint;
use crate::scalar::{Batch, Instructions, Lanes, Task, WIDTH};

/// Maximum number of Newton steps; one is enough if second derivatives predict the equilibrium well.
const STEPS: usize = 6;
/// Batches that go through each stage together: a stage waits for its own results most of the time, and meanwhile the
/// processor can work on the next batch.
pub(in crate::tolerance) const TOGETHER: usize = 4;

impl<const N: usize> TaylorModel<'_, N> {
    /// Solves the members of several batches from their random bits.
    pub(super) fn solve(&self, instructions: Instructions, batches: &mut [SampleBatch<'_>]) {
        instructions.run(Equilibria { prepared: self, instructions, batches });
        if let Some(reference) = &self.reference {
            instructions.run(GeneralModes { prepared: self, reference, batches });
        }
        for group in &self.groups {
            for batch in &mut *batches {
                batch.put_in_order(group);
            }
        }
    }

    fn point<'b>(&'b self, coordinates: &'b [Batch], design: &'b [Batch]) -> BatchPoint<'b> {
        BatchPoint { q: coordinates, u: &self.inputs, b: design }
    }
}

/// Equilibria, and undamped modes if no others are wanted.
struct Equilibria<'a, 'b, const N: usize> {
    prepared: &'a TaylorModel<'a, N>,
    instructions: Instructions,
    batches: &'a mut [SampleBatch<'b>],
}

impl<const N: usize> Task for Equilibria<'_, '_, N> {
    type Output = ();

    #[inline(always)]
    fn run<V: Lanes>(self) {
        let Self { prepared, instructions, batches } = self;
        for_size_up_to::<N>(
            prepared.nominal.coordinates.len(),
            #[inline(always)]
            |n| solve_equilibria::<V, N>(n, (prepared, instructions), batches),
        );
    }
}

#[inline(always)]
fn solve_equilibria<V: Lanes, const N: usize>(
    n: usize,
    (prepared, instructions): (&TaylorModel<'_, N>, Instructions),
    batches: &mut [SampleBatch<'_>],
) {
    for batch in &mut *batches {
        for at in (0..WIDTH).step_by(V::WIDTH) {
            stages::draw::<V, N>(prepared, batch, at);
        }
        stages::distribute(prepared, batch.design);
        for at in (0..WIDTH).step_by(V::WIDTH) {
            stages::predict::<V, N>(n, prepared, batch, at);
        }
        batch.resting = Batch::all(0.0);
        let all = prepared.all_possible && batch.members == WIDTH;
        batch.flags = if all { Batch::all(1.0) } else { stages::possible(prepared, batch.design, batch.members) };
    }
    for _ in 0..STEPS {
        let mut moving = false;
        for batch in &mut *batches {
            if !batch.rests() {
                moving = true;
                let point = prepared.point(batch.coordinates, batch.design);
                prepared.kernels.residual_and_stiffness_batch(instructions, point, batch.residual, batch.stiffness);
            }
        }
        if !moving {
            break;
        }
        for batch in &mut *batches {
            if !batch.rests() {
                for at in (0..WIDTH).step_by(V::WIDTH) {
                    equilibrium::newton_step::<V, N>(n, prepared, batch, at);
                }
            }
        }
    }
    for batch in &mut *batches {
        let point = prepared.point(batch.coordinates, batch.design);
        let linear = &mut batch.linear;
        prepared.kernels.linear_batch(instructions, point, linear);
        match &prepared.statics {
            Statics::Potential(potential) => {
                for at in (0..WIDTH).step_by(V::WIDTH) {
                    equilibrium::between_modes::<V, N>(n, potential, batch, at);
                }
            }
            Statics::Forces(_) => equilibrium::nominal_stiffness(prepared, instructions, batch),
        }
    }
    for batch in &mut *batches {
        for at in (0..WIDTH).step_by(V::WIDTH) {
            let mut flag = equilibrium::continues_nominal::<V, N>(n, prepared, batch, at);
            if let (None, Statics::Potential(potential)) = (&prepared.reference, &prepared.statics) {
                flag = modes::undamped::<V, N>(n, potential, batch, flag, at);
            }
            flag.store(&mut batch.flags, at);
        }
        batch.accept();
    }
}

/// Modes by the nominal pairs, for any number of unknowns: they involve so much arithmetic that the loops do not
/// matter.
struct GeneralModes<'a, 'b, const N: usize> {
    prepared: &'a TaylorModel<'a, N>,
    reference: &'a Reference,
    batches: &'a mut [SampleBatch<'b>],
}

impl<const N: usize> Task for GeneralModes<'_, '_, N> {
    type Output = ();

    #[inline(always)]
    fn run<V: Lanes>(self) {
        let nominal = (self.prepared, self.reference);
        let n = self.prepared.nominal.coordinates.len().min(N);
        for batch in self.batches {
            for at in (0..WIDTH).step_by(V::WIDTH) {
                modes::general::<V, N>(n, nominal, batch, at);
            }
            batch.accept();
        }
    }
}
