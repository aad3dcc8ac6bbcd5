//! Total derivatives of one mode.
//!
//! # Results hold each number once
//!
//! The eigenvalue of an undamped mode is a root of `-lambda`, so the derivatives and the spread of its frequency are
//! those of `lambda`, scaled. `ModeSensitivity` and `ModeTolerance` store those of `lambda` and return the others on
//! request; only general modes store more. Storing all of them took a twelfth of a first-order analysis.

use super::Quantity;
use crate::algebra::{Vector, all_finite, greater, unless_finite};
use crate::modes::{Behaviour, Family};
use crate::{Complex, Mode};

/// First derivatives of one number with respect to every input and design variable.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(bound = "T: eigentol_statistics::serial::Exact + Copy + Default"))]
pub struct Slopes<T> {
    /// With respect to each input, per SI unit.
    pub by_input: Vector<T>,
    /// With respect to each design variable, per SI unit.
    pub by_design: Vector<T>,
}

impl<T: Copy + Default> Slopes<T> {
    #[doc(hidden)]
    pub fn map<R: Copy + Default>(&self, f: impl Fn(T) -> R) -> Slopes<R> {
        Slopes { by_input: self.by_input.map(&f), by_design: self.by_design.map(&f) }
    }

    /// The derivatives of two numbers together.
    #[doc(hidden)]
    #[must_use]
    pub fn zip<S: Copy + Default>(&self, other: &Slopes<S>) -> Slopes<(T, S)> {
        let pairs = |item: &[T], other: &[S]| item.iter().copied().zip(other.iter().copied()).collect();
        Slopes { by_input: pairs(&self.by_input, &other.by_input), by_design: pairs(&self.by_design, &other.by_design) }
    }

    /// Those by inputs, then those by design variables.
    #[doc(hidden)]
    pub fn iter(&self) -> impl Iterator<Item = T> {
        self.by_input.iter().chain(&self.by_design).copied()
    }

    /// Those by inputs, then those by design variables, to change them.
    #[doc(hidden)]
    pub fn iter_mut(&mut self) -> impl Iterator<Item = &mut T> {
        self.by_input.iter_mut().chain(&mut self.by_design)
    }

    /// Empty slopes, to be overwritten.
    #[inline]
    fn blank() -> Self {
        Self { by_input: Vector::default(), by_design: Vector::default() }
    }

    /// Makes room for the given numbers of inputs and design variables; the contents are unspecified.
    #[inline(always)]
    fn make_room(&mut self, inputs: usize, design: usize) -> [&mut [T]; 2] {
        [self.by_input.make_room(inputs), self.by_design.make_room(design)]
    }
}

/// Total derivatives of one mode.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ModeSensitivity {
    /// Derivatives of `lambda = -Re s^2`, 1/s^2 per SI unit. Zero if `s` has no derivative because it has merged with
    /// another eigenvalue.
    pub lambda: Slopes<f64>,
    /// The mode belongs to a cluster of nearly equal eigenvalues ([`Modes::cluster_of`](crate::Modes::cluster_of)):
    /// these numbers hold for the computed basis of the cluster and would differ in another. Only its
    /// `directional_derivatives` are well defined.
    pub clustered: bool,
    /// The eigenvalue `s` of the mode.
    value: Complex,
    /// The mode is undamped: `s^2 = -lambda`.
    undamped: bool,
    /// Derivatives of `s` for a general mode that has not merged with another.
    general: Option<Slopes<Complex>>,
}

impl ModeSensitivity {
    /// Derivatives of the eigenvalue `s`, 1/s per SI unit.
    ///
    /// `None` for an undamped neutral mode and for a general mode that has merged with another.
    #[must_use]
    pub fn s(&self) -> Option<Slopes<Complex>> {
        if self.undamped {
            return root_slope(self.value).map(|root| self.lambda.map(root));
        }
        self.general.clone()
    }

    /// Derivatives of `s` for a general mode that has them.
    #[doc(hidden)]
    pub fn general(&self) -> Option<&Slopes<Complex>> {
        self.general.as_ref()
    }

    /// Derivatives of the angular frequency `Im s`, rad/s per SI unit (eq. 21).
    ///
    /// `None` if the mode does not oscillate or its eigenvalue has no derivative.
    #[must_use]
    pub fn frequency(&self) -> Option<Slopes<f64>> {
        self.of(Quantity::Frequency)
    }

    /// Total derivatives of a quantity of the mode; `None` if it has none or if one exceeds the range of a double.
    #[must_use]
    pub fn of(&self, quantity: Quantity) -> Option<Slopes<f64>> {
        if !self.oscillates() && quantity != Quantity::Growth {
            return None;
        }
        let slope = |ds| quantity.slope(self.value, ds);
        let slopes = if self.undamped {
            let root = root_slope(self.value)?;
            self.lambda.map(|dlambda| slope(root(dlambda)))
        } else {
            self.general.as_ref()?.map(slope)
        };
        let finite = all_finite(&slopes.by_input) && all_finite(&slopes.by_design);
        finite.then_some(slopes)
    }

    /// Whether the mode oscillates.
    pub(crate) fn oscillates(&self) -> bool {
        self.value.im > 0.0
    }

    /// What it does, as far as its eigenvalue tells.
    pub(crate) fn behaviour(&self) -> Behaviour {
        if self.oscillates() { Behaviour::Oscillating(self.value.im) } else { Behaviour::Decaying(self.value.re) }
    }

    /// Whether its eigenvalue is zero for every input and design.
    pub(crate) fn is_free(&self) -> bool {
        let still = |slopes: &Slopes<Complex>| slopes.iter().all(|slope| slope == Complex::ZERO);
        self.value == Complex::ZERO && self.general.as_ref().is_some_and(still)
    }

    /// Empty derivatives, to be overwritten.
    #[inline]
    #[doc(hidden)]
    pub fn blank() -> Self {
        Self { lambda: Slopes::blank(), clustered: false, value: Complex::ZERO, undamped: true, general: None }
    }

    /// Assigns a mode that belongs to no cluster and the derivatives of its eigenvalue: of `lambda` (real part) for an
    /// undamped mode, of `s` for a general one.
    #[doc(hidden)]
    pub fn set(&mut self, mode: &Mode, family: Family, slopes: &Slopes<Complex>) {
        let (by_input, by_design) = (slopes.by_input.iter(), slopes.by_design.iter());
        match family {
            Family::Undamped => {
                let real = |slope: &Complex| slope.re;
                self.set_undamped(mode, by_input.map(real), by_design.map(real));
            }
            Family::General => self.set_general(mode, by_input.copied(), by_design.copied()),
        }
    }

    /// Assigns an undamped mode that belongs to no cluster and its derivatives of `lambda`.
    #[inline]
    pub(crate) fn set_undamped(
        &mut self,
        mode: &Mode,
        by_input: impl ExactSizeIterator<Item = f64>,
        by_design: impl ExactSizeIterator<Item = f64>,
    ) {
        let [inputs, design] = self.make_undamped(mode, by_input.len(), by_design.len());
        for (slot, slope) in inputs.iter_mut().zip(by_input) {
            *slot = slope;
        }
        for (slot, slope) in design.iter_mut().zip(by_design) {
            *slot = slope;
        }
    }

    /// Like [`Self::set_undamped`], but returns the places into which the caller writes the derivatives.
    #[inline(always)]
    #[doc(hidden)]
    pub fn make_undamped(&mut self, mode: &Mode, inputs: usize, design: usize) -> [&mut [f64]; 2] {
        self.clustered = false;
        self.value = mode.s;
        self.undamped = true;
        self.lambda.make_room(inputs, design)
    }

    /// Assigns a general mode and its derivatives of `s`; if they are not finite, it has merged with another.
    pub(crate) fn set_general(
        &mut self,
        mode: &Mode,
        by_input: impl ExactSizeIterator<Item = Complex>,
        by_design: impl ExactSizeIterator<Item = Complex>,
    ) {
        let s = self.general.get_or_insert_with(Slopes::blank);
        s.by_input.assign(by_input);
        s.by_design.assign(by_design);
        let lambda = |ds: &Complex| -2.0 * (mode.s * ds).re;
        self.lambda.by_input.set(&s.by_input, lambda);
        self.lambda.by_design.set(&s.by_design, lambda);
        let (inputs, design) = (s.by_input.len(), s.by_design.len());
        let rest: f64 = s.iter().map(|ds| unless_finite(ds.l1_norm())).sum();
        if rest == 0.0 && self.lambda_is_finite() {
            self.clustered = false;
            self.value = mode.s;
            self.undamped = false;
        } else {
            self.set_merged(mode, inputs, design);
        }
    }

    /// Assigns the mode of a free direction, whose eigenvalue is zero for every input and design.
    #[doc(hidden)]
    pub fn set_free(&mut self, inputs: usize, design: usize) {
        let s = self.general.get_or_insert_with(Slopes::blank);
        for slopes in s.make_room(inputs, design) {
            slopes.fill(Complex::ZERO);
        }
        for slopes in self.lambda.make_room(inputs, design) {
            slopes.fill(0.0);
        }
        self.clustered = false;
        self.value = Complex::ZERO;
        self.undamped = false;
    }

    /// Assigns a general mode that has merged with another and has no derivatives.
    pub(crate) fn set_merged(&mut self, mode: &Mode, inputs: usize, design: usize) {
        for slopes in self.lambda.make_room(inputs, design) {
            slopes.fill(0.0);
        }
        self.clustered = true;
        self.value = mode.s;
        self.undamped = false;
        self.general = None;
    }

    fn lambda_is_finite(&self) -> bool {
        all_finite(&self.lambda.by_input) && all_finite(&self.lambda.by_design)
    }

    #[inline(always)]
    #[doc(hidden)]
    pub fn finite(&self) -> bool {
        if self.undamped && self.value != Complex::ZERO {
            let rate = root_rate(self.value);
            let of = |sum, slopes: &[f64]| slopes.iter().fold(sum, |sum, slope| sum + unless_finite(rate * slope));
            return of(of(0.0, &self.lambda.by_input), &self.lambda.by_design) == 0.0;
        }
        // For a general mode, `s` is checked through `lambda`: derivatives of `lambda` are computed from those of `s`.
        self.lambda_is_finite()
    }
}

/// `|ds / dlambda|` of an undamped mode with non-zero `s`, real or imaginary: `s^2 = -lambda`.
#[inline(always)]
pub fn root_rate(s: Complex) -> f64 {
    0.5 / greater(s.re, s.im)
}

/// `ds = -dlambda / (2 s)` of an undamped mode; `None` if `s`, real or imaginary, is zero.
#[inline]
fn root_slope(s: Complex) -> Option<impl Fn(f64) -> Complex> {
    let rate = root_rate(s);
    let oscillates = s.im > 0.0;
    (s != Complex::ZERO).then_some(move |dlambda: f64| {
        if oscillates { Complex::new(0.0, rate * dlambda) } else { Complex::new(-rate * dlambda, 0.0) }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Behaviour;

    fn mode(s: Complex) -> Mode {
        Mode {
            s,
            lambda: -(s * s).re,
            shape: Vector::default(),
            left: Vector::default(),
            behaviour: Behaviour::Oscillating(s.im),
            residual: 0.0,
            error: 0.0,
            condition: 1.0,
            beside: 0.0,
            label: 0,
        }
    }

    #[test]
    fn a_frequency_whose_derivative_overflows_is_not_finite() {
        let mut mode_sensitivity = ModeSensitivity::blank();
        for (slope, finite) in [(1e100, true), (1e200, false)] {
            mode_sensitivity.set_undamped(&mode(Complex::new(0.0, 1e-150)), [].into_iter(), [slope].into_iter());
            assert_eq!(mode_sensitivity.finite(), finite);
            assert_eq!(mode_sensitivity.frequency().is_some(), finite);
        }
        // At rest only `lambda` has a derivative.
        mode_sensitivity.set_undamped(&mode(Complex::ZERO), [].into_iter(), [1e200].into_iter());
        assert!(mode_sensitivity.finite() && mode_sensitivity.s().is_none() && mode_sensitivity.frequency().is_none());
        mode_sensitivity.set_undamped(&mode(Complex::ZERO), [].into_iter(), [f64::INFINITY].into_iter());
        assert!(!mode_sensitivity.finite());
    }

    #[test]
    fn nothing_of_an_earlier_mode_remains() {
        let (s, ds) = (Complex::new(-0.5, 2.0), Complex::new(0.25, -3.0));
        let mut mode_sensitivity = ModeSensitivity::blank();
        let general = |mode_sensitivity: &mut ModeSensitivity, ds| {
            mode_sensitivity.set_general(&mode(s), [].into_iter(), [ds].into_iter());
        };
        for _ in 0..2 {
            general(&mut mode_sensitivity, ds);
            assert!(!mode_sensitivity.clustered && mode_sensitivity.finite());
            assert_eq!(mode_sensitivity.s().map(|slopes| slopes.by_design[0]), Some(ds));
            assert_eq!(mode_sensitivity.frequency().map(|slopes| slopes.by_design[0]), Some(ds.im));
            assert_eq!(mode_sensitivity.lambda.by_design[0], -2.0 * (s * ds).re);
            // Where it merges with another, its derivatives are not finite.
            general(&mut mode_sensitivity, Complex::new(f64::NAN, 0.0));
            assert!(mode_sensitivity.clustered && mode_sensitivity.finite());
            assert!(
                mode_sensitivity.s().is_none()
                    && Quantity::ALL.iter().all(|quantity| mode_sensitivity.of(*quantity).is_none())
            );
            assert_eq!(mode_sensitivity.lambda.by_design[0], 0.0);
        }
        general(&mut mode_sensitivity, ds);
        mode_sensitivity.set_merged(&mode(s), 0, 1);
        assert!(mode_sensitivity.clustered && mode_sensitivity.s().is_none());
        mode_sensitivity.set_undamped(&mode(Complex::new(0.0, 2.0)), [].into_iter(), [4.0].into_iter());
        assert!(!mode_sensitivity.clustered);
        assert_eq!(mode_sensitivity.s().map(|slopes| slopes.by_design[0]), Some(Complex::new(0.0, 1.0)));
    }
}
