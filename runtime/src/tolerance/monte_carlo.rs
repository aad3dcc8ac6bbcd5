//! Monte Carlo: every sample re-solves its own equilibrium and its own eigenproblem, and none is dropped in silence.

use rayon::prelude::*;

use super::batched::{Prepared, Solved, Sums, TOGETHER};
use super::pool;
use super::sampling::{Batches, Draw};
use super::statistics::Moments;
use super::{Statistics, Tolerances};
use crate::equilibrium::{Failure, Problem, settle};
use crate::lanes::{Instructions, WIDTH};
use crate::modes::{Family, PerMode, clusters, match_modes, solve_modes};
use crate::room::stack;
use crate::sensitivity::CLUSTER_GAP;
use crate::{Complex, Description, Equilibrium, Error, Mechanism, Modes, Policy, Stability};

/// Samples worked on by one thread at a time, whole batches; fixed, so that sums are formed in the same order on any machine.
const CHUNK: usize = 256;

/// How to sample.
#[derive(Clone, Copy)]
pub struct Sampling<'a> {
    /// Number of samples.
    pub samples: usize,
    /// The same seed gives the same samples and bit-identical results for any number of threads.
    pub seed: u64,
    /// Which of the independent sequences of the seed: points of a sweep that must not share samples take one each.
    pub stream: u64,
    /// Number of threads; 0 takes what the machine has. More than 256 count as 256, or as what the machine has if that is more.
    /// Threads that were started wait for the next run.
    pub threads: usize,
    /// Return every sample, not only the statistics.
    pub keep_samples: bool,
    /// Solve several samples side by side with these vector instructions where the mechanism allows it: generated code, no
    /// constraints, undamped modes, at most eight coordinates. Statistics are those of the samples one by one up to
    /// rounding, and do not depend on which instructions are taken; `None` takes the samples one by one. The result says
    /// which it was ([`MonteCarlo::side_by_side`]).
    pub vectors: Option<Instructions>,
    /// Called with a number of samples whenever that many more are done, from any thread.
    pub progress: Option<&'a (dyn Fn(usize) + Sync)>,
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
            progress: None,
        }
    }
}

/// What became of one sample.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// It has a stable equilibrium, or one that is marginal, held by gyroscopic forces, or free in some directions.
    Stable,
    /// Its equilibrium is unstable without oscillation.
    Divergent,
    /// Its equilibrium is unstable in a growing oscillation.
    Flutter,
    /// The stability of its equilibrium could not be decided.
    Undecided,
    /// No equilibrium was found.
    NoEquilibrium,
    /// Its constraints cannot be met together: its lengths do not close the loops.
    NotAssembled,
    /// Its design describes bodies that cannot exist, or lies outside the domain of an expression.
    Unphysical,
    /// Its eigenproblem could not be solved.
    NoModes,
}

/// How many samples had each outcome; the numbers sum to the number of samples.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// [`Outcome::Stable`].
    pub stable: usize,
    /// [`Outcome::Divergent`].
    pub divergent: usize,
    /// [`Outcome::Flutter`].
    pub flutter: usize,
    /// [`Outcome::Undecided`].
    pub undecided: usize,
    /// [`Outcome::NoEquilibrium`].
    pub no_equilibrium: usize,
    /// [`Outcome::NotAssembled`].
    pub not_assembled: usize,
    /// [`Outcome::Unphysical`].
    pub unphysical: usize,
    /// [`Outcome::NoModes`].
    pub no_modes: usize,
}

impl Counts {
    /// Sum over all outcomes.
    pub fn total(&self) -> usize {
        self.stable
            + self.divergent
            + self.flutter
            + self.undecided
            + self.no_equilibrium
            + self.not_assembled
            + self.unphysical
            + self.no_modes
    }

    fn add(&mut self, outcome: Outcome, number: usize) {
        *match outcome {
            Outcome::Stable => &mut self.stable,
            Outcome::Divergent => &mut self.divergent,
            Outcome::Flutter => &mut self.flutter,
            Outcome::Undecided => &mut self.undecided,
            Outcome::NoEquilibrium => &mut self.no_equilibrium,
            Outcome::NotAssembled => &mut self.not_assembled,
            Outcome::Unphysical => &mut self.unphysical,
            Outcome::NoModes => &mut self.no_modes,
        } += number;
    }

    fn merge(&mut self, other: &Self) {
        self.stable += other.stable;
        self.divergent += other.divergent;
        self.flutter += other.flutter;
        self.undecided += other.undecided;
        self.no_equilibrium += other.no_equilibrium;
        self.not_assembled += other.not_assembled;
        self.unphysical += other.unphysical;
        self.no_modes += other.no_modes;
    }
}

/// One sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample<const N: usize, const P: usize> {
    /// Its design variables, SI.
    pub design: [f64; P],
    /// What became of it.
    pub outcome: Outcome,
    /// Its equilibrium, when it has one.
    pub coordinates: Option<[f64; N]>,
    /// Eigenvalues `s` in the order of the nominal modes, 1/s; `None` where they were not found, or where the sample has no
    /// such mode.
    pub eigenvalues: PerMode<Option<Complex>, N>,
    /// Frequencies in the order of the nominal modes, rad/s; `None` for a mode that does not oscillate.
    pub frequencies: PerMode<Option<f64>, N>,
    /// Damping ratios in the order of the nominal modes; `None` where there is none.
    pub damping_ratios: PerMode<Option<f64>, N>,
}

/// Result of a Monte Carlo run.
#[derive(Clone, Debug, PartialEq)]
pub struct MonteCarlo<const N: usize, const P: usize> {
    /// Number of samples.
    pub samples: usize,
    /// What became of them.
    pub counts: Counts,
    /// Stable samples for which the nominal position itself is unstable: they settled on another branch.
    pub left_nominal_branch: usize,
    /// Statistics of the frequency over the stable samples where the mode oscillates, rad/s, by nominal mode; `None`
    /// without any value.
    pub modes: PerMode<Option<Statistics>, N>,
    /// Statistics of the damping ratio over the same samples.
    pub damping_ratios: PerMode<Option<Statistics>, N>,
    /// Samples were solved side by side in vectors ([`Sampling::vectors`]), but for those that need a solver of their own. One by
    /// one the statistics differ in the last bits.
    pub side_by_side: bool,
    /// Some nominal modes have equal eigenvalues: which of them a mode of a sample is taken for is arbitrary, and only
    /// statistics of all of them together mean something ([`clusters`](crate::tolerance::clusters)).
    pub clustered: bool,
    /// Every sample in order, when asked for.
    pub all: Option<Vec<Sample<N, P>>>,
    /// Which modes they belong to.
    pub family: Family,
    /// The mechanism they belong to.
    pub description: &'static Description,
}

/// Samples the design variables about those of `nominal` (normal, by `tolerances`), re-solves each sample from the
/// nominal equilibrium and gathers the statistics of its frequencies, matched to the nominal modes by shape. Samples
/// settle on a stable equilibrium whichever was wanted of the nominal one.
///
/// # Errors
/// [`Error::Threads`] when worker threads cannot be started. Samples that fail are counted, not errors.
pub fn monte_carlo<M, const N: usize, const U: usize, const P: usize, const O: usize>(
    mechanism: &M,
    nominal: &Equilibrium<N, U, P>,
    modes: &Modes<N>,
    tolerances: &Tolerances<P>,
    sampling: &Sampling<'_>,
) -> Result<MonteCarlo<N, P>, Error>
where
    M: Mechanism<N, U, P, O>,
{
    let prepared = match sampling.vectors {
        Some(vectors) if const { Prepared::<M, N, U, P, O>::POSSIBLE } => {
            Prepared::new(mechanism, nominal, modes, tolerances, vectors)
        }
        _ => None,
    };
    let side_by_side = prepared.is_some();
    let run = Run {
        mechanism,
        nominal,
        modes,
        tolerances,
        sampling,
        prepared,
    };
    let chunk = |index: usize| run.chunk(index);
    let chunks = 0..sampling.samples.div_ceil(CHUNK);
    let pieces: Vec<Piece<N, P>> = match (sampling.threads, const { stack(N, P) }) {
        (1, _) => chunks.map(chunk).collect(),
        (0, None) => chunks.into_par_iter().map(chunk).collect(),
        (threads, stack) => {
            pool::of(threads, stack)?.install(|| chunks.into_par_iter().map(chunk).collect())
        }
    };
    let mut counts = Counts::default();
    let empty = modes.modes.map(|_| Moments::EMPTY);
    let (mut frequencies, mut damping_ratios) = (empty, empty);
    let mut left_nominal_branch = 0;
    let mut all = sampling
        .keep_samples
        .then(|| Vec::with_capacity(sampling.samples));
    for piece in pieces {
        counts.merge(&piece.counts);
        left_nominal_branch += piece.left_nominal_branch;
        for (sum, part) in frequencies.iter_mut().zip(&piece.frequencies) {
            sum.merge(part);
        }
        for (sum, part) in damping_ratios.iter_mut().zip(&piece.damping_ratios) {
            sum.merge(part);
        }
        if let Some(all) = &mut all {
            all.extend(piece.samples);
        }
    }
    Ok(MonteCarlo {
        samples: sampling.samples,
        counts,
        left_nominal_branch,
        modes: frequencies.map(Moments::statistics),
        damping_ratios: damping_ratios.map(Moments::statistics),
        side_by_side,
        clustered: clusters(modes, CLUSTER_GAP).contains(&true),
        all,
        family: modes.family,
        description: nominal.description,
    })
}

struct Piece<const N: usize, const P: usize> {
    counts: Counts,
    left_nominal_branch: usize,
    frequencies: PerMode<Moments, N>,
    damping_ratios: PerMode<Moments, N>,
    samples: Vec<Sample<N, P>>,
}

/// Everything that a chunk of samples needs.
struct Run<'a, M, const N: usize, const U: usize, const P: usize, const O: usize> {
    mechanism: &'a M,
    nominal: &'a Equilibrium<N, U, P>,
    modes: &'a Modes<N>,
    tolerances: &'a Tolerances<P>,
    sampling: &'a Sampling<'a>,
    prepared: Option<Prepared<'a, M, N, U, P, O>>,
}

impl<M, const N: usize, const U: usize, const P: usize, const O: usize> Run<'_, M, N, U, P, O>
where
    M: Mechanism<N, U, P, O>,
{
    fn chunk(&self, index: usize) -> Piece<N, P> {
        let first = index * CHUNK;
        let number = CHUNK.min(self.sampling.samples - first);
        let sequence = (self.sampling.seed, self.sampling.stream);
        let empty = self.modes.modes.map(|_| Moments::EMPTY);
        let keep = self.sampling.keep_samples;
        let mut piece = Piece {
            counts: Counts::default(),
            left_nominal_branch: 0,
            frequencies: empty,
            damping_ratios: empty,
            samples: Vec::with_capacity(if keep { number } else { 0 }),
        };
        match &self.prepared {
            Some(prepared) if const { Prepared::<M, N, U, P, O>::POSSIBLE } => {
                let mut draw = Batches::from::<P>(sequence, first as u64);
                self.side_by_side(prepared, &mut draw, number, &mut piece);
            }
            _ => {
                let nominal = &self.nominal.design;
                let mut draw = Draw::from(sequence, first as u64, nominal, self.tolerances);
                for _ in 0..number {
                    self.alone(draw.next(), &mut piece);
                }
            }
        }
        if let Some(progress) = self.sampling.progress {
            progress(number);
        }
        piece
    }

    /// Solves samples in batches, and alone those that no batch can vouch for.
    fn side_by_side(
        &self,
        prepared: &Prepared<'_, M, N, U, P, O>,
        draw: &mut Batches,
        number: usize,
        piece: &mut Piece<N, P>,
    ) {
        let mut sums = Sums::new();
        let mut batches = [const { Solved::new() }; TOGETHER];
        let mut left = number;
        while left > 0 {
            let used = TOGETHER.min(left.div_ceil(WIDTH));
            let batches = &mut batches[..used];
            for batch in &mut *batches {
                batch.members = WIDTH.min(left);
                left -= batch.members;
                draw.next(&mut batch.bits);
            }
            prepared.solve(batches, &mut sums);
            for batch in &*batches {
                self.decided(batch, piece);
            }
        }
        for (r, nominal) in prepared.frequencies.iter().enumerate() {
            piece.frequencies[r].merge(&sums.frequency(r, *nominal));
            piece.damping_ratios[r].merge(&sums.damping_ratio());
        }
    }

    /// Counts what a batch accepted, and solves the others alone.
    fn decided(&self, batch: &Solved<N, P>, piece: &mut Piece<N, P>) {
        let accepted = batch.accepted.count_ones() as usize;
        piece.counts.add(Outcome::Stable, accepted);
        if accepted == batch.members && !self.sampling.keep_samples {
            return;
        }
        for member in 0..batch.members {
            if batch.accepted >> member & 1 == 0 {
                self.alone(batch.design.map(|batch| batch.0[member]), piece);
            } else if self.sampling.keep_samples {
                piece.samples.push(self.accepted(batch, member));
            }
        }
    }

    fn alone(&self, design: [f64; P], piece: &mut Piece<N, P>) {
        let (sample, left) = run_sample(self.mechanism, self.nominal, self.modes, design);
        piece.counts.add(sample.outcome, 1);
        if sample.outcome == Outcome::Stable {
            piece.left_nominal_branch += usize::from(left);
            for (r, omega) in sample.frequencies.iter().enumerate() {
                if let Some(omega) = omega {
                    piece.frequencies[r].add(*omega);
                    piece.damping_ratios[r].add(sample.damping_ratios[r].unwrap_or(0.0));
                }
            }
        }
        if self.sampling.keep_samples {
            piece.samples.push(sample);
        }
    }

    fn accepted(&self, solved: &Solved<N, P>, member: usize) -> Sample<N, P> {
        let count = self.modes.modes.len();
        let frequency = |r: usize| solved.frequencies[r].0[member];
        Sample {
            design: solved.design.map(|batch| batch.0[member]),
            outcome: Outcome::Stable,
            coordinates: Some(solved.coordinates.map(|batch| batch.0[member])),
            eigenvalues: PerMode::from_fn(count, |r| Some(Complex::new(0.0, frequency(r)))),
            frequencies: PerMode::from_fn(count, |r| Some(frequency(r))),
            damping_ratios: PerMode::from_fn(count, |_| Some(0.0)),
        }
    }
}

/// Solves one sample; also tells whether it met an unstable region on the way from the nominal position.
fn run_sample<M, const N: usize, const U: usize, const P: usize, const O: usize>(
    mechanism: &M,
    nominal: &Equilibrium<N, U, P>,
    modes: &Modes<N>,
    design: [f64; P],
) -> (Sample<N, P>, bool)
where
    M: Mechanism<N, U, P, O>,
{
    let sample = |outcome, coordinates| Sample {
        design,
        outcome,
        coordinates,
        eigenvalues: modes.modes.map(|_| None),
        frequencies: modes.modes.map(|_| None),
        damping_ratios: modes.modes.map(|_| None),
    };
    if mechanism.violation(&nominal.inputs, &design).is_some() {
        return (sample(Outcome::Unphysical, None), false);
    }
    let problem = Problem::unchecked(mechanism, &nominal.inputs, &design);
    let settled = settle(&problem, &nominal.coordinates, Policy::Stable);
    let state = match settled {
        Ok(state) => state,
        Err(Failure::NotFound { .. } | Failure::Unbalanced { .. }) => {
            return (sample(Outcome::NoEquilibrium, None), false);
        }
        Err(Failure::NotAssembled { .. }) => return (sample(Outcome::NotAssembled, None), false),
        Err(Failure::OutsideDomain { .. } | Failure::SingularMass(_)) => {
            return (sample(Outcome::Unphysical, None), false);
        }
        Err(Failure::Mode { .. }) => return (sample(Outcome::NoModes, None), false),
    };
    let outcome = match state.stability {
        Stability::Divergent { .. } => Outcome::Divergent,
        Stability::Flutter { .. } => Outcome::Flutter,
        Stability::Undecided => Outcome::Undecided,
        _ => Outcome::Stable,
    };
    if state.regular().is_err() {
        return (sample(outcome, Some(state.coordinates)), false);
    }
    let Ok(found) = solve_modes(
        &state.linear,
        modes.family,
        state.description,
        state.rounding,
    ) else {
        return (sample(Outcome::NoModes, Some(state.coordinates)), false);
    };
    let order = match_modes(modes, &found, &state.linear);
    let own = order.map(|position| position.and_then(|position| found.modes.get(position)));
    let solved = Sample {
        eigenvalues: own.map(|mode| mode.map(|mode| mode.s)),
        frequencies: own.map(|mode| mode.and_then(|mode| mode.frequency())),
        damping_ratios: own.map(|mode| mode.and_then(|mode| mode.damping_ratio())),
        ..sample(outcome, Some(state.coordinates))
    };
    (solved, state.left_unstable_region)
}
