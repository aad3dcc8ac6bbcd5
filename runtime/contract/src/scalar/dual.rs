//! Numbers with one derivative: evaluating a generated kernel in them differentiates it along any direction.
//!
//! # Directions in dual numbers
//!
//! The derivative of a kernel along a direction is the kernel itself in numbers with a slope (this file). Separate,
//! symbolically derived kernels needed up to a fifth fewer operations, and a tenth less time for 32 bars though more
//! for two; but they were more than half of the generated text, and rustc checks text at some 30 microseconds an
//! operation, called or not.

use core::array::from_fn;
use core::ops::{Add, Div, Mul, Neg, Sub};

use super::real::Real;

/// A value and its derivative along some direction (forward differentiation).
///
/// Kernels are generic over their scalar. Evaluated in duals whose slopes form a direction, they return values and
/// exact directional derivatives at about three times the cost. Duals of duals carry second derivatives.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Dual<T> {
    /// The number.
    pub value: T,
    /// Its derivative.
    pub slope: T,
}

impl<T: Real> Dual<T> {
    /// A value that is constant.
    #[inline(always)]
    pub fn fixed(value: T) -> Self {
        Self { value, slope: T::constant(0.0) }
    }

    /// Values that change along a direction.
    #[inline]
    pub fn along<const K: usize>(values: &[T; K], direction: &[T; K]) -> [Self; K] {
        from_fn(|k| Self { value: values[k], slope: direction[k] })
    }

    #[inline(always)]
    fn through(self, value: T, by_self: T) -> Self {
        Self { value, slope: by_self * self.slope }
    }
}

impl<T: Real> Add for Dual<T> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self { value: self.value + other.value, slope: self.slope + other.slope }
    }
}

impl<T: Real> Sub for Dual<T> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self { value: self.value - other.value, slope: self.slope - other.slope }
    }
}

impl<T: Real> Mul for Dual<T> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Self { value: self.value * other.value, slope: self.slope * other.value + self.value * other.slope }
    }
}

impl<T: Real> Div for Dual<T> {
    type Output = Self;
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        let value = self.value / other.value;
        Self { value, slope: (self.slope - value * other.slope) / other.value }
    }
}

impl<T: Real> Neg for Dual<T> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self { value: -self.value, slope: -self.slope }
    }
}

impl<T: Real> Real for Dual<T> {
    #[inline(always)]
    fn constant(value: f64) -> Self {
        Self::fixed(T::constant(value))
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        self.through(root, T::constant(0.5) / root)
    }
    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        let (sine, cosine) = self.value.sin_cos();
        (self.through(sine, cosine), self.through(cosine, -sine))
    }
    #[inline(always)]
    fn sin_cos_all<const K: usize>(angles: [Self; K]) -> [(Self, Self); K] {
        let values = T::sin_cos_all(angles.map(|angle| angle.value));
        from_fn(|k| {
            let (sine, cosine) = values[k];
            (angles[k].through(sine, cosine), angles[k].through(cosine, -sine))
        })
    }
    #[inline(always)]
    fn run<R>(kernel: impl FnOnce() -> R) -> R {
        T::run(kernel)
    }
    #[inline]
    fn tan(self) -> Self {
        let tangent = self.value.tan();
        self.through(tangent, T::constant(1.0) + tangent * tangent)
    }
    #[inline]
    fn asin(self) -> Self {
        let rest = T::constant(1.0) - self.value * self.value;
        self.through(self.value.asin(), T::constant(1.0) / rest.sqrt())
    }
    #[inline]
    fn acos(self) -> Self {
        let rest = T::constant(1.0) - self.value * self.value;
        self.through(self.value.acos(), -(T::constant(1.0) / rest.sqrt()))
    }
    #[inline]
    fn atan2(self, x: Self) -> Self {
        let square = self.value * self.value + x.value * x.value;
        Self { value: self.value.atan2(x.value), slope: (x.value * self.slope - self.value * x.slope) / square }
    }
    #[inline]
    fn exp(self) -> Self {
        let power = self.value.exp();
        self.through(power, power)
    }
    #[inline]
    fn ln(self) -> Self {
        self.through(self.value.ln(), T::constant(1.0) / self.value)
    }
    #[inline]
    fn powi(self, exponent: i32) -> Self {
        if exponent == 0 {
            // the general form divides by zero at zero
            return Self::fixed(self.value.powi(0));
        }
        let below = self.value.powi(exponent - 1);
        let slope = T::constant(f64::from(exponent)) * below;
        self.through(self.value.powi(exponent), slope)
    }
    #[inline]
    fn spline(self, pieces: &[[f64; 5]], derivative: usize) -> Self {
        let slope = self.value.spline(pieces, derivative + 1);
        self.through(self.value.spline(pieces, derivative), slope)
    }
    #[inline]
    fn powf(self, exponent: Self) -> Self {
        let value = self.value.powf(exponent.value);
        let by_base = exponent.value * self.value.powf(exponent.value - T::constant(1.0));
        Self { value, slope: by_base * self.slope + value * self.value.ln() * exponent.slope }
    }
}
