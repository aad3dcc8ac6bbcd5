//! The gaps of open loops.

use super::super::convergence::relative_gaps;
use super::super::operating_point::OperatingPoint;
use crate::algebra::{Matrix, Vector};

/// The constraints on positions at a state, numbered from zero.
pub(in crate::equilibrium) struct Gaps {
    pub(in crate::equilibrium) gaps: Vector,
    /// `Phi_q`.
    pub(in crate::equilibrium) rows: Matrix,
    /// Each gap relative to what small motions open ([`relative_gaps`]), and the largest.
    pub(super) each: Vector,
    pub(in crate::equilibrium) relative: f64,
    pub(super) worst: usize,
}

/// The constraints on positions; `None` if they are not finite.
pub(in crate::equilibrium) fn gaps(point: &OperatingPoint<'_>, x: &[f64]) -> Option<Gaps> {
    let structure = point.structure;
    let (residual, stiffness) = point.mechanism.residual_and_stiffness(x, point.inputs, point.design);
    let mut gaps = Gaps {
        gaps: residual[structure.position_rows()].into(),
        rows: Matrix::zeros(structure.position_constraints, x.len()),
        each: relative_gaps(point, x, &residual, &stiffness),
        relative: 0.0,
        worst: 0,
    };
    for (k, row) in structure.position_rows().enumerate() {
        gaps.rows[k][..structure.coordinates].copy_from_slice(&stiffness[row][..structure.coordinates]);
        let finite = gaps.gaps[k].is_finite() && gaps.rows[k].iter().all(|v| v.is_finite());
        if !finite {
            return None;
        }
        if gaps.each[k] > gaps.relative {
            (gaps.relative, gaps.worst) = (gaps.each[k], k);
        }
    }
    Some(gaps)
}

/// Restricts rows to the coordinates that are not held.
pub(in crate::equilibrium) fn free(rows: &Matrix, held: &[bool]) -> Matrix {
    Matrix::from_fn(rows.row_count(), rows.column_count(), |k, j| if held[j] { 0.0 } else { rows[k][j] })
}
