//! Monte Carlo: every sample solves its own equilibrium and eigenproblem, and every failure is counted.

use super::gather::{Part, SampleRun};
use super::partial::{SEED, STREAM, VARIABLES};
use super::run::{Format, Run};
use super::solver::{Numbered, SampleSolver, SampleWorkspace};
use super::{Fingerprint, MonteCarlo, PartialMonteCarlo, Sampling, Tolerances};
use crate::kernels::BatchKernels;
use crate::modes::{CLUSTER_GAP, clusters};
use crate::{Equilibrium, Error, Modes};

/// Chunks of samples that justify a thread of their own: side by side, a chunk takes about ten microseconds.
const CHUNKS_SIDE_BY_SIDE: u64 = 4;

/// Samples the design variables about those of `nominal` (according to `tolerances`) and gathers statistics of the
/// frequencies.
///
/// Each sample is re-solved from the nominal equilibrium, and its modes are matched to the nominal modes by shape.
/// Samples settle on a stable equilibrium; about an unstable one they stay at the equilibrium next to it, and statistics
/// are those of the samples that are unstable in the same way.
///
/// # Errors
/// [`Error::WrongLength`] for tolerances of another mechanism, [`Error::Setting`] for a range that is not one of the
/// samples or for points that are not random, [`Error::Threads`] if worker threads cannot be started. Samples that fail
/// are counted and are not errors.
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
    Ok(run_samples(mechanism, about, tolerances, sampling, fingerprint)?.into_result())
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
    run_samples(mechanism, (nominal, modes), tolerances, sampling, fingerprint)
}

/// Adds how samples are drawn to the fingerprint of what they are drawn about.
fn drawn(about: Fingerprint, method: &str, tolerances: &Tolerances, sampling: &Sampling<'_>) -> Fingerprint {
    let varied = tolerances.sigmas().iter().filter(|sigma| **sigma > 0.0);
    about
        .with("method", method)
        .with(VARIABLES, varied.count())
        .with("samples", sampling.samples)
        .with(SEED, sampling.seed)
        .with(STREAM, sampling.stream)
        .with("samples kept", sampling.keep_samples)
}

fn run_samples(
    mechanism: &dyn BatchKernels,
    (nominal, modes): (&Equilibrium, &Modes),
    tolerances: &Tolerances,
    sampling: &Sampling<'_>,
    fingerprint: impl FnOnce(&str) -> Fingerprint,
) -> Result<PartialMonteCarlo, Error> {
    tolerances.check_count(nominal.design.len())?;
    sampling.check_random()?;
    let range = sampling.now()?;
    let solver = SampleSolver::new(
        mechanism,
        (nominal, modes),
        tolerances,
        sampling.vectors,
        (sampling.seed, sampling.stream),
        sampling.keep_samples,
    );
    let side_by_side = solver.side_by_side();
    let work = SampleRun {
        threads: sampling.threads,
        size: (nominal.coordinates.len(), nominal.design.len()),
        least: if side_by_side { CHUNKS_SIDE_BY_SIDE } else { 1 },
        progress: sampling.progress,
        stop: sampling.stop,
    };
    let plan = solver.plan()?;
    let solve = |room: &mut SampleWorkspace, part: &mut Part<'_, Numbered>| solver.solve(room, part);
    let (parts, kept) = work.gather(&plan, &[range], || solver.room(), solve)?;
    let method = if side_by_side { "Monte Carlo side by side" } else { "Monte Carlo one by one" };
    Ok(PartialMonteCarlo {
        format: Format,
        run: Run {
            fingerprint: fingerprint(method),
            of_each: sampling.samples as u64,
            parts,
            inputs: nominal.inputs.clone(),
            description: nominal.description.clone(),
        },
        kept: sampling.keep_samples.then_some(kept),
        side_by_side,
        clustered: clusters(modes, CLUSTER_GAP).contains(&true),
        family: modes.family,
    })
}
