//! Speeds, or constraints on velocities: roots of the system of first order ([`System`]), their vectors completed to those
//! of the bordered pencil.

use super::system::System;
use super::{Gathered, Normalisation, is_shared, lift, with_reactions};
use crate::array::Square;
use crate::constraints::Tangent;
use crate::modes::general::{Eigenproblem, Numbers, Roots, solve_on};
use crate::modes::symmetric::Trouble;
use crate::pencil::pencil_transposed_times;
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

impl<const N: usize> System<'_, N> {
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
        let rest = pencil_transposed_times(self.linear, s, &psi);
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
