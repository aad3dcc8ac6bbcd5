//! A range of one input in which something is looked for.

use crate::{Error, Input};

/// Where to look: `steps` equal steps of one input from `low` to `high`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    /// The input that varies.
    pub input: Input,
    /// Where the search starts, SI.
    pub low: f64,
    /// Where it ends, SI; below `low` to search downwards.
    pub high: f64,
    /// Number of steps; two events within one step are not told apart.
    pub steps: usize,
}

impl Range {
    /// The ends of the steps, `low` excluded.
    pub(super) fn steps(&self) -> impl Iterator<Item = f64> + use<> {
        let (low, high, count) = (self.low, self.high, self.steps);
        (1..=count).map(move |step| low + (high - low) * step as f64 / count as f64)
    }

    pub(super) fn check<const U: usize>(&self, mechanism: &'static str) -> Result<(), Error> {
        check_input::<U>(self.input, mechanism)?;
        let refused = if !(self.low.is_finite() && self.high.is_finite()) {
            "its ends must be finite"
        } else if self.low == self.high {
            "its ends must differ"
        } else if self.steps == 0 {
            "it needs at least one step"
        } else {
            return Ok(());
        };
        Err(Error::Setting {
            setting: "range",
            reason: refused.to_owned(),
        })
    }
}

pub(crate) fn check_input<const U: usize>(
    input: Input,
    mechanism: &'static str,
) -> Result<(), Error> {
    if input.0 < U {
        Ok(())
    } else {
        Err(Error::UnknownHandle {
            kind: "input",
            index: input.0,
            mechanism,
            count: U,
        })
    }
}
