//! The result of a Monte Carlo run.

use core::ops::Range;

use super::{Counts, Sample, Statistics};
use crate::algebra::Vector;
use crate::modes::Family;
use crate::{Description, Shared};

/// Result of a Monte Carlo run, over the samples that are done.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct MonteCarlo {
    /// Number of samples.
    pub samples: usize,
    /// Number of samples requested: more than `samples` if the run was stopped, or if this is only part of it.
    pub planned: usize,
    /// Seed of the random numbers; together with stream and ranges it reproduces the samples.
    pub seed: u64,
    /// Which of the seed's independent sequences was used.
    pub stream: u64,
    /// The numbers of the samples, sorted and disjoint; one range from 0 if none is missing.
    pub ranges: Vec<Range<u64>>,
    /// Number of samples with each outcome.
    pub counts: Counts,
    /// Samples as stable as the nominal equilibrium that lie on another branch: beyond a branch point, or in another
    /// valley.
    pub left_nominal_branch: usize,
    /// Statistics of the frequency, rad/s, by nominal mode, over the stable samples in which the mode oscillates;
    /// `None` if there are none. They include quantiles and a histogram ([`Statistics::quantile`],
    /// [`Statistics::sketch`]).
    pub modes: Vec<Option<Statistics>>,
    /// Statistics of the damping ratio over the same samples.
    pub damping_ratios: Vec<Option<Statistics>>,
    /// Samples were solved side by side in vectors ([`Sampling::vectors`](super::Sampling::vectors)), except those that
    /// had to be solved alone. If solved one by one, the statistics differ in the last bits.
    pub side_by_side: bool,
    /// Some nominal modes have equal eigenvalues. They have no identity but their order: in every sample, the modes that
    /// continue them count in ascending order of their natural frequencies.
    pub clustered: bool,
    /// Whether any variable has a tolerance.
    pub varies: bool,
    /// Every sample, in order, if requested.
    pub all: Option<Vec<Sample>>,
    /// The family of the modes.
    pub family: Family,
    /// The inputs they belong to, SI.
    pub inputs: Vector,
    /// The mechanism they belong to.
    pub description: Shared<Description>,
}
