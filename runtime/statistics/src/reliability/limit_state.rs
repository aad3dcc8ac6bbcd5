//! Limit states: functions of independent standard normal variables that are not positive in failure.

use core::fmt::Display;

/// Value and gradient of a limit state at a point.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct LimitValue {
    /// `g(z)`, in the unit of the limit state.
    pub value: f64,
    /// `dg/dz_i`, one per variable, in the unit of the limit state.
    pub gradient: Vec<f64>,
}

/// A limit state `g(z)` of independent standard normal variables `z`; failure is `g(z) <= 0`.
///
/// It may have no value somewhere, because the quantity it describes does not exist there; it then gives the reason.
/// Searches step back from such points and samplers count them; neither treats them as failures or as safe.
pub trait LimitState {
    /// The reason why there is no value.
    type Error: Display;

    /// Number of variables.
    fn dimension(&self) -> usize;

    /// Value and exact gradient at `z`.
    ///
    /// # Errors
    ///
    /// If there is no value at `z`.
    fn evaluate(&self, z: &[f64]) -> Result<LimitValue, Self::Error>;

    /// The value alone, for sampling.
    ///
    /// # Errors
    ///
    /// If there is no value at `z`.
    fn value(&self, z: &[f64]) -> Result<f64, Self::Error> {
        Ok(self.evaluate(z)?.value)
    }
}

impl<L: LimitState + ?Sized> LimitState for &L {
    type Error = L::Error;

    fn dimension(&self) -> usize {
        (**self).dimension()
    }

    fn evaluate(&self, z: &[f64]) -> Result<LimitValue, Self::Error> {
        (**self).evaluate(z)
    }

    fn value(&self, z: &[f64]) -> Result<f64, Self::Error> {
        (**self).value(z)
    }
}

/// A limit state defined by a closure for value and gradient.
#[derive(Clone, Copy, Debug)]
pub struct LimitFunction<F> {
    dimension: usize,
    function: F,
}

impl<F, E> LimitFunction<F>
where
    F: Fn(&[f64]) -> Result<LimitValue, E>,
{
    /// Creates a limit state with `dimension` variables.
    pub fn new(dimension: usize, function: F) -> Self {
        Self { dimension, function }
    }
}

impl<F, E> LimitState for LimitFunction<F>
where
    F: Fn(&[f64]) -> Result<LimitValue, E>,
    E: Display,
{
    type Error = E;

    fn dimension(&self) -> usize {
        self.dimension
    }

    fn evaluate(&self, z: &[f64]) -> Result<LimitValue, E> {
        (self.function)(z)
    }
}
