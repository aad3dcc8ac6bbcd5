//! Failure probabilities by sampling: plain Monte Carlo, and importance sampling around design points.

mod interval;
mod proposal;
mod sums;

use core::ops::Range;

pub use interval::{Interval, clopper_pearson, wilson};
pub use proposal::Proposal;
pub use sums::{Estimate, SampleSums};

use super::limit_state::LimitState;
use super::random::NormalSamples;
use crate::Error;

/// The meaning of failure for several limit states.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Failure {
    /// Any limit state fails: a series system, whose requirements must all be met.
    Any,
    /// All limit states fail: a parallel system.
    All,
}

/// Which samples to draw and when to stop.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SamplingSettings {
    /// Seed of all samples.
    pub seed: u64,
    /// Stream; samples of different streams of a seed are independent.
    pub stream: u64,
    /// Maximum number of samples.
    pub samples: u64,
    /// Number of samples between checks of the coefficient of variation.
    pub batch: u64,
    /// Target coefficient of variation of the probability, at which sampling stops; zero draws all samples.
    pub coefficient_of_variation: f64,
}

impl Default for SamplingSettings {
    fn default() -> Self {
        Self { seed: 1, stream: 0, samples: 1_000_000, batch: 1000, coefficient_of_variation: 0.05 }
    }
}

/// Fewer failures say nothing about the coefficient of variation.
const FAILURES: u64 = 10;

/// Limit that keeps sums of squared weights finite. Only samples so far on the safe side of a distant design point that
/// none of them will ever fail have larger weights.
const GREATEST_LN_WEIGHT: f64 = 300.0;

/// A failure probability estimated from samples.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SampledProbability {
    /// Failure probability. Samples without a value do not count as failures.
    pub probability: Estimate,
    /// Natural logarithm of the probability, valid even if the probability underflows; `None` without failures.
    pub ln_probability: Option<f64>,
    /// Standard error relative to the probability; `None` without failures.
    pub coefficient_of_variation: Option<f64>,
    /// Whether the target coefficient of variation was reached.
    pub reached: bool,
    /// Number of samples drawn.
    pub samples: u64,
    /// Number of samples that failed.
    pub failures: u64,
    /// Number of samples whose limit states lack the value needed to decide.
    pub without_value: u64,
    /// Probability that the deciding value is missing.
    pub probability_without_value: Estimate,
    /// Derivatives of the failure probability with respect to the mean of each standard normal variable, from the score
    /// function (Rubinstein 1986, *The score function approach for sensitivity analysis*): `E[1(failure) z_i]`.
    pub by_mean: Vec<Estimate>,
    /// Derivatives with respect to the standard deviation of each variable: `E[1(failure) (z_i^2 - 1)]`.
    pub by_sigma: Vec<Estimate>,
}

/// Draws samples and evaluates limit states at them.
#[derive(Clone, Debug)]
pub struct Sampler<'a, L> {
    limits: &'a [L],
    failure: Failure,
    proposal: &'a Proposal,
    settings: &'a SamplingSettings,
}

impl<'a, L: LimitState> Sampler<'a, L> {
    /// Prepares to sample one or several limit states of the same variables.
    ///
    /// # Errors
    ///
    /// If there are no limit states, if their number of variables differs from that of the proposal, or if a setting is
    /// invalid.
    pub fn new(
        limits: &'a [L],
        failure: Failure,
        proposal: &'a Proposal,
        settings: &'a SamplingSettings,
    ) -> Result<Self, Error> {
        let wrong = |setting, reason: String| Err(Error::Setting { setting, reason });
        if limits.is_empty() {
            return wrong("limits", "at least one is needed".into());
        }
        for limit in limits {
            if limit.dimension() != proposal.dimension() {
                return Err(Error::WrongLength {
                    kind: "variables of a limit state",
                    found: limit.dimension(),
                    expected: proposal.dimension(),
                });
            }
        }
        if settings.samples == 0 || settings.batch == 0 {
            return wrong("samples", "at least one is needed, in batches of one".into());
        }
        let wished = settings.coefficient_of_variation;
        if !(wished >= 0.0 && wished.is_finite()) {
            return wrong("coefficient_of_variation", format!("{wished} is negative or not finite"));
        }
        Ok(Self { limits, failure, proposal, settings })
    }

    /// The sums over samples `range`, each of which depends only on seed, stream and its number.
    pub fn sums(&self, range: Range<u64>) -> SampleSums {
        let SamplingSettings { seed, stream, .. } = *self.settings;
        let dimension = self.proposal.dimension();
        let mut samples = NormalSamples::new(seed, stream, range.start, dimension);
        let mut sums = SampleSums::new(dimension);
        let ln_scale = self.proposal.ln_scale();
        let mut z = vec![0.0; dimension];
        for _ in range {
            let ln_weight = self.proposal.draw(&mut samples, &mut z) - ln_scale;
            let weight = ln_weight.min(GREATEST_LN_WEIGHT).exp();
            sums.samples += 1;
            match self.fails(&z) {
                Some(true) => sums.add_failure(&z, weight),
                Some(false) => {}
                None => sums.add_without_value(weight),
            }
        }
        sums
    }

    /// Whether the system fails, if it can be told.
    fn fails(&self, z: &[f64]) -> Option<bool> {
        let decides = self.failure == Failure::Any;
        let mut unknown = false;
        for limit in self.limits {
            match limit.value(z) {
                Ok(value) if value.is_nan() => unknown = true,
                Ok(value) if (value <= 0.0) == decides => return Some(decides),
                Ok(_) => {}
                Err(_) => unknown = true,
            }
        }
        (!unknown).then_some(!decides)
    }

    /// The estimate from sums over any ranges.
    pub fn estimate(&self, sums: &SampleSums) -> SampledProbability {
        let ln_scale = self.proposal.ln_scale();
        let scale = ln_scale.exp();
        let mean = |moments: &sums::Moments| {
            let mean = moments.mean(sums.samples.max(1));
            Estimate { value: scale * mean.value, standard_error: scale * mean.standard_error }
        };
        let relative = sums.weights.mean(sums.samples.max(1));
        let some = relative.value > 0.0;
        let variation = some.then(|| relative.standard_error / relative.value);
        let wished = self.settings.coefficient_of_variation;
        SampledProbability {
            probability: mean(&sums.weights),
            ln_probability: some.then(|| ln_scale + relative.value.ln()),
            coefficient_of_variation: variation,
            reached: sums.failures >= FAILURES && variation.is_some_and(|v| v <= wished),
            samples: sums.samples,
            failures: sums.failures,
            without_value: sums.without_value,
            probability_without_value: mean(&sums.weights_without_value),
            by_mean: sums.by_mean.iter().map(mean).collect(),
            by_sigma: sums.by_sigma.iter().map(mean).collect(),
        }
    }

    /// Draws batches until the target coefficient of variation or the maximum number of samples is reached.
    ///
    /// # Examples
    ///
    /// ```
    /// use core::convert::Infallible;
    /// use eigentol_statistics::reliability::sampling::{Failure, Proposal, Sampler, SamplingSettings};
    /// use eigentol_statistics::reliability::{FormSettings, LimitFunction, LimitValue, form};
    ///
    /// let limits = [LimitFunction::new(1, |z: &[f64]| {
    ///     Ok::<_, Infallible>(LimitValue { value: 6.0 - z[0], gradient: vec![-1.0] })
    /// })];
    /// let at = form(&limits[0], &FormSettings::default())?.design_point;
    /// let proposal = Proposal::around(&[at])?;
    /// let settings = SamplingSettings::default();
    /// let sampler = Sampler::new(&limits, Failure::Any, &proposal, &settings)?;
    /// let found = sampler.run();
    /// assert!(found.reached && found.samples < 5000);
    /// assert!((found.probability.value / 9.865876e-10 - 1.0).abs() < 0.15);
    /// # Ok::<(), eigentol_statistics::Error>(())
    /// ```
    pub fn run(&self) -> SampledProbability {
        let SamplingSettings { samples, batch, .. } = *self.settings;
        let mut sums = SampleSums::new(self.proposal.dimension());
        loop {
            let first = sums.samples;
            sums.join(&self.sums(first..samples.min(first.saturating_add(batch))));
            let estimate = self.estimate(&sums);
            if estimate.reached || sums.samples >= samples {
                return estimate;
            }
        }
    }
}
