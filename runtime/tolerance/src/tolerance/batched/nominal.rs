//! How the nominal state depends on the design, to first and second order.

use crate::Equilibrium;
use crate::algebra::{Cholesky, Lu, Matrix, Vector, all_finite, all_finite_matrix, form};
use crate::batched::algebra::Row;
use crate::kernels::Kernels;

/// Number of design variables up to which second derivatives of the equilibrium shorten Newton's method.
pub(super) const FEW: usize = 8;
/// Displacement (rad or m) for differences if the equilibrium does not move.
const SMALL: f64 = 1e-4;
/// Largest relative change of a mode's stiffness that second derivatives may cause over the displacement of one
/// standard deviation. [`FAR`](super::equilibrium::FAR) times the displacement still leaves three quarters of the
/// stiffness.
const STRAIGHT: f64 = 0.007;

/// The nominal state and its neighbours.
pub(super) struct Nominal<'a> {
    pub(super) mechanism: &'a dyn Kernels,
    pub(super) state: &'a Equilibrium,
    /// Forces have a potential, and there are no constraints.
    pub(super) potential: bool,
}

impl Nominal<'_> {
    /// `dq*/db = -Khat^-1 dg/db` of the varied variables at a state next to an equilibrium; `None` if `Khat` is not
    /// positive definite or, if there is no potential, is singular.
    pub(super) fn slopes(&self, q: &[f64], b: &[f64], varied: &[usize]) -> Option<Vec<Vector>> {
        let inputs = &self.state.inputs;
        let (_, stiffness) = self.mechanism.residual_and_stiffness(q, inputs, b);
        let (_, by_design) = self.mechanism.residual_partials(q, inputs, b);
        let right = |&j: &usize| Vector::from_fn(q.len(), |i| -by_design[i][j]);
        let right = varied.iter().map(right);
        let slopes: Vec<Vector> = if self.potential {
            let factors = Cholesky::new(&stiffness).ok()?;
            right.map(|right| factors.solve(&right)).collect()
        } else {
            let factors = Lu::new(&stiffness)?;
            right.map(|right| factors.solve(&right)).collect()
        };
        slopes.iter().all(|slope| all_finite(slope)).then_some(slopes)
    }

    /// Coefficients of `db_j db_k`, `j <= k`: half of `d2q*/db_j db_k` for equal variables, all of it for different
    /// ones. They are secants of the slopes over one standard deviation along the equilibria.
    pub(super) fn curvatures<const N: usize>(
        &self,
        varied: &[usize],
        first: &[Vector],
        deviations: &[f64],
    ) -> Option<Vec<[Row<f64, N>; FEW]>> {
        let mut second = Vec::new();
        if varied.len() > FEW {
            return Some(second);
        }
        for (k, &variable) in varied.iter().enumerate() {
            let step = deviations[variable];
            let at = |step: f64| {
                let mut b = self.state.design.clone();
                b[variable] += step;
                let nominal = self.state.coordinates.iter();
                let q: Vector = nominal.zip(&first[k]).map(|(q, slope)| q + step * slope).collect();
                self.slopes(&q, &b, varied)
            };
            let (above, below) = (at(step)?, at(-step)?);
            let mut rows = [[0.0; N]; FEW];
            for (j, row) in rows.iter_mut().enumerate().take(k + 1) {
                let share = if j == k { 0.25 } else { 0.5 };
                for (i, value) in row.iter_mut().enumerate().take(first[k].len()) {
                    *value = share * (above[j][i] - below[j][i]) / step;
                }
            }
            second.push(rows);
        }
        second.iter().flatten().all(|row| all_finite(row)).then_some(second)
    }

    /// How far one standard deviation of every varied variable moves each coordinate, all in the same direction; a
    /// small displacement where the equilibrium does not move.
    pub(super) fn reach(&self, varied: &[usize], first: &[Vector], deviations: &[f64]) -> Vector {
        Vector::from_fn(self.state.coordinates.len(), |k| {
            first.iter().zip(varied).fold(SMALL, |sum, (slope, &j)| sum + (slope[k] * deviations[j]).abs())
        })
    }

    /// `dKhat/dq_k` by differences over this displacement; `None` if the stiffness of a mode is too nonlinear over it.
    pub(super) fn stiffening(&self, reach: &[f64], shapes: &Matrix, lambda: &[f64]) -> Option<Vec<Matrix>> {
        let Equilibrium { coordinates, inputs, design, .. } = self.state;
        let n = coordinates.len();
        let here = &self.state.linear.stiffness;
        let mut slopes = Vec::with_capacity(n);
        for k in 0..n {
            let at = |step: f64| {
                let mut q = coordinates.clone();
                q[k] += step;
                self.mechanism.residual_and_stiffness(&q, inputs, design).1
            };
            let (above, below) = (at(reach[k]), at(-reach[k]));
            let slope = Matrix::from_fn(n, n, |i, j| (above[i][j] - below[i][j]) / (2.0 * reach[k]));
            let bend = Matrix::from_fn(n, n, |i, j| 0.5 * (above[i][j] + below[i][j]) - here[i][j]);
            let bend = between(&bend, shapes);
            let straight =
                (0..n).all(|r| (0..n).all(|s| bend[r][s].abs() <= STRAIGHT * (lambda[r] * lambda[s]).sqrt()));
            if !straight || !all_finite_matrix(&slope) {
                return None;
            }
            slopes.push(slope);
        }
        Some(slopes)
    }
}

/// A symmetric matrix in the basis of the modes.
pub(super) fn between(matrix: &Matrix, shapes: &Matrix) -> Matrix {
    let n = shapes.row_count();
    Matrix::from_fn(n, n, |r, s| form(&shapes[r], matrix, &shapes[s]))
}
