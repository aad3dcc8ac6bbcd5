//! Probabilities of meeting requirements, from samples.

use eigentol_statistics::reliability::sampling::{Interval, clopper_pearson, wilson};

use super::requirements::{Requirements, all_met};
use crate::algebra::{Matrix, Vector};
use crate::deviations::Deviations;
use crate::response::Workspace;
use crate::tolerance::{Counts, Draw, Sampling, Tolerances, pool};
use crate::{Description, Error, Shared};

/// Number of samples that one thread solves as a unit.
const CHUNK: u64 = 64;
/// Number of chunks in memory at once.
const TOGETHER: usize = 4096;

/// Numbers of samples that met a requirement, failed it, or could not tell.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Tally {
    /// Samples that met it.
    pub met: usize,
    /// Samples that failed it.
    pub failed: usize,
    /// Samples that lack the response needed to tell.
    pub untold: usize,
}

impl Tally {
    /// Number of samples.
    #[must_use]
    pub fn samples(&self) -> usize {
        self.met + self.failed + self.untold
    }

    /// Fraction of the samples that failed.
    #[must_use]
    pub fn failure(&self) -> f64 {
        self.failed as f64 / self.samples() as f64
    }

    /// Wilson confidence interval of the failure probability.
    ///
    /// # Errors
    /// [`Error::Setting`] for a confidence that is not inside (0, 1).
    pub fn wilson(&self, confidence: f64) -> Result<Interval, Error> {
        Ok(wilson(self.failed as u64, self.samples() as u64, confidence)?)
    }

    /// Clopper-Pearson confidence interval of the failure probability: its coverage is at least `confidence`.
    ///
    /// # Errors
    /// As [`Self::wilson`].
    pub fn clopper_pearson(&self, confidence: f64) -> Result<Interval, Error> {
        let (failed, samples) = (self.failed as u64, self.samples() as u64);
        Ok(clopper_pearson(failed, samples, confidence)?)
    }

    fn add(&mut self, met: Option<bool>) {
        *match met {
            Some(true) => &mut self.met,
            Some(false) => &mut self.failed,
            None => &mut self.untold,
        } += 1;
    }

    fn merge(&mut self, other: &Self) {
        self.met += other.met;
        self.failed += other.failed;
        self.untold += other.untold;
    }
}

/// Probabilities of meeting requirements, from samples.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Chances {
    /// For all requirements at once.
    pub all: Tally,
    /// For each requirement.
    pub each: Vec<Tally>,
    /// Outcomes of the samples.
    pub counts: Counts,
    /// Number of samples requested: larger than the number solved if the run was stopped, or if this is part of a run.
    pub planned: usize,
    /// Whether any variable has a tolerance.
    pub varies: bool,
    /// The inputs of the operating point, SI.
    pub inputs: Vector,
    /// The mechanism they belong to.
    pub description: Shared<Description>,
}

impl Requirements<'_> {
    /// Probabilities of meeting the requirements, by plain Monte Carlo; identical for any number of threads.
    ///
    /// The counts of sample ranges that make up a run add up to those of the run. A stopped run has at least its first
    /// 64 samples. The settings of `sampling` for keeping samples and for vector instructions have no effect.
    ///
    /// # Errors
    /// [`Error::Setting`] for zero samples or an invalid range, [`Error::Threads`].
    pub fn chances(&self, sampling: &Sampling<'_>) -> Result<Chances, Error> {
        chances_of(self, self.deviations(), sampling)
    }
}

/// Like [`Requirements::chances`], for given deviations.
pub(crate) fn chances_of(
    requirements: &Requirements<'_>,
    deviations: &Deviations<'_>,
    sampling: &Sampling<'_>,
) -> Result<Chances, Error> {
    sampling.check_random()?;
    let range = sampling.now()?;
    if range.is_empty() {
        return Err(Error::setting(if sampling.samples == 0 { "samples" } else { "range" }, "at least one is needed"));
    }
    let watch = sampling.watch();
    let state = requirements.responses().nominal();
    let variables = deviations.dimension();
    let normal = Standard::new(variables)?;
    let room = || requirements.responses().workspace();
    let work = |room: &mut Workspace, index: usize| {
        let mut piece = Piece::new(requirements.wanted().len());
        if index > 0 && watch.stopped() {
            return Ok(piece);
        }
        let first = range.start + index as u64 * CHUNK;
        let number = CHUNK.min(range.end - first);
        let mut draw = normal.from((sampling.seed, sampling.stream), first);
        for _ in 0..number {
            let design = deviations.design(draw.next_design());
            let realisation = requirements.responses().at(room, &design)?;
            piece.counts.add(realisation.outcome, 1);
            let each = requirements.each_met(&design, &realisation);
            piece.all.add(all_met(&each));
            for (tally, met) in piece.each.iter_mut().zip(each) {
                tally.add(met);
            }
        }
        watch.advance(number as usize);
        Ok(piece)
    };
    let pieces = (range.end - range.start).div_ceil(CHUNK) as usize;
    let size = (state.coordinates.len(), variables);
    let mut sum = Piece::new(requirements.wanted().len());
    for done in (0..pieces).step_by(TOGETHER) {
        if done > 0 && watch.stopped() {
            break;
        }
        let (threads, number) = (sampling.threads, TOGETHER.min(pieces - done));
        let work = |room: &mut Workspace, index: usize| work(room, done + index);
        let part: Vec<Result<Piece, Error>> = pool::run(threads, size, number, room, work)?;
        for piece in part {
            let piece = piece?;
            sum.counts.merge(&piece.counts);
            sum.all.merge(&piece.all);
            for (total, other) in sum.each.iter_mut().zip(&piece.each) {
                total.merge(other);
            }
        }
    }
    Ok(Chances {
        all: sum.all,
        each: sum.each,
        counts: sum.counts,
        planned: sampling.samples,
        varies: deviations.tolerances().vary(),
        inputs: state.inputs.clone(),
        description: state.description.clone(),
    })
}

/// Independent standard normal numbers, the same ones from which [`Draw`] makes designs.
struct Standard {
    zeros: Vector,
    ones: Tolerances,
}

impl Standard {
    fn new(variables: usize) -> Result<Self, Error> {
        let ones = Vector::filled(variables, 1.0);
        Ok(Self { zeros: Vector::zeros(variables), ones: Tolerances::new(ones, 1.0, None::<Matrix>)? })
    }

    fn from(&self, sequence: (u64, u64), first: u64) -> Draw<'_> {
        Draw::starting(sequence, first, &self.zeros, &self.ones)
    }
}

struct Piece {
    counts: Counts,
    all: Tally,
    each: Vec<Tally>,
}

impl Piece {
    fn new(requirements: usize) -> Self {
        Self { counts: Counts::default(), all: Tally::default(), each: vec![Tally::default(); requirements] }
    }
}
