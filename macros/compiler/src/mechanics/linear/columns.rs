//! Matrices by columns.

use crate::algebra::{ExprId, Graph};

/// The transposed matrix.
pub(crate) fn transposed(columns: &[Vec<ExprId>]) -> Vec<Vec<ExprId>> {
    let row = |i: usize| columns.iter().map(|column| column[i]).collect();
    (0..columns.len()).map(row).collect()
}

/// The sum of two matrices.
pub(crate) fn added(g: &mut Graph, a: &[Vec<ExprId>], b: &[Vec<ExprId>]) -> Vec<Vec<ExprId>> {
    a.iter().zip(b).map(|(a, b)| a.iter().zip(b).map(|(&a, &b)| g.add(a, b)).collect()).collect()
}
