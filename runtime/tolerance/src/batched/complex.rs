//! Complex numbers, one in each lane.

use core::ops::{Add, Mul, Sub};

use num_complex::Complex64;

use crate::scalar::Lanes;

#[derive(Clone, Copy)]
pub(crate) struct Complex<V> {
    pub(crate) re: V,
    pub(crate) im: V,
}

impl<V: Lanes> Complex<V> {
    #[inline(always)]
    pub(crate) fn constant(z: Complex64) -> Self {
        Self { re: V::constant(z.re), im: V::constant(z.im) }
    }

    #[inline(always)]
    pub(crate) fn times(self, factor: V) -> Self {
        Self { re: self.re * factor, im: self.im * factor }
    }

    #[inline(always)]
    pub(crate) fn conjugate(self) -> Self {
        Self { re: self.re, im: -self.im }
    }

    /// `|z|^2`
    #[inline(always)]
    pub(crate) fn square(self) -> V {
        self.re * self.re + self.im * self.im
    }

    /// A bound on `|z|`, larger by at most a factor `sqrt(2)`.
    #[inline(always)]
    pub(crate) fn bound(self) -> V {
        self.re.abs() + self.im.abs()
    }

    #[inline(always)]
    pub(crate) fn inverse(self) -> Self {
        self.conjugate().times(V::constant(1.0) / self.square())
    }

    #[inline(always)]
    pub(crate) fn choose(mask: V::Mask, yes: Self, no: Self) -> Self {
        Self { re: V::choose(mask, yes.re, no.re), im: V::choose(mask, yes.im, no.im) }
    }
}

impl<V: Lanes> Add for Complex<V> {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self { re: self.re + other.re, im: self.im + other.im }
    }
}

impl<V: Lanes> Sub for Complex<V> {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self { re: self.re - other.re, im: self.im - other.im }
    }
}

impl<V: Lanes> Mul for Complex<V> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Self { re: self.re * other.re - self.im * other.im, im: self.re * other.im + self.im * other.re }
    }
}
