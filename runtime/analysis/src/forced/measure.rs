//! Displacement, velocity and acceleration of a vibrating output.

use crate::Complex;

/// How a vibrating output is measured: by itself, or by one of its derivatives by time.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Measure {
    /// The output itself, `y`, in its unit.
    #[default]
    Displacement,
    /// Its rate, `i w y`, per second.
    Velocity,
    /// The rate of its rate, `-w^2 y`, per second squared.
    Acceleration,
    /// The output over a limit that follows the frequency, `limit w^power` with `w` in rad/s.
    OfLimit {
        /// The limit at 1 rad/s, in the unit of the output (SI).
        limit: f64,
        /// The power.
        power: f64,
    },
}

impl Measure {
    /// The power of the frequency that it is proportional to.
    fn order(self) -> f64 {
        match self {
            Self::Displacement => 0.0,
            Self::Velocity => 1.0,
            Self::Acceleration => 2.0,
            Self::OfLimit { power, .. } => -power,
        }
    }

    /// The measure of an amplitude `y` at the frequency `w`, rad/s.
    #[must_use]
    pub fn of(self, w: f64, y: Complex) -> Complex {
        y * self.factor(w)
    }

    fn factor(self, w: f64) -> Complex {
        match self {
            Self::OfLimit { limit, power } => Complex::from(w.powf(-power) / limit),
            _ => Complex::new(0.0, w).powi(self.order() as i32),
        }
    }

    /// Its derivative, from the derivatives of frequency and amplitude.
    pub(super) fn slope(self, (w, y): (f64, Complex), dw: f64, dy: Complex) -> Complex {
        let n = self.order();
        self.factor(w) * (dy + y * (n * dw / w))
    }

    /// Its second derivative along two variables, from the values and derivatives of frequency and amplitude.
    pub(super) fn curvature(
        self,
        (w, y): (f64, Complex),
        [first, second]: [(f64, Complex); 2],
        (ddw, ddy): (f64, Complex),
    ) -> Complex {
        let n = self.order();
        let ((dw1, dy1), (dw2, dy2)) = (first, second);
        let mixed = dy1 * dw2 + dy2 * dw1 + y * ddw;
        self.factor(w) * (ddy + mixed * (n / w) + y * (n * (n - 1.0) * dw1 * dw2 / (w * w)))
    }
}
