//! Some batches of samples, through each stage together.

use super::{Prepared, Sums};
use crate::Mechanism;
use crate::lanes::{Batch, Store, Task, Vector, WIDTH};
use crate::tolerance::sampling::Bits;

/// Steps of Newton's method; one does where second derivatives predict the equilibrium well.
const STEPS: usize = 6;
/// Batches that go through each stage together: a stage waits for its own results most of the time, and meanwhile the
/// processor can work on the next batch.
pub(in crate::tolerance) const TOGETHER: usize = 4;

/// Samples of one batch.
pub(in crate::tolerance) struct Solved<const N: usize, const P: usize> {
    pub(in crate::tolerance) design: [Batch; P],
    pub(in crate::tolerance) coordinates: [Batch; N],
    pub(in crate::tolerance) frequencies: [Batch; N],
    /// Bit `k`: sample `k` passed every check. Of others only the design means anything.
    pub(in crate::tolerance) accepted: u32,
    /// Random bits, by pair of design variables.
    pub(in crate::tolerance) bits: [[Bits; 2]; P],
    /// How many of them are samples.
    pub(in crate::tolerance) members: usize,
    /// One for those that passed every check so far.
    pub(super) flags: Batch,
    /// One for those at whose equilibrium Newton's method came to rest.
    pub(super) resting: Batch,
    pub(super) residual: [Batch; N],
    /// In coordinates on the way to the equilibrium, between the nominal modes there.
    pub(super) stiffness: [[Batch; N]; N],
    pub(super) mass: [[Batch; N]; N],
}

impl<const N: usize, const P: usize> Solved<N, P> {
    pub(in crate::tolerance) const fn new() -> Self {
        Self {
            design: [Batch([0.0; WIDTH]); P],
            coordinates: [Batch([0.0; WIDTH]); N],
            frequencies: [Batch([0.0; WIDTH]); N],
            accepted: 0,
            bits: [[[0; WIDTH]; 2]; P],
            members: 0,
            flags: Batch([0.0; WIDTH]),
            resting: Batch([0.0; WIDTH]),
            residual: [Batch([0.0; WIDTH]); N],
            stiffness: [[Batch([0.0; WIDTH]); N]; N],
            mass: [[Batch([0.0; WIDTH]); N]; N],
        }
    }
}

impl<M, const N: usize, const U: usize, const P: usize, const O: usize> Prepared<'_, M, N, U, P, O>
where
    M: Mechanism<N, U, P, O>,
{
    /// Solves the members of some batches from their random bits, and adds them to `sums`.
    pub(in crate::tolerance) fn solve(&self, batches: &mut [Solved<N, P>], sums: &mut Sums<N>) {
        self.instructions.run(Work {
            prepared: self,
            batches,
            sums,
        });
    }
}

struct Work<'a, M, const N: usize, const U: usize, const P: usize, const O: usize> {
    prepared: &'a Prepared<'a, M, N, U, P, O>,
    batches: &'a mut [Solved<N, P>],
    sums: &'a mut Sums<N>,
}

impl<M, const N: usize, const U: usize, const P: usize, const O: usize> Task
    for Work<'_, M, N, U, P, O>
where
    M: Mechanism<N, U, P, O>,
{
    type Output = ();

    #[inline(always)]
    fn run<V: Vector>(self) {
        let Self {
            prepared,
            batches,
            sums,
        } = self;
        let one = V::constant(1.0);
        for batch in &mut *batches {
            for at in (0..batch.members).step_by(V::WIDTH) {
                let design: [V; P] = prepared.draw(&batch.bits, at);
                batch.design.store(&design, at);
                batch.coordinates.store(&prepared.predicted(&design), at);
            }
            batch.resting = Batch([0.0; WIDTH]);
            let all = prepared.all_possible && batch.members == WIDTH;
            batch.flags = if all {
                Batch::all(1.0)
            } else {
                prepared.possible(&batch.design, batch.members)
            };
        }
        for _ in 0..STEPS {
            let mut moving = false;
            for batch in &mut *batches {
                for at in (0..batch.members).step_by(V::WIDTH) {
                    if !rests::<V, N, P>(batch, at) {
                        moving = true;
                        prepared.evaluate::<V>(batch, at);
                    }
                }
            }
            if !moving {
                break;
            }
            for batch in &mut *batches {
                for at in (0..batch.members).step_by(V::WIDTH) {
                    if !rests::<V, N, P>(batch, at) {
                        prepared.improve::<V>(batch, at);
                    }
                }
            }
        }
        for batch in &mut *batches {
            for at in (0..batch.members).step_by(V::WIDTH) {
                prepared.matrices::<V>(batch, at);
            }
        }
        for batch in &mut *batches {
            batch.accepted = 0;
            for at in (0..batch.members).step_by(V::WIDTH) {
                let (lambda, flag) = prepared.modes::<V>(batch, at);
                for (r, lambda) in lambda.into_iter().enumerate() {
                    let frequency = lambda.sqrt();
                    frequency.store(&mut batch.frequencies[r], at);
                    let nominal = V::constant(prepared.frequencies[r]);
                    sums.add(r, at, frequency - nominal, flag);
                }
                let accepted = V::bits(one.at_most(flag));
                sums.count(accepted.count_ones());
                batch.accepted |= accepted << at;
            }
        }
    }
}

/// Whether all of these samples have come to rest.
#[inline(always)]
fn rests<V: Vector, const N: usize, const P: usize>(batch: &Solved<N, P>, at: usize) -> bool {
    V::every(V::constant(1.0).at_most(V::load(&batch.resting, at)))
}
