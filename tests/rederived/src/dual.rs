//! Dual numbers of the `num-dual` crate as a scalar for generated code: derivatives independent of the compiler's
//! differentiation.

use num_dual::Dual64;

use crate::num_dual::scalar;

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

scalar! { Dual of Dual64 }
