//! Hyper-dual numbers of the `num-dual` crate as a scalar for generated code: exact first and second derivatives that owe
//! nothing to the compiler's differentiation.

use std::cmp::Ordering;
use std::ops::{Add, Div, Mul, Neg, Sub};

use eigentol::Real;
use num_dual::{DualNum, HyperDual64};

/// A value, its derivatives along two directions and the mixed second one.
#[derive(Clone, Copy, Debug)]
pub struct Hyper(pub HyperDual64);

impl Hyper {
    /// The parts of a hyper-dual number: `1`, `e1`, `e2`, `e1 e2`.
    pub const PARTS: usize = 4;

    /// From value, first derivatives and mixed second derivative.
    pub fn new([re, eps1, eps2, eps1eps2]: [f64; Self::PARTS]) -> Self {
        Self(HyperDual64::new(re, eps1, eps2, eps1eps2))
    }

    /// Value, first derivatives and mixed second derivative.
    pub fn parts(self) -> [f64; Self::PARTS] {
        [self.0.re, self.0.eps1, self.0.eps2, self.0.eps1eps2]
    }

    /// The value.
    pub fn value(self) -> f64 {
        self.0.re
    }
}

impl PartialEq for Hyper {
    fn eq(&self, other: &Self) -> bool {
        self.parts() == other.parts()
    }
}

impl PartialOrd for Hyper {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        self.0.re.partial_cmp(&other.0.re)
    }
}

macro_rules! operator {
    ($($operator:ident $method:ident,)*) => {$(
        impl $operator for Hyper {
            type Output = Self;
            fn $method(self, other: Self) -> Self {
                Self(self.0.$method(other.0))
            }
        }
    )*};
}

operator! { Add add, Sub sub, Mul mul, Div div, }

impl Neg for Hyper {
    type Output = Self;
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

macro_rules! functions {
    ($($function:ident)*) => {
        $(fn $function(self) -> Self {
            Self(DualNum::$function(&self.0))
        })*
    };
}

impl Real for Hyper {
    fn constant(value: f64) -> Self {
        Self(HyperDual64::from_re(value))
    }
    fn sin_cos(self) -> (Self, Self) {
        let (sin, cos) = DualNum::sin_cos(&self.0);
        (Self(sin), Self(cos))
    }
    /// In axes turned to the value itself, where the quotient is defined: that of `num-dual` divides by `x`.
    fn atan2(self, x: Self) -> Self {
        let (x0, y0) = (Self::constant(x.value()), Self::constant(self.value()));
        let turned = (self * x0 - x * y0) / (x * x0 + self * y0);
        let angle = self.value().atan2(x.value());
        Self(DualNum::atan(&turned.0)) + Self::constant(angle)
    }
    fn powi(self, exponent: i32) -> Self {
        Self(DualNum::powi(&self.0, exponent))
    }
    fn powf(self, exponent: Self) -> Self {
        Self(DualNum::powd(&self.0, exponent.0))
    }
    functions! { sqrt tan asin acos exp ln }
}
