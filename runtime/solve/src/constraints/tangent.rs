//! The directions that constraints leave free, and the gauge of multipliers that they leave undetermined.
//!
//! `H = Phi_q` are the constraints on positions, `A = [A_q, A_v]` those on velocities (see [`crate::Role`]); the
//! columns of `Khat` for their multipliers are the transposes. Dependent rows leave combinations of multipliers
//! undetermined, and make `Khat` singular. The gauge `Khat[mu, mu] -= gamma sum_k m_k m_k^T`, with `m_k` the left null
//! vectors `n_k` of the rows times the squares of their sizes, makes it regular again. Multiplied by `n_k^T` from the
//! left, `Khat x = f` then gives `m_k^T mu = 0` where the constraints agree; solutions, eigenvalues and the rows of `H`
//! are otherwise unchanged.
//!
//! # Redundant constraints fix a gauge
//!
//! Where constraint rows are dependent, the reactions along the dependency are free. Where `Khat` enters the runtime, a
//! term for just these directions makes it regular and changes nothing else, because constraints that agree in a
//! neighbourhood have no curvature along the dependency. Where they have curvature, the configuration is singular and
//! is reported as such. The gauge is as stiff as the stiffest part of the mechanism: if it were softer, rounding
//! errors in its directions would open constraint gaps when reactions are large.
#![allow(clippy::needless_range_loop, reason = "index loops read as the formulas they are")]

use super::{Rows, Structure};
use crate::algebra::{Cholesky, Matrix, Vector, add_to, dot, greater, is_symmetric, largest, times};
use crate::kernels::Linear;

/// The directions that constraints leave free at one state.
#[derive(Clone, Debug)]
#[doc(hidden)]
pub struct Tangent {
    pub(crate) structure: Structure,
    /// Number of directions in which the coordinates can move, `f`.
    pub(crate) freedom: usize,
    /// Basis of the null space of `H`: `delta q = sum_i y_i basis[i]`. Orthonormal in the metric of the diagonal of
    /// `Mhat`, so that the reduced masses are of order one; zero except at coordinates.
    pub(crate) basis: Vec<Vector>,
    /// The rows of `H` over the coordinates, numbered from zero.
    pub(crate) positions: Rows,
    /// The independent rows of `H` in the metric of `basis`, in the order `positions.order`.
    pub(crate) normal: Rows,
    /// The rows of `[[H, 0], [A_q, A_v]]` over coordinates and speeds, numbered from zero: all constraints.
    pub(crate) all: Rows,
}

/// Smallest mass in the metric of the basis, relative to the largest: used for a massless coordinate.
const LIGHT: f64 = 1e-8;

impl Tangent {
    /// The free directions at a state with these matrices, before or after [`fix_gauge`].
    #[doc(hidden)]
    pub fn new(linear: &Linear, structure: Structure) -> Self {
        let all = all_rows(&linear.stiffness, structure);
        let positions = if structure.velocity_constraints == 0 {
            all.clone()
        } else {
            first_rows(&linear.stiffness, structure, structure.position_constraints)
        };
        let independent = Matrix::from_fn(positions.rank, structure.size(), |i, j| {
            gradient(&linear.stiffness, structure, positions.order[i], j)
        });
        let normal = Rows::independent(independent, inertias(linear, structure).map(f64::sqrt));
        Self {
            structure,
            freedom: structure.coordinates - normal.rank,
            basis: normal.null_basis(structure.coordinates),
            positions,
            normal,
            all,
        }
    }

    /// Number of constraints that follow from the others.
    #[doc(hidden)]
    pub fn redundant(&self) -> usize {
        self.all.dependent()
    }

    /// Left null vector `k` of all constraints, at the positions of their rows: `n^T [[H, 0], [A_q, A_v]] = 0`.
    #[doc(hidden)]
    pub fn null_left(&self, k: usize) -> Vector {
        placed(self.structure, &self.all.null_left(k))
    }

    /// Multipliers, at their positions, that balance a force by coordinate and speed: `H^T mu_1 + A_q^T mu_2 = force`
    /// by coordinate, `A_v^T mu_2 = force` by speed. Exact where possible, otherwise least squares; undetermined parts
    /// are zero, consistent with [`fix_gauge`].
    pub(crate) fn multipliers(&self, force: &[f64]) -> Vector {
        let mut force = Vector::from(force);
        force[self.structure.motions()..].fill(0.0);
        placed(self.structure, &self.all.multipliers(&force))
    }

    /// The coordinate that moves most along the first massless free direction.
    #[doc(hidden)]
    pub fn massless(&self, linear: &Linear) -> usize {
        match Cholesky::new(&self.reduce(&linear.mass)) {
            Err(direction) => self.foremost(direction),
            Ok(_) => 0,
        }
    }

    /// The coordinate that moves most along free direction `i`.
    pub(crate) fn foremost(&self, i: usize) -> usize {
        let along = &self.basis[i];
        (0..along.len()).fold(0, |most, j| if along[j].abs() > along[most].abs() { j } else { most })
    }

    /// `P y`, by coordinate; zero elsewhere.
    pub(crate) fn lift(&self, y: &[f64]) -> Vector {
        let mut x = Vector::zeros(self.structure.size());
        for (y, direction) in y.iter().zip(&self.basis) {
            add_to(&mut x, *y, direction);
        }
        x
    }

    /// `P^T force`.
    pub(crate) fn project(&self, force: &[f64]) -> Vector {
        self.basis.iter().map(|direction| dot(direction, force)).collect()
    }

    /// `P^T matrix P`; exactly symmetric for a symmetric matrix.
    pub(crate) fn reduce(&self, matrix: &Matrix) -> Matrix {
        let images: Vec<Vector> = self.basis.iter().map(|x| times(matrix, x)).collect();
        let mut reduced = Matrix::from_fn(self.freedom, self.freedom, |i, j| dot(&self.basis[i], &images[j]));
        if is_symmetric(matrix) {
            for i in 0..self.freedom {
                for j in 0..i {
                    let mean = 0.5 * (reduced[i][j] + reduced[j][i]);
                    (reduced[i][j], reduced[j][i]) = (mean, mean);
                }
            }
        }
        reduced
    }

    /// `P^T M P`, `P^T C P`, `P^T K_c P`. Complete if there are neither speeds nor constraints on velocities.
    pub(crate) fn reduce_linear(&self, linear: &Linear) -> Linear {
        Linear {
            mass: self.reduce(&linear.mass),
            damping: self.reduce(&linear.damping),
            stiffness: self.reduce(&linear.stiffness),
        }
    }
}

/// Puts values by constraint, numbered from zero, at the positions of their rows; zero elsewhere.
pub fn placed(structure: Structure, by_constraint: &[f64]) -> Vector {
    let mut placed = Vector::zeros(structure.size());
    placed[structure.constraint_rows()].copy_from_slice(by_constraint);
    placed
}

/// Fixes the multipliers that redundant constraints leave undetermined.
///
/// The gauge yields to multipliers as the largest stiffness yields to forces. If it yielded more, the rounding of its
/// vectors would open gaps under large multipliers.
pub fn fix_gauge(stiffness: &mut Matrix, structure: Structure) {
    let rows = all_rows(stiffness, structure);
    if rows.dependent() == 0 {
        return;
    }
    let places = structure.constraint_rows();
    let stiffest = (0..places.start).fold(0.0, |most, i| {
        let row = rows.scaled_down(&stiffness[i][..places.start]);
        greater(most, largest(&row) / rows.scale(i))
    });
    let stiffest = if stiffest > 0.0 { stiffest } else { largest(&rows.size) };
    for k in 0..rows.dependent() {
        let m = rows.null_left_scaled(k);
        for i in 0..rows.count() {
            for j in 0..rows.count() {
                stiffness[places.start + i][places.start + j] -= m[i] * m[j] / stiffest;
            }
        }
    }
}

/// A choice of constraints, at the positions of their rows, that follow from the others.
pub fn redundant_rows(stiffness: &Matrix, structure: Structure) -> Vec<bool> {
    let rows = all_rows(stiffness, structure);
    let mut redundant = vec![false; structure.size()];
    for &k in &rows.order[rows.rank..] {
        redundant[structure.motions() + k] = true;
    }
    redundant
}

/// All constraints over coordinates and speeds, in the balanced metric.
pub(crate) fn all_rows(stiffness: &Matrix, structure: Structure) -> Rows {
    first_rows(stiffness, structure, structure.constraints())
}

/// The first `count` constraints; those on positions come first.
fn first_rows(stiffness: &Matrix, structure: Structure, count: usize) -> Rows {
    Rows::balanced(Matrix::from_fn(count, structure.size(), |k, j| gradient(stiffness, structure, k, j)))
}

/// Column `j` of row `k` of `[[H, 0], [A_q, A_v]]`, taken from the column of `Khat` for its multiplier.
fn gradient(stiffness: &Matrix, structure: Structure, k: usize, j: usize) -> f64 {
    let motions = structure.motions();
    if j < motions { stiffness[j][motions + k] } else { 0.0 }
}

/// Masses of coordinates (the diagonal of `Mhat`) and of speeds (of `Chat`), with a lower limit relative to the
/// largest; one if there are none, and at reactions.
pub fn inertias(linear: &Linear, structure: Structure) -> Vector {
    let mut mass = Vector::filled(structure.size(), 1.0_f64);
    for block in [0..structure.coordinates, structure.speed_range()] {
        let diagonal = |j: usize| {
            let matrix = if j < structure.coordinates { &linear.mass } else { &linear.damping };
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
