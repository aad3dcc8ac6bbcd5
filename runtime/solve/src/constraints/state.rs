//! The constraints at one state: the freedom they leave, which are redundant, and whether the state is singular.

use super::{Structure, Tangent};
use crate::algebra::{Matrix, Vector, add_to, form, largest_element};
use crate::kernels::{Gradient, Kernels};

/// The constraints at one state. Rows are at the positions of their reactions among the unknowns.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ConstraintState {
    /// Number of directions in which the coordinates can move: all for an open mechanism.
    pub freedom: usize,
    /// Number of constraints that follow from the others. Redundant constraints determine only combinations of their
    /// reactions; the reported reactions cause forces with the smallest sum of squares.
    pub redundant: usize,
    /// The rows involved: any [`redundant`](Self::redundant) of them follow from the others.
    pub dependent: Vector<bool>,
    /// Rows become dependent, or vanish, at exactly this configuration (within rounding), but are independent around
    /// it, as for a flat parallelogram or a chain stretched to its limit. The linearised mechanism does not say how it
    /// can move.
    pub singular: bool,
}

/// Share of a left null vector above which a row takes part in it.
const TAKES_PART: f64 = 1e-8;
/// Relative curvature that rounding leaves in dependent constraints which stay redundant in a neighbourhood.
const CURVED: f64 = 1e-6;

impl ConstraintState {
    /// The state of `size` unknowns without constraints.
    pub(crate) fn open(size: usize) -> Self {
        Self { freedom: size, redundant: 0, dependent: Vector::filled(size, false), singular: false }
    }

    /// The state of a mechanism that is not open: it has constraints or speeds.
    pub(crate) fn new(mechanism: &dyn Kernels, (q, u, b): (&[f64], &[f64], &[f64]), tangent: &Tangent) -> Self {
        let structure = tangent.structure;
        let mut state =
            Self { freedom: tangent.freedom, redundant: tangent.redundant(), ..Self::open(structure.size()) };
        let first = structure.constraint_rows().start;
        for k in 0..tangent.redundant() {
            let share = tangent.all.null_left_scaled(k);
            for (i, &value) in share.iter().enumerate().take(structure.constraints()) {
                state.dependent[first + i] |= value.abs() > TAKES_PART * tangent.all.size[i];
            }
        }
        state.singular = singular(mechanism, (q, u, b), tangent);
        state
    }
}

/// Whether dependent constraints on positions separate at second order.
///
/// For left null vectors, `n^T H = 0`, the curvature `n . Phi_qq` vanishes on the null space of `H` if the constraints
/// stay redundant in a neighbourhood (the second derivative of `Phi = 0` along a motion, times `n`).
fn singular(mechanism: &dyn Kernels, (q, u, b): (&[f64], &[f64], &[f64]), tangent: &Tangent) -> bool {
    let dependent = tangent.positions.dependent();
    if dependent == 0 {
        return false;
    }
    let (f, basis) = (tangent.freedom, &tangent.basis);
    let size: Vec<Vector> = basis.iter().map(|vector| vector.map(f64::abs)).collect();
    // `Phi_qq` of each row on the null space, and the magnitude of its terms.
    let on_null_space = |row: usize| {
        let curvature = curvature(mechanism, (q, u, b), tangent.structure, row);
        let terms = curvature.map(f64::abs);
        let bent = Matrix::from_fn(f, f, |i, j| form(&basis[i], &curvature, &basis[j]));
        let most = Matrix::from_fn(f, f, |i, j| form(&size[i], &terms, &size[j]));
        (bent, largest_element(&most))
    };
    let curvatures: Vec<_> = tangent.structure.position_rows().map(on_null_space).collect();
    (0..dependent).any(|k| {
        let mut sum = Matrix::zeros(f, f);
        let mut terms = 0.0;
        for (share, (bent, size)) in tangent.positions.null_left(k).iter().zip(&curvatures) {
            terms += share.abs() * size;
            add_to(sum.as_flattened_mut(), *share, bent.as_flattened());
        }
        largest_element(&sum) > CURVED * terms
    })
}

/// `Phi_qq` of a constraint on positions, from its gradient along each coordinate.
pub(crate) fn curvature(
    mechanism: &dyn Kernels,
    (q, u, b): (&[f64], &[f64], &[f64]),
    structure: Structure,
    row: usize,
) -> Matrix {
    let unit = |k: usize| Vector::from_fn(q.len(), |i| if i == k { 1.0 } else { 0.0 });
    let (constraint, none) = (unit(row), Vector::zeros(q.len()));
    let mut gradient = Gradient::zeros(mechanism.sizes());
    let mut curvature = Matrix::zeros(q.len(), q.len());
    for j in 0..structure.coordinates {
        let vectors = [&constraint[..], &none, &none, &unit(j)];
        mechanism.pencil_gradient_into(q, u, b, vectors, &mut gradient);
        curvature[j].copy_from_slice(&gradient.coordinates);
    }
    curvature
}
