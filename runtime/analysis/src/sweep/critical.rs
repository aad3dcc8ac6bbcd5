//! Values of an input where stiffness vanishes on a branch of equilibria: critical speeds.

use super::points::CriticalState;
use super::range::Range;
use super::search::{Along, Met, Sought, search};
use crate::Error;
use crate::equilibrium::Policy;
use crate::error::NotFound;
use crate::kernels::DirectionalKernels;
use crate::modes::Family;

/// Finds the first input value at which the branch that is stable at `range.low` loses its stiffness: a limit point or
/// branch point, located to rounding accuracy.
///
/// A branch that runs to infinity is not critical. A non-symmetric `Khat` is critical where its determinant vanishes.
///
/// # Errors
/// [`Error::NotInRange`] if the branch keeps its stiffness; the cause if the branch cannot be followed to the end of
/// the range; otherwise as [`equilibrium`](crate::equilibrium::equilibrium).
pub fn critical_state(
    mechanism: &dyn DirectionalKernels,
    u: &[f64],
    b: &[f64],
    start: &[f64],
    range: Range,
) -> Result<CriticalState, Error> {
    let description = mechanism.description();
    let along = Along {
        mechanism,
        values: (u, b),
        start,
        policy: Policy::Stable,
        family: Family::of(&description),
        range,
        held: Vec::new(),
    };
    let sought = Sought { critical: true, ..Sought::default() };
    let mut first_state = None;
    let (events, _) = search(&along, &sought, |event| match event {
        Met::Critical(state, true) => {
            first_state = Some(state.clone());
            true
        }
        Met::Gap => true,
        _ => false,
    })?;
    if let Some(state) = first_state {
        return Ok(state);
    }
    let escapes = |error: &Error| {
        let reason = NotFound::Escape;
        matches!(error, Error::BranchLost { reason: own, .. } if *own == reason)
    };
    let gap = events.searched.gaps.into_iter().next();
    match gap.map(|gap| gap.reason).filter(|error| !escapes(error)) {
        Some(error) => Err(error),
        None => Err(range.without("critical value", &description)),
    }
}
