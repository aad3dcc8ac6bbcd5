//! A run of samples, any range of which can be processed separately: its identity and its missing samples.

use core::ops::Range;

use eigentol_statistics::summary::Partial;

use super::Fingerprint;
use crate::Error;

/// Version of the layout of stored partial results; other versions are refused on reading.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(into = "u32", try_from = "u32")
)]
pub struct Format;

#[cfg(feature = "serde")]
impl Format {
    const VERSION: u32 = 1;
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

/// Identity of a run, and the numbering of its samples: one randomisation after the other.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Run {
    #[doc(hidden)]
    pub fingerprint: Fingerprint,
    /// Number of randomisations.
    #[doc(hidden)]
    pub groups: u64,
    /// Number of samples in each.
    #[doc(hidden)]
    pub of_each: u64,
}

impl Run {
    /// Number of samples of the complete run.
    pub(crate) fn total(&self) -> u64 {
        self.of_each * self.groups
    }

    /// The ranges of samples that are done, sorted and disjoint; `parts` holds one part per randomisation.
    #[doc(hidden)]
    pub fn ranges(&self, parts: &[Partial]) -> Vec<Range<u64>> {
        let mut all: Vec<Range<u64>> = Vec::new();
        for (group, part) in parts.iter().enumerate() {
            let first = group as u64 * self.of_each;
            for own in part.ranges() {
                let own = own.start + first..own.end + first;
                match all.last_mut() {
                    Some(last) if last.end == own.start => last.end = own.end,
                    _ => all.push(own),
                }
            }
        }
        all
    }

    /// The ranges of samples that are missing, sorted and disjoint.
    #[doc(hidden)]
    pub fn missing(&self, parts: &[Partial]) -> Vec<Range<u64>> {
        let mut missing = Vec::new();
        let mut next = 0;
        for done in self.ranges(parts) {
            missing.push(next..done.start);
            next = done.end;
        }
        missing.push(next..self.total());
        missing.retain(|range| !range.is_empty());
        missing
    }

    /// Refuses a run with missing samples.
    #[doc(hidden)]
    pub fn check_complete(&self, parts: &[Partial]) -> Result<(), Error> {
        let missing = self.missing(parts);
        if missing.is_empty() {
            return Ok(());
        }
        Err(Error::SamplesMissing { missing })
    }

    /// Adds other samples of the same run; adds nothing if some of them are already there.
    #[doc(hidden)]
    pub fn merge(
        &self,
        parts: &mut [Partial],
        (other, added): (&Self, Vec<Partial>),
    ) -> Result<(), Error> {
        self.fingerprint.check(&other.fingerprint)?;
        for own in self.ranges(parts) {
            for added in other.ranges(&added) {
                let (start, end) = (own.start.max(added.start), own.end.min(added.end));
                if start < end {
                    return Err(Error::SamplesOverlap { start, end });
                }
            }
        }
        for (own, added) in parts.iter_mut().zip(added) {
            own.merge(added)?;
        }
        Ok(())
    }

    /// Refuses data that cannot be samples of this run: the first `outcomes` counts must count each sample once.
    #[cfg(feature = "serde")]
    #[doc(hidden)]
    pub fn check_parts(
        &self,
        parts: &[Partial],
        quantities: usize,
        outcomes: usize,
    ) -> Result<(), &'static str> {
        let total = self.groups.checked_mul(self.of_each);
        let fits = |part: &Partial| {
            let ranges = part.ranges();
            let done: u64 = ranges.iter().map(|own| own.end - own.start).sum();
            let counted = part.outcomes().get(..outcomes);
            let counted = counted.and_then(|all| {
                all.iter()
                    .try_fold(0_u64, |sum, number| sum.checked_add(*number))
            });
            part.plan().quantities() == quantities
                && ranges.last().is_none_or(|last| last.end <= self.of_each)
                && counted == Some(done)
        };
        let all = total.is_some() && parts.len() as u64 == self.groups && parts.iter().all(fits);
        if all {
            Ok(())
        } else {
            Err("the parts of these samples do not fit together")
        }
    }
}
