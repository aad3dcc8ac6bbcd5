//! A number with a bound on its rounding error.

use std::ops::{Add, Div, Mul, Neg, Sub};

use eigentol::Real;

/// A value and a first-order bound on its rounding error. Two ways to compute the same number agree when they differ by
/// no more than the sum of both bounds.
#[derive(Clone, Copy, Debug)]
pub struct Bounded {
    /// The computed number.
    pub value: f64,
    /// Bound on its error.
    pub error: f64,
}

/// Standard library functions are accurate to a few units in the last place.
const UNIT: f64 = 2.0 * f64::EPSILON;

impl Bounded {
    /// An argument, taken as exact.
    pub const fn exact(value: f64) -> Self {
        Self { value, error: 0.0 }
    }

    fn rounded(value: f64, inherited: f64) -> Self {
        Self { value, error: inherited + UNIT * value.abs() }
    }

    fn through(self, value: f64, slope: f64) -> Self {
        Self::rounded(value, slope.abs() * self.error)
    }
}

impl Add for Bounded {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self::rounded(self.value + other.value, self.error + other.error)
    }
}

impl Sub for Bounded {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self::rounded(self.value - other.value, self.error + other.error)
    }
}

impl Mul for Bounded {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let inherited = self.value.abs() * other.error + other.value.abs() * self.error;
        Self::rounded(self.value * other.value, inherited)
    }
}

impl Div for Bounded {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let value = self.value / other.value;
        let inherited = (self.error + value.abs() * other.error) / other.value.abs();
        Self::rounded(value, inherited)
    }
}

impl Neg for Bounded {
    type Output = Self;
    fn neg(self) -> Self {
        Self { value: -self.value, ..self }
    }
}

impl Real for Bounded {
    /// The compiler has folded constants: one that is not a simple number may be the result of operations on larger
    /// ones, such as the sine of half a turn.
    fn constant(value: f64) -> Self {
        let simple = (2.0 * value).fract() == 0.0;
        Self { value, error: if simple { 0.0 } else { 4.0 * UNIT * value.abs().max(1.0) } }
    }

    fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        self.through(root, 0.5 / root)
    }

    fn sin_cos(self) -> (Self, Self) {
        let (sine, cosine) = self.value.sin_cos();
        (self.through(sine, cosine), self.through(cosine, sine))
    }

    fn tan(self) -> Self {
        let tangent = self.value.tan();
        self.through(tangent, 1.0 + tangent * tangent)
    }

    fn asin(self) -> Self {
        let slope = 1.0 / (1.0 - self.value * self.value).sqrt();
        self.through(self.value.asin(), slope)
    }

    fn acos(self) -> Self {
        let slope = 1.0 / (1.0 - self.value * self.value).sqrt();
        self.through(self.value.acos(), slope)
    }

    fn atan2(self, x: Self) -> Self {
        let square = self.value * self.value + x.value * x.value;
        let inherited = (self.value.abs() * x.error + x.value.abs() * self.error) / square;
        Self::rounded(self.value.atan2(x.value), inherited)
    }

    fn exp(self) -> Self {
        let value = self.value.exp();
        self.through(value, value)
    }

    fn ln(self) -> Self {
        self.through(self.value.ln(), 1.0 / self.value)
    }

    fn powi(self, exponent: i32) -> Self {
        let slope = f64::from(exponent) * self.value.powi(exponent - 1);
        self.through(self.value.powi(exponent), slope)
    }

    /// The terms may exceed their sum in magnitude, and the start of a piece is a rounded number.
    fn spline(self, pieces: &[[f64; 5]], derivative: usize) -> Self {
        let value = self.value.spline(pieces, derivative);
        let slope = self.value.spline(pieces, derivative + 1).abs();
        let started = pieces.iter().rev().find(|piece| self.value >= piece[0]);
        let [start, coefficients @ ..] = *started.unwrap_or(&pieces[0]);
        let t = (self.value - start).abs();
        let mut power = 1.0;
        let mut terms = 0.0;
        for coefficient in &coefficients[derivative.min(4)..] {
            terms += 6.0 * coefficient.abs() * power;
            power *= t;
        }
        let inherited = slope * (self.error + UNIT * self.value.abs()) + 4.0 * UNIT * terms;
        Self::rounded(value, inherited)
    }

    fn powf(self, exponent: Self) -> Self {
        let value = self.value.powf(exponent.value);
        let by_base = exponent.value * self.value.powf(exponent.value - 1.0);
        let by_exponent = value * self.value.abs().ln();
        let inherited = by_base.abs() * self.error + by_exponent.abs() * exponent.error;
        Self::rounded(value, inherited)
    }
}
