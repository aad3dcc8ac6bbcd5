//! Monte Carlo: every sample solves its own equilibrium and its own eigenproblem, and every failure is counted.

use core::ops::Range;
use std::sync::atomic::AtomicBool;

use eigentol_statistics::summary::Partial;

use super::gather::{Part, Work};
use super::run::Run;
use super::solver::{LEFT_NOMINAL_BRANCH, Numbered, Room, Solver};
use super::{Counts, Fingerprint, Sample, Statistics, Tolerances};
use crate::algebra::Vector;
use crate::kernels::BatchKernels;
use crate::modes::{CLUSTER_GAP, Family, clusters};
use crate::scalar::Instructions;
use crate::setters::setters;
use crate::{Description, Equilibrium, Error, Modes, Shared};

/// Chunks of samples that are worth a thread of their own: side by side they take some ten microseconds each.
const CHUNKS_SIDE_BY_SIDE: u64 = 4;

/// How to sample.
#[derive(Clone)]
#[non_exhaustive]
pub struct Sampling<'a> {
    /// Number of samples.
    pub samples: usize,
    /// The same seed gives the same samples and bit-identical results for any number of threads.
    pub seed: u64,
    /// Which of the seed's independent sequences: points of a sweep that must not share samples take one each.
    pub stream: u64,
    /// Number of threads; 0 takes as many as the machine has. The limit is 256, or as many as the machine has if that is more.
    /// Started threads wait for the next run.
    pub threads: usize,
    /// Return every sample, not only the statistics.
    pub keep_samples: bool,
    /// Solve several samples side by side with these vector instructions where the mechanism allows it: generated code, no
    /// constraints, undamped modes, at most eight coordinates. Statistics are those of the samples one by one up to
    /// rounding, and do not depend on which instructions are taken; `None` takes the samples one by one. The result says
    /// which it was ([`MonteCarlo::side_by_side`]).
    pub vectors: Option<Instructions>,
    /// Which of the samples to take now; all unless set. Results of other ranges are added by [`PartialMonteCarlo::merge`].
    pub range: Option<Range<u64>>,
    /// Called with the number of samples done since the last call, from any thread.
    pub progress: Option<&'a (dyn Fn(usize) + Sync)>,
    /// Ends the run soon after it becomes true, with the samples that are done.
    pub stop: Option<&'a AtomicBool>,
}

impl<'a> Sampling<'a> {
    setters!(
        samples: usize,
        seed: u64,
        stream: u64,
        threads: usize,
        keep_samples: bool,
        vectors: Option<Instructions>,
        range: Option<Range<u64>>,
        progress: Option<&'a (dyn Fn(usize) + Sync)>,
        stop: Option<&'a AtomicBool>,
    );

    /// The samples to take now.
    fn now(&self) -> Result<Range<u64>, Error> {
        let total = self.samples as u64;
        let range = self.range.clone().unwrap_or(0..total);
        if range.start > range.end || range.end > total {
            return Err(Error::Setting {
                setting: "range",
                reason: format!("{range:?} is not a range of the {total} samples"),
            });
        }
        Ok(range)
    }
}

impl Default for Sampling<'_> {
    fn default() -> Self {
        Self {
            samples: 3000,
            seed: 0,
            stream: 0,
            threads: 0,
            keep_samples: false,
            vectors: Some(Instructions::best()),
            range: None,
            progress: None,
            stop: None,
        }
    }
}

/// Result of a Monte Carlo run, of the samples that are done.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct MonteCarlo {
    /// Number of samples.
    pub samples: usize,
    /// Number of samples that were asked for: more where the run was stopped, or where this is a part of one.
    pub planned: usize,
    /// What became of them.
    pub counts: Counts,
    /// Stable samples for which the nominal position itself is unstable: they settled on another branch.
    pub left_nominal_branch: usize,
    /// Statistics of the frequency over the stable samples where the mode oscillates, rad/s, by nominal mode; `None`
    /// without any value. Quantiles and a histogram are among them ([`Statistics::quantile`], [`Statistics::sketch`]).
    pub modes: Vec<Option<Statistics>>,
    /// Statistics of the damping ratio over the same samples.
    pub damping_ratios: Vec<Option<Statistics>>,
    /// Samples were solved side by side in vectors ([`Sampling::vectors`]), except those that had to be solved alone. Solved one by
    /// one, the statistics differ in the last bits.
    pub side_by_side: bool,
    /// Some nominal modes have equal eigenvalues. Which of them a sample's mode is matched to is arbitrary, and only
    /// statistics of all of them together mean something ([`clusters`](crate::clusters::clusters)).
    pub clustered: bool,
    /// Every sample in order, when asked for.
    pub all: Option<Vec<Sample>>,
    /// Which modes they belong to.
    pub family: Family,
    /// The inputs they belong to, SI.
    pub inputs: Vector,
    /// The mechanism they belong to.
    pub description: Shared<Description>,
}

/// Some samples of a Monte Carlo run. Parts of a run merge to the same bits as the whole, however it was split.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct PartialMonteCarlo {
    run: Run,
    part: Partial,
    kept: Option<Vec<Numbered>>,
    side_by_side: bool,
    clustered: bool,
    family: Family,
    inputs: Vector,
    description: Shared<Description>,
}

/// Samples the design variables about those of `nominal` (by `tolerances`), re-solves each sample from the
/// nominal equilibrium and gathers the statistics of its frequencies, matched to the nominal modes by shape. Samples
/// settle on a stable equilibrium, whatever policy found the nominal one.
///
/// # Errors
/// [`Error::WrongLength`] for tolerances of another mechanism, [`Error::Setting`] for a range that is none of the samples,
/// [`Error::Threads`] when worker threads cannot be started. Samples that fail are counted, not errors.
pub fn monte_carlo(
    mechanism: &dyn BatchKernels,
    nominal: &Equilibrium,
    modes: &Modes,
    tolerances: &Tolerances,
    sampling: &Sampling<'_>,
) -> Result<MonteCarlo, Error> {
    let all = partial_monte_carlo(mechanism, nominal, modes, tolerances, sampling)?;
    Ok(all.into_result())
}

/// As [`monte_carlo`], to be merged with other ranges of the same run.
///
/// # Errors
/// As [`monte_carlo`].
pub fn partial_monte_carlo(
    mechanism: &dyn BatchKernels,
    nominal: &Equilibrium,
    modes: &Modes,
    tolerances: &Tolerances,
    sampling: &Sampling<'_>,
) -> Result<PartialMonteCarlo, Error> {
    tolerances.check_count(nominal.design.len())?;
    let range = sampling.now()?;
    let solver = Solver::new(
        mechanism,
        (nominal, modes),
        tolerances,
        sampling.vectors,
        (sampling.seed, sampling.stream),
        sampling.keep_samples,
    );
    let side_by_side = solver.side_by_side();
    let work = Work {
        threads: sampling.threads,
        size: (nominal.coordinates.len(), nominal.design.len()),
        least: if side_by_side { CHUNKS_SIDE_BY_SIDE } else { 1 },
        progress: sampling.progress,
        stop: sampling.stop,
    };
    let plan = solver.plan()?;
    let solve = |room: &mut Room, part: &mut Part<'_, Numbered>| solver.solve(room, part);
    let (mut parts, kept) = work.gather(&plan, &[range], || solver.room(), solve)?;
    let method = if side_by_side {
        "Monte Carlo side by side"
    } else {
        "Monte Carlo one by one"
    };
    let fingerprint = Fingerprint::new(mechanism, nominal, modes, tolerances)
        .with("method", method)
        .with("samples", sampling.samples)
        .with("seed", sampling.seed)
        .with("stream", sampling.stream)
        .with("samples kept", sampling.keep_samples);
    Ok(PartialMonteCarlo {
        run: Run {
            fingerprint,
            groups: 1,
            of_each: sampling.samples as u64,
        },
        part: parts.pop().unwrap_or_else(|| Partial::new(plan)),
        kept: sampling.keep_samples.then_some(kept),
        side_by_side,
        clustered: clusters(modes, CLUSTER_GAP).contains(&true),
        family: modes.family,
        inputs: nominal.inputs.clone(),
        description: nominal.description.clone(),
    })
}

impl PartialMonteCarlo {
    /// Adds other samples of the same run.
    ///
    /// # Errors
    /// [`Error::OtherRun`] for samples of another run, [`Error::SamplesOverlap`] for those that have been added already; nothing has
    /// been added then.
    pub fn merge(&mut self, other: Self) -> Result<(), Error> {
        let own = core::slice::from_mut(&mut self.part);
        self.run.merge(own, (&other.run, vec![other.part]))?;
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

    /// The ranges of samples that are done, in order and apart.
    #[must_use]
    pub fn ranges(&self) -> Vec<Range<u64>> {
        self.run.ranges(self.parts())
    }

    /// The ranges of samples that are not done, in order and apart.
    #[must_use]
    pub fn missing(&self) -> Vec<Range<u64>> {
        self.run.missing(self.parts())
    }

    /// Refuses a run that is not complete.
    ///
    /// # Errors
    /// [`Error::SamplesMissing`], which names the gaps.
    pub fn check_complete(&self) -> Result<(), Error> {
        self.run.check_complete(self.parts())
    }

    /// What the run was asked for: equal for parts that can be merged.
    #[must_use]
    pub fn fingerprint(&self) -> &Fingerprint {
        &self.run.fingerprint
    }

    /// Statistics of the samples that are done.
    #[must_use]
    pub fn result(&self) -> MonteCarlo {
        self.clone().into_result()
    }

    fn parts(&self) -> &[Partial] {
        core::slice::from_ref(&self.part)
    }

    pub(crate) fn into_result(self) -> MonteCarlo {
        let outcomes = self.part.outcomes();
        let counts = Counts::of_all(outcomes);
        let left_nominal_branch = outcomes.get(LEFT_NOMINAL_BRANCH).copied();
        let mut modes = self.part.into_statistics();
        let damping_ratios = match self.family {
            Family::General => modes.split_off(modes.len() / 2),
            Family::Undamped => (modes.iter().flatten())
                .map(|mode| Statistics::of_equal(0.0, mode.count))
                .collect(),
        };
        MonteCarlo {
            samples: counts.total(),
            planned: self.run.total() as usize,
            counts,
            left_nominal_branch: left_nominal_branch.unwrap_or(0) as usize,
            modes,
            damping_ratios,
            side_by_side: self.side_by_side,
            clustered: self.clustered,
            all: (self.kept).map(|kept| kept.into_iter().map(|(_, sample)| sample).collect()),
            family: self.family,
            inputs: self.inputs,
            description: self.description,
        }
    }
}
