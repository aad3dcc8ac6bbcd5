//! Monte Carlo: every sample solves its own equilibrium and its own eigenproblem, and every failure is counted.

use super::batched::{Memory, Solved, Sums, TOGETHER, TaylorModel};
use super::pool;
use super::sample::Solution;
use super::sampling::{Batches, Draw};
use super::statistics::Moments;
use super::{Counts, Outcome, Sample, Statistics, Tolerances};
use crate::algebra::Vector;
use crate::kernels::BatchKernels;
use crate::modes::{CLUSTER_GAP, Family, clusters};
use crate::scalar::{Batch, Instructions, WIDTH};
use crate::setters::setters;
use crate::{Complex, Description, Equilibrium, Error, Modes, Shared};

/// Samples worked on by one thread at a time, whole batches; fixed, so that sums are formed in the same order on any machine.
const CHUNK: usize = 256;

/// How to sample.
#[derive(Clone, Copy)]
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
    /// Called with the number of samples done since the last call, from any thread.
    pub progress: Option<&'a (dyn Fn(usize) + Sync)>,
}

impl<'a> Sampling<'a> {
    setters!(
        samples: usize,
        seed: u64,
        stream: u64,
        threads: usize,
        keep_samples: bool,
        vectors: Option<Instructions>,
        progress: Option<&'a (dyn Fn(usize) + Sync)>,
    );
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

/// Result of a Monte Carlo run.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct MonteCarlo {
    /// Number of samples.
    pub samples: usize,
    /// What became of them.
    pub counts: Counts,
    /// Stable samples for which the nominal position itself is unstable: they settled on another branch.
    pub left_nominal_branch: usize,
    /// Statistics of the frequency over the stable samples where the mode oscillates, rad/s, by nominal mode; `None`
    /// without any value.
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

/// Samples the design variables about those of `nominal` (normal, by `tolerances`), re-solves each sample from the
/// nominal equilibrium and gathers the statistics of its frequencies, matched to the nominal modes by shape. Samples
/// settle on a stable equilibrium, whatever policy found the nominal one.
///
/// # Errors
/// [`Error::WrongLength`] for tolerances of another mechanism, [`Error::Threads`] when worker threads cannot be started. Samples
/// that fail are counted, not errors.
pub fn monte_carlo(
    mechanism: &dyn BatchKernels,
    nominal: &Equilibrium,
    modes: &Modes,
    tolerances: &Tolerances,
    sampling: &Sampling<'_>,
) -> Result<MonteCarlo, Error> {
    tolerances.check_count(nominal.design.len())?;
    let prepared = (sampling.vectors)
        .and_then(|vectors| TaylorModel::new(mechanism, nominal, modes, tolerances, vectors));
    let side_by_side = prepared.is_some();
    let run = Run {
        mechanism,
        nominal,
        modes,
        tolerances,
        sampling,
        prepared,
    };
    let room = || run.room();
    let chunk = |room: &mut Room, index: usize| run.chunk(room, index);
    let chunks = sampling.samples.div_ceil(CHUNK);
    let size = (nominal.coordinates.len(), nominal.design.len());
    let pieces = pool::run(sampling.threads, size, chunks, room, chunk)?;
    let mut sum = Piece::empty(modes.modes.len());
    sum.samples = Vec::with_capacity(run.kept(sampling.samples));
    for piece in pieces {
        sum.merge(piece);
    }
    let statistics = |moments: &[Moments]| moments.iter().map(Moments::statistics).collect();
    Ok(MonteCarlo {
        samples: sampling.samples,
        counts: sum.counts,
        left_nominal_branch: sum.left_nominal_branch,
        modes: statistics(&sum.frequencies),
        damping_ratios: statistics(&sum.damping_ratios),
        side_by_side,
        clustered: clusters(modes, CLUSTER_GAP).contains(&true),
        all: sampling.keep_samples.then_some(sum.samples),
        family: modes.family,
        inputs: nominal.inputs.clone(),
        description: nominal.description.clone(),
    })
}

/// What is gathered of some samples.
struct Piece {
    counts: Counts,
    left_nominal_branch: usize,
    frequencies: Vec<Moments>,
    damping_ratios: Vec<Moments>,
    samples: Vec<Sample>,
}

impl Piece {
    fn empty(modes: usize) -> Self {
        Self {
            counts: Counts::default(),
            left_nominal_branch: 0,
            frequencies: vec![Moments::EMPTY; modes],
            damping_ratios: vec![Moments::EMPTY; modes],
            samples: Vec::new(),
        }
    }

    fn merge(&mut self, other: Self) {
        self.counts.merge(&other.counts);
        self.left_nominal_branch += other.left_nominal_branch;
        for (own, other) in [
            (&mut self.frequencies, &other.frequencies),
            (&mut self.damping_ratios, &other.damping_ratios),
        ] {
            for (sum, part) in own.iter_mut().zip(other) {
                sum.merge(part);
            }
        }
        self.samples.extend(other.samples);
    }
}

/// What one thread solves samples in.
struct Room {
    /// For those solved together; none where samples are solved one by one.
    together: Memory,
    alone: Solution,
}

/// Everything that a chunk of samples needs.
struct Run<'a> {
    mechanism: &'a dyn BatchKernels,
    nominal: &'a Equilibrium,
    modes: &'a Modes,
    tolerances: &'a Tolerances,
    sampling: &'a Sampling<'a>,
    prepared: Option<TaylorModel<'a>>,
}

impl Run<'_> {
    /// How many of `number` samples are returned.
    fn kept(&self, number: usize) -> usize {
        if self.sampling.keep_samples {
            number
        } else {
            0
        }
    }

    fn room(&self) -> Room {
        let (n, p) = (self.nominal.coordinates.len(), self.nominal.design.len());
        let count = self.prepared.as_ref().map_or(0, |_| TOGETHER);
        Room {
            together: Memory::new(count, n, p),
            alone: Solution::about(self.nominal, self.modes),
        }
    }

    fn chunk(&self, room: &mut Room, index: usize) -> Piece {
        let first = index * CHUNK;
        let number = CHUNK.min(self.sampling.samples - first);
        let sequence = (self.sampling.seed, self.sampling.stream);
        let mut piece = Piece::empty(self.modes.modes.len());
        piece.samples = Vec::with_capacity(self.kept(number));
        match &self.prepared {
            Some(prepared) => {
                let mut draw = Batches::from(sequence, first as u64, self.nominal.design.len());
                self.side_by_side(prepared, room, &mut draw, number, &mut piece);
            }
            None => {
                let nominal = &self.nominal.design;
                let mut draw = Draw::from(sequence, first as u64, nominal, self.tolerances);
                for _ in 0..number {
                    self.alone(&mut room.alone, draw.next(), &mut piece);
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
        prepared: &TaylorModel<'_>,
        room: &mut Room,
        draw: &mut Batches,
        number: usize,
        piece: &mut Piece,
    ) {
        let (n, p) = (self.nominal.coordinates.len(), self.nominal.design.len());
        let mut sums = Sums::new(n);
        let mut together = room.together.batches::<TOGETHER>(n, p);
        let mut left = number;
        while left > 0 {
            let used = TOGETHER.min(left.div_ceil(WIDTH));
            let batches = &mut together[..used];
            for batch in &mut *batches {
                batch.members = WIDTH.min(left);
                left -= batch.members;
                draw.next(batch.bits);
            }
            prepared.solve(batches, &mut sums);
            for batch in &*batches {
                self.decided(batch, &mut room.alone, piece);
            }
        }
        for (r, nominal) in prepared.frequencies.iter().enumerate() {
            piece.frequencies[r].merge(&sums.frequency(r, *nominal));
            piece.damping_ratios[r].merge(&sums.damping_ratio());
        }
    }

    /// Counts what a batch accepted, and solves the others alone.
    fn decided(&self, batch: &Solved<'_>, alone: &mut Solution, piece: &mut Piece) {
        let accepted = batch.accepted.count_ones() as usize;
        piece.counts.add(Outcome::Stable, accepted);
        if accepted == batch.members && !self.sampling.keep_samples {
            return;
        }
        for member in 0..batch.members {
            if batch.accepted >> member & 1 == 0 {
                self.alone(alone, &member_of(batch.design, member), piece);
            } else if self.sampling.keep_samples {
                piece.samples.push(Self::accepted(batch, member));
            }
        }
    }

    /// Solves a sample by itself.
    fn alone(&self, solved: &mut Solution, design: &[f64], piece: &mut Piece) {
        solved.solve(self.mechanism, self.nominal, self.modes, design);
        piece.counts.add(solved.outcome, 1);
        if solved.outcome == Outcome::Stable {
            piece.left_nominal_branch += usize::from(solved.state.left_unstable_region);
            for r in 0..self.modes.modes.len() {
                let Some(mode) = solved.mode(r) else { continue };
                if let Some(omega) = mode.frequency() {
                    piece.frequencies[r].add(omega);
                    piece.damping_ratios[r].add(mode.damping_ratio().unwrap_or(0.0));
                }
            }
        }
        if self.sampling.keep_samples {
            piece
                .samples
                .push(solved.sample(design, self.modes.modes.len()));
        }
    }

    /// A sample that passed the checks of its batch.
    fn accepted(solved: &Solved<'_>, member: usize) -> Sample {
        let frequencies = member_of(solved.frequencies, member);
        let eigenvalue = |omega: &f64| Some(Complex::new(0.0, *omega));
        Sample {
            design: member_of(solved.design, member),
            outcome: Outcome::Stable,
            coordinates: Some(member_of(solved.coordinates, member)),
            eigenvalues: frequencies.iter().map(eigenvalue).collect(),
            damping_ratios: vec![Some(0.0); frequencies.len()],
            frequencies: frequencies.into_iter().map(Some).collect(),
        }
    }
}

/// What belongs to one member of a batch.
fn member_of(batches: &[Batch], member: usize) -> Vector {
    batches.iter().map(|batch| batch.0[member]).collect()
}
