//! Samples in parallel. The gathered results have the same bits for any number of threads and any split into ranges.
//!
//! # Runs in parts
//!
//! A sample is a function of seed, stream and index, and sums of 256 neighbours meet in a binary tree over the index
//! (`eigentol_statistics::summary`), so statistics have the same bits for any split into ranges, order of merging and
//! number of threads. Threads therefore share samples freely (`tolerance/gather.rs`, for modes and responses alike). A
//! run is described by a list of facts, compared as text (`tolerance/fingerprint.rs`): names, values, what the kernels
//! give at some states, tolerances, nominal state, method, seed. Parts are merged only where all facts agree; the first
//! difference is named. Runs that will not be merged make no fingerprint.

use core::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering};

use eigentol_statistics::summary::{CHUNK, Chunk, Partial, Plan, chunks};

use super::pool;
use crate::Error;
use crate::scalar::{Instructions, Lanes, Task};

/// Pieces that a thread works on before results are combined.
const ROUND: u64 = 4;
/// Maximum number of chunks per piece: threads should not wait long for the last one.
const MOST: u64 = 64;

/// How samples are processed, with the progress callback and the stop flag.
#[doc(hidden)]
pub struct SampleRun<'a> {
    /// Number of threads; 0 for as many as the machine has.
    #[doc(hidden)]
    pub threads: usize,
    /// Numbers of unknowns and design variables, which determine the stack size of a thread.
    #[doc(hidden)]
    pub size: (usize, usize),
    /// Number of chunks that justify a thread of their own.
    #[doc(hidden)]
    pub least: u64,
    /// Called with the number of samples done since the last call.
    #[doc(hidden)]
    pub progress: Option<&'a (dyn Fn(usize) + Sync)>,
    /// Stops the work when it becomes true.
    #[doc(hidden)]
    pub stop: Option<&'a AtomicBool>,
}

/// Samples of one chunk to be solved.
#[doc(hidden)]
pub struct Part<'a, K> {
    #[doc(hidden)]
    pub group: usize,
    #[doc(hidden)]
    pub samples: Range<u64>,
    #[doc(hidden)]
    pub chunk: &'a mut Chunk,
    /// Results kept from the samples so far.
    pub(crate) kept: &'a mut Vec<K>,
}

impl SampleRun<'_> {
    /// Processes the samples of one range per group, or as many as are done when the work is stopped. Returns them
    /// together with what `solve` keeps, in order. Each thread has its own workspace.
    #[doc(hidden)]
    pub fn gather<R, K: Send>(
        &self,
        plan: &Plan,
        groups: &[Range<u64>],
        room: impl Fn() -> R + Sync + Send,
        solve: impl Fn(&mut R, &mut Part<'_, K>) -> Result<(), Error> + Sync + Send,
    ) -> Result<(Vec<Partial>, Vec<K>), Error> {
        let mut all: Vec<Option<Partial>> = vec![None; groups.len()];
        let mut kept = Vec::new();
        let mut pieces = self.pieces(groups);
        while !self.stopped() {
            let round: Vec<(usize, Range<u64>)> = pieces.by_ref().take(ROUND as usize * self.threads()).collect();
            if round.is_empty() {
                break;
            }
            let work = |room: &mut R, at: usize| self.piece(plan, round[at].clone(), room, &solve);
            let solved = pool::run(self.threads, self.size, round.len(), &room, work)?;
            for ((group, _), piece) in round.iter().zip(solved) {
                let (part, retained) = piece?;
                match &mut all[*group] {
                    Some(all) => all.merge(part)?,
                    none => *none = Some(part),
                }
                kept.extend(retained);
            }
        }
        let done = |part: Option<Partial>| part.unwrap_or_else(|| Partial::new(plan.clone()));
        Ok((all.into_iter().map(done).collect(), kept))
    }

    /// The samples of a range of a group, or as many as are done.
    fn piece<R, K>(
        &self,
        plan: &Plan,
        (group, samples): (usize, Range<u64>),
        room: &mut R,
        solve: impl Fn(&mut R, &mut Part<'_, K>) -> Result<(), Error>,
    ) -> Result<(Partial, Vec<K>), Error> {
        let mut part = Partial::new(plan.clone());
        let mut kept = Vec::new();
        let mut chunk: Option<Chunk> = None;
        for range in chunks(samples) {
            if self.stopped() {
                break;
            }
            let chunk = match &mut chunk {
                Some(chunk) => {
                    chunk.restart(range.clone())?;
                    chunk
                }
                None => chunk.insert(Chunk::new(plan, range.clone())?),
            };
            let mut part_of_chunk = Part { group, samples: range.clone(), chunk, kept: &mut kept };
            solve(room, &mut part_of_chunk)?;
            Instructions::best().run(Add(&mut part, chunk))?;
            if let Some(progress) = self.progress {
                progress((range.end - range.start) as usize);
            }
        }
        Ok((part, kept))
    }

    /// Splits the ranges into pieces of whole chunks.
    fn pieces(&self, groups: &[Range<u64>]) -> impl Iterator<Item = (usize, Range<u64>)> {
        let size = CHUNK as u64;
        let lengths = groups.iter().map(|group| group.end.saturating_sub(group.start));
        let chunks: u64 = lengths.map(|length| length.div_ceil(size)).sum();
        let share = match self.threads {
            1 => u64::MAX / size,
            _ => chunks.div_ceil(ROUND * self.threads() as u64).clamp(self.least.min(MOST), MOST),
        };
        let pieces = move |(group, samples): (usize, &Range<u64>)| {
            let (mut start, end) = (samples.start, samples.end);
            core::iter::from_fn(move || {
                let range = start..(start / size).saturating_add(share).saturating_mul(size).min(end);
                start = range.end;
                (!range.is_empty()).then_some((group, range))
            })
        };
        groups.iter().enumerate().flat_map(pieces)
    }

    fn threads(&self) -> usize {
        match self.threads {
            0 => std::thread::available_parallelism().map_or(1, usize::from),
            threads => threads.min(pool::MOST),
        }
    }

    fn stopped(&self) -> bool {
        self.stop.is_some_and(|stop| stop.load(Ordering::Relaxed))
    }
}

/// Accumulates a chunk, with vector instructions if available.
struct Add<'a>(&'a mut Partial, &'a Chunk);

impl Task for Add<'_> {
    type Output = Result<(), eigentol_statistics::Error>;

    #[inline(always)]
    fn run<V: Lanes>(self) -> Self::Output {
        self.0.add(self.1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pieces_end_where_chunks_do() {
        for threads in [1, 2, 3, 7] {
            for range in [0..0, 5..6, 0..3000, 100..100_000, 255..257] {
                let work = SampleRun { threads, size: (1, 1), least: 4, progress: None, stop: None };
                let groups = [0..0, range.clone()];
                let pieces: Vec<_> = work.pieces(&groups).collect();
                let mut next = range.start;
                for (group, piece) in &pieces {
                    assert_eq!((*group, piece.start), (1, next));
                    assert!(piece.end % CHUNK as u64 == 0 || piece.end == range.end);
                    next = piece.end;
                }
                assert!(next == range.end && (threads > 1 || pieces.len() <= 1));
            }
        }
    }
}
