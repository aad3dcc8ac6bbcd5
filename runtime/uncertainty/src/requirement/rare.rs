//! Small failure probabilities: importance sampling about design points.

use core::cell::{Cell, RefCell};

use eigentol_statistics::reliability::sampling::{
    Estimate, Failure, Interval, Proposal, SampleSums, SampledProbability, Sampler, SamplingSettings,
};
use eigentol_statistics::reliability::{self, LimitState, LimitValue};

use super::reliability::Reliability;
use super::requirements::{Requirements, all_met};
use crate::algebra::Vector;
use crate::judge::{Judgement, TRUSTED_PROBABILITY_ERROR};
use crate::response::Workspace;
use crate::tolerance::{Counts, Outcome, Sampling, pool};
use crate::{Description, Error, Shared};

/// Number of samples that one thread solves as a unit, and number of such units between checks of the result.
const CHUNK: u64 = 64;
const CHUNKS: u64 = 16;
/// Share of the samples that are distributed like the designs, if failures may lie anywhere.
const PLAIN: f64 = 0.5;
/// Standard errors by which an estimate from samples must miss to be contradicted.
const CLEARLY: f64 = 3.0;
/// Probability of seeing none of the failures that are said to be possible though unseen.
const UNSEEN: f64 = 0.05;

/// Probability of failing any requirement, by importance sampling.
///
/// Derivatives are with respect to mean and standard deviation of the standard normal variables.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct RareFailure {
    /// The estimate from the samples. Samples that lack the response needed to tell are counted, but not as failures.
    pub failure: SampledProbability,
    /// Outcomes of the samples; these are not distributed like the designs, so their fractions are not probabilities.
    pub counts: Counts,
    /// Number of design points about which samples were drawn.
    pub centres: usize,
    /// Requirements of which some failure has no design point: [`Requirement::Stable`](super::Requirement::Stable), or
    /// a limit of which the search failed. For their sake half of the samples are distributed like the designs.
    pub without_design_point: Vec<usize>,
    /// Probability that failures of these requirements may have without having been seen, at a confidence of 95 %:
    /// three over the number of samples distributed like the designs. Zero if every requirement has its design points.
    pub unseen: f64,
    /// The same probability by lines of designs ([`Reliability::judgement`]), which see what lies far from the design
    /// points.
    pub judgement: Judgement,
    /// The inputs of the operating point, SI.
    pub inputs: Vector,
    /// The mechanism it belongs to.
    pub description: Shared<Description>,
}

impl RareFailure {
    /// Whether the samples reached their target and lines of designs do not contradict them: a failure far from all
    /// design points, or a layer too thin for samples to meet, shows in neither the samples nor their standard error.
    #[must_use]
    pub fn trusted(&self) -> bool {
        self.failure.reached && !self.contradicted()
    }

    /// Whether lines of designs found another probability, beyond the errors of both.
    #[must_use]
    pub fn contradicted(&self) -> bool {
        let Estimate { value, standard_error } = self.failure.probability;
        let judged = self.judgement.judged().filter(|x| x.settled);
        judged.is_some_and(|judged| {
            let Interval { lower, upper } = judged.interval();
            let known = CLEARLY * standard_error + TRUSTED_PROBABILITY_ERROR * judged.probability.value;
            value + known < lower || value - known > upper
        })
    }
}

impl Requirements<'_> {
    /// Probability of failing any requirement, from at most the samples of `sampling` about the design points of `about`,
    /// fewer if its coefficient of variation falls to `accuracy`; identical for any number of threads. The estimate is
    /// unbiased wherever failure lies, but its standard error cannot see a failure region far from all design points:
    /// lines of designs do ([`RareFailure::trusted`]). If a requirement has no design point, sampling goes on until what
    /// its failures may hide ([`RareFailure::unseen`]) is within the target too, or until the largest number of samples.
    ///
    /// # Errors
    /// [`Error::Setting`] if `about` has no design point, for zero samples, for points that are not random or for an
    /// invalid `accuracy`; [`Error::Threads`].
    pub fn rare_failure(
        &self,
        about: &Reliability,
        sampling: &Sampling<'_>,
        accuracy: f64,
    ) -> Result<RareFailure, Error> {
        sampling.check_random()?;
        let settings = &SamplingSettings {
            seed: sampling.seed,
            stream: sampling.stream,
            samples: sampling.samples as u64,
            coefficient_of_variation: accuracy,
            ..SamplingSettings::default()
        };
        let design_points = about.limits.iter().filter_map(|limit| limit.design_points.as_ref().ok());
        let centres: Vec<reliability::DesignPoint> =
            design_points.flatten().map(|point| point.normal.clone()).collect();
        if centres.is_empty() {
            return Err(Error::Setting {
                setting: "design points",
                reason: "there is none to sample about: sample plainly".to_owned(),
            });
        }
        let without_design_point = about.without_design_point();
        let proposal = Proposal::around(&centres)?;
        let proposal = match without_design_point.is_empty() {
            true => proposal,
            false => proposal.defended(PLAIN)?,
        };
        let state = self.responses().nominal();
        let size = (state.coordinates.len(), self.deviations().dimension());
        let whole = [self.whole()];
        let all = Sampler::new(&whole, Failure::Any, &proposal, settings)?;
        let mut sums: Option<SampleSums> = None;
        let mut counts = Counts::default();
        let mut first = 0;
        loop {
            let left = settings.samples - first;
            let number = left.min(CHUNK * CHUNKS);
            let piece = |(): &mut (), index: usize| -> Result<(SampleSums, Counts), Error> {
                let start = first + CHUNK * index as u64;
                let end = (start + CHUNK).min(first + number);
                let limits = [self.whole()];
                let sampler = Sampler::new(&limits, Failure::Any, &proposal, settings)?;
                Ok((sampler.sums(start..end), limits[0].counts.get()))
            };
            let chunks = number.div_ceil(CHUNK) as usize;
            for part in pool::run(sampling.threads, size, chunks, || (), piece)? {
                let (part, part_counts) = part?;
                counts.merge(&part_counts);
                match &mut sums {
                    Some(sums) => sums.join(&part),
                    None => sums = Some(part),
                }
            }
            self.responses().go_on()?;
            first += number;
            let unseen = match without_design_point.is_empty() {
                true => 0.0,
                false => -UNSEEN.ln() / (PLAIN * first as f64),
            };
            let Some(mut failure) = sums.as_ref().map(|sums| all.estimate(sums)) else {
                continue;
            };
            let target = settings.coefficient_of_variation * failure.probability.value;
            failure.reached &= unseen <= target;
            if failure.reached || first >= settings.samples {
                return Ok(RareFailure {
                    failure,
                    without_design_point,
                    unseen,
                    judgement: about.judgement,
                    counts,
                    centres: centres.len(),
                    inputs: state.inputs.clone(),
                    description: state.description.clone(),
                });
            }
        }
    }

    fn whole(&self) -> Whole<'_> {
        Whole {
            requirements: self,
            room: RefCell::new(self.responses().workspace()),
            counts: Cell::new(Counts::default()),
        }
    }
}

/// All requirements as one limit state that only tells whether they are met.
struct Whole<'a> {
    requirements: &'a Requirements<'a>,
    room: RefCell<Workspace>,
    counts: Cell<Counts>,
}

impl Whole<'_> {
    fn count(&self, outcome: Outcome) {
        let mut counts = self.counts.get();
        counts.add(outcome, 1);
        self.counts.set(counts);
    }
}

impl LimitState for Whole<'_> {
    type Error = String;

    fn dimension(&self) -> usize {
        self.requirements.deviations().dimension()
    }

    fn evaluate(&self, z: &[f64]) -> Result<LimitValue, String> {
        let value = self.value(z)?;
        let gradient = vec![0.0; z.len()];
        Ok(LimitValue { value, gradient })
    }

    fn value(&self, z: &[f64]) -> Result<f64, String> {
        let design = self.requirements.deviations().design(z);
        let responses = self.requirements.responses();
        let realisation = responses.at(&mut self.room.borrow_mut(), &design);
        let realisation = realisation.map_err(|error| error.to_string())?;
        self.count(realisation.outcome);
        match all_met(&self.requirements.each_met(&design, &realisation)) {
            Some(true) => Ok(1.0),
            Some(false) => Ok(-1.0),
            None => Err("the design has no response to tell".to_owned()),
        }
    }
}
