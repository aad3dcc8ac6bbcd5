//! Values of an input at which a mode meets a condition.

use super::condition::{Condition, Crossing, Line};
use super::range::Range;
use super::search::{Along, Events, Met, Sought, search};
use super::track::Following;
use crate::Error;
use crate::kernels::DirectionalKernels;
use crate::modes::Family;

/// Finds every event in a range, along the followed equilibria: where frequencies meet `lines`, where oscillations
/// start or stop growing, and where stiffness vanishes.
///
/// Events do not depend on any grid of values: the search solves as many states as it takes to exclude others, and
/// [`Events::searched`] tells how far it has come. Flutter is sought only among general modes.
///
/// # Errors
/// [`Error::UnknownHandle`], [`Error::Setting`]. A range without an equilibrium is a
/// [gap](crate::sweep::Searched::gaps).
pub fn events(
    mechanism: &dyn DirectionalKernels,
    u: &[f64],
    b: &[f64],
    start: &[f64],
    following: impl Into<Following>,
    range: Range,
    lines: &[Line],
) -> Result<Events, Error> {
    let sought = Sought { lines: lines.to_vec(), flutter: true, critical: true };
    let along = along(mechanism, (u, b), start, following.into(), range);
    Ok(search(&along, &sought, |_| false)?.0)
}

fn along<'a>(
    mechanism: &'a dyn DirectionalKernels,
    values: (&'a [f64], &'a [f64]),
    start: &'a [f64],
    following: Following,
    range: Range,
) -> Along<'a> {
    let default_family = || Family::of(&mechanism.description());
    Along {
        mechanism,
        values,
        start,
        policy: following.policy,
        family: following.family.unwrap_or_else(default_family),
        range,
        held: following.held,
    }
}

/// Finds every input value in a range at which a frequency equals a line (a plain number is the multiple of the input),
/// along the followed equilibria. Modes keep their identity along the range. A frequency that jumps across the line
/// together with the equilibrium does not count.
///
/// # Errors
/// [`Error::UnknownHandle`], [`Error::Setting`], or the reason why there is no equilibrium in the whole range.
pub fn crossings(
    mechanism: &dyn DirectionalKernels,
    u: &[f64],
    b: &[f64],
    start: &[f64],
    following: impl Into<Following>,
    range: Range,
    line: impl Into<Line>,
) -> Result<Vec<Crossing>, Error> {
    let along = along(mechanism, (u, b), start, following.into(), range);
    meetings(&along, Condition::Line(line.into()), |_| false)
}

/// Finds every input value in a range at which an oscillation starts or stops growing, along the followed equilibria.
///
/// Otherwise like [`crossings`], but always with general modes.
///
/// # Errors
/// As [`crossings`].
pub fn flutter_onsets(
    mechanism: &dyn DirectionalKernels,
    u: &[f64],
    b: &[f64],
    start: &[f64],
    following: impl Into<Following>,
    range: Range,
) -> Result<Vec<Crossing>, Error> {
    let along = along(mechanism, (u, b), start, following.into(), range);
    meetings(&along, Condition::FlutterOnset, |_| false)
}

/// The first value in a range at which the mode that has position `mode` at the start, or else none of `others`, meets a
/// condition; `None` if there is none.
pub(crate) fn first_crossing(
    mechanism: &dyn DirectionalKernels,
    values: (&[f64], &[f64]),
    start: &[f64],
    following: Following,
    range: Range,
    (mode, condition): (usize, Condition),
    others: Option<&[usize]>,
) -> Result<Option<Crossing>, Error> {
    // Labels at the start are positions; modes that end on the way change the positions of others.
    let wanted = |crossing: &Crossing| {
        let label = crossing.modes.modes[crossing.mode].label;
        label == mode || others.is_some_and(|others| !others.contains(&label))
    };
    let along = along(mechanism, values, start, following, range);
    Ok(meetings(&along, condition, wanted)?.into_iter().find(wanted))
}

/// Finds the crossings in a range until one of them is `enough`.
fn meetings(
    along: &Along<'_>,
    condition: Condition,
    enough: impl Fn(&Crossing) -> bool,
) -> Result<Vec<Crossing>, Error> {
    let (lines, family) = match condition {
        Condition::FlutterOnset => (Vec::new(), Family::General),
        Condition::Line(line) => (vec![line], along.family),
    };
    let sought = Sought { flutter: lines.is_empty(), lines, critical: false };
    let along = Along { family, ..along.clone() };
    let (events, _) = search(&along, &sought, |event| match event {
        Met::Crossing(crossing) => enough(crossing),
        _ => false,
    })?;
    match events.searched.states {
        0 => Err((events.searched.gaps.into_iter().next()).map_or(Error::CriticalState, |gap| gap.reason)),
        _ => Ok(events.crossings),
    }
}
