//! How the nominal equilibrium validates those near it.

use super::nominal::{Nominal, between};
use crate::algebra::{Lu, Matrix, Vector};
use crate::batched::algebra::{Row, Square, small};
use crate::eigenproblem::Reference;
use crate::modes::{Family, free_pairs};
use crate::{Equilibrium, Modes};

/// Largest relative rounding error of an eigenvalue, estimated from the nominal matrices.
const ROUNDING: f64 = 1e-10;

/// The criterion by which the stiffness of a sample is compared with the nominal one.
pub(super) enum Statics<const N: usize> {
    /// Forces with a potential, and no constraints: the stiffness stays positive definite.
    Potential(Potential<N>),
    /// Other forces, including reactions: the stiffness stays regular.
    Forces(Forces<N>),
}

pub(super) struct Potential<const N: usize> {
    /// Undamped nominal modes, one per row.
    pub(super) shapes: Square<f64, N>,
    /// Their `lambda`, 1/s^2.
    pub(super) lambda: Row<f64, N>,
    /// `1/2 dKhat/dq_k` by `k` and row, with off-diagonal rows doubled and rows after `k` unused: the quadratic terms
    /// of the residual.
    pub(super) curvature: Vec<Square<f64, N>>,
    /// `dKhat/dq_k` in the basis of the nominal modes.
    pub(super) stiffening: Vec<Square<f64, N>>,
}

pub(super) struct Forces<const N: usize> {
    /// Inverse of the nominal stiffness, its rows divided by [`Self::units`].
    pub(super) inverse: Square<f64, N>,
    /// Units of the unknowns: motions with equal kinetic energies, and reactions.
    pub(super) units: Row<f64, N>,
}

impl<const N: usize> Statics<N> {
    /// `None` if the nominal state is not clear enough. `reach` is how far one standard deviation of every variable
    /// moves each coordinate.
    pub(super) fn new(
        nominal: &Nominal<'_>,
        (modes, reference): (&Modes, Option<&Reference>),
        reach: &[f64],
    ) -> Option<Self> {
        let (state, n) = (nominal.state, reach.len());
        if !nominal.potential {
            return Some(Self::Forces(Forces::new(state, &reference?.units)?));
        }
        let (shapes, lambda) = match modes.family {
            Family::Undamped => (modes.real_shapes(), modes.modes.iter().map(|mode| mode.lambda).collect()),
            Family::General => {
                let pairs = free_pairs(&state.linear, &modes.description).ok()?;
                (pairs.shapes, pairs.lambda)
            }
        };
        if !lambda.iter().all(|&value| value > 0.0) || !well_conditioned(state, &shapes, &lambda) {
            return None;
        }
        let slopes = nominal.stiffening(reach, &shapes, &lambda)?;
        Some(Self::Potential(Potential {
            curvature: slopes.iter().enumerate().map(quadratic_terms).collect(),
            stiffening: slopes.iter().map(|slope| small(n, &between(slope, &shapes))).collect(),
            shapes: small(n, &shapes),
            lambda: row(&lambda),
        }))
    }
}

impl<const N: usize> Forces<N> {
    fn new(state: &Equilibrium, units: &[f64]) -> Option<Self> {
        let n = units.len();
        let factors = Lu::new(&state.linear.stiffness)?;
        let columns = (0..n).map(|j| {
            let unit = Vector::from_fn(n, |i| if i == j { 1.0 } else { 0.0 });
            factors.solve(&unit)
        });
        let columns: Vec<Vector> = columns.collect();
        let inverse = Matrix::from_fn(n, n, |i, j| columns[j][i] / units[i]);
        Some(Self { inverse: small(n, &inverse), units: row(units) })
    }
}

/// Copies values into a row of small fixed size.
pub(super) fn row<const N: usize>(values: &[f64]) -> Row<f64, N> {
    core::array::from_fn(|i| values.get(i).copied().unwrap_or(0.0))
}

/// Whether `phi^T Khat phi` gives every eigenvalue with enough digits.
fn well_conditioned(nominal: &Equilibrium, shapes: &Matrix, lambda: &[f64]) -> bool {
    let n = lambda.len();
    let linear = &nominal.linear;
    shapes.iter().zip(lambda).all(|(shape, lambda)| {
        (0..n)
            .flat_map(|i| (0..n).map(move |j| (i, j)))
            .map(|(i, j)| {
                let size = linear.stiffness[i][j].abs() + lambda * linear.mass[i][j].abs();
                (shape[i] * shape[j]).abs() * size
            })
            .sum::<f64>()
            * f64::EPSILON
            <= ROUNDING * lambda
    })
}

/// `1/2 dKhat/dq_k`, with row `j < k` also standing for row `k` of `j`.
fn quadratic_terms<const N: usize>((k, slope): (usize, &Matrix)) -> Square<f64, N> {
    let mut terms = small(slope.row_count(), slope);
    for (j, row) in terms.iter_mut().enumerate() {
        let share = if j == k { 0.5 } else { 1.0 };
        row.iter_mut().for_each(|slope| *slope *= share);
    }
    terms
}
