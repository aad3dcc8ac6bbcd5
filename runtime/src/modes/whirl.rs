//! Whirl: whether a vibration circles in the sense in which the bodies spin.

use crate::kernels::Kernels;
use crate::{Equilibrium, Mode, Modes};

/// Sense in which a vibration circles about the axes of the spinning bodies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Sense {
    /// With the spin.
    Forward,
    /// Against the spin.
    Backward,
    /// Along a line, or circles of both senses that cancel.
    Planar,
}

/// How a mode whirls.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Whirl {
    /// From 1 (every orbit a circle run through with the spin) through 0 (straight) to -1 (circles against it). Orbits are
    /// those of the centres of mass and of the small rotations of the bodies, weighted with mass, second moment and
    /// the square of the spin, as seen by an observer who moves with the coordinates: where they are declared behind the
    /// drive, in the turning frame.
    pub ratio: f64,
}

impl Whirl {
    /// The sense; ratios within 1e-6 of zero are planar.
    #[must_use]
    pub fn sense(self) -> Sense {
        if self.ratio > 1e-6 {
            Sense::Forward
        } else if self.ratio < -1e-6 {
            Sense::Backward
        } else {
            Sense::Planar
        }
    }
}

/// The whirl of each mode; `None` where it does not apply: for a mode that does not oscillate, or that moves nothing
/// across the axis of a spin.
pub fn whirls(mechanism: &dyn Kernels, at: &Equilibrium, modes: &Modes) -> Vec<Option<Whirl>> {
    let whirl = |mode: &Mode| {
        mode.frequency()?;
        let real = mode.shape.map(|value| value.re);
        let imaginary = mode.shape.map(|value| value.im);
        let [moment, size] =
            mechanism.whirl(&at.coordinates, &at.inputs, &at.design, &real, &imaginary);
        (size > 0.0 && moment.is_finite() && size.is_finite()).then(|| Whirl {
            ratio: (moment / size).clamp(-1.0, 1.0),
        })
    };
    modes.modes.iter().map(whirl).collect()
}
