//! Values of an input where a mode meets a condition: its frequency equals a multiple of the input (resonance, critical
//! speed of a rotor), or its oscillation stops decaying (onset of flutter). Located by Newton's method with exact slopes.

use super::points::SweepPoint;
use super::range::Range;
use super::track::{Following, Tracker};
use crate::equilibrium::{Bracket, refine};
use crate::kernels::Kernels;
use crate::modes::Family;
use crate::sensitivity::{Quantity, sensitivities};
use crate::{Equilibrium, Error, Input, Mode, Modes};

/// A line `ratio u + offset` that a frequency is compared with: an engine order, or a fixed excitation.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Line {
    /// Multiple of the input; rad/s per SI unit of the input.
    pub ratio: f64,
    /// Part that does not depend on the input, rad/s.
    pub offset: f64,
}

impl From<f64> for Line {
    /// The line `ratio u`.
    fn from(ratio: f64) -> Self {
        Self { ratio, offset: 0.0 }
    }
}

/// What a mode meets at a value of an input.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Condition {
    /// Its frequency equals a line: `Im s = ratio u + offset`.
    Line(Line),
    /// Its oscillation neither grows nor decays: `Re s = 0`, with growth on one side.
    FlutterOnset,
}

/// A state where a mode meets a condition.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Crossing {
    /// The input that was varied.
    pub input: Input,
    /// Its value there, SI.
    pub value: f64,
    /// What is met.
    pub condition: Condition,
    /// Position of the mode in `modes`.
    pub mode: usize,
    /// The equilibrium there.
    pub equilibrium: Equilibrium,
    /// The modes there, in the order they have at the start of the range.
    pub modes: Modes,
}

impl Condition {
    /// What is zero where the condition is met; `value` is what the input really is.
    fn excess(self, modes: &Modes, label: usize, value: f64) -> Option<f64> {
        let mode = modes.modes.iter().find(|mode| mode.label == label)?;
        let omega = mode.frequency()?;
        Some(match self {
            Self::Line(line) => omega - line.ratio * value - line.offset,
            // What cannot be told from zero counts as not growing.
            Self::FlutterOnset if mode.s.re.abs() <= mode.error => -mode.error,
            Self::FlutterOnset => mode.s.re,
        })
    }

    /// Whether a mode meets the condition, but for rounding: where the equilibrium jumps to another branch, its frequency
    /// jumps across a line without meeting it.
    fn is_met(self, mode: &Mode, value: f64) -> bool {
        const ROUNDING: f64 = 1e-6;
        let Some(omega) = mode.frequency() else {
            return false;
        };
        match self {
            Self::Line(line) => {
                let (slope, offset) = (line.ratio * value, line.offset);
                let size = omega + slope.abs() + offset.abs();
                (omega - slope - offset).abs() <= ROUNDING * size
            }
            Self::FlutterOnset => mode.s.re.abs() <= mode.error.max(ROUNDING * mode.s.norm()),
        }
    }

    /// The quantity of the mode, and how the other side of the condition moves with the input.
    pub(crate) fn sides(self) -> (Quantity, f64) {
        match self {
            Self::Line(line) => (Quantity::Frequency, line.ratio),
            Self::FlutterOnset => (Quantity::Growth, 0.0),
        }
    }

    /// Derivative of the excess by the input along the equilibria; `None` where there is none.
    fn slope(
        self,
        mechanism: &dyn Kernels,
        (state, modes): (&Equilibrium, &Modes),
        label: usize,
        input: Input,
    ) -> Option<f64> {
        let position = modes.modes.iter().position(|mode| mode.label == label)?;
        let all = sensitivities(mechanism, state, modes).ok()?;
        let own = all.modes.get(position).filter(|own| !own.clustered)?;
        let (quantity, other) = self.sides();
        Some(own.of(quantity)?.by_input.get(input.index())? - other)
    }
}

/// Finds every value of an input in a range at which a frequency equals a line (a number is the multiple of the input),
/// on the equilibria that are followed; modes keep their identity along the range. Points without an equilibrium or
/// without modes are passed over, and a frequency that jumps across the line with the equilibrium does not meet it.
///
/// # Errors
/// [`Error::UnknownHandle`], [`Error::Setting`], and the error of the first point.
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

/// Finds every value of an input in a range at which an oscillation begins or ceases to grow, on the equilibria that
/// are followed. As [`crossings`], always with general modes.
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

/// The first value in a range at which the mode that is number `mode` at its start meets a condition; `None` where it does not.
pub(crate) fn first_crossing(
    mechanism: &dyn Kernels,
    values: (&[f64], &[f64]),
    start: &[f64],
    following: Following,
    range: Range,
    (mode, condition): (usize, Condition),
) -> Result<Option<Crossing>, Error> {
    // Labels at the start are positions; modes that end on the way move the positions of others.
    let wanted = |crossing: &Crossing| crossing.modes.modes[crossing.mode].label == mode;
    let met = |found: &[Crossing]| found.iter().any(wanted);
    let found = meetings(mechanism, values, start, following, range, condition, met)?;
    Ok(found.into_iter().find(wanted))
}

/// However many there are, there may be more.
fn never(_: &[Crossing]) -> bool {
    false
}

/// The meetings in a range, until there are enough.
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

/// Adds the meetings between two neighbouring points, by label of the modes.
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
}
