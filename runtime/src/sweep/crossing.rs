//! Values of an input at which a mode meets a condition, located by Newton's method with exact slopes.

use super::condition::{Condition, Crossing, Line};
use super::merging;
use super::points::SweepPoint;
use super::range::Range;
use super::track::{Following, Tracker};
use crate::Error;
use crate::equilibrium::{Bracket, refine};
use crate::kernels::Kernels;
use crate::modes::Family;

/// Finds every input value in a range at which a frequency equals a line (a plain number is the multiple of the input),
/// along the followed equilibria. Modes keep their identity along the range. Points without an equilibrium or without
/// modes are skipped. A frequency that jumps across the line together with the equilibrium does not count.
///
/// # Errors
/// [`Error::UnknownHandle`], [`Error::Setting`], or the error of the first point.
pub fn crossings(
    mechanism: &dyn Kernels,
    u: &[f64],
    b: &[f64],
    start: &[f64],
    following: impl Into<Following>,
    range: Range,
    line: impl Into<Line>,
) -> Result<Vec<Crossing>, Error> {
    let line = Condition::Line(line.into());
    meetings(
        mechanism,
        (u, b),
        start,
        following.into(),
        range,
        line,
        never,
    )
}

/// Finds every input value in a range at which an oscillation starts or stops growing, along the followed equilibria.
///
/// Otherwise like [`crossings`], but always with general modes.
///
/// # Errors
/// As [`crossings`].
pub fn flutter_onsets(
    mechanism: &dyn Kernels,
    u: &[f64],
    b: &[f64],
    start: &[f64],
    following: impl Into<Following>,
    range: Range,
) -> Result<Vec<Crossing>, Error> {
    let onset = Condition::FlutterOnset;
    meetings(
        mechanism,
        (u, b),
        start,
        following.into(),
        range,
        onset,
        never,
    )
}

/// The first value in a range at which the mode that has position `mode` at the start meets a condition; `None` if
/// there is none.
pub(crate) fn first_crossing(
    mechanism: &dyn Kernels,
    values: (&[f64], &[f64]),
    start: &[f64],
    following: Following,
    range: Range,
    (mode, condition): (usize, Condition),
) -> Result<Option<Crossing>, Error> {
    // Labels at the start are positions; modes that end on the way change the positions of others.
    let wanted = |crossing: &Crossing| crossing.modes.modes[crossing.mode].label == mode;
    let met = |found: &[Crossing]| found.iter().any(wanted);
    let found = meetings(mechanism, values, start, following, range, condition, met)?;
    Ok(found.into_iter().find(wanted))
}

/// Never enough: all crossings are wanted.
fn never(_: &[Crossing]) -> bool {
    false
}

/// Finds the crossings in a range until `enough` returns true.
fn meetings(
    mechanism: &dyn Kernels,
    values: (&[f64], &[f64]),
    start: &[f64],
    following: Following,
    range: Range,
    condition: Condition,
    enough: impl Fn(&[Crossing]) -> bool,
) -> Result<Vec<Crossing>, Error> {
    range.check(&mechanism.description())?;
    if let Condition::Line(Line { ratio, offset }) = condition
        && !(ratio.is_finite() && offset.is_finite())
    {
        return Err(Error::Setting {
            setting: "line",
            reason: format!("{ratio} times the input + {offset} rad/s is not finite"),
        });
    }
    let following = Following {
        family: match condition {
            Condition::FlutterOnset => Some(Family::General),
            Condition::Line(_) => following.family,
        },
        ..following
    };
    let mut tracker = Tracker::new(mechanism, values, start, following, range.input);
    if let Some(failed) = tracker.advance(range.low) {
        failed.modes?;
    }
    let mut found = Vec::new();
    for value in range.values() {
        let before = tracker.last.clone();
        if tracker.advance(value).is_some() {
            continue;
        }
        if let (Some(before), Some(after)) = (&before, &tracker.last) {
            between(&tracker, before, after, condition, &mut found);
        }
        if enough(&found) {
            break;
        }
    }
    Ok(found)
}

/// Adds the crossings between two neighbouring points, matching modes by label.
pub(crate) fn between(
    tracker: &Tracker<'_>,
    before: &SweepPoint,
    after: &SweepPoint,
    condition: Condition,
    found: &mut Vec<Crossing>,
) {
    let (Ok(solved), Ok(after_modes)) = (before.solved(), &after.modes) else {
        return;
    };
    let known = found.len();
    for label in solved.1.modes.iter().map(|mode| mode.label) {
        let (Some(at_low), Some(at_high)) = (
            condition.excess(solved.1, label, tracker.actual(before.value)),
            condition.excess(after_modes, label, tracker.actual(after.value)),
        ) else {
            continue;
        };
        if (at_low > 0.0) == (at_high > 0.0) {
            continue;
        }
        let bracket = Bracket {
            low: before.value,
            high: after.value,
            at_low,
            at_high,
        };
        let root = refine(bracket, |trial| {
            let (state, modes) = tracker.near(trial, solved).ok()?;
            let excess = condition.excess(&modes, label, tracker.actual(trial))?;
            let slope = condition.slope(tracker.mechanism, (&state, &modes), label, tracker.input);
            Some((excess, slope))
        });
        let Ok((equilibrium, modes)) = tracker.near(root, solved) else {
            continue;
        };
        let actual = tracker.actual(root);
        let position = modes
            .modes
            .iter()
            .position(|mode| mode.label == label && condition.is_met(mode, actual));
        if let Some(mode) = position {
            found.push(Crossing {
                input: tracker.input,
                value: root,
                condition,
                mode,
                equilibrium,
                modes,
            });
        }
    }
    if condition == Condition::FlutterOnset && found.len() == known {
        found.extend(merging::onset(tracker, before, after));
    }
}
