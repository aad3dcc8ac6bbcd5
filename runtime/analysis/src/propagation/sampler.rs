//! Sampling settings: the kind of points, their number, and the range to solve now.

use core::ops::Range;
use std::sync::atomic::AtomicBool;

use eigentol_statistics::sequence::Sequence;

use crate::Error;
use crate::setters;

/// The kind of sampling points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Points {
    /// Independent random points.
    Random,
    /// Latin hypercubes.
    LatinHypercube,
    /// The scrambled Sobol' sequence.
    Sobol,
}

/// Sampling settings.
#[derive(Clone)]
#[non_exhaustive]
pub struct Sampler<'a> {
    /// The kind of points.
    pub points: Points,
    /// Maximum number of samples: see [`Self::total`].
    pub samples: u64,
    /// Number of independent randomisations of a Latin hypercube or a Sobol' sequence; the scatter between them is the
    /// reported error. Random samples have one.
    pub randomisations: u64,
    /// Seed. The same seed gives the same samples, and the same bits for any number of threads.
    pub seed: u64,
    /// Which independent sequence of the seed to use.
    pub stream: u64,
    /// Number of threads; 0 uses all available.
    pub threads: usize,
    /// The range of samples to solve now; all by default. Results of other ranges are added by
    /// [`Samples::merge`](super::Samples::merge).
    pub range: Option<Range<u64>>,
    /// Called from any thread with the number of samples done since the last call.
    pub progress: Option<&'a (dyn Fn(usize) + Sync)>,
    /// Stops the run soon after it becomes true, keeping the samples done so far.
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

    /// At most 4096 samples at points of this kind, in 8 randomisations.
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

    /// Total number of samples: equally many in each randomisation, and a power of two for a Sobol' sequence.
    ///
    /// # Errors
    /// [`Error::Setting`] for zero samples, fewer than two randomisations of points that are not random, or fewer than
    /// two samples in each.
    pub fn total(&self) -> Result<u64, Error> {
        Ok(self.groups() * self.of_each()?)
    }

    /// Number of randomisations.
    pub(super) fn groups(&self) -> u64 {
        match self.points {
            Points::Random => 1,
            Points::LatinHypercube | Points::Sobol => self.randomisations,
        }
    }

    /// Number of samples in each randomisation.
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

    /// The points of one randomisation.
    pub(super) fn sequence(&self, group: u64, dimensions: usize) -> Result<Sequence, Error> {
        let (d, seed) = (dimensions.max(1), self.seed);
        // The streams of a run and its neighbours must not coincide.
        let stream = self.stream.wrapping_mul(self.groups()).wrapping_add(group);
        Ok(match self.points {
            Points::Random => Sequence::random(d, seed, stream)?,
            Points::LatinHypercube => Sequence::latin_hypercube(d, self.of_each()?, seed, stream)?,
            Points::Sobol => Sequence::sobol(d, seed, stream)?,
        })
    }

    /// The range of samples to solve now.
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
