//! One mode and its interpretation.
//!
//! # One type for every mode
//!
//! Undamped and general modes are the same `Mode`: an eigenvalue `s`, a right and a left vector, and their meaning. An
//! undamped mode has `s^2 = -lambda`, one real vector that serves as both, and keeps `lambda`, which stays smooth where
//! `s` has a root. Sensitivities, spreads, Monte Carlo, sweeps and crossings are written once. The compiler decides the
//! family (`Chat` zero and `Khat` symmetric, or not), not the numbers at one state: a sweep that starts at rest keeps
//! its family. `N` coordinates have `N` to `2 N` modes, because a real eigenvalue is a motion of its own.

use core::f64::consts::{LN_2, TAU};
use core::fmt;

use eigentol_results::numbers::rough;
use eigentol_results::relevance::EVERYTHING;

use crate::algebra::Vector;
use crate::eigenproblem::ApproximatePair;
use crate::rounding::{Sign, sign};
use crate::{Complex, Description};

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
    /// Nothing depends on where the mechanism stands along it, whatever the design: its eigenvalue is exactly zero.
    Free,
    /// Nothing resists it here: its eigenvalue is zero within rounding.
    Neutral,
    /// It grows without oscillation (static instability); rate, 1/s.
    Divergent(f64),
}

/// How far above the last mode that beams resolve by their number those of other kinds are shown.
const BESIDE: f64 = 1.5;

impl Behaviour {
    /// What a general mode does, whose eigenvalue is known up to an error.
    pub(crate) fn of_general(s: Complex, error: f64, zero: bool) -> Self {
        let keeps_amplitude = sign(s.re, error) == Sign::Zero;
        match (zero, s.im > 0.0, s.re > 0.0) {
            (true, ..) => Self::Neutral,
            (_, true, _) if keeps_amplitude => Self::Oscillating(s.im),
            (_, true, false) => Self::Damped(s.im),
            (_, true, true) => Self::Flutter(s.im),
            (_, false, false) => Self::Decaying(-s.re),
            (_, false, true) => Self::Divergent(s.re),
        }
    }

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
            Self::Decaying(_) | Self::Free | Self::Neutral | Self::Divergent(_) => None,
        }
    }

    /// Angular frequency or rate, whichever it has; zero without either.
    fn speed(self) -> f64 {
        match self {
            Self::Oscillating(x) | Self::Damped(x) | Self::Flutter(x) | Self::Decaying(x) | Self::Divergent(x) => {
                x.abs()
            }
            Self::Free | Self::Neutral => 0.0,
        }
    }

    /// Which of these modes the coordinates of beams resolve: those that are hardly faster than the last oscillation that
    /// they do, all without beams; and what texts say about the others.
    #[doc(hidden)]
    #[must_use]
    pub fn resolved(all: &[Self], of: &Description) -> (Vec<usize>, Option<String>) {
        let mut frequencies: Vec<f64> = all.iter().filter_map(|mode| mode.frequency()).collect();
        frequencies.sort_by(f64::total_cmp);
        let last = of.resolved_modes.and_then(|count| frequencies.get(count.max(1) - 1));
        let shows = |mode: &Self| mode.grows() || last.is_none_or(|last| mode.speed() <= BESIDE * last);
        let shown: Vec<usize> = (0..all.len()).filter(|k| shows(&all[*k])).collect();
        let left = all.len() - shown.len();
        let modes = if left == 1 { "mode is" } else { "modes are" };
        let said = format!("{left} {modes} left out that the coordinates of beams hardly resolve: {EVERYTHING}.");
        (shown, (left > 0).then_some(said))
    }

    /// Its name in tables: `oscillating`.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Oscillating(_) => "oscillating",
            Self::Damped(_) => "damped",
            Self::Flutter(_) => "flutter",
            Self::Decaying(_) => "decaying",
            Self::Free => "free",
            Self::Neutral => "neutral",
            Self::Divergent(_) => "divergent",
        }
    }
}

impl fmt::Display for Behaviour {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Oscillating(_) => write!(f, "oscillates"),
            Self::Damped(_) => write!(f, "decays"),
            Self::Flutter(_) => write!(f, "grows (flutter)"),
            Self::Decaying(rate) => write!(f, "creeps back, rate {} 1/s", rough(*rate)),
            Self::Free => write!(f, "free"),
            Self::Neutral => write!(f, "neutral"),
            Self::Divergent(rate) => {
                write!(f, "diverges, rate {} 1/s: doubles in {} s", rough(*rate), rough(LN_2 / rate))
            }
        }
    }
}

/// One mode.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Mode {
    /// Eigenvalue, 1/s: the motion varies as `exp(s t)`. For a conjugate pair, the one with positive imaginary part;
    /// for an undamped divergent mode, the growing one.
    pub s: Complex,
    /// `-Re s^2`, 1/s^2. For an undamped mode, the eigenvalue of `Khat phi = lambda Mhat phi`: the square of the
    /// frequency, negative for divergence.
    pub lambda: f64,
    /// Right vector `phi` over all unknowns, reactions of constraints included: `phi^H Mhat phi = 1`, with its largest
    /// coordinate component real and positive. With speeds or constraints on velocities, where a mode may move speeds
    /// only, the largest component of a coordinate or speed is one. Real for an undamped mode.
    pub shape: Vector<Complex>,
    /// Left vector of a general mode; empty for an undamped one.
    pub(crate) left: Vector<Complex>,
    /// What `s` means physically.
    pub behaviour: Behaviour,
    /// Largest component of the mode's equation, left or right, relative to the terms in it.
    #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
    pub residual: f64,
    /// Estimated absolute error of `s`, 1/s.
    #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
    pub error: f64,
    /// Condition number of `s` as an eigenvalue of the balanced first-order system: 1 for an undamped mode, large where
    /// eigenvalues and their vectors are about to merge, infinite where they have merged.
    #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
    pub condition: f64,
    /// How far beside `s`, as a part of it, its vectors are those of the equations: next to a pole of shafts.
    pub(crate) beside: f64,
    /// Identifies the motion: modes with the same label along a sweep are one motion. Without a sweep, the position.
    pub label: usize,
}

impl Mode {
    /// This mode as a predictor for the modes of a nearby problem.
    #[doc(hidden)]
    pub fn near(&self) -> ApproximatePair<'_> {
        ApproximatePair { s: self.s, right: &self.shape, left: self.left() }
    }

    /// Left vector `psi`, normalised as [`shape`](Self::shape), except that with speeds or constraints on velocities
    /// the largest of all its components is one. For an undamped mode it is the shape.
    #[must_use]
    pub fn left(&self) -> &[Complex] {
        if self.left.is_empty() { &self.shape } else { &self.left }
    }

    /// Angular frequency at which the mode oscillates, `Im s`, rad/s; `None` if it does not oscillate.
    #[must_use]
    pub fn frequency(&self) -> Option<f64> {
        self.behaviour.frequency()
    }

    /// Natural angular frequency `|s|`, rad/s; `None` if the mode does not oscillate.
    #[must_use]
    pub fn natural_frequency(&self) -> Option<f64> {
        self.frequency().map(|_| self.s.norm())
    }

    /// Damping ratio `-Re s / |s|`; negative for a growing mode, `None` for a neutral one.
    #[must_use]
    pub fn damping_ratio(&self) -> Option<f64> {
        match self.behaviour {
            Behaviour::Oscillating(_) => Some(0.0),
            Behaviour::Free | Behaviour::Neutral => None,
            _ => Some(-self.s.re / self.s.norm()),
        }
    }

    /// Logarithmic decrement `-2 pi Re s / Im s` of an oscillation; negative for one that grows.
    #[must_use]
    pub fn log_decrement(&self) -> Option<f64> {
        Some(self.damping_ratio()? * TAU * self.s.norm() / self.frequency()?)
    }

    /// The `s` of the equations that its vectors fulfil: its eigenvalue, but next to a pole of shafts a little beside it.
    #[doc(hidden)]
    #[must_use]
    pub fn place(&self) -> Complex {
        self.s * (1.0 + self.beside)
    }

    /// A mode of a mechanism with shafts, whose vectors fulfil the equations at a `place`.
    pub(crate) fn general(
        [s, place]: [Complex; 2],
        (shape, left): (Vector<Complex>, Vector<Complex>),
        behaviour: Behaviour,
        residual: f64,
        error: f64,
    ) -> Self {
        Self {
            s,
            lambda: -(s * s).re,
            shape,
            left,
            behaviour,
            residual,
            error,
            condition: 1.0,
            beside: ((place - s) / s).re,
            label: 0,
        }
    }

    /// An empty mode, to be overwritten.
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
            beside: 0.0,
            label: 0,
        }
    }

    /// Overwrites this mode with an undamped mode given by its eigenvalue and the error of that, reusing the vectors. Returns
    /// the place into which the caller writes the shape, of `n` components.
    #[inline(always)]
    pub(super) fn make_undamped(
        &mut self,
        label: usize,
        (lambda, error): (f64, f64),
        residual: f64,
        n: usize,
    ) -> &mut [Complex] {
        let rate = lambda.abs().sqrt();
        // `sqrt(error)`, or `error / rate` if that is smaller.
        let of_s = if rate * rate > error { error / rate } else { error.sqrt() };
        self.set_oscillating(label, lambda, rate, residual, of_s);
        match sign(lambda, error) {
            Sign::Positive => {}
            Sign::Negative => (self.s, self.behaviour) = (Complex::new(rate, 0.0), Behaviour::Divergent(rate)),
            Sign::Zero => (self.s, self.behaviour) = (Complex::ZERO, Behaviour::Neutral),
        }
        self.shape.make_room(n)
    }

    /// Overwrites everything but the shape with an undamped mode that oscillates at `rate`, with the error of `s`.
    #[inline(always)]
    #[doc(hidden)]
    pub fn set_oscillating(&mut self, label: usize, lambda: f64, rate: f64, residual: f64, error: f64) {
        self.s = Complex::new(0.0, rate);
        self.behaviour = Behaviour::Oscillating(rate);
        self.lambda = lambda;
        self.left.make_room(0);
        self.residual = residual;
        self.error = error;
        self.condition = 1.0;
        self.label = label;
    }

    /// Real part of the shape, which is all of it for an undamped mode.
    #[doc(hidden)]
    pub fn real_shape(&self) -> Vector {
        self.shape.map(|value| value.re)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_general_modes_have_a_left_vector_of_their_own() {
        let [i, two] = [Complex::new(0.0, 1.0), Complex::new(2.0, 0.0)];
        let general = Mode { shape: [Complex::ONE, i].into(), left: [i, two].into(), ..Mode::blank() };
        assert_eq!(general.left(), [i, two]);
        let mut undamped = general;
        let shape = undamped.make_undamped(0, (4.0, 0.0), 0.0, 2);
        shape.copy_from_slice(&[1.0, 0.5].map(Complex::from));
        assert_eq!(undamped.left(), [Complex::ONE, Complex::new(0.5, 0.0)]);
        assert_eq!(undamped.near().left, &undamped.shape[..]);
    }
}
