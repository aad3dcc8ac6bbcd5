//! Plans: which statistics to gather.

use super::Sketch;
use super::checks::check_below;
use crate::Error;

/// The statistics to gather from samples with a given number of quantities.
///
/// Moments of each quantity are always included; anything not requested costs nothing.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Plan {
    /// For each quantity an empty sketch, if requested.
    pub(super) sketches: Vec<Option<Sketch>>,
    /// Sorted; the first of a pair is the smaller.
    pub(super) pairs: Vec<(usize, usize)>,
    pub(super) outcomes: usize,
}

impl Plan {
    /// A plan for the moments of `quantities` quantities.
    #[must_use]
    pub fn new(quantities: usize) -> Self {
        Self { sketches: vec![None; quantities], pairs: Vec::new(), outcomes: 0 }
    }

    /// Number of quantities.
    #[must_use]
    pub fn quantities(&self) -> usize {
        self.sketches.len()
    }

    /// Adds the distribution of a quantity, for quantiles and histograms: a [`Sketch`] about `reference`, such as the
    /// nominal value, for deviations of the order of `scale`, both in the unit of the quantity.
    ///
    /// # Errors
    ///
    /// If there is no such quantity, and as for [`Sketch::new`].
    pub fn sketch(mut self, quantity: usize, reference: f64, scale: f64) -> Result<Self, Error> {
        self.check(quantity)?;
        self.sketches[quantity] = Some(Sketch::new(reference, scale)?);
        Ok(self)
    }

    /// Adds the covariances of each of `firsts` with each of `seconds`, over the samples that have both.
    ///
    /// # Errors
    ///
    /// If there is no such quantity.
    pub fn covariances(mut self, firsts: &[usize], seconds: &[usize]) -> Result<Self, Error> {
        for &first in firsts {
            for &second in seconds {
                self.check(first)?;
                self.check(second)?;
                if first != second {
                    self.pairs.push((first.min(second), first.max(second)));
                }
            }
        }
        self.pairs.sort_unstable();
        self.pairs.dedup();
        Ok(self)
    }

    /// Adds counts of samples for each of `outcomes` outcomes.
    #[must_use]
    pub fn outcomes(mut self, outcomes: usize) -> Self {
        self.outcomes = outcomes;
        self
    }

    pub(super) fn check(&self, quantity: usize) -> Result<(), Error> {
        check_below("quantity", quantity, self.quantities())
    }
}
