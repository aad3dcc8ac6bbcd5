//! Workspace.

use num_complex::Complex64;

use super::measure::Pair;

/// Buffers of numbers of each type, taken from the front.
pub(super) struct Work {
    pub(super) real: Vec<f64>,
    pub(super) complex: Vec<Complex64>,
    pub(super) indices: Vec<usize>,
    pub(super) flags: Vec<bool>,
    pub(super) pairs: Vec<Pair>,
}

impl Work {
    /// The workspace for `n` coordinates.
    pub(super) fn new(n: usize) -> Self {
        Self {
            real: vec![0.0; (17 * n + 18) * n],
            complex: vec![Complex64::ZERO; (12 * n + 11) * n],
            indices: vec![0; 6 * n],
            flags: vec![false; 4 * n],
            pairs: vec![Pair::NONE; 2 * n],
        }
    }
}

/// Takes the next `count` numbers of a buffer.
pub(super) fn take<'a, T>(store: &mut &'a mut [T], count: usize) -> &'a mut [T] {
    let (taken, rest) = std::mem::take(store).split_at_mut(count);
    *store = rest;
    taken
}
