//! A number type that counts operations.

use std::cell::Cell;
use std::ops::{Add, Div, Mul, Neg, Sub};

use eigentol::{Dual, Real};
use eigentol_compiler::program::Kernel;

use eigentol_consistency::interpreter::interpret;

thread_local! {
    static OPERATIONS: Cell<usize> = const { Cell::new(0) };
}

/// The number of operations and function calls that a kernel takes in dual numbers. The interpreter evaluates sine and
/// cosine of an angle separately, so generated code does slightly fewer.
pub fn operations_along(kernel: &Kernel) -> usize {
    let start = Dual { value: Counted(0.7), slope: Counted(0.3) };
    let arguments: Vec<Vec<Dual<Counted>>> =
        kernel.parameters.iter().map(|parameter| vec![start; parameter.entries.len()]).collect();
    let slices: Vec<&[Dual<Counted>]> = arguments.iter().map(Vec::as_slice).collect();
    OPERATIONS.set(0);
    interpret(kernel, &slices);
    OPERATIONS.get()
}

#[derive(Clone, Copy)]
struct Counted(f64);

fn counted(value: f64) -> Counted {
    OPERATIONS.set(OPERATIONS.get() + 1);
    Counted(value)
}

macro_rules! operators {
    ($($operator:ident $method:ident),*) => {$(
        impl $operator for Counted {
            type Output = Self;
            fn $method(self, other: Self) -> Self {
                counted(self.0.$method(other.0))
            }
        }
    )*};
}

operators! { Add add, Sub sub, Mul mul, Div div }

/// A negation counts as part of the operation that follows it.
impl Neg for Counted {
    type Output = Self;
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

macro_rules! functions {
    ($($function:ident),*) => {$(
        fn $function(self) -> Self {
            counted(self.0.$function())
        }
    )*};
}

impl Real for Counted {
    functions! { sqrt, tan, asin, acos, exp, ln }
    fn constant(value: f64) -> Self {
        Self(value)
    }
    fn sin_cos(self) -> (Self, Self) {
        let (sine, cosine) = self.0.sin_cos();
        (counted(sine), Self(cosine))
    }
    fn atan2(self, x: Self) -> Self {
        counted(self.0.atan2(x.0))
    }
    fn powi(self, exponent: i32) -> Self {
        counted(self.0.powi(exponent))
    }
    fn spline(self, pieces: &[[f64; 5]], derivative: usize) -> Self {
        counted(self.0.spline(pieces, derivative))
    }
    fn powf(self, exponent: Self) -> Self {
        counted(self.0.powf(exponent.0))
    }
}
