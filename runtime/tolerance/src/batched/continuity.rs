//! Checks that the states of a block continue the preceding path, each compared with the three states before it.

use super::algebra::keep;
use super::block::Block;
use crate::equilibrium::{MISSED, Path, STILL};
use crate::scalar::{Batch, Lanes, Task, WIDTH};

/// Keeps the flags of lanes whose state is close to the parabola through the three states before it, much closer than
/// to the last of them: the vector form of [`confirmed`](crate::equilibrium::confirmed).
pub(super) struct Continuity<'a, 'b> {
    pub(super) path: &'a Path,
    pub(super) block: &'a mut Block<'b>,
}

impl Task for Continuity<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn run<V: Lanes>(self) {
        let Self { path, block } = self;
        let n = block.coordinates.len();
        let values = before(&block.values, three_of(|ago| path.values()[ago]));
        for at in (0..WIDTH).step_by(V::WIDTH) {
            let u = V::load(&block.values, at);
            let [u0, u1, u2] = three::<V>(&values, at);
            let (first, second) = (u - u0, u - u1);
            let (one, zero) = (V::constant(1.0), V::constant(0.0));
            let (step, earlier, both) = (one / (u0 - u1), one / (u1 - u2), one / (u0 - u2));
            let (mut missed, mut moved, mut size) = (zero, zero, one);
            for i in 0..n {
                let q = V::load(&block.coordinates[i], at);
                let states = before(&block.coordinates[i], three_of(|ago| path.state(ago, i)));
                let [q0, q1, q2] = three::<V>(&states, at);
                let slope = (q0 - q1) * step;
                let bend = (slope - (q1 - q2) * earlier) * both;
                let predicted = q0 + first * (slope + second * bend);
                missed = greater(missed, (q - predicted).abs());
                moved = greater(moved, (q - q0).abs());
                size = greater(size, q.abs());
            }
            let allowed = V::constant(MISSED) * moved + V::constant(STILL) * size;
            keep(V::load(&block.flags, at), missed.at_most(allowed)).store(&mut block.flags, at);
        }
    }
}

/// What was one, two and three states ago, without a function call for each.
#[inline(always)]
fn three_of(of: impl Fn(usize) -> f64) -> [f64; 3] {
    [of(0), of(1), of(2)]
}

/// The values one, two and three positions before each one of a batch; before the first, those of the past, latest
/// first.
#[inline(always)]
fn before(batch: &Batch, past: [f64; 3]) -> [Batch; 3] {
    let mut places = [Batch::default(); 3];
    for (by, places) in (1..).zip(&mut places) {
        for k in 0..WIDTH {
            places.0[k] = if k < by { past[by - 1 - k] } else { batch.0[k - by] };
        }
    }
    places
}

#[inline(always)]
fn three<V: Lanes>(batches: &[Batch; 3], at: usize) -> [V; 3] {
    let mut vectors = [V::constant(0.0); 3];
    for (vector, batch) in vectors.iter_mut().zip(batches) {
        *vector = V::load(batch, at);
    }
    vectors
}

/// The greater of two; NaN is kept.
#[inline(always)]
fn greater<V: Lanes>(a: V, b: V) -> V {
    V::choose(b.at_most(a), a, b)
}
