//! A run of samples of which any range can be taken by itself: what belongs to it, what is missing.

use core::ops::Range;

use eigentol_statistics::summary::Partial;

use super::Fingerprint;
use crate::Error;

/// Version of the layout in which partial results are written. Another one is refused when it is read.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(into = "u32", try_from = "u32")
)]
pub(crate) struct Format;

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

/// What is asked of a run, and how its samples are numbered: those of one randomisation after the other.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Run {
    pub(crate) fingerprint: Fingerprint,
    /// How many randomisations there are.
    pub(crate) groups: u64,
    /// Samples of each.
    pub(crate) of_each: u64,
}

impl Run {
    /// Number of samples when all are done.
    pub(crate) fn total(&self) -> u64 {
        self.of_each * self.groups
    }

    /// The ranges of samples that are done, in order and apart; `parts` are those of each randomisation.
    pub(crate) fn ranges(&self, parts: &[Partial]) -> Vec<Range<u64>> {
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

    /// The ranges of samples that are not done, in order and apart.
    pub(crate) fn missing(&self, parts: &[Partial]) -> Vec<Range<u64>> {
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

    /// Refuses a run of which samples are missing.
    pub(crate) fn check_complete(&self, parts: &[Partial]) -> Result<(), Error> {
        let missing = self.missing(parts);
        if missing.is_empty() {
            return Ok(());
        }
        Err(Error::SamplesMissing { missing })
    }

    /// Adds other samples of the same run; nothing where some of them are there already.
    pub(crate) fn merge(
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

    /// Refuses what cannot be samples of this run: `outcomes` counts each of them once among the first.
    #[cfg(feature = "serde")]
    pub(crate) fn check_parts(
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
