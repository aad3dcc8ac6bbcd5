//! Matrices by columns.

use crate::algebra::{ExprId, Graph};

/// The sum of two matrices.
pub(crate) fn added(g: &mut Graph, a: &[Vec<ExprId>], b: &[Vec<ExprId>]) -> Vec<Vec<ExprId>> {
    a.iter().zip(b).map(|(a, b)| a.iter().zip(b).map(|(&a, &b)| g.add(a, b)).collect()).collect()
}
