//! What a search for a design point that failed has found.

use core::fmt;

/// Number of evaluations of a limit state.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Evaluations {
    /// Evaluations of value and gradient.
    pub total: usize,
    /// Evaluations that gave no value, or one that is not finite.
    pub without_value: usize,
}

/// Deviation of a point from a design point. It does not depend on the unit of the limit state.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Residuals {
    /// `|g| / |grad g| / max(1, |z|)`: first-order distance from the limit.
    pub limit: f64,
    /// `|z - beta n| / max(1, |z|)`, where `n` is the direction towards failure and `|beta| = |z|`: angle between the
    /// point and the normal of the limit.
    pub direction: f64,
}

impl Residuals {
    /// The larger of the two.
    pub fn largest(&self) -> f64 {
        self.limit.max(self.direction)
    }
}

/// The point closest to being a design point that a search found.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Closest {
    /// Its coordinates.
    pub point: Vec<f64>,
    /// Value of the limit state.
    pub value: f64,
    /// Its residuals as a design point; `None` if the gradient is zero.
    pub residuals: Option<Residuals>,
    /// Evaluations of the whole search.
    pub evaluations: Evaluations,
}

impl fmt::Display for Closest {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "the best point has value {}, ", self.value)?;
        match self.residuals {
            None => write!(f, "no gradient")?,
            Some(residuals) => {
                write!(f, "is {:.1e} off the limit and {:.1e} off its normal", residuals.limit, residuals.direction)?
            }
        }
        let Evaluations { total, without_value } = self.evaluations;
        write!(f, " ({total} evaluations, {without_value} without a value)")
    }
}
