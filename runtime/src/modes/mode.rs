//! One mode, and what it means.

use crate::Complex;
use crate::algebra::Vector;
use crate::eigenproblem::Near;
use crate::rounding::{Sign, sign};

/// How a disturbance along a mode develops.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Behaviour {
    /// It oscillates and neither grows nor decays within rounding; angular frequency, rad/s.
    Oscillating(f64),
    /// It oscillates and decays; angular frequency, rad/s.
    Damped(f64),
    /// It oscillates and grows (dynamic instability); angular frequency, rad/s.
    Flutter(f64),
    /// It decays without oscillation (overdamped); rate, 1/s.
    Decaying(f64),
    /// Nothing resists it: its eigenvalue is zero within rounding.
    Neutral,
    /// It grows without oscillation (static instability); rate, 1/s.
    Divergent(f64),
}

impl Behaviour {
    /// Whether a small disturbance grows.
    #[must_use]
    pub fn grows(self) -> bool {
        matches!(self, Self::Flutter(_) | Self::Divergent(_))
    }

    /// Angular frequency of the oscillation, rad/s; `None` without one.
    #[must_use]
    pub fn frequency(self) -> Option<f64> {
        match self {
            Self::Oscillating(omega) | Self::Damped(omega) | Self::Flutter(omega) => Some(omega),
            Self::Decaying(_) | Self::Neutral | Self::Divergent(_) => None,
        }
    }
}

/// One mode.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Mode {
    /// Eigenvalue, 1/s: the motion goes as `exp(s t)`. Of a conjugate pair the one with positive imaginary part; of an
    /// undamped divergent mode the growing one.
    pub s: Complex,
    /// `-Re s^2`, 1/s^2. Of an undamped mode the eigenvalue of `Khat phi = lambda Mhat phi`: the square of the frequency,
    /// negative for divergence.
    pub lambda: f64,
    /// Right vector `phi`, by unknown, the reactions of constraints included: `phi^H Mhat phi = 1`, its largest component
    /// of a coordinate real and positive. With speeds or constraints on velocities, where a mode may move speeds only, the
    /// largest component of a coordinate or speed is one. Real for an undamped mode.
    pub shape: Vector<Complex>,
    /// Left vector `psi`, normalised alike; with speeds or constraints on velocities its largest component of all is one.
    /// Of an undamped mode the same as `shape`.
    pub left: Vector<Complex>,
    /// What `s` means.
    pub behaviour: Behaviour,
    /// Greatest component of the equation of the mode, left or right, relative to the terms in it.
    #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
    pub residual: f64,
    /// Estimated absolute error of `s`, 1/s.
    #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
    pub error: f64,
    /// Condition number of `s` as an eigenvalue of the balanced first-order system: 1 for an undamped mode, great where
    /// eigenvalues and their vectors are about to merge, infinite where they have.
    #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
    pub condition: f64,
    /// Number of the motion: modes with one number along a sweep are one motion. Without a sweep, the position.
    pub label: usize,
}

impl Mode {
    /// As what predicts the mode of a problem near by.
    pub(crate) fn near(&self) -> Near<'_> {
        Near {
            s: self.s,
            right: &self.shape,
            left: &self.left,
        }
    }

    /// Angular frequency at which the mode oscillates, `Im s`, rad/s; `None` for a mode that does not.
    #[must_use]
    pub fn frequency(&self) -> Option<f64> {
        self.behaviour.frequency()
    }

    /// Natural angular frequency `|s|`, rad/s; `None` for a mode that does not oscillate.
    #[must_use]
    pub fn natural_frequency(&self) -> Option<f64> {
        self.frequency().map(|_| self.s.norm())
    }

    /// Damping ratio `-Re s / |s|`; negative for a mode that grows, `None` for a neutral one.
    #[must_use]
    pub fn damping_ratio(&self) -> Option<f64> {
        match self.behaviour {
            Behaviour::Oscillating(_) => Some(0.0),
            Behaviour::Neutral => None,
            _ => Some(-self.s.re / self.s.norm()),
        }
    }

    /// What a mode is written over.
    pub(super) fn blank() -> Self {
        Self {
            s: Complex::ZERO,
            lambda: 0.0,
            shape: Vector::default(),
            left: Vector::default(),
            behaviour: Behaviour::Neutral,
            residual: 0.0,
            error: 0.0,
            condition: 1.0,
            label: 0,
        }
    }

    /// Writes an undamped mode with an eigenvalue and its error over this one, whose vectors are used again.
    #[inline]
    pub(crate) fn set_undamped(
        &mut self,
        label: usize,
        (lambda, error): (f64, f64),
        shape: impl ExactSizeIterator<Item = f64>,
        residual: f64,
    ) {
        let rate = lambda.abs().sqrt();
        (self.s, self.behaviour) = match sign(lambda, error) {
            Sign::Positive => (Complex::new(0.0, rate), Behaviour::Oscillating(rate)),
            Sign::Negative => (Complex::new(rate, 0.0), Behaviour::Divergent(rate)),
            Sign::Zero => (Complex::ZERO, Behaviour::Neutral),
        };
        self.lambda = lambda;
        let (right, left) = (
            self.shape.make_room(shape.len()),
            self.left.make_room(shape.len()),
        );
        for ((right, left), value) in right.iter_mut().zip(left).zip(shape) {
            *right = value.into();
            *left = *right;
        }
        self.residual = residual;
        // `sqrt(error)`, or `error / rate` where that is less.
        self.error = if rate * rate > error {
            error / rate
        } else {
            error.sqrt()
        };
        self.condition = 1.0;
        self.label = label;
    }

    /// Real parts of the shape: all of it for an undamped mode.
    pub(crate) fn real_shape(&self) -> Vector {
        self.shape.map(|value| value.re)
    }
}
