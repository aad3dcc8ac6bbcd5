//! What constraints are at one state: how much freedom they leave, which say the same, whether the state is singular.

use super::Tangent;
use crate::Mechanism;
use crate::array::{Square, form, largest_element};

/// The constraints at one state. Rows have the places of their reactions among the unknowns.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ConstraintState<const N: usize> {
    /// Number of directions in which the coordinates can move: all of them for an open mechanism.
    pub freedom: usize,
    /// Number of constraints that follow from the others. Reactions of constraints that say the same are determined only
    /// together: given are those of which the squares, in terms of the forces they cause, have the least sum.
    pub redundant: usize,
    /// The rows that take part: of these, so many can go.
    pub dependent: [bool; N],
    /// Rows lose their independence here, or so near that rounding takes the state there, and nowhere else: a flat
    /// parallelogram, a chain stretched to its limit. The linearised mechanism does not say how it can move.
    pub singular: bool,
}

/// Share of a null left vector that counts as taking part.
const TAKES_PART: f64 = 1e-8;
/// Part of the curvatures of dependent constraints that rounding leaves where they say the same in a neighbourhood.
const CURVED: f64 = 1e-6;

impl<const N: usize> ConstraintState<N> {
    /// Without constraints.
    pub(crate) fn open() -> Self {
        Self {
            freedom: N,
            redundant: 0,
            dependent: [false; N],
            singular: false,
        }
    }

    /// Of a mechanism that is not open.
    pub(crate) fn new<M, const U: usize, const P: usize, const O: usize>(
        mechanism: &M,
        (q, u, b): (&[f64; N], &[f64; U], &[f64; P]),
        tangent: &Tangent<N>,
    ) -> Self
    where
        M: Mechanism<N, U, P, O>,
    {
        let structure = tangent.structure;
        let mut found = Self {
            freedom: tangent.freedom,
            redundant: tangent.redundant(),
            ..Self::open()
        };
        let first = structure.constraint_rows().start;
        for k in 0..tangent.redundant() {
            let share = tangent.all.null_left_scaled(k);
            for (i, &value) in share.iter().enumerate().take(structure.constraints()) {
                found.dependent[first + i] |= value.abs() > TAKES_PART * tangent.all.size[i];
            }
        }
        found.singular = singular(mechanism, (q, u, b), tangent);
        found
    }
}

/// Whether dependent constraints on positions curve apart: `n . Phi_qq`, `n^T H = 0`, is zero on the null space of `H` where
/// they say the same in a neighbourhood (the second derivative of `Phi = 0` along a motion, times `n`).
fn singular<M, const N: usize, const U: usize, const P: usize, const O: usize>(
    mechanism: &M,
    (q, u, b): (&[f64; N], &[f64; U], &[f64; P]),
    tangent: &Tangent<N>,
) -> bool
where
    M: Mechanism<N, U, P, O>,
{
    let rows = tangent.structure.position_rows();
    let size = tangent.basis.map(|vector| vector.map(f64::abs));
    // `Phi_qq` of one row on the null space, and the size of what it is summed from.
    let curvature = |row: usize| -> (Square<N>, f64) {
        let along = core::array::from_fn(|i| if i == row { 1.0 } else { 0.0 });
        let change = mechanism.linear_along(q, u, b, &along, &[0.0; U], &[0.0; P]);
        let terms = change.stiffness.map(|row| row.map(f64::abs));
        let mut most = 0.0_f64;
        let bent = core::array::from_fn(|i| {
            core::array::from_fn(|j| {
                if i < tangent.freedom && j < tangent.freedom {
                    most = most.max(form(&size[i], &terms, &size[j]));
                    form(&tangent.basis[i], &change.stiffness, &tangent.basis[j])
                } else {
                    0.0
                }
            })
        });
        (bent, most)
    };
    (0..tangent.positions.dependent()).any(|k| {
        let n = tangent.positions.null_left(k);
        let mut sum = [[0.0; N]; N];
        let mut terms = 0.0;
        for (i, row) in rows.clone().enumerate() {
            if n[i] != 0.0 {
                let (bent, size) = curvature(row);
                terms += n[i].abs() * size;
                for (total, part) in sum.iter_mut().flatten().zip(bent.iter().flatten()) {
                    *total += n[i] * part;
                }
            }
        }
        largest_element(&sum) > CURVED * terms
    })
}
