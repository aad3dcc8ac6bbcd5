//! Redundant constraints: whether they stay consistent when a variable changes.

use crate::algebra::Matrix;
use crate::constraints::{Structure, Tangent};
use crate::kernels::Kernels;
use crate::{Equilibrium, Error};

/// Relative remainder below which the terms of a sum count as cancelling.
const ROUNDING: f64 = 1e-9;

/// Checks that redundant constraints stay consistent: with `n` their left null vectors, `n^T dPhi/du = 0` and
/// `n^T dPhi/db = 0`. Otherwise the mechanism closes only at these values, and nothing has a derivative.
///
/// # Errors
/// [`Error::ClosesHereOnly`], and [`Error::SingularConfiguration`] if constraints become dependent at exactly this
/// configuration.
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

/// Whether `n` also cancels the constraints at rest, where a constraint on velocities that repeats one on positions is
/// void.
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

/// A variable that changes `n^T Phi`, and the constraint most affected.
fn broken(n: &[f64], partials: &Matrix) -> Option<(usize, usize)> {
    let rows = partials.row_count();
    let rests = |j: usize| cancels((0..rows).map(|i| n[i] * partials[i][j]));
    let j = (0..partials.column_count()).find(|&j| !rests(j))?;
    let share = |i: usize| (n[i] * partials[i][j]).abs();
    let most = (1..rows).fold(0, |most, i| if share(i) > share(most) { i } else { most });
    Some((most, j))
}
