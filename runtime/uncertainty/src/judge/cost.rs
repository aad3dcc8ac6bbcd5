//! Cost of a sample: a count of operations, so that the number of samples is the same on every machine.

use crate::Description;
use crate::modes::{Family, Modes};
use crate::tolerance::side_by_side_possible;

/// Limit on the additions and multiplications spent on the designs that judge a number: some ten milliseconds.
pub const BUDGET: f64 = 1.5e8;

/// Cost of an elementary function, in additions and multiplications.
const FUNCTION: f64 = 40.0;
/// Evaluations of residual and stiffness until a sample has converged.
const STEPS: f64 = 4.0;
/// Time of a vectorised operation relative to a scalar one.
const SIDE_BY_SIDE: f64 = 0.25;

/// How many plain samples are worth their time, some hundredths of a second for each of `budgets`: 3000, or fewer of
/// machines with many coordinates, but at least 200.
#[must_use]
pub fn affordable(modes: &Modes, budgets: f64) -> usize {
    let most = budgets * BUDGET / operations(modes, false);
    most.clamp(200.0, 3000.0) as usize
}

/// Whether samples may be solved in vectorised blocks.
pub(crate) fn together(modes: &Modes) -> bool {
    side_by_side_possible(&modes.description, modes.family)
}

/// Operations per sample: equilibrium, modes and their evaluation.
pub(crate) fn operations(modes: &Modes, together: bool) -> f64 {
    let description = &modes.description;
    let n = description.coordinates.len() as f64;
    let kernels = STEPS * kernel(description, "residual_and_stiffness") + kernel(description, "linear");
    // The n^3 terms: reduction, iterations and vectors of a symmetric pencil, or of a general one of twice the size,
    // left and right.
    match (together, modes.family) {
        (true, Family::Undamped) => 200.0 + SIDE_BY_SIDE * (kernels + 16.0 * n.powi(3)),
        (true, Family::General) => 400.0 + SIDE_BY_SIDE * (kernels + 160.0 * n.powi(3)),
        (false, Family::Undamped) => 2_000.0 + kernels + 30.0 * n.powi(3),
        (false, Family::General) => 6_000.0 + kernels + 240.0 * n.powi(3),
    }
}

/// Operations of a kernel; estimated from the size of its result if its code was not generated.
fn kernel(description: &Description, name: &str) -> f64 {
    let n = description.coordinates.len() as f64;
    description
        .kernel(name)
        .map_or(50.0 * n * n, |kernel| kernel.operations as f64 + FUNCTION * kernel.functions as f64)
}
