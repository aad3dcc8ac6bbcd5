//! Quantities of a mode, such as frequency and damping ratio: values and derivatives from those of its eigenvalue.

use core::f64::consts::TAU;

use crate::{Complex, Mode, Text, Unit};

/// A real number that describes a mode.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Quantity {
    /// Angular frequency of the oscillation `Im s`, rad/s.
    Frequency,
    /// Natural angular frequency `|s|`, rad/s.
    NaturalFrequency,
    /// Damping ratio `-Re s / |s|`.
    DampingRatio,
    /// Rate of growth `Re s`, 1/s.
    Growth,
    /// Logarithmic decrement `-2 pi Re s / Im s`: of the ratio of two maxima one after the other.
    LogDecrement,
}

impl Quantity {
    /// All quantities.
    pub const ALL: [Self; 5] =
        [Self::Frequency, Self::NaturalFrequency, Self::DampingRatio, Self::Growth, Self::LogDecrement];

    /// The unit of the quantity.
    #[must_use]
    pub fn unit(self) -> Unit {
        Unit {
            symbol: Text::Static(match self {
                Self::Frequency | Self::NaturalFrequency => "rad/s",
                Self::DampingRatio | Self::LogDecrement => "",
                Self::Growth => "1/s",
            }),
            scale: 1.0,
        }
    }

    /// The value for a mode; `None` if it has none: a frequency without oscillation, a damping ratio of a neutral mode.
    #[must_use]
    pub fn of(self, mode: &Mode) -> Option<f64> {
        match self {
            Self::Frequency => mode.frequency(),
            Self::NaturalFrequency => mode.natural_frequency(),
            Self::DampingRatio => mode.damping_ratio(),
            Self::Growth => Some(mode.s.re),
            Self::LogDecrement => mode.log_decrement(),
        }
    }

    /// Like [`Self::of`], for the eigenvalue of a mode that decays or keeps its amplitude.
    #[doc(hidden)]
    pub fn of_stable(self, s: Complex) -> Option<f64> {
        match self {
            Self::Frequency | Self::NaturalFrequency | Self::LogDecrement if s.im <= 0.0 => None,
            Self::DampingRatio | Self::LogDecrement if s.re == 0.0 => Some(0.0),
            _ => Some(self.value(s)),
        }
    }

    /// The value for a non-zero eigenvalue.
    #[doc(hidden)]
    pub fn value(self, s: Complex) -> f64 {
        match self {
            Self::Frequency => s.im,
            Self::NaturalFrequency => s.norm(),
            Self::DampingRatio => -s.re / s.norm(),
            Self::Growth => s.re,
            Self::LogDecrement => -TAU * s.re / s.im,
        }
    }

    /// First derivative along a direction in which `s` changes at the rate `ds`.
    #[doc(hidden)]
    pub fn slope(self, s: Complex, ds: Complex) -> f64 {
        // Uses the unit vector of `s`: powers of `|s|` may exceed the range of a double.
        let size = s.norm();
        let unit = s / size;
        match self {
            Self::Frequency => ds.im,
            Self::Growth => ds.re,
            Self::NaturalFrequency => (unit.conj() * ds).re,
            // -Im s Im(conj(s) ds) / |s|^3, negated: exact for imaginary `s`.
            Self::DampingRatio => unit.im * (unit.conj() * ds).im / size,
            // -2 pi cot(arg s), whose slope is 2 pi / sin^2.
            Self::LogDecrement => TAU * (unit.conj() * ds).im / size / (unit.im * unit.im),
        }
    }

    /// Second derivative along two directions in which `s` changes at the rates `a` and `b`, with the second derivative
    /// `ab`.
    #[doc(hidden)]
    pub fn curvature(self, s: Complex, a: Complex, b: Complex, ab: Complex) -> f64 {
        let size = s.norm();
        let unit = s / size;
        match self {
            Self::Frequency => ab.im,
            Self::Growth => ab.re,
            Self::NaturalFrequency => {
                // The components of both slopes across `s` bend it.
                let across = |x: Complex| (unit.conj() * x).im;
                (unit.conj() * ab).re + across(a) * (across(b) / size)
            }
            Self::DampingRatio => {
                // -Re (s / |s|) from the logarithm of s: s/|s| = exp(i arg s), arg = Im ln s.
                let [la, lb, lab] = logarithmic(s, a, b, ab);
                unit.re * la.im * lb.im + unit.im * lab.im
            }
            Self::LogDecrement => {
                let [la, lb, lab] = logarithmic(s, a, b, ab);
                TAU * (lab.im - 2.0 * (unit.re / unit.im) * la.im * lb.im) / (unit.im * unit.im)
            }
        }
    }
}

crate::worded! {
    Quantity {
        Self::Frequency => "frequency",
        Self::NaturalFrequency => "natural frequency",
        Self::DampingRatio => "damping ratio",
        Self::Growth => "growth",
        Self::LogDecrement => "log decrement",
    }
}

/// For undamped modes: the derivative of `s` from that of `lambda = -s^2`.
pub fn eigenvalue_slope(s: Complex, dlambda: f64) -> Complex {
    over((-0.5 * dlambda).into(), s)
}

/// Derivatives of `ln s`: the first two, and the second along both.
fn logarithmic(s: Complex, a: Complex, b: Complex, ab: Complex) -> [Complex; 3] {
    let (la, lb) = (over(a, s), over(b, s));
    [la, lb, over(ab, s) - la * lb]
}

/// `a / s` without squaring `|s|`, which may exceed the range of a double.
fn over(a: Complex, s: Complex) -> Complex {
    let size = s.norm();
    a * (s.conj() / size) / size
}

/// Second derivative of `s` from its first derivatives and the second derivative of `lambda = -s^2`.
pub fn eigenvalue_curvature(s: Complex, a: Complex, b: Complex, ddlambda: f64) -> Complex {
    -(over((0.5 * ddlambda).into(), s) + a * over(b, s))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_are_in_the_order_of_their_declaration() {
        for (index, quantity) in Quantity::ALL.into_iter().enumerate() {
            assert_eq!(quantity as usize, index);
        }
    }
}
