//! How to sample: which points, how many of them, which of these now.

use core::ops::Range;
use std::sync::atomic::AtomicBool;

use eigentol_statistics::sequence::Sequence;

use crate::Error;
use crate::setters::setters;

/// What kind of points to sample at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Points {
    /// Independent random ones.
    Random,
    /// Latin hypercubes.
    LatinHypercube,
    /// The Sobol' sequence, scrambled.
    Sobol,
}

/// How to sample.
#[derive(Clone)]
#[non_exhaustive]
pub struct Sampler<'a> {
    /// Which points.
    pub points: Points,
    /// At most this many samples: see [`Self::total`].
    pub samples: u64,
    /// How many independent randomisations of a Latin hypercube or a Sobol' sequence the samples are made of; the scatter between them is
    /// the error that is reported. Random samples have one.
    pub randomisations: u64,
    /// The same seed gives the same samples, and the same bits for any number of threads.
    pub seed: u64,
    /// Which of the seed's independent sequences.
    pub stream: u64,
    /// Number of threads; 0 takes as many as the machine has.
    pub threads: usize,
    /// Which of the samples to take now; all unless set. Results of other ranges are added by
    /// [`Samples::merge`](super::Samples::merge).
    pub range: Option<Range<u64>>,
    /// Called with the number of samples done since the last call, from any thread.
    pub progress: Option<&'a (dyn Fn(usize) + Sync)>,
    /// Ends the run soon after it becomes true, with the samples that are done.
    pub stop: Option<&'a AtomicBool>,
}

impl<'a> Sampler<'a> {
    setters!(
        samples: u64,
        randomisations: u64,
        seed: u64,
        stream: u64,
        threads: usize,
        range: Option<Range<u64>>,
        progress: Option<&'a (dyn Fn(usize) + Sync)>,
        stop: Option<&'a AtomicBool>,
    );

    /// At most 4096 samples at such points, of 8 randomisations.
    #[must_use]
    pub fn new(points: Points) -> Self {
        Self {
            points,
            samples: 4096,
            randomisations: 8,
            seed: 0,
            stream: 0,
            threads: 0,
            range: None,
            progress: None,
            stop: None,
        }
    }

    /// How many samples there are in all: as many in each randomisation, a power of two of a Sobol' sequence.
    ///
    /// # Errors
    /// [`Error::Setting`] without any sample, with less than two randomisations of points that are not random, or less than two
    /// samples for each.
    pub fn total(&self) -> Result<u64, Error> {
        Ok(self.groups() * self.of_each()?)
    }

    /// How many randomisations there are.
    pub(super) fn groups(&self) -> u64 {
        match self.points {
            Points::Random => 1,
            Points::LatinHypercube | Points::Sobol => self.randomisations,
        }
    }

    /// Samples of each randomisation.
    pub(super) fn of_each(&self) -> Result<u64, Error> {
        let refused = |setting, reason| Err(Error::Setting { setting, reason });
        let (samples, groups) = (self.samples, self.groups());
        match self.points {
            Points::Random if samples == 0 => refused("samples", "there must be one".to_owned()),
            Points::Random => Ok(samples),
            _ if groups < 2 => refused(
                "randomisations",
                format!("{groups}: the error is the scatter between two or more"),
            ),
            _ if samples / groups < 2 => refused(
                "samples",
                format!("{samples} leave less than two for each of {groups} randomisations"),
            ),
            Points::LatinHypercube => Ok(samples / groups),
            Points::Sobol => Ok(1 << (samples / groups).ilog2()),
        }
    }

    /// The points of a randomisation.
    pub(super) fn sequence(&self, group: u64, dimensions: usize) -> Result<Sequence, Error> {
        let (d, seed) = (dimensions.max(1), self.seed);
        // Streams of a run and of its neighbours must not meet.
        let stream = self.stream.wrapping_mul(self.groups()).wrapping_add(group);
        Ok(match self.points {
            Points::Random => Sequence::random(d, seed, stream)?,
            Points::LatinHypercube => Sequence::latin_hypercube(d, self.of_each()?, seed, stream)?,
            Points::Sobol => Sequence::sobol(d, seed, stream)?,
        })
    }

    /// The samples to take now.
    pub(super) fn now(&self) -> Result<Range<u64>, Error> {
        let total = self.total()?;
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
