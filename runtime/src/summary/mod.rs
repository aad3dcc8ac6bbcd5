//! First order, second order and clusters side by side, and for every mode whether its standard deviation can be
//! trusted: measured against samples where these are cheap.
//!
//! # How a verdict is found
//!
//! Some samples, always the same ones, are solved anew, each on its own stable equilibrium, and first and second order predict
//! each of them. The ratio of the standard deviations over the same samples is known much better than either, and more are
//! drawn until the error of first order is clearly below 3 %, clearly above, or known to 0.4 %. The number of operations
//! is limited ([`BUDGET`]), not the time, so that the answer is the same on every machine. What samples cannot decide within it is
//! judged by distances to the critical state and by the second-order model, which errs: a distance does not tell how large the error
//! is, and near a critical state the Taylor series does not converge.
//!
//! # What a frequency is across critical states
//!
//! Standard deviations of samples are those over all stable samples together, on whatever branch of equilibria each of them has settled.
//! A mode that does not oscillate in a sample has no frequency there, and an unstable sample has none at all. Both are counted
//! ([`Check::count`], [`Sampled`]) and left out of mean and standard deviation.

mod branch;
mod chances;
mod cost;
mod judge;
mod paired;
mod sampled;
mod verdict;

pub use chances::{Chance, Sampled, Sampling};
pub use paired::Measured;
pub use verdict::{Advice, Check, Doubt, TRUSTED_SIGMA_ERROR, Trust};

use self::judge::{Judge, expanded_near_a_root};
use self::sampled::{About, Prediction};
use crate::algebra::Vector;
use crate::clusters::{ClusterTolerance, clusters};
use crate::kernels::SummaryKernels;
use crate::second_order::{SecondOrder, second_order_watched};
use crate::sensitivity::sensitivities;
use crate::tolerance::{FirstOrder, Tolerances, first_order};
use crate::{Description, Equilibrium, Error, Modes, Shared, Watch};

/// Additions and multiplications that the samples of a [`summary`] may cost: some ten milliseconds.
pub const BUDGET: f64 = 1.5e8;

/// What tolerances do to the modes, with a verdict for each.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Summary {
    /// First-order spread.
    pub first: FirstOrder,
    /// Spread to second order.
    pub second: SecondOrder,
    /// The modes that tolerances may bring together, by their distances.
    pub clusters: Vec<ClusterTolerance>,
    /// For each mode whether its standard deviation can be trusted.
    pub trust: Vec<Trust>,
    /// What became of the samples.
    pub sampling: Sampling,
    /// The inputs it belongs to, SI.
    pub inputs: Vector,
    /// The mechanism it belongs to.
    pub description: Shared<Description>,
}

impl Summary {
    /// Whether every mode is trusted.
    pub fn trusted(&self) -> bool {
        self.trust.iter().all(Trust::trusted)
    }

    /// The cluster that a mode belongs to; `None` where samples found that its modes do not mix.
    #[must_use]
    pub fn cluster_of(&self, mode: usize) -> Option<&ClusterTolerance> {
        let mut all = self.clusters.iter();
        let own = all.find(|cluster| cluster.modes.contains(&mode))?;
        let mixed = |doubt: &Doubt| matches!(doubt, Doubt::Clustered { .. });
        (self.trust.get(mode)?.doubts.iter().any(mixed)).then_some(own)
    }

    /// The standard deviation of a frequency to second order, rad/s; `None` where there is none, or where it means nothing
    /// because the series does not converge.
    pub(crate) fn second_order_sigma(&self, mode: usize) -> Option<f64> {
        let second = self.second.modes[mode].as_ref().ok()?;
        let trust = &self.trust[mode];
        let converges = !expanded_near_a_root(&trust.doubts) || trust.advice == Advice::SecondOrder;
        converges.then_some(second.frequency.moments.sigma)
    }

    /// What became of the samples; `None` where there are none.
    #[must_use]
    pub fn sampled(&self) -> Option<&Sampled> {
        match &self.sampling {
            Sampling::Done(sampled) => Some(sampled),
            _ => None,
        }
    }
}

/// First order, second order, clusters and a verdict for each mode, by samples within [`BUDGET`].
///
/// # Errors
/// [`Error::CriticalState`] when `Khat` is singular, [`Error::OutsideDomain`] when a derivative is not finite,
/// [`Error::WrongLength`] for tolerances of another mechanism, [`Error::Threads`] when worker threads cannot be started.
pub fn summary(
    mechanism: &dyn SummaryKernels,
    at: &Equilibrium,
    modes: &Modes,
    tolerances: &Tolerances,
) -> Result<Summary, Error> {
    summary_within(mechanism, at, modes, tolerances, BUDGET)
}

/// Like [`summary`], with samples that may cost so many operations: more decide closer cases, none leave the distances.
///
/// # Errors
/// As [`summary`].
pub fn summary_within(
    mechanism: &dyn SummaryKernels,
    at: &Equilibrium,
    modes: &Modes,
    tolerances: &Tolerances,
    budget: f64,
) -> Result<Summary, Error> {
    summary_watched(mechanism, (at, modes), tolerances, budget, Watch::default())
}

/// Like [`summary_within`], for somebody who waits.
///
/// # Errors
/// As [`summary`]; [`Error::Stopped`] if the work is stopped: half a verdict is none.
pub fn summary_watched(
    mechanism: &dyn SummaryKernels,
    (at, modes): (&Equilibrium, &Modes),
    tolerances: &Tolerances,
    budget: f64,
    watch: Watch<'_>,
) -> Result<Summary, Error> {
    let slopes = sensitivities(mechanism, at, modes)?;
    let mut summary = Summary {
        first: first_order(modes, &slopes, tolerances)?,
        second: second_order_watched(mechanism, (at, modes), tolerances, watch)?,
        clusters: clusters(mechanism, at, modes, tolerances)?,
        trust: Vec::new(),
        sampling: Sampling::NotNeeded,
        inputs: at.inputs.clone(),
        description: modes.description.clone(),
    };
    let judge = Judge {
        first: &summary.first,
        second: &summary.second,
        clusters: &summary.clusters,
    };
    let own = || modes.modes.iter().enumerate();
    let predictions: Vec<Prediction<'_>> = own()
        .flat_map(|(mode, own)| judge.predictions(mode, own))
        .collect();
    let about = About {
        mechanism,
        at,
        modes,
        tolerances,
        watch,
    };
    let groups: Vec<&[usize]> = (summary.clusters.iter())
        .map(|cluster| &cluster.modes[..])
        .collect();
    let found = about.sample(&predictions, &groups, budget)?;
    let trust = own()
        .map(|(mode, own)| judge.verdict(mode, own, &predictions, &found))
        .collect();
    (summary.trust, summary.sampling) = (trust, found.sampling);
    Ok(summary)
}
