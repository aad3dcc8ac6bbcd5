//! Parallel sampling of any model, and sample statistics.

use core::ops::Range;

use eigentol_statistics::normal;
use eigentol_statistics::sequence::Sequence;
use eigentol_statistics::summary::{Chunk, Comoments, Covariance, Moments, Partial, Plan, Sketch, Statistics};

use super::model::{Evaluated, Model, TOGETHER};
use super::result::{Estimated, QUANTILES, Quantile, ResponseSpread};
use super::space::Space;
use crate::Error;
use crate::algebra::Vector;
use crate::response::Responses;
use crate::tolerance::gather::{Part, SampleRun};
use crate::tolerance::{Outcome, Sampling, Tolerances};

/// Statistics of some samples, per randomisation: responses first, then the varying design variables.
pub(super) struct Gathered<'a>(pub(super) &'a [Partial]);

/// Reference value and scale of a response for its quantile sketch, SI; any positive scale works.
pub(super) type Scale = (f64, f64);

/// The responses of the nominal design, SI, and the scales expected of their samples.
pub(super) fn nominal_scales(
    responses: &Responses<'_>,
    tolerances: &Tolerances,
) -> Result<(Vec<Option<f64>>, Vec<Scale>), Error> {
    let design = &responses.nominal().design;
    let realisation = responses.with_gradients(&mut responses.workspace(), design)?;
    let slopes = realisation.gradients.iter().map(Option::as_deref);
    let scales = realisation.values.iter().zip(slopes);
    let scales = scales.map(|(value, slopes)| tolerances.scale(*value, slopes));
    let scales = scales.collect();
    Ok((realisation.values, scales))
}

/// The model to sample.
pub(super) struct Task<'a, M> {
    pub(super) model: &'a M,
    pub(super) space: &'a Space<'a>,
    pub(super) scales: Vec<Scale>,
    /// Number of unknowns of the mechanism, which determines the stack size of a thread.
    pub(super) unknowns: usize,
}

impl<M: Model> Task<'_, M> {
    /// The statistics to gather from the samples of each randomisation.
    fn plan(&self) -> Result<Plan, Error> {
        let (responses, variables) = (self.scales.len(), self.space.variables().len());
        let all: Vec<usize> = (0..responses + variables).collect();
        let mut plan = Plan::new(all.len()).covariances(&all[..responses], &all)?.outcomes(Outcome::ALL.len());
        for (k, (reference, scale)) in self.scales.iter().enumerate() {
            plan = plan.sketch(k, *reference, *scale)?;
        }
        Ok(plan)
    }

    /// Solves the requested range of samples, or as many of them as are done when the run is stopped.
    pub(super) fn gather(&self, sampling: &Sampling<'_>) -> Result<Vec<Partial>, Error> {
        let plan = self.plan()?;
        let (of_each, now) = (sampling.of_each()?, sampling.now()?);
        let sequences = (0..sampling.groups())
            .map(|group| sampling.sequence(group, self.space.dimensions()))
            .collect::<Result<Vec<_>, _>>()?;
        let groups: Vec<Range<u64>> = (0..sampling.groups())
            .map(|group| {
                let first = group * of_each;
                let inside = |sample: u64| sample.clamp(first, first + of_each) - first;
                inside(now.start)..inside(now.end)
            })
            .collect();
        let work = SampleRun {
            threads: sampling.threads,
            size: (self.unknowns, self.space.nominal.len()),
            least: 1,
            progress: sampling.progress,
            stop: sampling.stop,
        };
        let room = || self.model.room();
        let solve = |room: &mut M::Room, part: &mut Part<'_, ()>| {
            let sequence = &sequences[part.group];
            self.solve(room, sequence, part)
        };
        let (parts, _) = work.gather(&plan, &groups, room, solve)?;
        Ok(parts)
    }

    /// Solves a chunk of samples.
    fn solve(
        &self,
        room: &mut M::Room,
        sequence: &Sequence,
        Part { chunk, samples, .. }: &mut Part<'_, ()>,
    ) -> Result<(), Error> {
        let mut walk = sequence.from(samples.start);
        let variables = self.space.variables();
        let mut points: Vec<Vector> = Vec::with_capacity(TOGETHER);
        for first in samples.clone().step_by(TOGETHER) {
            points.clear();
            let most = TOGETHER.min((samples.end - first) as usize);
            while points.len() < most {
                let Some(probabilities) = walk.next_point() else {
                    break;
                };
                points.push(self.space.standard(normals(probabilities)));
            }
            self.model
                .evaluate(room, &points, &mut |k, evaluated| take(chunk, first + k as u64, &evaluated, &variables))?;
        }
        Ok(())
    }
}

/// Converts probabilities to standard normal numbers.
pub(super) fn normals(probabilities: &[f64]) -> impl Iterator<Item = f64> {
    probabilities.iter().map(|p| normal::quantile(*p))
}

/// Records the result of a sample.
fn take(
    chunk: &mut Chunk,
    sample: u64,
    Evaluated { design, outcome, values }: &Evaluated<'_>,
    variables: &[usize],
) -> Result<(), Error> {
    chunk.count(*outcome as usize, 1)?;
    for (k, value) in values.iter().enumerate() {
        chunk.set(sample, k, *value)?;
    }
    for (k, &variable) in variables.iter().enumerate() {
        chunk.set(sample, values.len() + k, Some(design[variable]))?;
    }
    Ok(())
}

impl Gathered<'_> {
    /// Number of samples.
    pub(super) fn total(&self) -> u64 {
        self.0.iter().map(|part: &Partial| part.outcomes().iter().sum::<u64>()).sum()
    }

    /// Covariance of two quantities, the first of them a response; `None` where no two samples have both.
    pub(super) fn covariance(&self, first: usize, second: usize) -> Result<Option<f64>, Error> {
        if first == second {
            let all = Statistics::of(&self.moments(first)?, None);
            return Ok(all.and_then(|all: Statistics| Some(all.sigma?.powi(2) * self.divisor(all.count))));
        }
        let mut all = Comoments::default();
        for part in self.0 {
            all.merge(&part.comoments(first, second)?);
        }
        Ok(Covariance::of(&all).and_then(|all: Covariance| Some(all.covariance? * self.divisor(all.count))))
    }

    /// Factor that replaces the variance divisor `n - 1` by the right one for these points. A mean over random points
    /// takes one degree of freedom from a variance; a mean over balanced points is so much more accurate than the
    /// spread that it takes none.
    fn divisor(&self, count: u64) -> f64 {
        let n = count as f64;
        if self.0.len() == 1 { 1.0 } else { (n - 1.0) / n }
    }

    /// Number of samples that have a quantity.
    pub(super) fn count(&self, quantity: usize) -> Result<u64, Error> {
        Ok(self.moments(quantity)?.count())
    }

    fn moments(&self, quantity: usize) -> Result<Moments, Error> {
        let mut all = Moments::default();
        for part in self.0 {
            all.merge(&part.moments(quantity)?);
        }
        Ok(all)
    }

    /// Statistics over the samples of all randomisations.
    fn statistics(&self, quantity: usize) -> Result<Option<Statistics>, Error> {
        let mut sketch: Option<Sketch> = None;
        for part in self.0 {
            let statistics = part.statistics(quantity)?;
            let Some(part_sketch) = statistics.as_ref().and_then(Statistics::sketch) else {
                continue;
            };
            match &mut sketch {
                None => sketch = Some(part_sketch.clone()),
                Some(all) => all.merge(part_sketch)?,
            }
        }
        Ok(Statistics::of(&self.moments(quantity)?, sketch))
    }

    /// The value below which a quantity lies with a given probability; `None` if no sample has it.
    pub(super) fn quantile(&self, quantity: usize, probability: f64) -> Result<Option<f64>, Error> {
        let Some(all) = self.statistics(quantity)? else {
            return Ok(None);
        };
        Ok(Some(all.quantile(probability)?.value))
    }

    /// The spread of a response; `None` if no sample has it.
    pub(super) fn spread(&self, response: usize, nominal: Option<f64>) -> Result<Option<ResponseSpread>, Error> {
        let Some(all) = self.statistics(response)? else {
            return Ok(None);
        };
        let groups = self.groups(response)?;
        let one = self.0.len() == 1;
        let errors = |alone: Option<f64>, of: &dyn Fn(&Statistics) -> Option<f64>| {
            if one { alone } else { scatter(&groups, of) }
        };
        let mut quantiles = Vec::new();
        for probability in QUANTILES {
            let error = if one {
                let ends = all.quantile_interval(probability, ONE_SIGMA)?;
                ends.map(|ends| 0.5 * (ends.upper - ends.lower))
            } else {
                quantile_error(&all, &groups, probability)
            };
            quantiles.push(Quantile { probability, value: all.quantile(probability)?.value, error });
        }
        let total = self.total() as f64;
        let (n, divisor) = (all.count as f64, self.divisor(all.count));
        // The estimate for `n` random values contains the factor `sqrt(n (n - 1)) / (n - 2)` against bias; remove it.
        let unskewed = if one { 1.0 } else { (n - 2.0) / (n * (n - 1.0)).sqrt() };
        Ok(Some(ResponseSpread {
            nominal,
            mean: Estimated::new(all.mean, errors(all.standard_error, &|x| Some(x.mean))),
            sigma: (all.sigma)
                .map(|sigma| Estimated::new(sigma * divisor.sqrt(), errors(all.sigma_error, &|x| x.sigma))),
            skewness: (all.skewness)
                .map(|value| Estimated::new(value * unskewed, errors(all.skewness_error, &|x| x.skewness))),
            quantiles,
            share: all.count as f64 / total,
        }))
    }

    /// Statistics of each randomisation; empty unless all have the same number of samples.
    fn groups(&self, response: usize) -> Result<Vec<Statistics>, Error> {
        let number = |part: &Partial| part.outcomes().iter().sum::<u64>();
        let equal = self.0.windows(2).all(|pair| number(&pair[0]) == number(&pair[1]));
        if !equal {
            return Ok(Vec::new());
        }
        Ok(self.0.iter().map(|part| part.statistics(response)).collect::<Result<Option<_>, _>>()?.unwrap_or_default())
    }
}

/// Probability that a normal variable lies within one standard deviation.
const ONE_SIGMA: f64 = 0.682_689_492_137_085_9;

/// Standard error of a quantile of the samples of all randomisations.
///
/// The shares of samples below it scatter between randomisations. In the tails, where each randomisation has hardly a
/// sample, their own quantiles would not. `None` where not one sample is expected beyond it: the outermost sample then
/// says little about the quantile.
fn quantile_error(all: &Statistics, groups: &[Statistics], probability: f64) -> Option<f64> {
    if all.count as f64 * probability.min(1.0 - probability) < 1.0 {
        return None;
    }
    let quantile = all.quantile(probability).ok()?;
    let share = scatter(groups, &|item| Some(item.sketch()?.cdf(quantile.value).ok()?.value))?;
    // Definitions of a quantile differ by up to half a sample.
    let share = share.hypot(0.5 / all.count as f64);
    let [lower, upper] = [-share, share].map(|change| all.quantile((probability + change).clamp(0.0, 1.0)).ok());
    // In a bucket of the sketch any value is as likely as any other.
    let bucket = quantile.error / 3.0_f64.sqrt();
    Some((0.5 * (upper?.value - lower?.value)).hypot(bucket))
}

/// Standard error of the mean over independent randomisations.
fn scatter(groups: &[Statistics], of: &dyn Fn(&Statistics) -> Option<f64>) -> Option<f64> {
    let values = groups.iter().map(of).collect::<Option<Vec<f64>>>()?;
    Statistics::of(&Moments::of(&values), None)?.standard_error
}
