//! The conditions that a mode can meet at a value of an input: its frequency equals a multiple of the input (resonance,
//! critical speed of a rotor), or its oscillation stops decaying (onset of flutter).

use crate::sensitivity::Quantity;
use crate::{Equilibrium, Input, Mode, Modes};

/// A line `ratio u + offset` to compare frequencies with: an engine order or a fixed excitation frequency.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Line {
    /// Multiple of the input; rad/s per SI unit of the input.
    pub ratio: f64,
    /// Constant part, rad/s.
    pub offset: f64,
}

impl From<f64> for Line {
    /// The line `ratio u`.
    fn from(ratio: f64) -> Self {
        Self { ratio, offset: 0.0 }
    }
}

/// A condition that a mode can meet at a value of an input.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Condition {
    /// The frequency equals a line: `Im s = ratio u + offset`.
    Line(Line),
    /// The oscillation neither grows nor decays: `Re s = 0`, with growth on one side; or flutter and divergence turn into
    /// each other: `Im s = 0`, with growth on both sides.
    FlutterOnset,
}

/// What changes at an event, in the direction of the search.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Change {
    /// One more motion grows behind it: an instability begins.
    Onset,
    /// One motion fewer grows behind it: an instability ends.
    End,
    /// As many motions grow behind it as before.
    Pass,
    /// The condition is met without being passed: a frequency touches a line, a growth or a stiffness touches zero.
    Touch,
    /// A growing oscillation ceases to oscillate: flutter turns into divergence.
    ToDivergence,
    /// Two motions that grow without oscillation become one that oscillates: divergence turns into flutter.
    ToFlutter,
}

/// A state where a mode meets a condition.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Crossing {
    /// The varied input.
    pub input: Input,
    /// Its value at the crossing, SI.
    pub value: f64,
    /// The condition that is met.
    pub condition: Condition,
    /// Whether an instability begins or ends there.
    pub change: Change,
    /// Two eigenvalues merge there, so the value has no derivative.
    #[cfg_attr(feature = "serde", serde(default))]
    pub merging: bool,
    /// Position of the mode in `modes`.
    pub mode: usize,
    /// The equilibrium at the crossing.
    pub equilibrium: Equilibrium,
    /// The modes at the crossing, in their order at the start of the range.
    pub modes: Modes,
}

impl Condition {
    /// Whether a mode meets the condition within rounding. Where the equilibrium jumps to another branch, a frequency
    /// jumps across a line without meeting it.
    pub(super) fn is_met(self, mode: &Mode, value: f64) -> bool {
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

    /// The quantity of the mode on one side of the condition, and the rate at which the other side changes with the
    /// input.
    pub(crate) fn sides(self) -> (Quantity, f64) {
        match self {
            Self::Line(line) => (Quantity::Frequency, line.ratio),
            Self::FlutterOnset => (Quantity::Growth, 0.0),
        }
    }
}
