//! The position of deviations among the design variables, and the resulting conversion of arguments and results.

use core::mem::replace;

use crate::algebra::{Matrix, Vector};
use crate::kernels::{Gradient, PartialMatrices, ResidualPartials};

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
        let (own, deviations) = self.split(b);
        let mut applied = Vector::from(u);
        for (&input, &deviation) in self.inputs.iter().zip(deviations) {
            applied[input] = sum(applied[input], deviation);
        }
        (applied, own)
    }

    /// Converts a gradient of the mechanism.
    pub(super) fn gradient<T: Copy + Default>(
        &self,
        gradient: &mut Gradient<T>,
        kernel: impl FnOnce(&mut Gradient<T>),
    ) {
        let mut design = replace(&mut gradient.design, Vector::zeros(self.design));
        kernel(gradient);
        self.join(&mut design, &gradient.inputs, &gradient.design);
        gradient.design = design;
    }

    /// Converts derivatives of the residual.
    pub(super) fn residual_partials<T: Copy + Default>(
        &self,
        partials: &mut ResidualPartials<T>,
        kernel: impl FnOnce(&mut ResidualPartials<T>),
    ) {
        let own = Matrix::zeros(partials.1.row_count(), self.design);
        let mut by_design = replace(&mut partials.1, own);
        kernel(partials);
        self.join_rows(&mut by_design, &partials.0, &partials.1);
        partials.1 = by_design;
    }

    /// Converts derivatives of the outputs with respect to unknowns, inputs and design variables.
    pub(super) fn output_partials(
        &self,
        [by_coordinate, by_input, by_design]: [&mut Matrix; 3],
        kernel: impl FnOnce([&mut Matrix; 3]),
    ) {
        let mut own = Matrix::zeros(by_design.row_count(), self.design);
        kernel([by_coordinate, &mut *by_input, &mut own]);
        self.join_rows(by_design, by_input, &own);
    }

    /// Converts derivatives of the matrices.
    pub(super) fn partial_matrices(&self, own: &PartialMatrices, joined: &mut PartialMatrices) {
        let [by_coordinate, by_input, by_design] = joined.lists_mut();
        by_coordinate.copy_from_slice(own.by_coordinate());
        by_input.copy_from_slice(own.by_input());
        let (design, deviations) = by_design.split_at_mut(own.by_design().len());
        design.copy_from_slice(own.by_design());
        let size = deviations.len() / self.inputs.len().max(1);
        for (to, &input) in deviations.chunks_exact_mut(size.max(1)).zip(&self.inputs) {
            to.copy_from_slice(&by_input[input * size..][..size]);
        }
    }

    /// Derivatives with respect to design variables and deviations, from those with respect to inputs and design
    /// variables.
    fn join<T: Copy>(&self, joined: &mut [T], by_input: &[T], by_design: &[T]) {
        let (own, deviations) = joined.split_at_mut(self.design);
        own.copy_from_slice(by_design);
        for (to, &input) in deviations.iter_mut().zip(&self.inputs) {
            *to = by_input[input];
        }
    }

    fn join_rows<T: Copy>(
        &self,
        joined: &mut Matrix<T>,
        by_input: &Matrix<T>,
        by_design: &Matrix<T>,
    ) {
        for i in 0..joined.row_count() {
            self.join(&mut joined[i], &by_input[i], &by_design[i]);
        }
    }
}
