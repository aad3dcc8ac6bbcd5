//! A dual number over any `Real`. Nested, it gives exact derivatives of any order; the hand-written mechanisms of these
//! tests get their derivatives this way.

use std::cmp::Ordering;
use std::ops::{Add, Div, Mul, Neg, Sub};

use eigentol::Real;

#[derive(Clone, Copy, Debug)]
pub struct Dual<T> {
    pub value: T,
    pub slope: T,
}

impl<T: Real> Dual<T> {
    pub fn new(value: T, slope: T) -> Self {
        Self { value, slope }
    }

    pub fn fixed(value: T) -> Self {
        Self { value, slope: T::constant(0.0) }
    }

    fn chain(self, value: T, derivative: T) -> Self {
        Self { value, slope: self.slope * derivative }
    }
}

impl<T: Real> Add for Dual<T> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self::new(self.value + other.value, self.slope + other.slope)
    }
}

impl<T: Real> Sub for Dual<T> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self::new(self.value - other.value, self.slope - other.slope)
    }
}

impl<T: Real> Mul for Dual<T> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Self::new(self.value * other.value, self.slope * other.value + self.value * other.slope)
    }
}

impl<T: Real> Div for Dual<T> {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let value = self.value / other.value;
        Self::new(value, (self.slope - value * other.slope) / other.value)
    }
}

impl<T: Real> Neg for Dual<T> {
    type Output = Self;
    fn neg(self) -> Self {
        Self::new(-self.value, -self.slope)
    }
}

impl<T: PartialEq> PartialEq for Dual<T> {
    fn eq(&self, other: &Self) -> bool {
        self.value == other.value
    }
}

impl<T: PartialOrd> PartialOrd for Dual<T> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        self.value.partial_cmp(&other.value)
    }
}

impl<T: Real> Real for Dual<T> {
    fn constant(value: f64) -> Self {
        Self::fixed(T::constant(value))
    }
    fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        self.chain(root, T::constant(0.5) / root)
    }
    fn sin_cos(self) -> (Self, Self) {
        let (sin, cos) = self.value.sin_cos();
        (self.chain(sin, cos), self.chain(cos, -sin))
    }
    fn tan(self) -> Self {
        let tan = self.value.tan();
        self.chain(tan, T::constant(1.0) + tan * tan)
    }
    fn asin(self) -> Self {
        let one = T::constant(1.0);
        self.chain(self.value.asin(), one / (one - self.value * self.value).sqrt())
    }
    fn acos(self) -> Self {
        let one = T::constant(1.0);
        self.chain(self.value.acos(), -(one / (one - self.value * self.value).sqrt()))
    }
    fn atan2(self, x: Self) -> Self {
        let square = self.value * self.value + x.value * x.value;
        let slope = (self.slope * x.value - self.value * x.slope) / square;
        Self::new(self.value.atan2(x.value), slope)
    }
    fn exp(self) -> Self {
        let value = self.value.exp();
        self.chain(value, value)
    }
    fn spline(self, pieces: &[[f64; 5]], derivative: usize) -> Self {
        let slope = self.value.spline(pieces, derivative + 1);
        self.chain(self.value.spline(pieces, derivative), slope)
    }
    fn ln(self) -> Self {
        self.chain(self.value.ln(), T::constant(1.0) / self.value)
    }
    fn powi(self, exponent: i32) -> Self {
        let factor = T::constant(f64::from(exponent)) * self.value.powi(exponent - 1);
        self.chain(self.value.powi(exponent), factor)
    }
    fn powf(self, exponent: Self) -> Self {
        (exponent * self.ln()).exp()
    }
}
