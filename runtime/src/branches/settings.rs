//! How far and how finely branches are followed.

use crate::arguments::check_input;
use crate::setters::setters;
use crate::{Any, Description, Error, Input};

/// Settings of a continuation: the range of one input and the sizes of the steps.
///
/// Lengths along a branch are measured with `(high - low)` as the unit of the input and `size + |q_i|` as the unit of a
/// coordinate or speed; a reaction of a constraint counts by the work it does on a unit of the coordinates it holds,
/// compared with the work of all other forces.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(bound = ""))]
pub struct Continuation<M = Any> {
    /// The input that varies.
    pub input: Input<M>,
    /// Where branches are started, SI.
    pub low: f64,
    /// The other end of the range, SI; it may be the smaller one.
    pub high: f64,
    /// Greatest step along a branch: two events within one step can be missed. 0.05 unless set.
    pub max_step: f64,
    /// A branch that cannot be followed with this step ends. 1e-8 unless set.
    pub min_step: f64,
    /// Most points in each direction of one branch. 2000 unless set.
    pub max_points: usize,
    /// Most Newton iterations for one point. 8 unless set.
    pub max_corrections: usize,
    /// Most branches. 64 unless set.
    pub max_branches: usize,
    /// A change of a coordinate, rad or m (of a speed, rad/s or m/s), that counts as large. 1 unless set.
    pub size: f64,
    /// Multiple of `size` (and of the coordinates at the start) beyond which a coordinate counts as infinite. 1e6 unless
    /// set.
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

    /// From `low` to `high` with the settings that suit most mechanisms.
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

    /// The same, of any mechanism.
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
            (
                "step",
                "the least must not exceed the greatest, nor that the range",
            )
        } else if !positive(self.size) {
            ("size", "it must be positive")
        } else if self.escape.is_nan() || self.escape <= 1.0 {
            ("escape", "it must be greater than one")
        } else if self.max_points == 0 || self.max_corrections < 2 || self.max_branches == 0 {
            (
                "limits",
                "one point, one branch and two corrections are the least",
            )
        } else {
            return Ok(());
        };
        Err(Error::Setting {
            setting,
            reason: reason.to_owned(),
        })
    }

    /// Width of the range, SI.
    pub(super) fn range(&self) -> f64 {
        (self.high - self.low).abs()
    }

    /// The least and the greatest value.
    pub(super) fn bounds(&self) -> (f64, f64) {
        (self.low.min(self.high), self.low.max(self.high))
    }
}
