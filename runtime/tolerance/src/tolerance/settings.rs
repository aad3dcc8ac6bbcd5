//! How to sample: what kind of points, how many, which of them now, and who watches.

use core::ops::Range;
use std::sync::atomic::AtomicBool;

use eigentol_statistics::sequence::Sequence;

use crate::scalar::Instructions;
use crate::setters;
use crate::{Error, Watch};

/// The kind of sampling points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Points {
    /// Independent random points.
    Random,
    /// Latin hypercubes.
    LatinHypercube,
    /// The scrambled Sobol' sequence.
    Sobol,
}

/// How to sample. Each question says which settings it takes.
#[derive(Clone)]
#[non_exhaustive]
pub struct Sampling<'a> {
    /// The kind of points: random ones for modes, requirements and clusters, any for responses.
    pub points: Points,
    /// Number of samples; the most of them where points come in randomisations ([`Self::total`]).
    pub samples: usize,
    /// Number of independent randomisations of a Latin hypercube or a Sobol' sequence; the scatter between them is the
    /// reported error. Random samples have one.
    pub randomisations: u64,
    /// Seed of the random numbers; the same seed gives the same samples and bit-identical results for any number of
    /// threads.
    pub seed: u64,
    /// Which of the seed's independent sequences to use; points of a sweep that must not share samples take one each.
    pub stream: u64,
    /// Number of threads; 0 takes as many as the machine has. The limit is 256, or the number the machine has if that
    /// is larger. Threads, once started, wait for the next run.
    pub threads: usize,
    /// Returns every sample of the modes, not only the statistics.
    pub keep_samples: bool,
    /// Vector instructions that solve several samples of the modes side by side where the mechanism allows it: at most
    /// sixteen unknowns, no constraints on velocities. `None` solves the samples one by one.
    ///
    /// Samples that do not clearly continue the nominal state are solved alone. The statistics are those of the samples
    /// solved one by one, up to rounding, and do not depend on the instructions. [`MonteCarlo::side_by_side`] reports
    /// which way was used.
    ///
    /// [`MonteCarlo::side_by_side`]: super::MonteCarlo::side_by_side
    pub vectors: Option<Instructions>,
    /// Which of the samples to process now; all by default. Results of other ranges are added by `merge`.
    pub range: Option<Range<u64>>,
    /// Called with the number of samples done since the last call, from any thread.
    pub progress: Option<&'a (dyn Fn(usize) + Sync)>,
    /// Stops the run soon after it becomes true, with the samples done so far.
    pub stop: Option<&'a AtomicBool>,
}

impl<'a> Sampling<'a> {
    setters!(
        points: Points,
        samples: usize,
        randomisations: u64,
        seed: u64,
        stream: u64,
        threads: usize,
        keep_samples: bool,
        vectors: Option<Instructions>,
        range: Option<Range<u64>>,
        progress: Option<&'a (dyn Fn(usize) + Sync)>,
        stop: Option<&'a AtomicBool>,
    );

    /// Total number of samples: equally many in each randomisation, and a power of two for a Sobol' sequence.
    ///
    /// # Errors
    /// [`Error::Setting`] for fewer than two randomisations of points that are not random, or fewer than two samples in
    /// each.
    pub fn total(&self) -> Result<u64, Error> {
        Ok(self.groups() * self.of_each()?)
    }

    /// Number of randomisations.
    #[doc(hidden)]
    pub fn groups(&self) -> u64 {
        match self.points {
            Points::Random => 1,
            Points::LatinHypercube | Points::Sobol => self.randomisations,
        }
    }

    /// Number of samples in each randomisation.
    #[doc(hidden)]
    pub fn of_each(&self) -> Result<u64, Error> {
        let refused = |setting, reason| Err(Error::setting(setting, reason));
        let (samples, groups) = (self.samples as u64, self.groups());
        match self.points {
            Points::Random => Ok(samples),
            _ if groups < 2 => {
                refused("randomisations", format!("{groups}: the error is the scatter between two or more"))
            }
            _ if samples / groups < 2 => {
                refused("samples", format!("{samples} leave less than two for each of {groups} randomisations"))
            }
            Points::LatinHypercube => Ok(samples / groups),
            Points::Sobol => Ok(1 << (samples / groups).ilog2()),
        }
    }

    /// The points of one randomisation.
    #[doc(hidden)]
    pub fn sequence(&self, group: u64, dimensions: usize) -> Result<Sequence, Error> {
        let (d, seed) = (dimensions.max(1), self.seed);
        // The streams of a run and its neighbours must not coincide.
        let stream = self.stream.wrapping_mul(self.groups()).wrapping_add(group);
        Ok(match self.points {
            Points::Random => Sequence::random(d, seed, stream)?,
            Points::LatinHypercube => Sequence::latin_hypercube(d, self.of_each()?, seed, stream)?,
            Points::Sobol => Sequence::sobol(d, seed, stream)?,
        })
    }

    /// The samples to process now.
    #[doc(hidden)]
    pub fn now(&self) -> Result<Range<u64>, Error> {
        let total = self.total()?;
        let range = self.range.clone().unwrap_or(0..total);
        if range.start > range.end || range.end > total {
            return Err(Error::setting("range", format!("{range:?} is not a range of the {total} samples")));
        }
        Ok(range)
    }

    /// Refuses points that are not random.
    #[doc(hidden)]
    pub fn check_random(&self) -> Result<(), Error> {
        if self.points == Points::Random {
            return Ok(());
        }
        Err(Error::setting("points", "only responses can be sampled at others than random points"))
    }

    /// The progress callback and the stop flag.
    #[doc(hidden)]
    pub fn watch(&self) -> Watch<'a> {
        Watch::default().progress(self.progress).stop(self.stop)
    }
}

impl Default for Sampling<'_> {
    fn default() -> Self {
        Self {
            points: Points::Random,
            samples: 3000,
            randomisations: 8,
            seed: 0,
            stream: 0,
            threads: 0,
            keep_samples: false,
            vectors: Some(Instructions::best()),
            range: None,
            progress: None,
            stop: None,
        }
    }
}
