//! A run of samples, any range of which can be processed separately: its identity and its missing samples.

use core::ops::Range;

use eigentol_statistics::summary::Partial;

use super::{Counts, Fingerprint};
use crate::algebra::Vector;
use crate::{Description, Error, Shared};

/// Version of the layout of stored partial results; other versions are refused on reading.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(into = "u32", try_from = "u32"))]
pub struct Format;

#[cfg(feature = "serde")]
impl Format {
    const VERSION: u32 = 2;
}

#[cfg(feature = "serde")]
impl From<Format> for u32 {
    fn from(Format: Format) -> Self {
        Format::VERSION
    }
}

#[cfg(feature = "serde")]
impl TryFrom<u32> for Format {
    type Error = String;

    fn try_from(found: u32) -> Result<Self, String> {
        let known = Self::VERSION;
        if found == known {
            return Ok(Self);
        }
        Err(format!(
            "these samples were written in version {found} of the format, and version {known} can be read: take one version of \
             eigentol for all parts of a run"
        ))
    }
}

/// Some samples of a run: its identity, and the statistics of the samples that are done, one randomisation after the other.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Run {
    #[doc(hidden)]
    pub fingerprint: Fingerprint,
    /// Number of samples in each randomisation.
    #[doc(hidden)]
    pub of_each: u64,
    /// The statistics of each randomisation.
    #[doc(hidden)]
    pub parts: Vec<Partial>,
    /// The inputs of the operating point, SI.
    #[doc(hidden)]
    pub inputs: Vector,
    /// The mechanism it belongs to.
    #[doc(hidden)]
    pub description: Shared<Description>,
}

impl Run {
    /// Number of samples of the complete run.
    pub(crate) fn total(&self) -> u64 {
        self.of_each * self.parts.len() as u64
    }

    /// Outcomes of the samples that are done.
    #[doc(hidden)]
    pub fn counts(&self) -> Counts {
        Counts::of_parts(&self.parts)
    }

    /// The ranges of samples that are done, sorted and disjoint.
    #[doc(hidden)]
    pub fn ranges(&self) -> Vec<Range<u64>> {
        let mut all: Vec<Range<u64>> = Vec::new();
        for (group, part) in self.parts.iter().enumerate() {
            let first = group as u64 * self.of_each;
            for range in part.ranges() {
                let shifted = range.start + first..range.end + first;
                match all.last_mut() {
                    Some(last) if last.end == shifted.start => last.end = shifted.end,
                    _ => all.push(shifted),
                }
            }
        }
        all
    }

    /// The ranges of samples that are missing, sorted and disjoint.
    #[doc(hidden)]
    pub fn missing(&self) -> Vec<Range<u64>> {
        let mut missing = Vec::new();
        let mut next = 0;
        for done in self.ranges() {
            missing.push(next..done.start);
            next = done.end;
        }
        missing.push(next..self.total());
        missing.retain(|range| !range.is_empty());
        missing
    }

    /// Refuses a run with missing samples.
    #[doc(hidden)]
    pub fn check_complete(&self) -> Result<(), Error> {
        let missing = self.missing();
        if missing.is_empty() {
            return Ok(());
        }
        Err(Error::SamplesMissing { missing })
    }

    /// Adds other samples of the same run; adds nothing if some of them are already there.
    #[doc(hidden)]
    pub fn merge(&mut self, other: Self) -> Result<(), Error> {
        self.fingerprint.check(&other.fingerprint)?;
        let added = other.ranges();
        for range in self.ranges() {
            for added in &added {
                let (start, end) = (range.start.max(added.start), range.end.min(added.end));
                if start < end {
                    return Err(Error::SamplesOverlap { start, end });
                }
            }
        }
        for (part, added) in self.parts.iter_mut().zip(other.parts) {
            part.merge(added)?;
        }
        Ok(())
    }

    /// Refuses data that cannot be samples of one run: the first `outcomes` counts must count each sample once.
    #[cfg(feature = "serde")]
    #[doc(hidden)]
    pub fn check(&self, quantities: usize, outcomes: usize) -> Result<(), &'static str> {
        let total = self.of_each.checked_mul(self.parts.len() as u64);
        let fits = |part: &Partial| {
            let ranges = part.ranges();
            let done: u64 = ranges.iter().map(|range| range.end - range.start).sum();
            let counted = part.outcomes().get(..outcomes);
            let counted = counted.and_then(|all| all.iter().try_fold(0_u64, |sum, number| sum.checked_add(*number)));
            part.plan().quantities() == quantities
                && ranges.last().is_none_or(|last| last.end <= self.of_each)
                && counted == Some(done)
        };
        let inputs = self.inputs.len() == self.description.inputs.len();
        if total.is_some() && inputs && !self.parts.is_empty() && self.parts.iter().all(fits) {
            Ok(())
        } else {
            Err("the parts of these samples do not fit together")
        }
    }
}

/// What the parts of any run tell of it, inside of their implementation.
#[doc(hidden)]
#[macro_export]
macro_rules! of_run {
    () => {
        /// The ranges of samples that are done, sorted and disjoint.
        #[must_use]
        pub fn ranges(&self) -> Vec<::core::ops::Range<u64>> {
            self.run.ranges()
        }

        /// The ranges of samples that are missing, sorted and disjoint.
        #[must_use]
        pub fn missing(&self) -> Vec<::core::ops::Range<u64>> {
            self.run.missing()
        }

        /// Refuses an incomplete run.
        ///
        /// # Errors
        /// [`Error::SamplesMissing`], which lists the gaps.
        pub fn check_complete(&self) -> Result<(), $crate::Error> {
            self.run.check_complete()
        }

        /// Identifies the run: equal for parts that can be merged.
        #[must_use]
        pub fn fingerprint(&self) -> &$crate::tolerance::Fingerprint {
            &self.run.fingerprint
        }
    };
}
