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
use super::{Gathered, Normalisation, is_shared, lift, measure, with_reactions};
use crate::array::{Cholesky, Square, dot};
use crate::constraints::{Rows, Tangent};
use crate::modes::general::{Eigenproblem, Numbers, Roots, solve_on};
use crate::modes::symmetric::Trouble;
use crate::{Complex, Linear};

pub(super) fn roots<const N: usize>(
    linear: &Linear<f64, N>,
    tangent: &Tangent<N>,
) -> Result<Roots<N>, Trouble> {
    let system = System::new(linear, tangent)?;
    let size = tangent.freedom + system.independent;
    let mut matrix = [[[0.0; N]; N]; 4];
    let matrix = &mut matrix.as_flattened_mut().as_flattened_mut()[..size * size];
    system.fill(matrix);
    let mut numbers = [[Numbers::NONE; 2]; N];
    let mut right = [[[Complex::default(); N]; N]; 4];
    let mut left = right;
    let right = &mut right.as_flattened_mut().as_flattened_mut()[..size * size];
    let left = &mut left.as_flattened_mut().as_flattened_mut()[..size * size];
    let problem = Eigenproblem::FirstOrder { n: size, matrix };
    let count = solve_on(problem, numbers.as_flattened_mut(), right, left)?;
    let numbers = &numbers.as_flattened()[..count];
    let mut gathered = Gathered::new(linear, tangent.structure, Normalisation::Largest);
    for (i, own) in numbers.iter().enumerate() {
        let vector = i * size..(i + 1) * size;
        let phi = system.motion(&right[vector.clone()]);
        gathered.add(
            own,
            is_shared(numbers, i),
            with_reactions(linear, tangent, own.s, &phi),
            system.left(own.s, &left[vector]),
        )?;
    }
    Ok(gathered.roots)
}

/// The reduced matrices. Vectors by velocity have `ydot` in the first `freedom` places, then the speeds.
struct System<'a, const N: usize> {
    linear: &'a Linear<f64, N>,
    tangent: &'a Tangent<N>,
    /// Number of independent velocities.
    independent: usize,
    /// All constraints on velocities, `[A_q P, A_v]`.
    velocity: Rows<N>,
    /// The first `independent` rows are the columns of `Z`.
    free: Square<N>,
    /// The first `freedom` rows are the columns of `E`.
    forced: Square<N>,
    /// `M_nu` and `C_nu`, `freedom` + number of speeds in size.
    mass: Square<N>,
    damping: Square<N>,
    /// `K_y`: rows by velocity, columns by position.
    stiffness: Square<N>,
}

impl<'a, const N: usize> System<'a, N> {
    fn new(linear: &'a Linear<f64, N>, tangent: &'a Tangent<N>) -> Result<Self, Trouble> {
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
        let row = |k: usize| -> [f64; N] {
            let (c, b) = (
                &linear.damping[rows.start + k],
                &linear.stiffness[rows.start + k],
            );
            core::array::from_fn(|a| {
                if a < f {
                    dot(c, &tangent.basis[a])
                } else if a < velocities {
                    b[speeds.start + a - f]
                } else {
                    0.0
                }
            })
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

    fn velocities(&self) -> usize {
        self.tangent.freedom + self.tangent.structure.speeds
    }

    /// `F`, row by row.
    fn fill(&self, matrix: &mut [f64]) {
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

    /// Coordinates and speeds of a right vector.
    fn motion(&self, z: &[Complex]) -> [Complex; N] {
        let f = self.tangent.freedom;
        let (y, w) = z.split_at(f);
        let mut nu = combined(w, &self.free);
        for (nu, part) in nu.iter_mut().zip(combined(y, &self.forced)) {
            *nu += part;
        }
        let mut x = lift(self.tangent, y);
        for (k, place) in self.tangent.structure.speed_range().enumerate() {
            x[place] = nu[f + k];
        }
        x
    }

    /// The left vector of the bordered pencil. With `psi_nu = Z l_w` the columns of positions and velocities say
    /// `kappa = l_y - E^T M_nu^T psi_nu`, `[A_q P, A_v]^T psi_2 = (kappa; 0) - (s M_nu + C_nu)^T psi_nu`, and the columns of
    /// coordinates give the rest.
    fn left(&self, s: Complex, l: &[Complex]) -> [Complex; N] {
        let (f, structure) = (self.tangent.freedom, self.tangent.structure);
        let (l_y, l_w) = l.split_at(f);
        let nu = combined(l_w, &self.free);
        let transposed = |matrix: &Square<N>| -> [Complex; N] {
            let mut sum = [Complex::default(); N];
            for (row, x) in matrix.iter().zip(&nu) {
                for (sum, value) in sum.iter_mut().zip(row) {
                    *sum += x * value;
                }
            }
            sum
        };
        let (m, c) = (transposed(&self.mass), transposed(&self.damping));
        let force: [Complex; N] = core::array::from_fn(|a| {
            let kappa = if a < f {
                let forced = self.forced[a].iter().zip(&m);
                l_y[a] - forced.map(|(e, m)| m * e).sum::<Complex>()
            } else {
                Complex::default()
            };
            if a < self.velocities() {
                kappa - s * m[a] - c[a]
            } else {
                Complex::default()
            }
        });
        let re = self.velocity.multipliers(&force.map(|value| value.re));
        let im = self.velocity.multipliers(&force.map(|value| value.im));
        let mut psi = lift(self.tangent, &nu[..f]);
        for (k, place) in structure.speed_range().enumerate() {
            psi[place] = nu[f + k];
        }
        for (k, place) in structure.velocity_rows().enumerate() {
            psi[place] = Complex::new(re[k], im[k]);
        }
        let rest = measure::times_transposed(self.linear, s, &psi);
        let rest: [Complex; N] = core::array::from_fn(|i| {
            if i < structure.coordinates {
                -rest[i]
            } else {
                Complex::default()
            }
        });
        let re = self
            .tangent
            .positions
            .multipliers(&rest.map(|value| value.re));
        let im = self
            .tangent
            .positions
            .multipliers(&rest.map(|value| value.im));
        for (k, place) in structure.position_rows().enumerate() {
            psi[place] = Complex::new(re[k], im[k]);
        }
        psi
    }
}

/// `sum_i amounts_i vectors[i]`.
fn combined<const N: usize>(amounts: &[Complex], vectors: &Square<N>) -> [Complex; N] {
    let mut sum = [Complex::default(); N];
    for (amount, vector) in amounts.iter().zip(vectors) {
        for (sum, value) in sum.iter_mut().zip(vector) {
            *sum += amount * value;
        }
    }
    sum
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
