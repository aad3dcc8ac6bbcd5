//! Redundant constraints: whether they go on saying the same when a variable changes.

use crate::algebra::Matrix;
use crate::constraints::{Structure, Tangent};
use crate::kernels::Kernels;
use crate::{Equilibrium, Error};

/// What remains of a sum of terms that cancel but for rounding, relative to the terms.
const ROUNDING: f64 = 1e-9;

/// Checks that redundant constraints stay consistent: with `n` their null left vectors, `n^T dPhi/du = 0` and
/// `n^T dPhi/db = 0`. Otherwise the mechanism closes at these values only, and nothing has a derivative.
///
/// # Errors
/// [`Error::ClosesHereOnly`], and [`Error::SingularConfiguration`] where constraints are dependent here alone.
pub(super) fn check(mechanism: &dyn Kernels, at: &Equilibrium) -> Result<(), Error> {
    let description = &at.description;
    let structure = Structure::of(description);
    if structure.constraints() == 0 {
        return Ok(());
    }
    at.regular()?;
    if at.constraints.redundant == 0 {
        return Ok(());
    }
    let tangent = Tangent::new(&at.linear, structure);
    let (by_input, by_design) =
        mechanism.residual_partials(&at.coordinates, &at.inputs, &at.design);
    for k in 0..tangent.redundant() {
        let n = tangent.null_left(k);
        if !at_rest(&n, at, structure) {
            continue;
        }
        let input = broken(&n, &by_input).map(|(i, j)| (i, &description.inputs[j].name));
        let design = || broken(&n, &by_design).map(|(i, j)| (i, &description.design[j].name));
        if let Some((constraint, variable)) = input.or_else(design) {
            return Err(Error::ClosesHereOnly {
                constraint: description.unknown_name(constraint),
                variable: variable.clone(),
            });
        }
    }
    Ok(())
}

/// Whether `n` cancels the constraints at rest as well: a constraint on velocities that repeats one on positions says
/// nothing there.
fn at_rest(n: &[f64], at: &Equilibrium, structure: Structure) -> bool {
    (0..structure.motions()).all(|j| {
        let terms = structure
            .constraint_rows()
            .map(|i| n[i] * at.linear.stiffness[i][j]);
        cancels(terms)
    })
}

fn cancels(terms: impl Iterator<Item = f64>) -> bool {
    let (sum, size) = terms.fold((0.0, 0.0), |(sum, size), term| {
        (sum + term, size + f64::abs(term))
    });
    f64::abs(sum) <= ROUNDING * size
}

/// A variable that moves `n^T Phi`, and the constraint that feels it most.
fn broken(n: &[f64], partials: &Matrix) -> Option<(usize, usize)> {
    let rows = partials.row_count();
    let rests = |j: usize| cancels((0..rows).map(|i| n[i] * partials[i][j]));
    let j = (0..partials.column_count()).find(|&j| !rests(j))?;
    let share = |i: usize| (n[i] * partials[i][j]).abs();
    let most = (1..rows).fold(0, |most, i| if share(i) > share(most) { i } else { most });
    Some((most, j))
}
