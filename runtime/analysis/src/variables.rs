//! Inputs and design variables together.

use crate::algebra::Matrix;
use crate::{Description, Text, Unit};

/// An input or a design variable.
#[derive(Clone, Copy)]
pub(crate) struct Variable<'a> {
    pub(crate) name: &'a Text,
    pub(crate) unit: &'a Unit,
}

/// All variables, inputs first.
pub(crate) fn variables(d: &Description) -> Vec<Variable<'_>> {
    d.inputs.iter().map(|info| Variable { name: &info.name, unit: &info.unit }).chain(design_variables(d)).collect()
}

/// The design variables.
pub(crate) fn design_variables(d: &Description) -> impl Iterator<Item = Variable<'_>> {
    d.design.iter().map(|info| Variable { name: &info.name, unit: &info.unit })
}

/// Entry of a matrix, which a damaged file may have truncated.
pub(crate) fn entry<T: Copy>(matrix: &Matrix<T>, i: usize, j: usize) -> Option<T> {
    matrix.iter().nth(i)?.get(j).copied()
}
