//! One number of each of several states, and how results with vectors become results with batches.

use super::Vector;
use crate::{Gradient, Linear, LinearPartials};

/// States in a batch.
pub const WIDTH: usize = 8;

/// One number of each of [`WIDTH`] states, aligned for the widest vector.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(align(64))]
pub struct Batch(pub [f64; WIDTH]);

impl Batch {
    /// The same number for every state.
    pub fn all(value: f64) -> Self {
        Self([value; WIDTH])
    }

    /// `value(k)` for state `k`.
    pub fn from_fn(value: impl FnMut(usize) -> f64) -> Self {
        Self(core::array::from_fn(value))
    }
}

impl Default for Batch {
    fn default() -> Self {
        Self::all(0.0)
    }
}

/// The vectors of the states from `at` on.
#[inline(always)]
pub(crate) fn load<V: Vector, const K: usize>(from: &[Batch; K], at: usize) -> [V; K] {
    let mut vectors = [V::constant(0.0); K];
    for (vector, from) in vectors.iter_mut().zip(from) {
        *vector = V::load(from, at);
    }
    vectors
}

/// The same of a matrix.
#[inline(always)]
#[cfg(feature = "std")]
pub(crate) fn load_matrix<V: Vector, const R: usize, const C: usize>(
    from: &[[Batch; C]; R],
    at: usize,
) -> [[V; C]; R] {
    let mut rows = [[V::constant(0.0); C]; R];
    for (row, from) in rows.iter_mut().zip(from) {
        *row = load(from, at);
    }
    rows
}

/// Writes results for the states from `at` on: the same shape, of vectors here and of batches there.
pub(crate) trait Store<From> {
    fn store(&mut self, from: &From, at: usize);
}

impl<V: Vector, const K: usize> Store<[V; K]> for [Batch; K] {
    #[inline(always)]
    fn store(&mut self, from: &[V; K], at: usize) {
        for (to, from) in self.iter_mut().zip(from) {
            from.store(to, at);
        }
    }
}

impl<V: Vector, const R: usize, const C: usize> Store<[[V; C]; R]> for [[Batch; C]; R] {
    #[inline(always)]
    fn store(&mut self, from: &[[V; C]; R], at: usize) {
        for (to, from) in self.iter_mut().zip(from) {
            to.store(from, at);
        }
    }
}

impl<V: Vector, const N: usize> Store<Linear<V, N>> for Linear<Batch, N> {
    #[inline(always)]
    fn store(&mut self, from: &Linear<V, N>, at: usize) {
        self.mass.store(&from.mass, at);
        self.damping.store(&from.damping, at);
        self.stiffness.store(&from.stiffness, at);
    }
}

impl<V: Vector, const N: usize, const U: usize, const P: usize> Store<Gradient<V, N, U, P>>
    for Gradient<Batch, N, U, P>
{
    #[inline(always)]
    fn store(&mut self, from: &Gradient<V, N, U, P>, at: usize) {
        self.coordinates.store(&from.coordinates, at);
        self.inputs.store(&from.inputs, at);
        self.design.store(&from.design, at);
    }
}

impl<V: Vector, const N: usize, const U: usize, const P: usize> Store<LinearPartials<V, N, U, P>>
    for LinearPartials<Batch, N, U, P>
{
    #[inline(always)]
    fn store(&mut self, from: &LinearPartials<V, N, U, P>, at: usize) {
        each(&mut self.by_coordinate, &from.by_coordinate, at);
        each(&mut self.by_input, &from.by_input, at);
        each(&mut self.by_design, &from.by_design, at);
    }
}

#[inline(always)]
fn each<V: Vector, const N: usize>(to: &mut [Linear<Batch, N>], from: &[Linear<V, N>], at: usize) {
    for (to, from) in to.iter_mut().zip(from) {
        to.store(from, at);
    }
}

impl<A: Store<B>, B, C: Store<D>, D> Store<(B, D)> for (A, C) {
    #[inline(always)]
    fn store(&mut self, from: &(B, D), at: usize) {
        self.0.store(&from.0, at);
        self.1.store(&from.1, at);
    }
}
