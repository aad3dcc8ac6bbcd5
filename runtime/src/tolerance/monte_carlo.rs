//! Monte Carlo: every sample solves its own equilibrium and its own eigenproblem, and every failure is counted.

use core::ops::Range;
use std::sync::atomic::AtomicBool;

use eigentol_statistics::summary::Partial;

use super::gather::{Part, Work};
use super::partial::{SEED, STREAM};
use super::run::{Format, Run};
use super::solver::{Numbered, Room, Solver};
use super::{Fingerprint, MonteCarlo, PartialMonteCarlo, Tolerances};
use crate::kernels::BatchKernels;
use crate::modes::{CLUSTER_GAP, clusters};
use crate::scalar::Instructions;
use crate::setters::setters;
use crate::{Equilibrium, Error, Modes, Watch};

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
    /// Solve several samples side by side with these vector instructions where the mechanism allows it: at most sixteen unknowns, no
    /// constraints on velocities. Samples that are not clearly what the nominal state has become are solved alone. Statistics are
    /// those of the samples one by one up to rounding, and do not depend on which instructions are taken; `None` takes the
    /// samples one by one. The result says which it was ([`MonteCarlo::side_by_side`]).
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

    /// Who waits for them.
    pub(crate) fn watch(&self) -> Watch<'a> {
        Watch::default().progress(self.progress).stop(self.stop)
    }

    /// The samples to take now.
    pub(crate) fn now(&self) -> Result<Range<u64>, Error> {
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
    let about = (nominal, modes);
    // Nothing will be merged with it: nobody asks what it was drawn about.
    let fingerprint = |method: &str| drawn(Fingerprint::default(), method, sampling);
    let all = gathered(mechanism, about, tolerances, sampling, fingerprint)?;
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
    let fingerprint = |method: &str| {
        let about = Fingerprint::new(mechanism, nominal, modes, tolerances);
        drawn(about, method, sampling)
    };
    gathered(
        mechanism,
        (nominal, modes),
        tolerances,
        sampling,
        fingerprint,
    )
}

/// How samples are drawn, added to what they are drawn about.
fn drawn(about: Fingerprint, method: &str, sampling: &Sampling<'_>) -> Fingerprint {
    about
        .with("method", method)
        .with("samples", sampling.samples)
        .with(SEED, sampling.seed)
        .with(STREAM, sampling.stream)
        .with("samples kept", sampling.keep_samples)
}

fn gathered(
    mechanism: &dyn BatchKernels,
    (nominal, modes): (&Equilibrium, &Modes),
    tolerances: &Tolerances,
    sampling: &Sampling<'_>,
    fingerprint: impl FnOnce(&str) -> Fingerprint,
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
    Ok(PartialMonteCarlo {
        format: Format,
        run: Run {
            fingerprint: fingerprint(method),
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
