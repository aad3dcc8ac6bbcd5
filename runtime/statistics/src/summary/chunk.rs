//! Chunks of samples that are summed as a unit.

use std::ops::Range;

use super::checks::check_below;
use super::mask::{CHUNK, Mask};
use super::plan::Plan;
use crate::Error;

/// Number of samples in all chunks together.
const END: u64 = 1 << 60;

/// Splits a range of samples at the boundaries of chunks.
///
/// ```
/// use eigentol_statistics::summary::chunks;
///
/// let pieces: Vec<_> = chunks(100..600).collect();
/// assert_eq!(pieces, [100..256, 256..512, 512..600]);
/// ```
pub fn chunks(samples: Range<u64>) -> impl Iterator<Item = Range<u64>> {
    let size = CHUNK as u64;
    let chunks = if samples.is_empty() { 0..0 } else { samples.start / size..(samples.end - 1) / size + 1 };
    chunks.map(move |c| samples.start.max(c * size)..samples.end.min(c.saturating_add(1).saturating_mul(size)))
}

/// The values of some samples of one chunk, ordered by quantity.
///
/// A sample need not have every quantity: a mode that does not oscillate has no frequency.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Chunk {
    pub(super) index: u64,
    pub(super) covered: Mask,
    /// Values by quantity and sample of the chunk.
    #[cfg_attr(feature = "serde", serde(with = "super::bits::many"))]
    pub(super) values: Vec<f64>,
    /// For each quantity, which samples have it.
    pub(super) present: Vec<Mask>,
    /// Number of samples with each outcome.
    pub(super) outcomes: Vec<u64>,
}

impl Chunk {
    /// Creates an empty chunk for these samples, which must lie in one chunk. No sample has any quantity yet.
    ///
    /// # Errors
    ///
    /// If the range is empty, crosses a chunk boundary (see [`chunks`]) or ends beyond `2^60`.
    pub fn new(plan: &Plan, samples: Range<u64>) -> Result<Self, Error> {
        let mut chunk = Self::empty(plan, 0);
        chunk.restart(samples)?;
        Ok(chunk)
    }

    /// A chunk without samples.
    pub(super) fn empty(plan: &Plan, index: u64) -> Self {
        Self {
            index,
            covered: Mask::default(),
            values: vec![0.0; plan.quantities() * CHUNK],
            present: vec![Mask::default(); plan.quantities()],
            outcomes: vec![0; plan.outcomes],
        }
    }

    /// Discards all contents, for reuse with other samples.
    ///
    /// # Errors
    ///
    /// As for [`Chunk::new`].
    pub fn restart(&mut self, samples: Range<u64>) -> Result<(), Error> {
        let index = samples.start / CHUNK as u64;
        if samples.is_empty() || samples.end > END || (samples.end - 1) / CHUNK as u64 != index {
            let reason = format!("{samples:?} is not a part of one chunk; use `chunks` to split a range");
            return Err(Error::setting("samples", reason));
        }
        let start = (samples.start % CHUNK as u64) as usize;
        self.index = index;
        self.covered = Mask::of(start..start + (samples.end - samples.start) as usize);
        self.present.fill(Mask::default());
        self.outcomes.fill(0);
        Ok(())
    }

    /// Sets a quantity of a sample; `None` if the sample does not have it.
    ///
    /// # Errors
    ///
    /// If there is no such sample or quantity in this chunk. The value itself is checked when the chunk is added.
    pub fn set(&mut self, sample: u64, quantity: usize, value: Option<f64>) -> Result<(), Error> {
        check_below("quantity", quantity, self.present.len())?;
        let offset = (sample % CHUNK as u64) as usize;
        if sample / CHUNK as u64 != self.index || !self.covered.has(offset) {
            let reason = format!("{sample} is not among the samples of this chunk");
            return Err(Error::setting("sample", reason));
        }
        self.present[quantity].set(offset, value.is_some());
        self.values[quantity * CHUNK + offset] = value.unwrap_or_default();
        Ok(())
    }

    /// Sets a quantity of all samples at once, in order.
    ///
    /// # Errors
    ///
    /// If there is no such quantity, or if the number of values differs from that of samples.
    pub fn set_all(&mut self, quantity: usize, values: &[f64]) -> Result<(), Error> {
        check_below("quantity", quantity, self.present.len())?;
        let start = self.covered.places().next().unwrap_or_default();
        let expected = self.covered.count();
        if values.len() != expected {
            let found = values.len();
            return Err(Error::WrongLength { kind: "values of samples", found, expected });
        }
        let start = quantity * CHUNK + start;
        self.values[start..start + expected].copy_from_slice(values);
        self.present[quantity] = self.covered;
        Ok(())
    }

    /// Sets a quantity of at most 64 consecutive samples, starting at `first`.
    ///
    /// Bits of `having`, from the lowest on, tell which of them have it.
    ///
    /// # Errors
    ///
    /// If there is no such quantity, or if some of these samples are not in this chunk.
    #[inline]
    pub fn set_some(&mut self, first: u64, quantity: usize, values: &[f64], having: u64) -> Result<(), Error> {
        check_below("quantity", quantity, self.present.len())?;
        let (start, count) = ((first % CHUNK as u64) as usize, values.len());
        if first / CHUNK as u64 != self.index || !self.covered.has_all(start, count) {
            let reason = format!("{first} and the next, {count} in all, are not among those of this chunk");
            return Err(Error::setting("samples", reason));
        }
        let offset = quantity * CHUNK + start;
        self.values[offset..offset + count].copy_from_slice(values);
        self.present[quantity].put(start, count, having);
        Ok(())
    }

    /// Adds `samples` to the count of an outcome.
    ///
    /// # Errors
    ///
    /// If there is no such outcome.
    pub fn count(&mut self, outcome: usize, samples: u64) -> Result<(), Error> {
        check_below("outcome", outcome, self.outcomes.len())?;
        self.outcomes[outcome] += samples;
        Ok(())
    }

    /// The values of a quantity at all places of the chunk, and a mask of those present.
    #[inline(always)]
    pub(super) fn column(&self, quantity: usize) -> Option<(&[f64; CHUNK], Mask)> {
        let (columns, _) = self.values.as_chunks::<CHUNK>();
        Some((columns.get(quantity)?, *self.present.get(quantity)?))
    }

    /// Takes the samples of another part of the same chunk, but not the counts of outcomes.
    pub(super) fn join(&mut self, other: &Self) {
        self.covered = self.covered.or(other.covered);
        let (to, _) = self.values.as_chunks_mut::<CHUNK>();
        let (from, _) = other.values.as_chunks::<CHUNK>();
        for (k, (to, from)) in to.iter_mut().zip(from).enumerate() {
            for index in other.present[k].places() {
                to[index] = from[index];
            }
            self.present[k] = self.present[k].or(other.present[k]);
        }
    }

    /// The ranges of samples covered.
    pub(super) fn samples(&self) -> impl Iterator<Item = Range<u64>> {
        let first = self.index * CHUNK as u64;
        self.covered.places().map(move |offset| {
            let sample = first + offset as u64;
            sample..sample + 1
        })
    }
}
