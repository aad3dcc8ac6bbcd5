//! Redundant constraints: whether they stay consistent when a variable changes.

use crate::algebra::{Matrix, Vector, dot};
use crate::constraints::{Rows, Structure, Tangent, placed};
use crate::equilibrium::SMALL_MOTION;
use crate::kernels::Kernels;
use crate::{Equilibrium, Error};

/// Relative remainder below which the terms of a sum count as cancelling.
pub(crate) const ROUNDING: f64 = 1e-9;

/// Checks that redundant constraints stay consistent: with `n` their left null vectors, `n^T dPhi/du = 0` and
/// `n^T dPhi/db = 0`. Otherwise the mechanism closes only at these values, and nothing has a derivative.
///
/// # Errors
/// [`Error::ClosesHereOnly`], and [`Error::SingularConfiguration`] if constraints become dependent at exactly this
/// configuration.
#[inline]
pub(super) fn check(mechanism: &dyn Kernels, at: &Equilibrium) -> Result<(), Error> {
    at.regular()?;
    if at.constraints.redundant == 0 { Ok(()) } else { check_consistent(mechanism, at) }
}

#[cold]
fn check_consistent(mechanism: &dyn Kernels, at: &Equilibrium) -> Result<(), Error> {
    let description = &at.description;
    let structure = Structure::of(description);
    let tangent = Tangent::new(&at.linear, structure);
    let (by_input, by_design) = mechanism.residual_partials(&at.coordinates, &at.inputs, &at.design);
    let scale = Scale::new(at, &tangent);
    for k in 0..tangent.redundant() {
        let n = tangent.null_left(k);
        if !at_rest(&n, at, structure) {
            continue;
        }
        let input = scale.broken(&n, &by_input, &at.inputs);
        let input = input.map(|(i, j)| (i, &description.inputs[j].name));
        let design = || scale.broken(&n, &by_design, &at.design).map(|(i, j)| (i, &description.design[j].name));
        if let Some((constraint, variable)) = input.or_else(design) {
            return Err(Error::ClosesHereOnly {
                constraint: description.unknown_name(constraint),
                variable: variable.clone(),
            });
        }
    }
    Ok(())
}

/// Whether `n` also cancels the constraints at rest, where a constraint on velocities that repeats one on positions is
/// void.
fn at_rest(n: &[f64], at: &Equilibrium, structure: Structure) -> bool {
    let first = structure.motions();
    let rows = Matrix::from_fn(structure.constraints(), first, |k, j| at.linear.stiffness[first + k][j]);
    Rows::balanced(rows).cancel(&n[structure.constraint_rows()], ROUNDING)
}

/// What changes of gaps are compared with.
struct Scale {
    /// Inverse sizes of the constraints, at the positions of their rows: the most that a null vector holds of each.
    weights: Vector,
    /// What changes of all motions by their own size open.
    opened: f64,
}

impl Scale {
    fn new(at: &Equilibrium, tangent: &Tangent) -> Self {
        let weights = placed(tangent.structure, &tangent.all.size.map(|size| 1.0 / size));
        let motions = &at.coordinates[..tangent.structure.motions()];
        let opened = tangent.structure.constraint_rows().fold(0.0, |sum, i| {
            motions
                .iter()
                .zip(&at.linear.stiffness[i])
                .fold(sum, |sum, (q, slope)| sum + weights[i] * slope.abs() * (SMALL_MOTION + q.abs()))
        });
        Self { weights, opened }
    }

    /// A variable that changes `n^T Phi`, and the constraint most affected. A change of the variable by its own size
    /// must open more than rounding.
    fn broken(&self, n: &[f64], partials: &Matrix, values: &[f64]) -> Option<(usize, usize)> {
        let broken = |j: usize| {
            let column = partials.column(j);
            let terms = dot(&self.weights, &column.map(f64::abs));
            let opening = self.opened / (SMALL_MOTION + values[j].abs());
            dot(n, &column).abs() > ROUNDING * (terms + opening)
        };
        let j = (0..partials.column_count()).find(|&j| broken(j))?;
        let share = |i: usize| (n[i] * partials[i][j]).abs();
        let rows = 1..partials.row_count();
        let most = rows.fold(0, |most, i| if share(i) > share(most) { i } else { most });
        Some((most, j))
    }
}
