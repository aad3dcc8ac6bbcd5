//! The complex numbers that elements and chains are eliminated in: plain, or of several reals side by side and with
//! derivatives.

use core::ops::{Add, AddAssign, Mul, Neg, Sub, SubAssign};

use eigentol_contract::Real;
use eigentol_numerics::Complex;

/// A complex number.
pub(crate) trait Number:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Neg<Output = Self> + AddAssign + SubAssign
{
    /// A number that does not change.
    fn of(value: Complex) -> Self;
    /// Zero.
    fn zero() -> Self;
    /// Times a real.
    fn times(self, factor: f64) -> Self;
    /// One over it.
    fn inverse(self) -> Self;
}

impl Number for Complex {
    #[inline(always)]
    fn of(value: Complex) -> Self {
        value
    }
    #[inline(always)]
    fn zero() -> Self {
        Self::ZERO
    }
    #[inline(always)]
    fn times(self, factor: f64) -> Self {
        self * factor
    }
    #[inline(always)]
    fn inverse(self) -> Self {
        self.inv()
    }
}

/// A complex number of any reals.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pair<R> {
    pub(crate) re: R,
    pub(crate) im: R,
}

impl<R: Real> Number for Pair<R> {
    #[inline(always)]
    fn of(value: Complex) -> Self {
        Self { re: R::constant(value.re), im: R::constant(value.im) }
    }
    #[inline(always)]
    fn zero() -> Self {
        Self::of(Complex::ZERO)
    }
    #[inline(always)]
    fn times(self, factor: f64) -> Self {
        let factor = R::constant(factor);
        Self { re: self.re * factor, im: self.im * factor }
    }
    #[inline(always)]
    fn inverse(self) -> Self {
        let scale = R::constant(1.0) / (self.re * self.re + self.im * self.im);
        Self { re: self.re * scale, im: -(self.im * scale) }
    }
}

impl<R: Real> Add for Pair<R> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self { re: self.re + other.re, im: self.im + other.im }
    }
}

impl<R: Real> Sub for Pair<R> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self { re: self.re - other.re, im: self.im - other.im }
    }
}

impl<R: Real> Mul for Pair<R> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Self { re: self.re * other.re - self.im * other.im, im: self.re * other.im + self.im * other.re }
    }
}

impl<R: Real> Neg for Pair<R> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self { re: -self.re, im: -self.im }
    }
}

impl<R: Real> AddAssign for Pair<R> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl<R: Real> SubAssign for Pair<R> {
    #[inline(always)]
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}
