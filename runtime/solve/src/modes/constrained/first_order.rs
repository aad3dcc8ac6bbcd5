//! Modes with speeds or constraints on velocities: roots of the first-order [`System`], their vectors completed to
//! those of the bordered pencil.

use super::system::System;
use super::{Gathered, is_shared, lift, with_reactions};
use crate::Complex;
use crate::algebra::{Matrix, Vector};
use crate::constraints::Tangent;
use crate::eigenproblem::{Eigenproblem, EigenproblemError, Root, roots_of};
use crate::kernels::Linear;
use crate::modes::deflation;
use crate::modes::normalisation::Normalisation;
use crate::modes::pencil::pencil_transposed_times;

pub(super) fn roots(linear: &Linear, tangent: &Tangent, free: usize) -> Result<Vec<Root>, EigenproblemError> {
    let system = System::new(linear, tangent)?;
    let (matrix, terms) = match free {
        0 => (system.matrix(), Matrix::default()),
        _ => system.matrix_without_rounding(),
    };
    let reduced =
        deflation::first_order_roots((&matrix, &terms), free, |matrix| roots_of(Eigenproblem::FirstOrder(matrix)))?;
    let size = if tangent.structure.holonomic() { Normalisation::Mass } else { Normalisation::Largest };
    let mut gathered = Gathered::new(linear, tangent.structure, size);
    for (i, root) in reduced.iter().enumerate() {
        let phi = system.motion(&root.right);
        let right = with_reactions(linear, tangent, root.s, &phi);
        let left = system.left(root.s, &root.left);
        match i >= free && deflation::is_standing(root) {
            // No eigenvector of its own, but the motion that accelerates one before it.
            true => gathered.keep(root.clone(), right, left),
            false => gathered.add(root, is_shared(&reduced, i), right, left),
        }
    }
    Ok(gathered.roots)
}

impl System<'_> {
    /// Coordinates and speeds of a right vector.
    fn motion(&self, z: &[Complex]) -> Vector<Complex> {
        let f = self.tangent.freedom;
        let (y, w) = z.split_at(f);
        let mut nu = self.combined(w, &self.free);
        for (nu, part) in nu.iter_mut().zip(self.combined(y, &self.forced)) {
            *nu += part;
        }
        let mut x = lift(self.tangent, y);
        for (k, index) in self.tangent.structure.speed_range().enumerate() {
            x[index] = nu[f + k] * self.units[k];
        }
        x
    }

    /// The left vector of the bordered pencil. With `psi_nu = Z l_w` the columns of positions and velocities give
    /// `kappa = l_y - E^T M_nu^T psi_nu` and `[A_q P, A_v]^T psi_2 = (kappa; 0) - (s M_nu + C_nu)^T psi_nu`; the
    /// columns of coordinates give the rest.
    fn left(&self, s: Complex, l: &[Complex]) -> Vector<Complex> {
        let (f, structure) = (self.tangent.freedom, self.tangent.structure);
        let (l_y, l_w) = l.split_at(f);
        let nu = self.combined(l_w, &self.free);
        let (m, c) = (self.combined(&nu, self.mass.iter()), self.combined(&nu, self.damping.iter()));
        let terms = |a: usize| {
            let forced = self.forced.get(a).map(|forced| forced.iter().zip(&m));
            let forced = forced.into_iter().flatten().map(|(e, m)| -m * e);
            let given = l_y.get(a).copied();
            [-s * m[a], -c[a]].into_iter().chain(given).chain(forced)
        };
        let most = (0..self.velocities()).flat_map(terms).fold(0.0, |most: f64, term| most.max(term.norm()));
        // What rounding leaves of forces that cancel would make a reaction of its own.
        let rounding = 4.0 * self.velocities() as f64 * f64::EPSILON * most;
        let force = Vector::from_fn(self.velocities(), |a| {
            let sum: Complex = terms(a).sum();
            if sum.norm() <= rounding { Complex::default() } else { sum }
        });
        let re = self.velocity.multipliers(&force.map(|value| value.re));
        let im = self.velocity.multipliers(&force.map(|value| value.im));
        let mut psi = lift(self.tangent, &nu[..f]);
        for (k, index) in structure.speed_range().enumerate() {
            psi[index] = nu[f + k] * self.units[k];
        }
        for (k, velocity_row) in structure.velocity_rows().enumerate() {
            psi[velocity_row] = Complex::new(re[k], im[k]);
        }
        let rest = pencil_transposed_times(self.linear, s, &psi);
        let rest =
            Vector::from_fn(rest.len(), |i| if i < structure.coordinates { -rest[i] } else { Complex::default() });
        let re = self.tangent.positions.multipliers(&rest.map(|value| value.re));
        let im = self.tangent.positions.multipliers(&rest.map(|value| value.im));
        for (k, position_row) in structure.position_rows().enumerate() {
            psi[position_row] = Complex::new(re[k], im[k]);
        }
        psi
    }

    /// `sum_i amounts_i vectors[i]`, by velocity.
    fn combined(&self, amounts: &[Complex], vectors: impl IntoIterator<Item = impl AsRef<[f64]>>) -> Vector<Complex> {
        let mut sum = Vector::zeros(self.velocities());
        for (amount, vector) in amounts.iter().zip(vectors) {
            for (sum, value) in sum.iter_mut().zip(vector.as_ref()) {
                *sum += amount * value;
            }
        }
        sum
    }
}
