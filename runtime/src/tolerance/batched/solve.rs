//! Some batches of samples, through each stage together.

use super::TaylorModel;
use super::samples::Solved;
use super::stages;
use crate::batched::algebra::for_size;
use crate::kernels::BatchPoint;
use crate::scalar::{Batch, Lanes, Task, WIDTH};

/// Steps of Newton's method; one does where second derivatives predict the equilibrium well.
const STEPS: usize = 6;
/// Batches that go through each stage together: a stage waits for its own results most of the time, and meanwhile the
/// processor can work on the next batch.
pub(in crate::tolerance) const TOGETHER: usize = 4;

impl TaylorModel<'_> {
    /// Solves the members of some batches from their random bits.
    pub(in crate::tolerance) fn solve(&self, batches: &mut [Solved<'_>]) {
        self.instructions.run(Work {
            prepared: self,
            batches,
        });
    }

    fn point<'b>(&'b self, coordinates: &'b [Batch], design: &'b [Batch]) -> BatchPoint<'b> {
        BatchPoint {
            q: coordinates,
            u: &self.inputs,
            b: design,
        }
    }
}

struct Work<'a, 'b> {
    prepared: &'a TaylorModel<'a>,
    batches: &'a mut [Solved<'b>],
}

impl Task for Work<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn run<V: Lanes>(self) {
        let Self { prepared, batches } = self;
        for_size(
            prepared.nominal.coordinates.len(),
            #[inline(always)]
            |n| through::<V>(n, prepared, batches),
        );
    }
}

#[inline(always)]
fn through<V: Lanes>(n: usize, prepared: &TaylorModel<'_>, batches: &mut [Solved<'_>]) {
    let one = V::constant(1.0);
    for batch in &mut *batches {
        for at in (0..WIDTH).step_by(V::WIDTH) {
            stages::draw::<V>(prepared, batch, at);
        }
        stages::distribute(prepared, batch.design);
        for at in (0..WIDTH).step_by(V::WIDTH) {
            stages::predict::<V>(n, prepared, batch, at);
        }
        batch.resting = Batch::all(0.0);
        let all = prepared.all_possible && batch.members == WIDTH;
        batch.flags = if all {
            Batch::all(1.0)
        } else {
            stages::possible(prepared, batch.design, batch.members)
        };
    }
    for _ in 0..STEPS {
        let mut moving = false;
        for batch in &mut *batches {
            if !batch.rests() {
                moving = true;
                let point = prepared.point(batch.coordinates, batch.design);
                prepared.kernels.residual_and_stiffness_batch(
                    prepared.instructions,
                    point,
                    batch.residual,
                    batch.stiffness,
                );
            }
        }
        if !moving {
            break;
        }
        for batch in &mut *batches {
            if !batch.rests() {
                for at in (0..WIDTH).step_by(V::WIDTH) {
                    stages::improve::<V>(n, prepared, batch, at);
                }
            }
        }
    }
    for batch in &mut *batches {
        let point = prepared.point(batch.coordinates, batch.design);
        let linear = &mut batch.linear;
        prepared
            .kernels
            .linear_batch(prepared.instructions, point, linear);
        for at in (0..WIDTH).step_by(V::WIDTH) {
            stages::between_modes::<V>(n, prepared, batch, at);
        }
    }
    for batch in &mut *batches {
        batch.accepted = 0;
        let members = (1_u32 << batch.members) - 1;
        for at in (0..WIDTH).step_by(V::WIDTH) {
            let (lambda, flag) = stages::modes::<V>(n, prepared, batch, at);
            let frequencies = &mut batch.frequencies[..n];
            for r in 0..n {
                lambda[r].sqrt().store(&mut frequencies[r], at);
            }
            let accepted = V::bits(one.at_most(flag));
            batch.accepted |= accepted << at;
        }
        batch.accepted &= members;
    }
}
