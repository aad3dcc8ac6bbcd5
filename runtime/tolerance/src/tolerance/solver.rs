//! Solves samples, one by one or side by side, and records their outcomes.

use eigentol_statistics::summary::{LARGEST, Plan};

use super::batched::{Memory, Prepared, SampleBatch, Size, TOGETHER};
use super::gather::Part;
use super::sample::Solution;
use super::sampling::{Batches, Draw};
use super::{Outcome, Sample, Tolerances};
use crate::algebra::Vector;
use crate::equilibrium::{Branch, Needed};
use crate::kernels::BatchKernels;
use crate::modes::Family;
use crate::scalar::{Batch, Instructions, WIDTH};
use crate::sensitivity::{Quantity, sensitivities};
use crate::{Complex, Equilibrium, Error, Modes};

/// Index, after the outcomes, of the count of stable samples on another branch than the nominal one.
pub(super) const LEFT_NOMINAL_BRANCH: usize = Outcome::ALL.len();

/// A sample with its number.
pub(super) type Numbered = (u64, Sample);

/// Workspace of one thread.
pub(super) struct SampleWorkspace {
    /// For batches; empty if samples are solved one by one.
    together: Memory,
    alone: Solution,
}

/// All data that samples need.
pub(super) struct SampleSolver<'a> {
    pub(super) mechanism: &'a dyn BatchKernels,
    pub(super) nominal: &'a Equilibrium,
    pub(super) modes: &'a Modes,
    pub(super) tolerances: &'a Tolerances,
    /// Seed and stream.
    pub(super) sequence: (u64, u64),
    pub(super) keep_samples: bool,
    vectors: Option<Instructions>,
    /// The neighbourhood of the nominal state, if the mechanism is of a kind that is solved in vectors.
    prepared: Option<Prepared<'a>>,
}

impl<'a> SampleSolver<'a> {
    pub(super) fn new(
        mechanism: &'a dyn BatchKernels,
        (nominal, modes): (&'a Equilibrium, &'a Modes),
        tolerances: &'a Tolerances,
        vectors: Option<Instructions>,
        sequence: (u64, u64),
        keep_samples: bool,
    ) -> Self {
        Self {
            mechanism,
            nominal,
            modes,
            tolerances,
            sequence,
            keep_samples,
            vectors,
            prepared: Prepared::new(mechanism, (nominal, modes), tolerances),
        }
    }

    pub(super) fn side_by_side(&self) -> bool {
        self.in_vectors().is_some()
    }

    /// What solves samples side by side, if that is wanted and possible.
    fn in_vectors(&self) -> Option<(&Prepared<'a>, Instructions)> {
        self.prepared.as_ref().zip(self.vectors)
    }

    /// What is gathered: the frequency of each nominal mode, and its damping ratio if modes can be damped; the
    /// outcomes, followed by [`LEFT_NOMINAL_BRANCH`].
    pub(super) fn plan(&self) -> Result<Plan, Error> {
        let slopes = sensitivities(self.mechanism, self.nominal, self.modes).ok();
        let quantities = match self.modes.family {
            Family::Undamped => &[Quantity::Frequency][..],
            Family::General => &[Quantity::Frequency, Quantity::DampingRatio],
        };
        let count = self.modes.modes.len();
        let mut plan = Plan::new(quantities.len() * count).outcomes(LEFT_NOMINAL_BRANCH + 1);
        for (k, quantity) in quantities.iter().enumerate() {
            for (r, mode) in self.modes.modes.iter().enumerate() {
                let mode_slopes = slopes.as_ref().and_then(|all| all.modes.get(r)).and_then(|x| x.of(*quantity));
                let by_design = mode_slopes.as_ref().map(|x| &x.by_design[..]);
                let (reference, scale) = self.tolerances.scale(quantity.of(mode), by_design);
                plan = plan.sketch(k * count + r, reference, scale)?;
            }
        }
        Ok(plan)
    }

    pub(super) fn room(&self) -> SampleWorkspace {
        let count = if self.side_by_side() { TOGETHER } else { 0 };
        SampleWorkspace {
            together: Memory::new(count, Size::of(self.nominal, self.modes)),
            alone: Solution::about(self.nominal, self.modes),
        }
    }

    /// Solves the samples of one chunk.
    pub(super) fn solve(&self, room: &mut SampleWorkspace, part: &mut Part<'_, Numbered>) -> Result<(), Error> {
        if let Some(vectors) = self.in_vectors() {
            return self.solve_batched(vectors, room, part);
        }
        let (nominal, samples) = (&self.nominal.design, part.samples.clone());
        let mut draw = Draw::starting(self.sequence, samples.start, nominal, self.tolerances);
        for sample in samples {
            self.solve_single(&mut room.alone, (sample, draw.next_design()), part)?;
        }
        Ok(())
    }

    /// Solves samples in batches; those that fail a check are solved one by one.
    fn solve_batched(
        &self,
        (prepared, vectors): (&Prepared<'_>, Instructions),
        room: &mut SampleWorkspace,
        part: &mut Part<'_, Numbered>,
    ) -> Result<(), Error> {
        let samples = part.samples.clone();
        let size = Size::of(self.nominal, self.modes);
        let mut draw = Batches::from(self.sequence, samples.start, size.design);
        let mut together = room.together.batches::<TOGETHER>(size);
        let mut next = samples.start;
        while next < samples.end {
            let left = (samples.end - next) as usize;
            let batches = &mut together[..TOGETHER.min(left.div_ceil(WIDTH))];
            let mut left = left;
            for batch in &mut *batches {
                batch.members = WIDTH.min(left);
                left -= batch.members;
                draw.next(batch.bits);
            }
            prepared.solve(vectors, batches);
            for batch in &*batches {
                self.record_batch((next, batch), &mut room.alone, part)?;
                next += batch.members as u64;
            }
        }
        Ok(())
    }

    /// Records the samples that a batch accepted, and solves the others alone.
    fn record_batch(
        &self,
        (first, batch): (u64, &SampleBatch<'_>),
        alone: &mut Solution,
        part: &mut Part<'_, Numbered>,
    ) -> Result<(), Error> {
        let accepted = batch.accepted.count_ones() as usize;
        part.chunk.count(Outcome::Stable as usize, accepted as u64)?;
        let having = u64::from(batch.accepted);
        let (count, damped) = (self.modes.modes.len(), self.modes.family == Family::General);
        let all = batch.frequencies.iter().zip(&*batch.rates);
        for (r, (frequencies, rates)) in all.enumerate() {
            if self.modes.modes[r].frequency().is_none() {
                continue;
            }
            let set = &mut part.chunk;
            set.set_some(first, r, &frequencies.0[..batch.members], having)?;
            if damped {
                let ratios = Batch::from_fn(|k| {
                    let s = Complex::new(rates.0[k], frequencies.0[k]);
                    Quantity::DampingRatio.of_stable(s).unwrap_or(0.0)
                });
                set.set_some(first, count + r, &ratios.0[..batch.members], having)?;
            }
        }
        if accepted == batch.members && !self.keep_samples {
            return Ok(());
        }
        for member in 0..batch.members {
            let sample = first + member as u64;
            if batch.accepted >> member & 1 == 0 {
                let design = member_of(batch.design, member);
                self.solve_single(alone, (sample, &design), part)?;
            } else if self.keep_samples {
                part.kept.push((sample, accepted_member(batch, member)));
            }
        }
        Ok(())
    }

    /// Whether an equilibrium lies on the nominal branch. Newton's method is asked only where the neighbourhood of the
    /// nominal equilibrium, by which samples side by side are judged, does not tell.
    fn is_on_nominal_branch(&self, design: &[f64], equilibrium: &Equilibrium) -> bool {
        let q = &equilibrium.coordinates;
        let near = |prepared: &Prepared<'_>| prepared.is_continued_by(q, &equilibrium.linear.stiffness);
        self.prepared.as_ref().is_some_and(near) || Branch::of(self.mechanism, self.nominal).holds(design, q)
    }

    /// Solves a sample on its own.
    fn solve_single(
        &self,
        solved: &mut Solution,
        (sample, design): (u64, &[f64]),
        Part { chunk, kept, .. }: &mut Part<'_, Numbered>,
    ) -> Result<(), Error> {
        solved.solve(self.mechanism, self.nominal, (self.modes, Needed::Modes), design);
        chunk.count(solved.outcome as usize, 1)?;
        let count = self.modes.modes.len();
        if solved.continues(self.nominal) {
            let left = !self.is_on_nominal_branch(design, &solved.state);
            chunk.count(LEFT_NOMINAL_BRANCH, u64::from(left))?;
            for r in 0..count {
                let Some(mode) = solved.mode(r) else { continue };
                let Some(omega) = mode.frequency().filter(|omega| *omega <= LARGEST) else {
                    continue;
                };
                chunk.set(sample, r, Some(omega))?;
                if self.modes.family == Family::General {
                    let ratio = mode.damping_ratio().unwrap_or(0.0);
                    chunk.set(sample, count + r, Some(ratio))?;
                }
            }
        }
        if self.keep_samples {
            kept.push((sample, solved.sample(design, count)));
        }
        Ok(())
    }
}

/// A sample that passed the checks of its batch.
fn accepted_member(solved: &SampleBatch<'_>, member: usize) -> Sample {
    let eigenvalues: Vec<Complex> = solved.eigenvalues(member).collect();
    let all = |quantity: Quantity| eigenvalues.iter().map(|s| quantity.of_stable(*s)).collect();
    Sample {
        design: member_of(solved.design, member),
        outcome: Outcome::Stable,
        coordinates: Some(member_of(solved.coordinates, member)),
        damping_ratios: all(Quantity::DampingRatio),
        frequencies: all(Quantity::Frequency),
        eigenvalues: eigenvalues.into_iter().map(Some).collect(),
    }
}

/// The values of one member of a batch.
fn member_of(batches: &[Batch], member: usize) -> Vector {
    batches.iter().map(|batch| batch.0[member]).collect()
}
