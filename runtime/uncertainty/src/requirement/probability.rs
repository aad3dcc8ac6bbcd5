//! How probable it is that requirements are failed, by whatever finds it out.

use eigentol_statistics::Distribution;
use eigentol_statistics::reliability::FormSettings;
use eigentol_statistics::reliability::sampling::Interval;

use super::chances::{Chances, Tally, chances_of};
use super::kinds::Requirement;
use super::reliability::{Reliability, judge_requirements, reliability_of};
use super::requirements::Requirements;
use crate::algebra::Vector;
use crate::judge::{Judged, Judgement, TRUSTED_PROBABILITY_ERROR};
use crate::tolerance::Sampling;
use crate::{Description, Error, Shared};

/// Confidence of the intervals.
const CONFIDENCE: f64 = 0.95;
/// Probabilities below this are as good as none.
const NEGLIGIBLE: f64 = 1e-12;

/// How a probability of failure was found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum EstimatedBy {
    /// By design points, which describe the failure as lines of designs confirm. The number is that of the lines; what
    /// the design points say of it ([`Probabilities::reliability`]) can be relied on: importance and derivatives.
    DesignPoint,
    /// By lines of designs solved anew, where there are no design points or these do not describe the failure.
    Lines,
    /// By plain samples, where a variable takes discrete values or lines tell less.
    Samples,
}

/// A probability of failure.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct FailureProbability {
    /// The probability.
    pub value: f64,
    /// 95 % confidence interval. No model is behind it: every design is solved anew.
    pub interval: Interval,
    /// Probability that a design lacks the response needed to tell; such designs do not count as failures.
    pub untold: f64,
    /// How it was found.
    pub by: EstimatedBy,
    /// Number of designs solved for it, those of the search for design points not counted.
    pub designs: u64,
}

impl FailureProbability {
    fn of_lines(judged: &Judged, described: bool) -> Self {
        Self {
            value: judged.probability.value,
            interval: judged.interval(),
            untold: judged.untold.value.min(1.0),
            by: match described {
                _ if judged.lines == 0 => EstimatedBy::Samples,
                true => EstimatedBy::DesignPoint,
                false => EstimatedBy::Lines,
            },
            designs: judged.designs,
        }
    }

    fn width(&self) -> f64 {
        self.interval.upper - self.interval.lower
    }

    /// Whether it is known better than a model has to be for it to be trusted.
    fn is_sharp(&self) -> bool {
        self.width() <= (2.0 * TRUSTED_PROBABILITY_ERROR * self.value).max(NEGLIGIBLE)
    }

    fn of_samples(tally: &Tally) -> Result<Self, Error> {
        let samples = tally.samples();
        Ok(Self {
            value: tally.failure(),
            interval: tally.clopper_pearson(CONFIDENCE)?,
            untold: tally.untold as f64 / samples as f64,
            by: EstimatedBy::Samples,
            designs: samples as u64,
        })
    }
}

/// How probable it is that requirements are failed.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Probabilities {
    /// The requirements.
    pub wanted: Vec<Requirement>,
    /// Probability of failing each of them.
    pub each: Vec<FailureProbability>,
    /// Probability of failing any of them.
    pub any: FailureProbability,
    /// The design points, if there can be any: the most probable ways to fail, and what changes their probability.
    pub reliability: Option<Reliability>,
    /// The plain samples, if any were drawn.
    pub chances: Option<Chances>,
    /// The inputs of the operating point, SI.
    pub inputs: Vector,
    /// The mechanism it belongs to.
    pub description: Shared<Description>,
}

/// Where each evaluation takes a search along an input, a few starts must do.
fn of_searches() -> FormSettings {
    FormSettings { optimiser_evaluations: 20, iterations: 15, restarts: 2, regions: 3, ..FormSettings::default() }
}

impl Requirements<'_> {
    /// How probable it is that each requirement, and that any, is failed: by design points and lines of designs along
    /// them, which also settle small probabilities; by plain samples, with the settings of `sampling`, where these tell
    /// more. Nothing needs to be chosen: [`FailureProbability::by`] tells which way was taken.
    ///
    /// # Errors
    /// [`Error::Setting`] if no tolerance is declared; [`Error::NoDesignTells`] if no design that was solved has the
    /// response of a requirement; [`Error::Setting`] for the flutter of a mode that has none where another has;
    /// those of [`Self::chances`]; [`Error::Stopped`].
    pub fn probabilities(&self, sampling: &Sampling<'_>) -> Result<Probabilities, Error> {
        let (deviations, state) = (self.deviations(), self.responses().nominal());
        let tolerances = deviations.tolerances();
        if !tolerances.vary() {
            return Err(Error::setting("tolerances", "no tolerance is declared, so nothing is left to chance"));
        }
        self.check_flutter()?;
        let continuous = tolerances
            .joint()
            .map(|(joint, _)| joint.variables())
            .is_none_or(|all| all.iter().all(Distribution::is_continuous));
        let mut reliability = None;
        let mut judgements: Vec<(Judgement, bool)> = Vec::new();
        if continuous {
            let settings = match self.responses().price() {
                1 => FormSettings::default(),
                _ => of_searches(),
            };
            let mut form = reliability_of(self, deviations, &settings)?;
            judgements = judge_requirements(self, sampling, &mut form)?;
            reliability = (!form.limits.is_empty()).then_some(form);
        }
        let settled = |index: usize| {
            let (judgement, described) = judgements.get(index)?;
            let judged = judgement.judged().filter(|x| x.settled)?;
            Some(FailureProbability::of_lines(judged, *described))
        };
        let count = self.wanted().len();
        let sharp = |index| settled(index).is_some_and(|chance| chance.is_sharp());
        // Of lines, which are weighted, it cannot be said that none of their designs has a response.
        let chances = if (0..=count).all(sharp) && self.nominal_has_all() {
            None
        } else {
            Some(chances_of(self, deviations, sampling)?)
        };
        let one = |index: usize| {
            let sampled =
                |chances: &Chances| FailureProbability::of_samples(chances.each.get(index).unwrap_or(&chances.all));
            let sampled = chances.as_ref().map(sampled).transpose()?;
            let sharpest = settled(index).into_iter().chain(sampled);
            sharpest.min_by(|a, b| a.width().total_cmp(&b.width())).ok_or(Error::Stopped)
        };
        let each: Vec<FailureProbability> = (0..count).map(one).collect::<Result<_, _>>()?;
        let sampled = chances.iter().flat_map(|chance| &chance.each);
        let nothing = |(failure_probability, tally): (&FailureProbability, &Tally)| {
            failure_probability.value <= NEGLIGIBLE && tally.untold == tally.samples()
        };
        if let Some(index) = each.iter().zip(sampled).position(nothing) {
            return Err(self.untold(index));
        }
        Ok(Probabilities {
            wanted: self.wanted().to_vec(),
            each,
            any: one(count)?,
            reliability,
            chances,
            inputs: state.inputs.clone(),
            description: state.description.clone(),
        })
    }
}
