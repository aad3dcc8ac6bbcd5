//! Complex numbers over hyper-dual ones.

use std::ops::{Add, Mul, Sub};

use eigentol::Real;
use nalgebra::Complex;

use crate::hyper::Hyper;

/// `re + i im`.
#[derive(Clone, Copy, Debug)]
pub(super) struct HyperComplex {
    pub(super) re: Hyper,
    pub(super) im: Hyper,
}

impl HyperComplex {
    /// A constant, without infinitesimal parts.
    pub(super) fn constant(value: Complex<f64>) -> Self {
        Self { re: Hyper::constant(value.re), im: Hyper::constant(value.im) }
    }

    /// One complex number per infinitesimal part.
    pub(super) fn parts(self) -> [Complex<f64>; Hyper::PARTS] {
        let (re, im) = (self.re.parts(), self.im.parts());
        std::array::from_fn(|part| Complex::new(re[part], im[part]))
    }

    /// The inverse of [`HyperComplex::parts`].
    pub(super) fn from_parts(parts: [Complex<f64>; Hyper::PARTS]) -> Self {
        Self { re: Hyper::new(parts.map(|part| part.re)), im: Hyper::new(parts.map(|part| part.im)) }
    }

    pub(super) fn scaled(self, factor: Hyper) -> Self {
        Self { re: self.re * factor, im: self.im * factor }
    }

    pub(super) fn modulus(self) -> Hyper {
        (self.re * self.re + self.im * self.im).sqrt()
    }
}

impl Add for HyperComplex {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self { re: self.re + other.re, im: self.im + other.im }
    }
}

impl Sub for HyperComplex {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self { re: self.re - other.re, im: self.im - other.im }
    }
}

impl Mul for HyperComplex {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Self { re: self.re * other.re - self.im * other.im, im: self.re * other.im + self.im * other.re }
    }
}
