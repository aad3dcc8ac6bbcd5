//! First order, second order and clusters side by side, and for every mode whether its standard deviation can be
//! trusted: checked against samples where these are cheap.
//!
//! # How a verdict is reached
//!
//! A number of samples, always the same ones, are solved anew, each on its own stable equilibrium, and first and second
//! order predict each of them. The ratio of the standard deviations over the same samples is known much more accurately
//! than either of them. More samples are drawn until the error of first order is clearly below 3 %, clearly above it,
//! or known to 0.4 %. The number of operations is limited ([`BUDGET`]), not the time, so that the answer is the same on
//! every machine. Cases that samples cannot decide within the budget are judged by distances to the critical state and
//! by the second-order model. These are less reliable: a distance does not tell how large the error is, and near a
//! critical state the Taylor series does not converge.
//!
//! # The meaning of a frequency across critical states
//!
//! Standard deviations of samples are taken over all stable samples together, on whatever branch of equilibria each of
//! them has settled. A mode that does not oscillate in a sample has no frequency there, and an unstable sample has none
//! at all. Both are counted ([`Check::count`], [`Sampled`]) and excluded from mean and standard deviation.

mod answer;
mod blades;
mod chances;
mod judge;
mod paired;
mod sampled;
mod sentences;
mod verdict;

pub use crate::judge::{BUDGET, Doubt, Measured, TRUSTED_SIGMA_ERROR};
pub use chances::{Chance, Sampled, Sampling};
pub use sentences::{News, Sentence};
pub use verdict::{Advice, Check, Trust};

use self::judge::{Judge, expanded_near_a_root};
use self::sampled::{About, Prediction};
use crate::algebra::Vector;
use crate::clusters::{ClusterTolerance, clusters};
use crate::kernels::SummaryKernels;
use crate::second_order::{SecondOrder, second_order_watched};
use crate::sensitivity::sensitivities;
use crate::tolerance::{FirstOrder, Tolerances, first_order};
use crate::{Description, Equilibrium, Error, Modes, Shared, Watch};

/// The effect of tolerances on the modes, with a verdict for each mode.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Summary {
    /// First-order spread.
    pub first: FirstOrder,
    /// Second-order spread.
    pub second: SecondOrder,
    /// The modes that tolerances may mix, according to their distances.
    pub clusters: Vec<ClusterTolerance>,
    /// For each mode, whether its standard deviation can be trusted.
    pub trust: Vec<Trust>,
    /// Whether samples were drawn, and what they showed.
    pub sampling: Sampling,
    /// The inputs of the operating point, SI.
    pub inputs: Vector,
    /// The mechanism it belongs to.
    pub description: Shared<Description>,
}

impl Summary {
    /// Whether every mode is trusted.
    pub fn trusted(&self) -> bool {
        self.trust.iter().all(Trust::trusted)
    }

    /// The cluster of a mode; `None` if the mode has none or samples showed that its modes do not mix.
    #[must_use]
    pub fn cluster_of(&self, mode: usize) -> Option<&ClusterTolerance> {
        let mut all = self.clusters.iter();
        let cluster = all.find(|cluster| cluster.modes.contains(&mode))?;
        (self.trust.get(mode)?.doubts.iter().any(Doubt::shared)).then_some(cluster)
    }

    /// The second-order standard deviation of a frequency, rad/s; `None` if there is none, or if it is meaningless
    /// because the series does not converge.
    pub(crate) fn second_order_sigma(&self, mode: usize) -> Option<f64> {
        let second = self.second.modes.get(mode)?.as_ref().ok()?;
        let trust = self.trust.get(mode)?;
        let converges = !expanded_near_a_root(&trust.doubts) || trust.advice == Advice::SecondOrder;
        converges.then_some(second.frequency.moments.sigma)
    }

    /// The results of the samples; `None` if none were drawn.
    #[must_use]
    pub fn sampled(&self) -> Option<&Sampled> {
        match &self.sampling {
            Sampling::Done(sampled) => Some(sampled),
            _ => None,
        }
    }
}

/// First order, second order, clusters and a verdict for each mode, checked by samples within [`BUDGET`].
///
/// # Errors
/// [`Error::CriticalState`] if `Khat` is singular, [`Error::OutsideDomain`] if a derivative is not finite,
/// [`Error::WrongLength`] for tolerances of another mechanism, [`Error::Threads`] if worker threads cannot be started.
pub fn summary(
    mechanism: &dyn SummaryKernels,
    at: &Equilibrium,
    modes: &Modes,
    tolerances: &Tolerances,
) -> Result<Summary, Error> {
    summary_within(mechanism, at, modes, tolerances, BUDGET)
}

/// Like [`summary`], with a custom budget for samples: a larger one decides closer cases; with zero, only distances and
/// the second-order model remain.
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

/// Like [`summary_within`], but `watch` follows the work and can stop it.
///
/// # Errors
/// As [`summary`]; [`Error::Stopped`] if the work is stopped, because half a verdict is worthless.
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
    let judge = Judge { first: &summary.first, second: &summary.second, clusters: &summary.clusters };
    let numbered = || modes.modes.iter().enumerate();
    let predictions: Vec<Prediction<'_>> = numbered().flat_map(|(mode, x)| judge.predictions(mode, x)).collect();
    let about = About { mechanism, at, modes, tolerances, watch };
    let groups: Vec<&[usize]> = (summary.clusters.iter()).map(|cluster| &cluster.modes[..]).collect();
    let sampled = about.sample(&predictions, &groups, budget)?;
    let mut trust: Vec<Trust> = numbered().map(|(mode, x)| judge.verdict(mode, x, &predictions, &sampled)).collect();
    for (trust, modes) in trust.iter_mut().zip(blades::mixed(mechanism, at, modes, &slopes, tolerances)) {
        if !modes.is_empty() {
            trust.doubts.retain(|doubt| !matches!(doubt, Doubt::EqualInEveryDesign { .. }));
            trust.doubts.push(Doubt::Blades { modes });
        }
    }
    (summary.trust, summary.sampling) = (trust, sampled.sampling);
    Ok(summary)
}
