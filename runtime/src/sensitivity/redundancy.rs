//! Redundant constraints: whether they go on saying the same when a variable changes.

use crate::constraints::{Structure, Tangent};
use crate::{Equilibrium, Error, Mechanism};

/// What remains of a sum of terms that cancel but for rounding, relative to the terms.
const ROUNDING: f64 = 1e-9;

/// Checks that redundant constraints stay consistent: with `n` their null left vectors, `n^T dPhi/du = 0` and
/// `n^T dPhi/db = 0`. Otherwise the mechanism closes at these values only, and nothing has a derivative.
///
/// # Errors
/// [`Error::ClosesHereOnly`], and [`Error::SingularConfiguration`] where constraints are dependent here alone.
pub(super) fn check<M, const N: usize, const U: usize, const P: usize, const O: usize>(
    mechanism: &M,
    at: &Equilibrium<N, U, P>,
) -> Result<(), Error>
where
    M: Mechanism<N, U, P, O>,
{
    let structure = const { Structure::of(&M::DESCRIPTION) };
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
        let names = (M::DESCRIPTION.inputs, M::DESCRIPTION.design);
        let inputs = broken(&n, &by_input).map(|(i, j)| (i, names.0.get(j).map(|info| info.name)));
        let design =
            || broken(&n, &by_design).map(|(i, j)| (i, names.1.get(j).map(|info| info.name)));
        if let Some((constraint, variable)) = inputs.or_else(design) {
            let name = M::DESCRIPTION.coordinates.get(constraint);
            return Err(Error::ClosesHereOnly {
                constraint: name.map_or("?", |info| info.name),
                variable: variable.unwrap_or("?"),
            });
        }
    }
    Ok(())
}

/// Whether `n` cancels the constraints at rest as well: a constraint on velocities that repeats one on positions says
/// nothing there.
fn at_rest<const N: usize, const U: usize, const P: usize>(
    n: &[f64; N],
    at: &Equilibrium<N, U, P>,
    structure: Structure,
) -> bool {
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
fn broken<const N: usize, const C: usize>(
    n: &[f64; N],
    partials: &[[f64; C]; N],
) -> Option<(usize, usize)> {
    let j = (0..C).find(|&j| !cancels((0..N).map(|i| n[i] * partials[i][j])))?;
    let share = |i: usize| (n[i] * partials[i][j]).abs();
    let most = (1..N).fold(0, |most, i| if share(i) > share(most) { i } else { most });
    Some((most, j))
}
