//! Monte Carlo: every sample solves its own equilibrium and eigenproblem, and every failure is counted.

use core::ops::Range;
use std::sync::atomic::AtomicBool;

use eigentol_statistics::summary::Partial;

use super::gather::{Part, Work};
use super::partial::{SEED, STREAM, VARIABLES};
use super::run::{Format, Run};
use super::solver::{Numbered, Room, Solver};
use super::{Fingerprint, MonteCarlo, PartialMonteCarlo, Tolerances};
use crate::kernels::BatchKernels;
use crate::modes::{CLUSTER_GAP, clusters};
use crate::scalar::Instructions;
use crate::setters;
use crate::{Equilibrium, Error, Modes, Watch};

/// Chunks of samples that justify a thread of their own: side by side, a chunk takes about ten microseconds.
const CHUNKS_SIDE_BY_SIDE: u64 = 4;

/// How to sample.
#[derive(Clone)]
#[non_exhaustive]
pub struct Sampling<'a> {
    /// Number of samples.
    pub samples: usize,
    /// Seed of the random numbers; the same seed gives the same samples and bit-identical results for any number of
    /// threads.
    pub seed: u64,
    /// Which of the seed's independent sequences to use; points of a sweep that must not share samples take one each.
    pub stream: u64,
    /// Number of threads; 0 takes as many as the machine has. The limit is 256, or the number the machine has if that
    /// is larger. Threads, once started, wait for the next run.
    pub threads: usize,
    /// Returns every sample, not only the statistics.
    pub keep_samples: bool,
    /// Vector instructions that solve several samples side by side where the mechanism allows it: at most sixteen
    /// unknowns, no constraints on velocities. `None` solves the samples one by one.
    ///
    /// Samples that do not clearly continue the nominal state are solved alone. The statistics are those of the samples
    /// solved one by one, up to rounding, and do not depend on the instructions. [`MonteCarlo::side_by_side`] reports
    /// which way was used.
    pub vectors: Option<Instructions>,
    /// Which of the samples to process now; all by default. Results of other ranges are added by
    /// [`PartialMonteCarlo::merge`].
    pub range: Option<Range<u64>>,
    /// Called with the number of samples done since the last call, from any thread.
    pub progress: Option<&'a (dyn Fn(usize) + Sync)>,
    /// Stops the run soon after it becomes true, with the samples done so far.
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

    /// The progress callback and the stop flag.
    #[doc(hidden)]
    pub fn watch(&self) -> Watch<'a> {
        Watch::default().progress(self.progress).stop(self.stop)
    }

    /// The samples to process now.
    #[doc(hidden)]
    pub fn now(&self) -> Result<Range<u64>, Error> {
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

/// Samples the design variables about those of `nominal` (according to `tolerances`) and gathers statistics of the
/// frequencies.
///
/// Each sample is re-solved from the nominal equilibrium, and its modes are matched to the nominal modes by shape.
/// Samples settle on a stable equilibrium; about an unstable one they stay at the equilibrium next to it, and statistics
/// are those of the samples that are unstable in the same way.
///
/// # Errors
/// [`Error::WrongLength`] for tolerances of another mechanism, [`Error::Setting`] for a range that is not one of the
/// samples, [`Error::Threads`] if worker threads cannot be started. Samples that fail are counted and are not errors.
pub fn monte_carlo(
    mechanism: &dyn BatchKernels,
    nominal: &Equilibrium,
    modes: &Modes,
    tolerances: &Tolerances,
    sampling: &Sampling<'_>,
) -> Result<MonteCarlo, Error> {
    let about = (nominal, modes);
    // Nothing will be merged with this run, so its fingerprint may stay empty.
    let fingerprint = |method: &str| drawn(Fingerprint::default(), method, tolerances, sampling);
    let all = gathered(mechanism, about, tolerances, sampling, fingerprint)?;
    Ok(all.into_result())
}

/// Like [`monte_carlo`], for one range of a run, to be merged with the others.
///
/// # Errors
/// Those of [`monte_carlo`].
pub fn partial_monte_carlo(
    mechanism: &dyn BatchKernels,
    nominal: &Equilibrium,
    modes: &Modes,
    tolerances: &Tolerances,
    sampling: &Sampling<'_>,
) -> Result<PartialMonteCarlo, Error> {
    let fingerprint = |method: &str| {
        let about = Fingerprint::new(mechanism, nominal, modes, tolerances);
        drawn(about, method, tolerances, sampling)
    };
    gathered(
        mechanism,
        (nominal, modes),
        tolerances,
        sampling,
        fingerprint,
    )
}

/// Adds how samples are drawn to the fingerprint of what they are drawn about.
fn drawn(
    about: Fingerprint,
    method: &str,
    tolerances: &Tolerances,
    sampling: &Sampling<'_>,
) -> Fingerprint {
    let varied = tolerances.sigmas().iter().filter(|sigma| **sigma > 0.0);
    about
        .with("method", method)
        .with(VARIABLES, varied.count())
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
