//! Hyper-dual numbers of the `num-dual` crate as a scalar for generated code: exact first and second derivatives
//! independent of the compiler's differentiation.

use num_dual::HyperDual64;

use crate::num_dual::scalar;

/// A value, its derivatives along two directions, and the mixed second derivative.
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

scalar! { Hyper of HyperDual64 }
