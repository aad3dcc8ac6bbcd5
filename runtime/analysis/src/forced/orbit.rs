//! The ellipse on which two vibrating outputs move.

use super::response::Harmonic;
use crate::{Complex, Output};

/// Relative difference of forward and backward part below which an orbit counts as a straight line, and share of either
/// below which it counts as a circle: rounding.
const ROUNDING: f64 = 1e-13;

/// The orbit of `x(t) = Re(X e^{i w t})` and `y(t) = Re(Y e^{i w t})`: `x + i y = f e^{i w t} + conj(b) e^{-i w t}`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Orbit {
    /// `f = (X + i Y) / 2`, in the unit of the outputs (SI): it circles from `x` to `y`.
    pub forward: Complex,
    /// `b = (X - i Y) / 2`: its conjugate circles from `y` to `x`.
    pub backward: Complex,
}

/// The direction in which an orbit is passed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Turning {
    /// From the first output to the second.
    Forward,
    /// From the second output to the first.
    Backward,
}

impl Orbit {
    /// The orbit of two amplitudes.
    #[must_use]
    pub fn of(x: Complex, y: Complex) -> Self {
        let turned = Complex::I * y;
        Self { forward: (x + turned) / 2.0, backward: (x - turned) / 2.0 }
    }

    /// Half of the longest and of the shortest diameter, `|f| + |b|` and `||f| - |b||`.
    #[must_use]
    pub fn semi_axes(&self) -> [f64; 2] {
        let (f, b) = (self.forward.norm(), self.backward.norm());
        [f + b, (f - b).abs()]
    }

    /// The angle of the longest diameter from the first output, rad, from -pi/2 to pi/2; `None` for a circle.
    #[must_use]
    pub fn direction(&self) -> Option<f64> {
        // Where both parts point the same way: `(arg f - arg b) / 2`.
        let product = self.forward * self.backward.conj();
        let [most, _] = self.semi_axes();
        let least = self.forward.norm().min(self.backward.norm());
        (least > ROUNDING * most).then(|| 0.5 * product.arg())
    }

    /// The direction in which it is passed; `None` on a straight line.
    #[must_use]
    pub fn turning(&self) -> Option<Turning> {
        let [long, short] = self.semi_axes();
        if short <= ROUNDING * long {
            return None;
        }
        Some(if self.forward.norm() > self.backward.norm() { Turning::Forward } else { Turning::Backward })
    }
}

impl Harmonic {
    /// The orbit of two outputs, which should be perpendicular displacements; `None` for an output that has no
    /// amplitude, and for one of another mechanism.
    #[must_use]
    pub fn orbit(&self, x: Output, y: Output) -> Option<Orbit> {
        let amplitude = |output: Output| self.outputs.get(output.index()).copied().flatten();
        Some(Orbit::of(amplitude(x)?, amplitude(y)?))
    }
}
