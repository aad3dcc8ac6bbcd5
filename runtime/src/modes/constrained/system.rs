//! Speeds, or constraints on velocities: a system of first order in positions `y` and independent velocities `w`.
//!
//! Velocities that the constraints allow are `nu = (ydot; v) = Z w + E y`: `Z` spans the null space of `[A_q P, A_v]`,
//! `E = -[A_q P, A_v]^+ B P`. The equations of motion are projected on `Z`, which removes all reactions. With
//! `M_nu = [M_y, M_v]`, `C_nu = [C_y, D_v]` the coefficients of `nudot` and `nu`, and `Z^T M_nu Z = I`,
//!
//! ```text
//! ydot = E_y y + Z_y w
//! wdot = -Z^T (M_nu E E_y + C_nu E + K_y) y - Z^T (M_nu E Z_y + C_nu Z) w
//! ```
#![allow(
    clippy::needless_range_loop,
    reason = "index loops read as the formulas they are"
)]

use super::quadratic::greatest;
use crate::Linear;
use crate::array::{Cholesky, Square, dot};
use crate::constraints::{Rows, Tangent, inertias};
use crate::modes::symmetric::Trouble;

/// Share of a constraint on velocities below which it follows from those on positions.
const FOLLOWS: f64 = 1e-10;

/// The reduced matrices. Vectors by velocity have `ydot` in the first `freedom` places, then the speeds.
pub(super) struct System<'a, const N: usize> {
    pub(super) linear: &'a Linear<f64, N>,
    pub(super) tangent: &'a Tangent<N>,
    /// Number of independent velocities.
    pub(super) independent: usize,
    /// All constraints on velocities, `[A_q P, A_v]`.
    pub(super) velocity: Rows<N>,
    /// The first `independent` rows are the columns of `Z`.
    pub(super) free: Square<N>,
    /// The first `freedom` rows are the columns of `E`.
    pub(super) forced: Square<N>,
    /// `M_nu` and `C_nu`, `freedom` + number of speeds in size.
    pub(super) mass: Square<N>,
    pub(super) damping: Square<N>,
    /// `K_y`: rows by velocity, columns by position.
    pub(super) stiffness: Square<N>,
}

impl<'a, const N: usize> System<'a, N> {
    pub(super) fn new(
        linear: &'a Linear<f64, N>,
        tangent: &'a Tangent<N>,
    ) -> Result<Self, Trouble> {
        let structure = tangent.structure;
        let (f, speeds) = (tangent.freedom, structure.speed_range());
        let velocities = f + speeds.len();
        // Row or column of a matrix over coordinates and speeds, by velocity.
        let by_velocity = |full: &[f64; N]| -> [f64; N] {
            core::array::from_fn(|a| {
                if a < f {
                    dot(&tangent.basis[a], full)
                } else if a < velocities {
                    full[speeds.start + a - f]
                } else {
                    0.0
                }
            })
        };
        // The unit vector of a velocity, among all unknowns.
        let direction = |a: usize| -> [f64; N] {
            if a < f {
                tangent.basis[a]
            } else {
                core::array::from_fn(|i| if i == speeds.start + a - f { 1.0 } else { 0.0 })
            }
        };
        let product =
            |matrix: &Square<N>, a: usize| by_velocity(&crate::array::times(matrix, &direction(a)));
        let (mut mass, mut damping, mut stiffness) = ([[0.0; N]; N], [[0.0; N]; N], [[0.0; N]; N]);
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
        let inertias = inertias(linear, structure);
        let row = |k: usize| -> [f64; N] {
            let (c, b) = (
                &linear.damping[rows.start + k],
                &linear.stiffness[rows.start + k],
            );
            let row: [f64; N] = core::array::from_fn(|a| {
                if a < f {
                    dot(c, &tangent.basis[a])
                } else if a < velocities {
                    b[speeds.start + a - f]
                } else {
                    0.0
                }
            });
            // Lengths in the metric of masses, in which the basis is orthonormal.
            let part = |value: f64, i: usize| value * value / inertias[i];
            let of_speeds: f64 = speeds.clone().map(|i| part(b[i], i)).sum();
            let whole = of_speeds + (0..speeds.start).map(|i| part(c[i], i)).sum::<f64>();
            let left = of_speeds + row[..f].iter().map(|x| x * x).sum::<f64>();
            if left > FOLLOWS * FOLLOWS * whole {
                row
            } else {
                [0.0; N]
            }
        };
        let velocity = Rows::balanced(rows.len(), row);
        let metric = metric(&mass, velocities);
        let independent = Rows::independent(velocity.rank, |i| row(velocity.order[i]), metric);
        let mut free = independent.null_basis(velocities);
        let count = velocities - velocity.rank;
        orthonormalise(&mut free[..count], &mass).map_err(|column| {
            let x: [f64; N] = core::array::from_fn(|i| {
                (0..velocities).fold(0.0, |sum, a| sum + column[a] * direction(a)[i])
            });
            Trouble::SingularMass(greatest(&x))
        })?;
        let mut forced = [[0.0; N]; N];
        for a in 0..f {
            let right: [f64; N] = core::array::from_fn(|i| {
                if i < velocity.rank {
                    let row = rows.start + velocity.order[i];
                    -dot(&linear.stiffness[row], &tangent.basis[a])
                } else {
                    0.0
                }
            });
            forced[a] = independent.shortest(&right);
        }
        Ok(Self {
            linear,
            tangent,
            independent: count,
            velocity,
            free,
            forced,
            mass,
            damping,
            stiffness,
        })
    }

    pub(super) fn velocities(&self) -> usize {
        self.tangent.freedom + self.tangent.structure.speeds
    }

    /// `F`, row by row.
    pub(super) fn fill(&self, matrix: &mut [f64]) {
        let f = self.tangent.freedom;
        let size = f + self.independent;
        // (ydot; v) that each variable alone makes, and the force that resists it.
        for j in 0..size {
            let nu = if j < f {
                &self.forced[j]
            } else {
                &self.free[j - f]
            };
            for i in 0..f {
                matrix[i * size + j] = nu[i];
            }
            let turned: [f64; N] = core::array::from_fn(|a| {
                (0..f).fold(0.0, |sum, b| sum + self.forced[b][a] * nu[b])
            });
            let (inertia, resistance) = (
                crate::array::times(&self.mass, &turned),
                crate::array::times(&self.damping, nu),
            );
            let force: [f64; N] = core::array::from_fn(|a| {
                let elastic = if j < f { self.stiffness[a][j] } else { 0.0 };
                inertia[a] + resistance[a] + elastic
            });
            for i in 0..self.independent {
                matrix[(f + i) * size + j] = -dot(&self.free[i], &force);
            }
        }
    }
}

/// Square roots of the masses of the velocities, none far below the greatest.
fn metric<const N: usize>(mass: &Square<N>, velocities: usize) -> [f64; N] {
    const LIGHT: f64 = 1e-4;
    let own: [f64; N] = core::array::from_fn(|a| {
        if a < velocities {
            mass[a][a].max(0.0).sqrt()
        } else {
            0.0
        }
    });
    let greatest = own.iter().fold(0.0, |a: f64, &b| a.max(b));
    own.map(|value| {
        if greatest > 0.0 {
            value.max(LIGHT * greatest)
        } else {
            1.0
        }
    })
}

/// Makes vectors orthonormal by a mass matrix; `Err` is one that moves no mass.
fn orthonormalise<const N: usize>(
    vectors: &mut [[f64; N]],
    mass: &Square<N>,
) -> Result<(), [f64; N]> {
    let count = vectors.len();
    let mut gram = [[0.0; N]; N];
    for (i, row) in gram.iter_mut().enumerate() {
        row[i] = 1.0;
    }
    for j in 0..count {
        let image = crate::array::times(mass, &vectors[j]);
        for i in 0..count {
            gram[i][j] = dot(&vectors[i], &image);
        }
    }
    let factors = Cholesky::new(&gram).map_err(|row| vectors[row.min(count - 1)])?;
    factors.orthonormalise(vectors);
    Ok(())
}
