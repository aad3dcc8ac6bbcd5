//! Interval arithmetic: the possible values of a physical requirement while the design varies in a box.

use core::cmp::Ordering;
use core::ops::{Add, Div, Mul, Neg, Sub};

use crate::Real;

/// All values that an expression takes while its variables run through their ranges, including rounding, since rounding
/// preserves the order of numbers. If nothing better is known, all numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    low: f64,
    high: f64,
}

const ALL: Interval = Interval { low: f64::NEG_INFINITY, high: f64::INFINITY };

impl Interval {
    /// `value` and everything within `distance` of it.
    #[must_use]
    pub fn about(value: f64, distance: f64) -> Self {
        Self::between([value - distance, value + distance])
    }

    /// The range that these ends span.
    fn between<const K: usize>(ends: [f64; K]) -> Self {
        if ends.iter().any(|end| end.is_nan()) {
            return ALL;
        }
        Self {
            low: ends.iter().copied().fold(f64::INFINITY, f64::min),
            high: ends.iter().copied().fold(f64::NEG_INFINITY, f64::max),
        }
    }
}

/// Ordered if no number of one interval equals or crosses a number of the other.
impl PartialOrd for Interval {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        if self.low > other.high {
            Some(Ordering::Greater)
        } else if self.high < other.low {
            Some(Ordering::Less)
        } else {
            None
        }
    }
}

impl Add for Interval {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self::between([self.low + other.low, self.high + other.high])
    }
}

impl Sub for Interval {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self::between([self.low - other.high, self.high - other.low])
    }
}

impl Mul for Interval {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let (a, b) = (self, other);
        Self::between([a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high])
    }
}

impl Div for Interval {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let (a, b) = (self, other);
        if b.low <= 0.0 && b.high >= 0.0 {
            return ALL;
        }
        Self::between([a.low / b.low, a.low / b.high, a.high / b.low, a.high / b.high])
    }
}

impl Neg for Interval {
    type Output = Self;
    fn neg(self) -> Self {
        Self { low: -self.high, high: -self.low }
    }
}

impl Real for Interval {
    fn constant(value: f64) -> Self {
        Self::between([value])
    }
    fn sqrt(self) -> Self {
        Self::between([self.low.sqrt(), self.high.sqrt()])
    }
    fn sin_cos(self) -> (Self, Self) {
        (ALL, ALL)
    }
    fn tan(self) -> Self {
        ALL
    }
    fn asin(self) -> Self {
        ALL
    }
    fn acos(self) -> Self {
        ALL
    }
    fn atan2(self, _: Self) -> Self {
        ALL
    }
    fn exp(self) -> Self {
        ALL
    }
    fn ln(self) -> Self {
        ALL
    }
    fn powi(self, exponent: i32) -> Self {
        crate::scalar::integer_power(self, exponent)
    }
    fn powf(self, _: Self) -> Self {
        ALL
    }
    fn spline(self, _: &[[f64; 5]], _: usize) -> Self {
        ALL
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_hold_what_their_members_give() {
        let zero = Interval::constant(0.0);
        let (a, b) = (Interval::about(2.0, 1.0), Interval::about(-1.0, 0.5));
        let members = |range: Interval| [range.low, 0.3 * range.low + 0.7 * range.high, range.high];
        for x in members(a) {
            for y in members(b) {
                for (range, value) in [
                    (a + b, x + y),
                    (a - b, x - y),
                    (a * b, x * y),
                    (b * b, y * y),
                    (a / b, x / y),
                    (-a, -x),
                    (a.sqrt(), x.sqrt()),
                    (b.powi(3), y * y * y),
                    (b.powi(-2), 1.0 / (y * y)),
                ] {
                    assert!(range.low <= value && value <= range.high, "{range:?} {value}");
                }
            }
        }
        assert!(a > zero && b < zero && (a + b).partial_cmp(&zero).is_none());
        // Nothing is known about these, and nothing is claimed.
        for unknown in [a / (a + b), b.sqrt(), a.ln(), Interval::constant(f64::NAN), ALL * zero] {
            assert!(unknown.partial_cmp(&zero).is_none(), "{unknown:?}");
        }
    }
}
