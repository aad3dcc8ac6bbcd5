//! Partial derivatives of the linearised matrices, as kernels write them.

use core::iter::repeat_n;
use core::ops::Range;

use super::{Linear, LinearPartials, Sizes};
use crate::algebra::Matrix;
use crate::mechanism;

/// Partial derivatives of the linearised matrices with respect to every coordinate, input and design variable, in one
/// block.
#[derive(Clone, Debug, PartialEq)]
pub struct PartialMatrices {
    sizes: Sizes,
    /// `Mhat`, `Chat` and `Khat` for each variable, row by row.
    entries: Vec<f64>,
}

impl PartialMatrices {
    /// Zeros.
    #[must_use]
    pub fn zeros(sizes: Sizes) -> Self {
        let variables = sizes.coordinates + sizes.inputs + sizes.design;
        Self { sizes, entries: repeat_n(0.0, variables * entries_of(sizes.coordinates)).collect() }
    }

    /// Converts to lists of matrices.
    #[must_use]
    pub fn to_lists(&self) -> LinearPartials {
        LinearPartials {
            by_coordinate: self.matrices(self.by_coordinate()).collect(),
            by_input: self.matrices(self.by_input()).collect(),
            by_design: self.matrices(self.by_design()).collect(),
        }
    }

    /// Converts some of the derivatives to matrices.
    pub(crate) fn matrices<'a>(&self, changes: &'a [f64]) -> impl ExactSizeIterator<Item = Linear> + use<'a> {
        let n = self.sizes.coordinates;
        let matrix = move |entries: &[f64]| Matrix::from_fn(n, n, |i, j| entries[i * n + j]);
        changes.chunks_exact(entries_of(n).max(1)).map(move |change| parts(change).map(matrix))
    }

    /// The derivatives with respect to the coordinates, one after the other, each as in [`parts`].
    #[inline]
    pub(crate) fn by_coordinate(&self) -> &[f64] {
        self.of(0..self.sizes.coordinates)
    }

    /// The derivatives with respect to the inputs.
    #[inline]
    pub(crate) fn by_input(&self) -> &[f64] {
        let first = self.sizes.coordinates;
        self.of(first..first + self.sizes.inputs)
    }

    /// The derivatives with respect to the design variables.
    #[inline]
    pub(crate) fn by_design(&self) -> &[f64] {
        let first = self.sizes.coordinates + self.sizes.inputs;
        self.of(first..first + self.sizes.design)
    }

    #[inline]
    fn of(&self, variables: Range<usize>) -> &[f64] {
        let each = entries_of(self.sizes.coordinates);
        &self.entries[variables.start * each..variables.end * each]
    }

    /// All three blocks.
    #[inline]
    pub(crate) fn lists(&self) -> [&[f64]; 3] {
        [self.by_coordinate(), self.by_input(), self.by_design()]
    }

    /// Elements of the derivatives of `Khat` below the diagonal become the mean of both.
    pub(crate) fn symmetrise_stiffness(&mut self) {
        let n = self.sizes.coordinates;
        for change in self.iter_mut() {
            for (i, j) in (0..n).flat_map(|i| (0..i).map(move |j| (i, j))) {
                change.stiffness[i * n + j] = 0.5 * (change.stiffness[i * n + j] + change.stiffness[j * n + i]);
            }
        }
    }

    /// All three blocks, mutable.
    #[inline]
    pub(crate) fn lists_mut(&mut self) -> [&mut [f64]; 3] {
        let each = entries_of(self.sizes.coordinates);
        let (by_coordinate, rest) = self.entries.split_at_mut(self.sizes.coordinates * each);
        let (by_input, by_design) = rest.split_at_mut(self.sizes.inputs * each);
        [by_coordinate, by_input, by_design]
    }

    /// The derivatives with respect to each variable: coordinates first, then inputs, then design variables; each
    /// matrix row by row.
    #[inline]
    pub fn iter_mut(&mut self) -> impl ExactSizeIterator<Item = mechanism::Linear<&mut [f64]>> {
        let each = entries_of(self.sizes.coordinates);
        self.entries.chunks_exact_mut(each.max(1)).map(move |change| {
            let (mass, rest) = change.split_at_mut(each / 3);
            let (damping, stiffness) = rest.split_at_mut(each / 3);
            mechanism::Linear { mass, damping, stiffness }
        })
    }
}

/// Number of entries of three matrices of size `n`.
#[inline(always)]
pub(crate) fn entries_of(n: usize) -> usize {
    3 * n * n
}

/// The derivatives of the three matrices with respect to one variable, row by row.
#[inline(always)]
pub(crate) fn parts(change: &[f64]) -> mechanism::Linear<&[f64]> {
    let size = change.len() / 3;
    mechanism::Linear {
        mass: &change[..size],
        damping: &change[size..2 * size],
        stiffness: &change[2 * size..3 * size],
    }
}
