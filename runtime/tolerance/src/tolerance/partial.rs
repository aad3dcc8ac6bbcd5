//! Part of the samples of a run, to be merged with others.

use eigentol_statistics::summary::Partial;

use super::result::MonteCarlo;
use super::run::{Format, Run};
use super::solver::{LEFT_NOMINAL_BRANCH, Numbered};
use super::{Sample, Statistics};
use crate::Error;
use crate::modes::Family;

/// The fingerprint facts that identify the random numbers.
pub(super) const SEED: &str = "seed";
pub(super) const STREAM: &str = "stream";
/// The one that tells how many variables have a tolerance.
pub(super) const VARIABLES: &str = "variables with a tolerance";

/// Part of the samples of a Monte Carlo run. Parts of a run merge to the same bits as the whole, however it was split.
///
/// With the feature `serde` it can be written and read back, by the same version of the format only. In JSON, numbers
/// keep their last digit only if the reader preserves it, as `serde_json` does with its feature `float_roundtrip`.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(remote = "Self", expecting = "a part of a Monte Carlo run"))]
#[non_exhaustive]
pub struct PartialMonteCarlo {
    pub(super) format: Format,
    pub(super) run: Run,
    pub(super) kept: Option<Vec<Numbered>>,
    pub(super) side_by_side: bool,
    pub(super) clustered: bool,
    pub(super) family: Family,
}

impl PartialMonteCarlo {
    /// Adds other samples of the same run.
    ///
    /// # Errors
    /// [`Error::OtherRun`] for samples of another run, [`Error::SamplesOverlap`] for samples that were already added;
    /// in either case nothing is added.
    pub fn merge(&mut self, other: Self) -> Result<(), Error> {
        self.run.merge(other.run)?;
        self.kept = match (self.kept.take(), other.kept) {
            (Some(mut kept), Some(other)) => {
                kept.extend(other);
                kept.sort_by_key(|(number, _)| *number);
                Some(kept)
            }
            _ => None,
        };
        Ok(())
    }

    crate::of_run!();

    /// Statistics of the samples done so far.
    #[must_use]
    pub fn result(&self) -> MonteCarlo {
        self.clone().into_result()
    }

    /// Takes out the kept samples, each with its number in the run, counted from 0; none if samples were not kept.
    ///
    /// The statistics stay, and later merges keep no samples: a run of any length needs only the memory of one part.
    pub fn take_samples(&mut self) -> Vec<(u64, Sample)> {
        self.kept.take().unwrap_or_default()
    }

    /// Seed and stream; `None` if the fingerprint of a file lacks them.
    fn sequence(&self) -> Option<(u64, u64)> {
        let number = |name| self.run.fingerprint.number(name);
        Some((number(SEED)?, number(STREAM)?))
    }

    pub(super) fn into_result(mut self) -> MonteCarlo {
        let (seed, stream) = self.sequence().unwrap_or_default();
        let varies = self.run.fingerprint.number(VARIABLES) != Some(0);
        let ranges = self.ranges();
        let planned = self.run.total() as usize;
        let counts = self.run.counts();
        let part = self.run.parts.pop();
        let left_nominal_branch = part.as_ref().map_or(&[][..], Partial::outcomes).get(LEFT_NOMINAL_BRANCH).copied();
        let mut modes = part.map_or_else(Vec::new, Partial::into_statistics);
        let damping_ratios = match self.family {
            Family::General => modes.split_off(modes.len() / 2),
            Family::Undamped => (modes.iter().flatten()).map(|mode| Statistics::of_equal(0.0, mode.count)).collect(),
        };
        MonteCarlo {
            samples: counts.total(),
            planned,
            seed,
            stream,
            ranges,
            counts,
            left_nominal_branch: left_nominal_branch.unwrap_or(0) as usize,
            modes,
            damping_ratios,
            side_by_side: self.side_by_side,
            varies,
            clustered: self.clustered,
            all: (self.kept).map(|kept| kept.into_iter().map(|(_, sample)| sample).collect()),
            family: self.family,
            inputs: self.run.inputs,
            description: self.run.description,
        }
    }
}

#[cfg(feature = "serde")]
eigentol_statistics::checked!(PartialMonteCarlo);

#[cfg(feature = "serde")]
impl PartialMonteCarlo {
    fn checked(self) -> Result<Self, &'static str> {
        let quantities = (self.run.parts.first()).map_or(0, |part| part.plan().quantities());
        self.run.check(quantities, LEFT_NOMINAL_BRANCH)?;
        let of_each_mode = match self.family {
            Family::Undamped => 1,
            Family::General => 2,
        };
        let numbers = self.kept.iter().flatten().map(|(number, _)| *number);
        let covered = self.ranges().into_iter().flatten();
        let kept = self.kept.is_none() || numbers.eq(covered);
        let one = self.run.parts.len() == 1;
        let drawn = self.sequence().is_some();
        if quantities.is_multiple_of(of_each_mode) && kept && one && drawn {
            Ok(self)
        } else {
            Err("the parts of these samples do not fit together")
        }
    }
}
