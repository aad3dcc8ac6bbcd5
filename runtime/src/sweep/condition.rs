//! The conditions that a mode can meet at a value of an input: its frequency equals a multiple of the input (resonance,
//! critical speed of a rotor), or its oscillation stops decaying (onset of flutter).

use crate::kernels::Kernels;
use crate::sensitivity::{Quantity, sensitivities};
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
    /// The oscillation neither grows nor decays: `Re s = 0`, with growth on one side.
    FlutterOnset,
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
    /// Position of the mode in `modes`.
    pub mode: usize,
    /// The equilibrium at the crossing.
    pub equilibrium: Equilibrium,
    /// The modes at the crossing, in their order at the start of the range.
    pub modes: Modes,
}

impl Condition {
    /// The function that vanishes where the condition is met; `value` is the actual input, deviation included.
    pub(super) fn excess(self, modes: &Modes, label: usize, value: f64) -> Option<f64> {
        let mode = modes.modes.iter().find(|mode| mode.label == label)?;
        let omega = mode.frequency()?;
        Some(match self {
            Self::Line(line) => omega - line.ratio * value - line.offset,
            // Growth indistinguishable from zero counts as no growth.
            Self::FlutterOnset if mode.s.re.abs() <= mode.error => -mode.error,
            Self::FlutterOnset => mode.s.re,
        })
    }

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

    /// Derivative of the excess with respect to the input along the equilibria; `None` where it does not exist.
    pub(super) fn slope(
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
