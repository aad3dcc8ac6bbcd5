//! The directions that constraints leave free, and the gauge of multipliers that they leave undetermined.
//!
//! `H = Phi_q` are the constraints on positions, `A = [A_q, A_v]` those on velocities (see [`crate::Role`]); the columns of
//! `Khat` that belong to their multipliers are the transposes. Dependent rows leave combinations of multipliers
//! undetermined, and `Khat` singular. `Khat[mu, mu] -= gamma sum_k m_k m_k^T`, `m_k` the null left vectors `n_k` of the
//! rows times the squares of their sizes, makes it regular again: multiplied by `n_k^T` from the left, `Khat x = f` then
//! says `m_k^T mu = 0` where the constraints agree, and all else is as it was: solutions, eigenvalues, and the rows of `H`.
#![allow(
    clippy::needless_range_loop,
    reason = "index loops read as the formulas they are"
)]

use super::{Rows, Structure};
use crate::Linear;
use crate::array::{Cholesky, Square, largest_element};

/// What constraints leave free at one state.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Tangent<const N: usize> {
    pub(crate) structure: Structure,
    /// Number of directions in which the coordinates can move, `f`.
    pub(crate) freedom: usize,
    /// The first `freedom` rows span the null space of `H`: `delta q = sum_i y_i basis[i]`. Orthonormal in the metric of
    /// the diagonal of `Mhat`, so that the reduced masses are of order one; zero in all places but those of coordinates.
    pub(crate) basis: Square<N>,
    /// The rows of `H` over the coordinates, numbered from zero.
    pub(crate) positions: Rows<N>,
    /// The independent rows of `H` in the metric of `basis`, in the order `positions.order`.
    pub(crate) normal: Rows<N>,
    /// The rows of `[[H, 0], [A_q, A_v]]` over coordinates and speeds, numbered from zero: all constraints.
    pub(crate) all: Rows<N>,
}

/// Least mass in the metric of the basis, relative to the greatest: what a massless coordinate gets.
const LIGHT: f64 = 1e-8;

impl<const N: usize> Tangent<N> {
    /// At a state with these matrices, before or after [`fix_gauge`].
    pub(crate) fn new(linear: &Linear<f64, N>, structure: Structure) -> Self {
        let all = all_rows(&linear.stiffness, structure);
        let positions = if structure.velocity_constraints == 0 {
            all
        } else {
            position_rows(&linear.stiffness, structure)
        };
        let normal = Rows::independent(
            positions.rank,
            |i| gradient(&linear.stiffness, structure, positions.order[i]),
            inertias(linear, structure).map(f64::sqrt),
        );
        Self {
            structure,
            freedom: structure.coordinates - normal.rank,
            basis: normal.null_basis(structure.coordinates),
            positions,
            normal,
            all,
        }
    }

    /// How many constraints follow from the others.
    pub(crate) fn redundant(&self) -> usize {
        self.all.dependent()
    }

    /// Left null vector `k` of all constraints, in the places of their rows: `n^T [[H, 0], [A_q, A_v]] = 0`.
    pub(crate) fn null_left(&self, k: usize) -> [f64; N] {
        placed(self.structure, &self.all.null_left(k))
    }

    /// Multipliers, in their places, that balance a force by coordinate and speed: `H^T mu_1 + A_q^T mu_2 = force` by
    /// coordinate, `A_v^T mu_2 = force` by speed. Exact where it can be, else in the sense of least squares; undetermined
    /// parts are zero, as [`fix_gauge`] has them.
    pub(crate) fn multipliers(&self, force: &[f64; N]) -> [f64; N] {
        let motions = self.structure.motions();
        let force = core::array::from_fn(|j| if j < motions { force[j] } else { 0.0 });
        placed(self.structure, &self.all.multipliers(&force))
    }

    /// The coordinate that moves most along the first free direction without a mass of its own.
    pub(crate) fn massless(&self, linear: &Linear<f64, N>) -> usize {
        match Cholesky::new(&self.reduce_mass(&linear.mass)) {
            Err(direction) => self.foremost(direction),
            Ok(_) => 0,
        }
    }

    /// The coordinate that moves most along free direction `i`.
    pub(crate) fn foremost(&self, i: usize) -> usize {
        let along = &self.basis[i];
        (0..N).fold(0, |most, j| {
            if along[j].abs() > along[most].abs() {
                j
            } else {
                most
            }
        })
    }

    /// `P y`, by coordinate; zero elsewhere.
    pub(crate) fn lift(&self, y: &[f64; N]) -> [f64; N] {
        core::array::from_fn(|j| {
            (0..self.freedom).fold(0.0, |sum, i| sum + y[i] * self.basis[i][j])
        })
    }

    /// `P^T force` in the first `freedom` places, zero elsewhere.
    pub(crate) fn project(&self, force: &[f64; N]) -> [f64; N] {
        let mut reduced = [0.0; N];
        for i in 0..self.freedom {
            reduced[i] = crate::array::dot(&self.basis[i], force);
        }
        reduced
    }

    /// The mass matrix of [`reduce`].
    pub(crate) fn reduce_mass(&self, mass: &Square<N>) -> Square<N> {
        self.filled(reduce_matrix(mass, self), 1.0)
    }

    /// The stiffness matrix of [`reduce`].
    pub(crate) fn reduce_stiffness(&self, stiffness: &Square<N>) -> Square<N> {
        let reduced = reduce_matrix(stiffness, self);
        let size = largest_element(&reduced);
        self.filled(reduced, if size > 0.0 { size } else { 1.0 })
    }

    fn filled(&self, mut reduced: Square<N>, value: f64) -> Square<N> {
        for i in self.freedom..N {
            reduced[i][i] = value;
        }
        reduced
    }
}

/// Values by constraint, numbered from zero, in the places of their rows; zero elsewhere.
pub(crate) fn placed<const N: usize>(structure: Structure, by_constraint: &[f64; N]) -> [f64; N] {
    let rows = structure.constraint_rows();
    core::array::from_fn(|i| {
        if rows.contains(&i) {
            by_constraint[i - rows.start]
        } else {
            0.0
        }
    })
}

/// `P^T M P`, `P^T C P`, `P^T K_c P` in the leading `freedom` rows and columns. The remaining diagonal holds masses of one
/// and one positive stiffness of the size of the others, so that factors and eigenvalues of the whole exist and have the
/// signs of the reduced ones: the last `N - freedom` unit vectors are modes that mean nothing. Complete where there are
/// neither speeds nor constraints on velocities.
pub(crate) fn reduce<const N: usize>(
    linear: &Linear<f64, N>,
    tangent: &Tangent<N>,
) -> Linear<f64, N> {
    Linear {
        mass: tangent.reduce_mass(&linear.mass),
        damping: reduce_matrix(&linear.damping, tangent),
        stiffness: tangent.reduce_stiffness(&linear.stiffness),
    }
}

/// `P^T matrix P` in the leading rows and columns, zero elsewhere; of a symmetric matrix exactly symmetric.
fn reduce_matrix<const N: usize>(matrix: &Square<N>, tangent: &Tangent<N>) -> Square<N> {
    let mut reduced = [[0.0; N]; N];
    let symmetric = (0..N).all(|i| (0..i).all(|j| matrix[i][j] == matrix[j][i]));
    for j in 0..tangent.freedom {
        let image = crate::array::times(matrix, &tangent.basis[j]);
        for i in 0..tangent.freedom {
            reduced[i][j] = crate::array::dot(&tangent.basis[i], &image);
        }
    }
    if symmetric {
        for i in 0..tangent.freedom {
            for j in 0..i {
                let mean = 0.5 * (reduced[i][j] + reduced[j][i]);
                (reduced[i][j], reduced[j][i]) = (mean, mean);
            }
        }
    }
    reduced
}

/// Fixes the multipliers that redundant constraints leave undetermined.
pub(crate) fn fix_gauge<const N: usize>(stiffness: &mut Square<N>, structure: Structure) {
    let rows = all_rows(stiffness, structure);
    let places = structure.constraint_rows();
    let greatest = rows.size[..rows.count]
        .iter()
        .fold(0.0, |a: f64, &b| a.max(b));
    for k in 0..rows.dependent() {
        let m = rows.null_left_scaled(k);
        for i in 0..rows.count {
            for j in 0..rows.count {
                stiffness[places.start + i][places.start + j] -= m[i] * m[j] / greatest;
            }
        }
    }
}

/// A choice of constraints, in the places of their rows, that follow from the others.
pub(crate) fn redundant_rows<const N: usize>(
    stiffness: &Square<N>,
    structure: Structure,
) -> [bool; N] {
    let rows = all_rows(stiffness, structure);
    let mut redundant = [false; N];
    for &k in &rows.order[rows.rank..rows.count] {
        redundant[structure.motions() + k] = true;
    }
    redundant
}

/// All constraints over coordinates and speeds, in the balanced metric.
pub(crate) fn all_rows<const N: usize>(stiffness: &Square<N>, structure: Structure) -> Rows<N> {
    Rows::balanced(structure.constraints(), |k| {
        gradient(stiffness, structure, k)
    })
}

/// The constraints on positions over the coordinates, in the balanced metric.
fn position_rows<const N: usize>(stiffness: &Square<N>, structure: Structure) -> Rows<N> {
    Rows::balanced(structure.position_constraints, |k| {
        gradient(stiffness, structure, k)
    })
}

/// Row `k` of `[[H, 0], [A_q, A_v]]`: the column of `Khat` that belongs to its multiplier.
fn gradient<const N: usize>(stiffness: &Square<N>, structure: Structure, k: usize) -> [f64; N] {
    let column = structure.motions() + k;
    core::array::from_fn(|j| {
        if j < structure.motions() {
            stiffness[j][column]
        } else {
            0.0
        }
    })
}

/// Masses of coordinates (the diagonal of `Mhat`) and of speeds (of `Chat`), none far below the greatest; one where there
/// are none, and in the places of reactions.
pub(crate) fn inertias<const N: usize>(linear: &Linear<f64, N>, structure: Structure) -> [f64; N] {
    let mut mass = [1.0_f64; N];
    for block in [0..structure.coordinates, structure.speed_range()] {
        let diagonal = |j: usize| {
            let matrix = if j < structure.coordinates {
                &linear.mass
            } else {
                &linear.damping
            };
            let mass = matrix[j][j];
            if mass.is_finite() { mass.max(0.0) } else { 0.0 }
        };
        let greatest = block.clone().map(diagonal).fold(0.0, f64::max);
        for j in block {
            if greatest > 0.0 {
                mass[j] = diagonal(j).max(LIGHT * greatest);
            }
        }
    }
    mass
}
