//! A range of one input to be searched.

use crate::arguments::check_input;
use crate::setters;
use crate::{Any, Description, Error, Input};

/// The range of one input to search, from `low` to `high`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(bound = ""))]
pub struct Range<M = Any> {
    /// The varied input.
    pub input: Input<M>,
    /// Start of the search, SI.
    pub low: f64,
    /// End of the search, SI; below `low` to search downwards.
    pub high: f64,
    /// Number of steps the search takes at least. It divides them wherever an event may hide, so that the events found do
    /// not depend on it. 10 by default.
    pub steps: usize,
}

impl<M> Range<M> {
    setters!(steps: usize);

    /// Creates a range from `low` to `high`, SI.
    #[must_use]
    pub fn new(input: Input<M>, low: f64, high: f64) -> Self {
        Self { input, low, high, steps: 10 }
    }

    /// The range without the type of its mechanism.
    #[must_use]
    pub fn any(&self) -> Range {
        Range { input: self.input.any(), low: self.low, high: self.high, steps: self.steps }
    }
}

impl Range {
    /// The error of a range in which there is no such thing.
    pub(crate) fn without(&self, what: &'static str, description: &Description) -> Error {
        let input = &description.inputs[self.input.index()];
        Error::NotInRange { what, input: input.name.clone(), low: self.low, high: self.high, unit: input.unit.clone() }
    }

    pub(crate) fn check(&self, description: &Description) -> Result<(), Error> {
        check_input(self.input, description)?;
        let refused = if !(self.low.is_finite() && self.high.is_finite()) {
            "its ends must be finite"
        } else if self.low == self.high {
            "its ends must differ"
        } else if self.steps == 0 {
            "it needs at least one step"
        } else {
            return Ok(());
        };
        Err(Error::setting("range", refused))
    }
}
