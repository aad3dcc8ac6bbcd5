//! What a Monte Carlo run gives.

use core::ops::Range;

use super::{Counts, Sample, Statistics};
use crate::algebra::Vector;
use crate::modes::Family;
use crate::{Description, Shared};

/// Result of a Monte Carlo run, of the samples that are done.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct MonteCarlo {
    /// Number of samples.
    pub samples: usize,
    /// Number of samples that were asked for: more where the run was stopped, or where this is a part of one.
    pub planned: usize,
    /// Seed of the random numbers: with stream and ranges it gives the same samples again.
    pub seed: u64,
    /// Which of the seed's independent sequences.
    pub stream: u64,
    /// The samples by their numbers, in order and apart; one range from 0 where none is missing.
    pub ranges: Vec<Range<u64>>,
    /// What became of them.
    pub counts: Counts,
    /// Stable samples for which the nominal position itself is unstable: they settled on another branch.
    pub left_nominal_branch: usize,
    /// Statistics of the frequency over the stable samples where the mode oscillates, rad/s, by nominal mode; `None`
    /// without any value. Quantiles and a histogram are among them ([`Statistics::quantile`], [`Statistics::sketch`]).
    pub modes: Vec<Option<Statistics>>,
    /// Statistics of the damping ratio over the same samples.
    pub damping_ratios: Vec<Option<Statistics>>,
    /// Samples were solved side by side in vectors ([`Sampling::vectors`](super::Sampling::vectors)), except those that had to be solved alone. Solved one by
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
