//! Whirl: whether a vibration circles in the direction in which the bodies spin.

use crate::kernels::Kernels;
use crate::{Equilibrium, Mode, Modes};

/// Direction in which a vibration circles about the axes of the spinning bodies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Sense {
    /// With the spin.
    Forward,
    /// Against the spin.
    Backward,
    /// Along a line, or circles in both directions that cancel.
    Planar,
}

/// How a mode whirls.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Whirl {
    /// From 1 (every orbit a circle traversed with the spin) through 0 (straight lines) to -1 (circles against the
    /// spin).
    ///
    /// The orbits are those of the centres of mass and of the small rotations of the bodies, weighted with mass, second
    /// moment and the square of the spin. They are seen by an observer who moves with the coordinates: in the rotating
    /// frame if the coordinates are declared behind the drive.
    pub ratio: f64,
}

impl Whirl {
    /// The direction; ratios within 1e-6 of zero are planar.
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

/// The whirl of each mode.
///
/// `None` for a mode that does not oscillate, or that moves nothing transverse to a spin axis.
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
