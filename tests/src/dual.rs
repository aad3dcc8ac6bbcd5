//! Dual numbers of the `num-dual` crate as a scalar for generated code: derivatives that owe nothing to the compiler's
//! differentiation.

use std::cmp::Ordering;
use std::ops::{Add, Div, Mul, Neg, Sub};

use eigentol::Real;
use num_dual::{Dual64, DualNum};

/// A value and its derivative along one direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dual(pub Dual64);

impl Dual {
    /// A value with a slope.
    pub fn new(value: f64, slope: f64) -> Self {
        Self(Dual64::new(value, slope))
    }

    /// The derivative.
    pub fn slope(self) -> f64 {
        self.0.eps
    }
}

impl PartialOrd for Dual {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        self.0.re.partial_cmp(&other.0.re)
    }
}

macro_rules! operator {
    ($($operator:ident $method:ident,)*) => {$(
        impl $operator for Dual {
            type Output = Self;
            fn $method(self, other: Self) -> Self {
                Self(self.0.$method(other.0))
            }
        }
    )*};
}

operator! { Add add, Sub sub, Mul mul, Div div, }

impl Neg for Dual {
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

impl Real for Dual {
    fn constant(value: f64) -> Self {
        Self(Dual64::from(value))
    }
    fn sin_cos(self) -> (Self, Self) {
        let (sin, cos) = DualNum::sin_cos(&self.0);
        (Self(sin), Self(cos))
    }
    fn atan2(self, x: Self) -> Self {
        Self(DualNum::atan2(&self.0, x.0))
    }
    fn powi(self, exponent: i32) -> Self {
        Self(DualNum::powi(&self.0, exponent))
    }
    fn powf(self, exponent: Self) -> Self {
        Self(DualNum::powd(&self.0, exponent.0))
    }
    functions! { sqrt tan asin acos exp ln }
}
