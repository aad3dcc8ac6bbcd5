//! Settings for following branches: range, step sizes and limits.

use crate::arguments::check_input;
use crate::setters;
use crate::{Any, Description, Error, Input};

/// Settings of a continuation: the range of one input and the sizes of the steps.
///
/// Lengths along a branch are measured with `(high - low)` as the unit of the input and `size + |q_i|`, with `size` in
/// radians or typical lengths of the mechanism, as the unit of a coordinate or speed. A constraint reaction is measured
/// by the work it does on a unit of the coordinates it holds, relative to the work of all other forces.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(bound = ""))]
pub struct Continuation<M = Any> {
    /// The varied input.
    pub input: Input<M>,
    /// Value at which branches start, SI.
    pub low: f64,
    /// The other end of the range, SI; it may be the smaller one.
    pub high: f64,
    /// Largest step along a branch: two events within one step can be missed. 0.05 by default.
    pub max_step: f64,
    /// Smallest step: a branch that cannot be followed with it ends. 1e-8 by default.
    pub min_step: f64,
    /// Maximum number of points in each direction of one branch. 2000 by default.
    pub max_points: usize,
    /// Maximum number of Newton iterations for one point. 8 by default.
    pub max_corrections: usize,
    /// Maximum number of branches. 64 by default.
    pub max_branches: usize,
    /// A change of a coordinate that counts as large, in multiples of a radian or of
    /// [`Description::length`](crate::Description::length) (of a speed, in rad/s or m/s). 1 by default.
    pub size: f64,
    /// Multiple of `size` (plus the largest coordinate at the start, in the same units) beyond which a coordinate
    /// counts as infinite. 1e6 by default.
    pub escape: f64,
}

impl<M> Continuation<M> {
    setters!(
        max_step: f64,
        min_step: f64,
        max_points: usize,
        max_corrections: usize,
        max_branches: usize,
        size: f64,
        escape: f64,
    );

    /// A range from `low` to `high`, with settings that suit most mechanisms.
    #[must_use]
    pub fn new(input: Input<M>, low: f64, high: f64) -> Self {
        Self {
            input,
            low,
            high,
            max_step: 0.05,
            min_step: 1e-8,
            max_points: 2000,
            max_corrections: 8,
            max_branches: 64,
            size: 1.0,
            escape: 1e6,
        }
    }

    /// The settings without the type of their mechanism.
    #[must_use]
    pub fn any(&self) -> Continuation {
        Continuation {
            input: self.input.any(),
            low: self.low,
            high: self.high,
            max_step: self.max_step,
            min_step: self.min_step,
            max_points: self.max_points,
            max_corrections: self.max_corrections,
            max_branches: self.max_branches,
            size: self.size,
            escape: self.escape,
        }
    }
}

impl Continuation {
    pub(crate) fn check(&self, description: &Description) -> Result<(), Error> {
        check_input(self.input, description)?;
        let positive = |value: f64| value > 0.0 && value.is_finite();
        let (setting, reason) = if !(self.low.is_finite() && self.high.is_finite()) {
            ("range", "its ends must be finite")
        } else if self.low == self.high {
            ("range", "its ends must differ")
        } else if !positive(self.range()) {
            ("range", "it is too wide")
        } else if !positive(self.min_step) || !positive(self.max_step) {
            ("step", "it must be positive")
        } else if self.min_step > self.max_step || self.max_step > 1.0 {
            ("step", "the least must not exceed the greatest, nor that the range")
        } else if !positive(self.size) {
            ("size", "it must be positive")
        } else if self.escape.is_nan() || self.escape <= 1.0 {
            ("escape", "it must be greater than one")
        } else if self.max_points == 0 || self.max_corrections < 2 || self.max_branches == 0 {
            ("limits", "one point, one branch and two corrections are the least")
        } else {
            return Ok(());
        };
        Err(Error::setting(setting, reason))
    }

    /// Width of the range, SI.
    pub(super) fn range(&self) -> f64 {
        (self.high - self.low).abs()
    }

    /// The smaller and the larger end of the range.
    pub(super) fn bounds(&self) -> (f64, f64) {
        (self.low.min(self.high), self.low.max(self.high))
    }
}
