//! Samples that are summed as one.

use std::ops::Range;

use super::checks::check_below;
use super::mask::{CHUNK, Mask};
use super::plan::Plan;
use crate::Error;

/// Number of samples of all chunks.
const END: u64 = 1 << 60;

/// Splits a range of samples where chunks end.
///
/// ```
/// use eigentol_statistics::summary::chunks;
///
/// let pieces: Vec<_> = chunks(100..600).collect();
/// assert_eq!(pieces, [100..256, 256..512, 512..600]);
/// ```
pub fn chunks(samples: Range<u64>) -> impl Iterator<Item = Range<u64>> {
    let size = CHUNK as u64;
    let chunks = if samples.is_empty() {
        0..0
    } else {
        samples.start / size..(samples.end - 1) / size + 1
    };
    chunks.map(move |c| {
        samples.start.max(c * size)..samples.end.min(c.saturating_add(1).saturating_mul(size))
    })
}

/// The values of some samples of one chunk, quantity by quantity. A sample need not have every quantity: a mode that does not
/// oscillate has no frequency.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Chunk {
    pub(super) index: u64,
    pub(super) covered: Mask,
    /// Of each quantity and sample of the chunk.
    #[cfg_attr(feature = "serde", serde(with = "super::bits::many"))]
    pub(super) values: Vec<f64>,
    /// For each quantity, which samples have it.
    pub(super) present: Vec<Mask>,
    /// How many samples had each outcome.
    pub(super) outcomes: Vec<u64>,
}

impl Chunk {
    /// Room for these samples, which lie in one chunk. No sample has any quantity yet.
    ///
    /// # Errors
    ///
    /// The range is empty, reaches into another chunk, see [`chunks`], or ends beyond `2^60`.
    pub fn new(plan: &Plan, samples: Range<u64>) -> Result<Self, Error> {
        let mut chunk = Self::empty(plan, 0);
        chunk.restart(samples)?;
        Ok(chunk)
    }

    /// Without samples.
    pub(super) fn empty(plan: &Plan, index: u64) -> Self {
        Self {
            index,
            covered: Mask::default(),
            values: vec![0.0; plan.quantities() * CHUNK],
            present: vec![Mask::default(); plan.quantities()],
            outcomes: vec![0; plan.outcomes],
        }
    }

    /// Forgets everything, to be used for other samples.
    ///
    /// # Errors
    ///
    /// As for [`Chunk::new`].
    pub fn restart(&mut self, samples: Range<u64>) -> Result<(), Error> {
        let index = samples.start / CHUNK as u64;
        if samples.is_empty() || samples.end > END || (samples.end - 1) / CHUNK as u64 != index {
            let reason =
                format!("{samples:?} is not a part of one chunk; use `chunks` to split a range");
            return Err(Error::Setting {
                setting: "samples",
                reason,
            });
        }
        let start = (samples.start % CHUNK as u64) as usize;
        self.index = index;
        self.covered = Mask::of(start..start + (samples.end - samples.start) as usize);
        self.present.fill(Mask::default());
        self.outcomes.fill(0);
        Ok(())
    }

    /// Sets a quantity of a sample, `None` if the sample does not have it.
    ///
    /// # Errors
    ///
    /// There is no such sample or quantity in this chunk. Whether the value is a number is asked when the chunk is added.
    pub fn set(&mut self, sample: u64, quantity: usize, value: Option<f64>) -> Result<(), Error> {
        check_below("quantity", quantity, self.present.len())?;
        let place = (sample % CHUNK as u64) as usize;
        if sample / CHUNK as u64 != self.index || !self.covered.has(place) {
            let reason = format!("{sample} is not among the samples of this chunk");
            return Err(Error::Setting {
                setting: "sample",
                reason,
            });
        }
        self.present[quantity].set(place, value.is_some());
        self.values[quantity * CHUNK + place] = value.unwrap_or_default();
        Ok(())
    }

    /// Sets a quantity of all samples, in order, at once.
    ///
    /// # Errors
    ///
    /// There is no such quantity, or there are not as many values as samples.
    pub fn set_all(&mut self, quantity: usize, values: &[f64]) -> Result<(), Error> {
        check_below("quantity", quantity, self.present.len())?;
        let start = self.covered.places().next().unwrap_or_default();
        let expected = self.covered.count();
        if values.len() != expected {
            let found = values.len();
            return Err(Error::WrongLength {
                kind: "values of samples",
                found,
                expected,
            });
        }
        let start = quantity * CHUNK + start;
        self.values[start..start + expected].copy_from_slice(values);
        self.present[quantity] = self.covered;
        Ok(())
    }

    /// Sets a quantity of some neighbouring samples, `first` and those after it, at most 64: of those that have it, by the bits of
    /// `having` from the lowest on.
    ///
    /// # Errors
    ///
    /// There is no such quantity, or not all of these are samples of this chunk.
    #[inline]
    pub fn set_some(
        &mut self,
        first: u64,
        quantity: usize,
        values: &[f64],
        having: u64,
    ) -> Result<(), Error> {
        check_below("quantity", quantity, self.present.len())?;
        let (start, count) = ((first % CHUNK as u64) as usize, values.len());
        if first / CHUNK as u64 != self.index || !self.covered.has_all(start, count) {
            let reason =
                format!("{first} and the next, {count} in all, are not among those of this chunk");
            return Err(Error::Setting {
                setting: "samples",
                reason,
            });
        }
        let place = quantity * CHUNK + start;
        self.values[place..place + count].copy_from_slice(values);
        self.present[quantity].put(start, count, having);
        Ok(())
    }

    /// Counts an outcome of so many samples.
    ///
    /// # Errors
    ///
    /// There is no such outcome.
    pub fn count(&mut self, outcome: usize, samples: u64) -> Result<(), Error> {
        check_below("outcome", outcome, self.outcomes.len())?;
        self.outcomes[outcome] += samples;
        Ok(())
    }

    /// The values of a quantity at all places of the chunk, and which are there.
    #[inline(always)]
    pub(super) fn column(&self, quantity: usize) -> Option<(&[f64; CHUNK], Mask)> {
        let (columns, _) = self.values.as_chunks::<CHUNK>();
        Some((columns.get(quantity)?, *self.present.get(quantity)?))
    }

    /// Takes over the samples of another part of the same chunk, but not what is counted.
    pub(super) fn join(&mut self, other: &Self) {
        self.covered = self.covered.or(other.covered);
        let (to, _) = self.values.as_chunks_mut::<CHUNK>();
        let (from, _) = other.values.as_chunks::<CHUNK>();
        for (k, (to, from)) in to.iter_mut().zip(from).enumerate() {
            for place in other.present[k].places() {
                to[place] = from[place];
            }
            self.present[k] = self.present[k].or(other.present[k]);
        }
    }

    /// The ranges of samples that are covered.
    pub(super) fn samples(&self) -> impl Iterator<Item = Range<u64>> {
        let first = self.index * CHUNK as u64;
        self.covered.places().map(move |place| {
            let sample = first + place as u64;
            sample..sample + 1
        })
    }
}
