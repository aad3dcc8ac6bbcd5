//! Numbers with one derivative, for what is not generated.

use core::ops::{Add, Div, Mul, Neg, Sub};

use crate::Real;

/// A value and its derivative.
#[derive(Clone, Copy)]
pub(crate) struct Dual<T> {
    value: T,
    pub(crate) slope: T,
}

impl<T: Real> Dual<T> {
    /// A value that stands still.
    pub(crate) fn fixed(value: T) -> Self {
        Self {
            value,
            slope: T::constant(0.0),
        }
    }

    fn through(self, value: T, by_self: T) -> Self {
        Self {
            value,
            slope: by_self * self.slope,
        }
    }
}

impl<T: Real> Add for Dual<T> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self {
            value: self.value + other.value,
            slope: self.slope + other.slope,
        }
    }
}

impl<T: Real> Sub for Dual<T> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self {
            value: self.value - other.value,
            slope: self.slope - other.slope,
        }
    }
}

impl<T: Real> Mul for Dual<T> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Self {
            value: self.value * other.value,
            slope: self.slope * other.value + self.value * other.slope,
        }
    }
}

impl<T: Real> Div for Dual<T> {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let value = self.value / other.value;
        Self {
            value,
            slope: (self.slope - value * other.slope) / other.value,
        }
    }
}

impl<T: Real> Neg for Dual<T> {
    type Output = Self;
    fn neg(self) -> Self {
        Self {
            value: -self.value,
            slope: -self.slope,
        }
    }
}

impl<T: Real> Real for Dual<T> {
    fn constant(value: f64) -> Self {
        Self::fixed(T::constant(value))
    }
    fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        self.through(root, T::constant(0.5) / root)
    }
    fn sin_cos(self) -> (Self, Self) {
        let (sine, cosine) = self.value.sin_cos();
        (self.through(sine, cosine), self.through(cosine, -sine))
    }
    fn tan(self) -> Self {
        let tangent = self.value.tan();
        self.through(tangent, T::constant(1.0) + tangent * tangent)
    }
    fn asin(self) -> Self {
        let rest = T::constant(1.0) - self.value * self.value;
        self.through(self.value.asin(), T::constant(1.0) / rest.sqrt())
    }
    fn acos(self) -> Self {
        let rest = T::constant(1.0) - self.value * self.value;
        self.through(self.value.acos(), -(T::constant(1.0) / rest.sqrt()))
    }
    fn atan2(self, x: Self) -> Self {
        let square = self.value * self.value + x.value * x.value;
        Self {
            value: self.value.atan2(x.value),
            slope: (x.value * self.slope - self.value * x.slope) / square,
        }
    }
    fn exp(self) -> Self {
        let power = self.value.exp();
        self.through(power, power)
    }
    fn ln(self) -> Self {
        self.through(self.value.ln(), T::constant(1.0) / self.value)
    }
    fn powi(self, exponent: i32) -> Self {
        let below = self.value.powi(exponent - 1);
        let slope = T::constant(f64::from(exponent)) * below;
        self.through(self.value.powi(exponent), slope)
    }
    fn powf(self, exponent: Self) -> Self {
        let value = self.value.powf(exponent.value);
        let by_base = exponent.value * self.value.powf(exponent.value - T::constant(1.0));
        Self {
            value,
            slope: by_base * self.slope + value * self.value.ln() * exponent.slope,
        }
    }
}
