//! Modes with speeds or constraints on velocities: a first-order system in positions `y` and independent velocities
//! `w`.
//!
//! The constraints allow the velocities `nu = (ydot; v) = Z w + E y`: `Z` spans the null space of `[A_q P, A_v]`, and
//! `E = -[A_q P, A_v]^+ B P`. The equations of motion are projected onto `Z`, which eliminates all reactions. With the
//! coefficients `M_nu = [M_y, M_v]` of `nudot` and `C_nu = [C_y, D_v]` of `nu`, and `Z^T M_nu Z = I`,
//!
//! ```text
//! ydot = E_y y + Z_y w
//! wdot = -Z^T (M_nu E E_y + C_nu E + K_y) y - Z^T (M_nu E Z_y + C_nu Z) w
//! ```
#![allow(clippy::needless_range_loop, reason = "index loops read as the formulas they are")]

use super::quadratic::greatest;
use crate::algebra::{Cholesky, Matrix, Vector, dot, times};
use crate::constraints::{Rows, Tangent, inertias};
use crate::eigenproblem::EigenproblemError;
use crate::kernels::Linear;

/// Share of a constraint on velocities below which it follows from the constraints on positions.
const FOLLOWS: f64 = 1e-10;

/// The reduced matrices. Vectors over velocities hold `ydot` in the first `freedom` places, then the speeds in units in
/// which their masses are of order one, as those of `ydot` are.
pub(super) struct System<'a> {
    pub(super) linear: &'a Linear,
    pub(super) tangent: &'a Tangent,
    /// The units of the speeds.
    pub(super) units: Vector,
    /// All constraints on velocities, `[A_q P, A_v]`.
    pub(super) velocity: Rows,
    /// The columns of `Z`.
    pub(super) free: Vec<Vector>,
    /// The columns of `E`.
    pub(super) forced: Vec<Vector>,
    /// `M_nu` and `C_nu`.
    pub(super) mass: Matrix,
    pub(super) damping: Matrix,
    /// `K_y`: rows by velocity, columns by position.
    pub(super) stiffness: Matrix,
}

impl<'a> System<'a> {
    pub(super) fn new(linear: &'a Linear, tangent: &'a Tangent) -> Result<Self, EigenproblemError> {
        let structure = tangent.structure;
        let (f, speeds) = (tangent.freedom, structure.speed_range());
        let velocities = f + speeds.len();
        let inertias = inertias(linear, structure);
        let units: Vector = speeds.clone().map(|i| 1.0 / inertias[i].sqrt()).collect();
        // A row or column over coordinates and speeds, converted to velocities.
        let by_velocity = |coordinates: &[f64], of_speeds: &[f64]| {
            Vector::from_fn(velocities, |a| {
                if a < f { dot(&tangent.basis[a], coordinates) } else { of_speeds[speeds.start + a - f] * units[a - f] }
            })
        };
        // The velocities over all unknowns.
        let unit =
            |(index, unit): (usize, &f64)| Vector::from_fn(structure.size(), |i| if i == index { *unit } else { 0.0 });
        let directions: Vec<Vector> =
            tangent.basis.iter().cloned().chain(speeds.clone().zip(&units).map(unit)).collect();
        let product = |matrix: &Matrix, a: usize| {
            let image = times(matrix, &directions[a]);
            by_velocity(&image, &image)
        };
        let square = || Matrix::zeros(velocities, velocities);
        let (mut mass, mut damping, mut stiffness) = (square(), square(), Matrix::zeros(velocities, f));
        for a in 0..velocities {
            let (m, c) = if a < f {
                let column = product(&linear.stiffness, a);
                for i in 0..velocities {
                    stiffness[i][a] = column[i];
                }
                (product(&linear.mass, a), product(&linear.damping, a))
            } else {
                (product(&linear.damping, a), product(&linear.stiffness, a))
            };
            for i in 0..velocities {
                (mass[i][a], damping[i][a]) = (m[i], c[i]);
            }
        }
        let rows = structure.velocity_rows();
        let row = |index: usize| {
            let (c, b) = (&linear.damping[index], &linear.stiffness[index]);
            let row = by_velocity(c, b);
            // Lengths in the mass metric, in which the basis is orthonormal.
            let part = |value: f64, i: usize| value * value / inertias[i];
            let of_speeds: f64 = speeds.clone().map(|i| part(b[i], i)).sum();
            let whole = of_speeds + (0..speeds.start).map(|i| part(c[i], i)).sum::<f64>();
            let left = row.iter().map(|x| x * x).sum::<f64>();
            if left > FOLLOWS * FOLLOWS * whole { row } else { Vector::zeros(velocities) }
        };
        let allowed: Vec<Vector> = rows.clone().map(row).collect();
        let velocity = Rows::balanced(Matrix::from_fn(rows.len(), velocities, |k, a| allowed[k][a]));
        let order = &velocity.order[..velocity.rank];
        let independent =
            Rows::independent(Matrix::from_fn(order.len(), velocities, |i, a| allowed[order[i]][a]), metric(&mass));
        let mut free = independent.null_basis(velocities);
        orthonormalise(&mut free, &mass).map_err(|column| {
            let x = Vector::from_fn(structure.size(), |i| {
                (0..velocities).fold(0.0, |sum, a| sum + column[a] * directions[a][i])
            });
            EigenproblemError::SingularMass(greatest(&x))
        })?;
        let forced = tangent.basis.iter().map(|along| {
            let right = order.iter().map(|k| -dot(&linear.stiffness[rows.start + k], along));
            independent.shortest(&right.collect::<Vector>())
        });
        let forced = forced.collect();
        Ok(Self { linear, tangent, units, velocity, free, forced, mass, damping, stiffness })
    }

    pub(super) fn velocities(&self) -> usize {
        self.tangent.freedom + self.tangent.structure.speeds
    }

    /// `F`.
    pub(super) fn matrix(&self) -> Matrix {
        let f = self.tangent.freedom;
        let size = f + self.free.len();
        let mut matrix = Matrix::zeros(size, size);
        // (ydot; v) caused by each variable alone, and the force that resists it.
        for j in 0..size {
            let nu = if j < f { &self.forced[j] } else { &self.free[j - f] };
            for i in 0..f {
                matrix[i][j] = nu[i];
            }
            let turned =
                Vector::from_fn(self.velocities(), |a| (0..f).fold(0.0, |sum, b| sum + self.forced[b][a] * nu[b]));
            let (inertia, resistance) = (times(&self.mass, &turned), times(&self.damping, nu));
            let force = Vector::from_fn(self.velocities(), |a| {
                let elastic = if j < f { self.stiffness[a][j] } else { 0.0 };
                inertia[a] + resistance[a] + elastic
            });
            for (i, free) in self.free.iter().enumerate() {
                matrix[f + i][j] = -dot(free, &force);
            }
        }
        matrix
    }

    /// [`Self::matrix`] with zeros where forces cancel, by which free directions are found, and the sizes of the terms of
    /// its elements.
    pub(super) fn matrix_without_rounding(&self) -> (Matrix, Matrix) {
        let size = |x: &Vector| x.map(f64::abs);
        let opposite = |x: &Vector| x.map(|value| -value.abs());
        let sizes = Self {
            velocity: self.velocity.clone(),
            units: self.units.clone(),
            free: self.free.iter().map(opposite).collect(),
            forced: self.forced.iter().map(size).collect(),
            mass: self.mass.map(f64::abs),
            damping: self.damping.map(f64::abs),
            stiffness: self.stiffness.map(f64::abs),
            ..*self
        };
        let (mut matrix, sizes) = (self.matrix(), sizes.matrix().map(f64::abs));
        let rounding = 4.0 * self.velocities() as f64 * f64::EPSILON;
        let pairs = matrix.as_flattened_mut().iter_mut();
        for (value, size) in pairs.zip(sizes.as_flattened()) {
            if value.abs() <= rounding * size {
                *value = 0.0;
            }
        }
        (matrix, sizes)
    }
}

/// Square roots of the masses of the velocities, with a lower limit relative to the largest.
fn metric(mass: &Matrix) -> Vector {
    const LIGHT: f64 = 1e-4;
    let scales = Vector::from_fn(mass.row_count(), |a| mass[a][a].max(0.0).sqrt());
    let greatest = scales.iter().fold(0.0, |a: f64, &b| a.max(b));
    scales.map(|value| if greatest > 0.0 { value.max(LIGHT * greatest) } else { 1.0 })
}

/// Makes vectors orthonormal in the mass matrix; `Err` is one that moves no mass.
fn orthonormalise(vectors: &mut [Vector], mass: &Matrix) -> Result<(), Vector> {
    let count = vectors.len();
    let images: Vec<Vector> = vectors.iter().map(|x| times(mass, x)).collect();
    let gram = Matrix::from_fn(count, count, |i, j| dot(&vectors[i], &images[j]));
    Cholesky::new(&gram).map_err(|row| vectors[row].clone())?.orthonormalise(vectors);
    Ok(())
}
