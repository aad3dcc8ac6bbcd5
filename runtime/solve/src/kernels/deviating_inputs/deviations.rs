//! The position of deviations among the design variables, and the resulting conversion of arguments and results.

use crate::algebra::Vector;
use crate::kernels::{Extent, PartialMatrices, Shape};

/// Deviations of inputs, which follow the mechanism's own design variables.
#[derive(Debug)]
pub(super) struct Deviations {
    design: usize,
    inputs: Vec<usize>,
}

impl Deviations {
    /// Deviations of these inputs, after the given number of design variables.
    pub(super) fn new(design: usize, inputs: Vec<usize>) -> Self {
        Self { design, inputs }
    }

    /// Number of the mechanism's own design variables.
    pub(super) fn design(&self) -> usize {
        self.design
    }

    /// The input of each deviation.
    pub(super) fn inputs(&self) -> &[usize] {
        &self.inputs
    }

    /// Splits into the mechanism's own design variables and the deviations.
    pub(super) fn split<'b, T>(&self, b: &'b [T]) -> (&'b [T], &'b [T]) {
        b.split_at(self.design)
    }

    /// The inputs and design variables passed to the mechanism; works for directions too.
    pub(super) fn applied<'b, T: Copy + Default>(
        &self,
        u: &[T],
        b: &'b [T],
        sum: impl Fn(T, T) -> T,
    ) -> (Vector<T>, &'b [T]) {
        let (design, deviations) = self.split(b);
        let mut applied = Vector::from(u);
        for (&input, &deviation) in self.inputs.iter().zip(deviations) {
            applied[input] = sum(applied[input], deviation);
        }
        (applied, design)
    }

    /// Calls the mechanism's kernel with lists of arguments, or of their changes, of which the first two are `u` and `b`
    /// after `at` others, and returns results with the derivatives by the deviations.
    pub(super) fn evaluated<T: Copy + Default, const N: usize>(
        &self,
        sum: fn(T, T) -> T,
        lists: [&[&[T]]; N],
        (arguments, shapes): (&[Extent], &[Shape]),
        results: &mut [&mut [T]],
        kernel: impl FnOnce([&[&[T]]; N], &mut [&mut [T]]),
    ) {
        let at = arguments.iter().take_while(|list| **list != Extent::Inputs).count();
        let applied = lists.map(|list| self.applied(list[at], list[at + 1], sum));
        let mut adjusted = lists.map(<[_]>::to_vec);
        for (list, (u, b)) in adjusted.iter_mut().zip(&applied) {
            list[at] = u;
            list[at + 1] = b;
        }
        let adjusted = adjusted.each_ref().map(Vec::as_slice);
        match (shapes, results) {
            ([.., [_, Extent::Design]], [before @ .., by_input, by_design]) => {
                let mut narrow = self.narrow(by_design.len());
                let mut narrowed: Vec<&mut [T]> = before.iter_mut().map(|x| &mut **x).collect();
                narrowed.extend([&mut **by_input, &mut narrow[..]]);
                kernel(adjusted, &mut narrowed);
                self.join_rows(by_design, by_input, &narrow);
            }
            (_, results) => kernel(adjusted, results),
        }
    }

    /// Converts derivatives of the matrices.
    pub(super) fn partial_matrices(&self, narrow: &PartialMatrices, joined: &mut PartialMatrices) {
        let [by_coordinate, by_input, by_design] = joined.lists_mut();
        by_coordinate.copy_from_slice(narrow.by_coordinate());
        by_input.copy_from_slice(narrow.by_input());
        let (design, deviations) = by_design.split_at_mut(narrow.by_design().len());
        design.copy_from_slice(narrow.by_design());
        let size = deviations.len() / self.inputs.len().max(1);
        for (to, &input) in deviations.chunks_exact_mut(size.max(1)).zip(&self.inputs) {
            to.copy_from_slice(&by_input[input * size..][..size]);
        }
    }

    /// Zeros in place of the rows of derivatives by design variables and deviations: those by design variables alone.
    pub(super) fn narrow<T: Copy + Default>(&self, entries: usize) -> Vec<T> {
        vec![T::default(); entries / self.width() * self.design]
    }

    /// Derivatives by design variables and deviations, row by row, from those by inputs and by design variables.
    pub(super) fn join_rows<T: Copy>(&self, joined: &mut [T], by_input: &[T], by_design: &[T]) {
        let width = self.width();
        let inputs = by_input.len() / (joined.len() / width).max(1);
        for (i, row) in joined.chunks_exact_mut(width).enumerate() {
            let (design, deviations) = row.split_at_mut(self.design);
            design.copy_from_slice(&by_design[i * self.design..][..self.design]);
            for (to, &input) in deviations.iter_mut().zip(&self.inputs) {
                *to = by_input[i * inputs + input];
            }
        }
    }

    /// Number of design variables and deviations, at least one.
    fn width(&self) -> usize {
        (self.design + self.inputs.len()).max(1)
    }
}
