//! Checks first and second order against re-solved samples: as many as a decision needs, within a budget.

use super::chances::{Chance, Sampled, Sampling};
use super::paired::Paired;
use super::verdict::Check;
use crate::algebra::Vector;
use crate::judge::{Measured, TRUSTED_SIGMA_ERROR, operations, together};
use crate::kernels::SummaryKernels;
use crate::second_order::Quadratic;
use crate::sensitivity::Quantity;
use crate::tolerance::{self, Counts, Outcome, Sample, Tolerances, monte_carlo};
use crate::{Equilibrium, Error, Modes, Watch};

/// Successive numbers of samples; the next is used if the last did not decide.
const STAGES: [usize; 5] = [256, 1024, 4096, 16_384, 65_536];
/// Minimum number of samples for a decision, and the number where rare samples matter. Quantities without values do not
/// count.
const DECISIVE: usize = 1024;
const DECISIVE_IN_DOUBT: usize = 4096;
/// Maximum number of samples drawn at once.
const TOGETHER: usize = 8192;
/// The error of a standard deviation that separates right from wrong.
const LIMIT: f64 = 0.03;
/// A smaller error is not rejected.
const GOOD: f64 = 0.01;
/// An error this many standard errors away from the limit is clearly below or above it.
const CLEARLY: f64 = 4.0;
/// With a standard error of the error this small, the case is decided.
const FINE: f64 = 0.004;
/// A standard deviation needs at least this many values.
pub(super) const FEWEST: usize = 128;
/// Standard deviations below this, relative to the quantity, are rounding errors.
pub(super) const ROUNDING: f64 = 1e-10;

/// A quantity to check, and its predictions.
pub(super) struct Prediction<'a> {
    pub(super) mode: usize,
    pub(super) quantity: Quantity,
    pub(super) nominal: f64,
    /// Magnitude of the quantity: a spread much smaller is rounding.
    pub(super) size: f64,
    /// Derivatives with respect to the design variables.
    pub(super) slopes: Option<Vector>,
    /// The first-order standard deviation that follows from them.
    pub(super) sigma: f64,
    pub(super) second: Option<&'a Quadratic>,
    /// Whether a critical state, critical damping or another mode is near, so that rare samples may matter.
    pub(super) doubtful: bool,
}

/// The nominal state about which samples are drawn.
pub(super) struct About<'a> {
    pub(super) mechanism: &'a dyn SummaryKernels,
    pub(super) at: &'a Equilibrium,
    pub(super) modes: &'a Modes,
    pub(super) tolerances: &'a Tolerances,
    pub(super) watch: Watch<'a>,
}

/// The result: a check of each prediction for which there are enough values, and the number of values.
pub(super) struct SampledChecks {
    pub(super) checks: Vec<Option<Check>>,
    pub(super) counts: Vec<usize>,
    /// For each group, the number of samples in which its modes are not in nominal order.
    pub(super) exchanged: Vec<usize>,
    pub(super) sampling: Sampling,
}

impl About<'_> {
    /// Draws samples until every prediction is decided or the operation budget is spent.
    pub(super) fn sample(
        &self,
        predictions: &[Prediction<'_>],
        groups: &[&[usize]],
        budget: f64,
    ) -> Result<SampledChecks, Error> {
        let mut exchanged = vec![0; groups.len()];
        let mut pairs = vec![Paired::new(); predictions.len()];
        let outcome = |pairs: &[Paired], exchanged, sampling| SampledChecks {
            exchanged,
            checks: (predictions.iter().zip(pairs)).map(|(prediction, paired)| check(prediction, paired)).collect(),
            counts: pairs.iter().map(Paired::count).collect(),
            sampling,
        };
        if predictions.is_empty() || !self.tolerances.vary() {
            return Ok(outcome(&pairs, exchanged, Sampling::NotNeeded));
        }
        let mut each = operations(self.modes, together(self.modes));
        let mut counts = Counts::default();
        let mut elsewhere = 0;
        let mut stream = 0;
        for stage in STAGES {
            if stage.max(DECISIVE) as f64 * each > budget {
                break;
            }
            while counts.total() < stage {
                let sampling = tolerance::Sampling::default()
                    .samples(TOGETHER.min(stage - counts.total()))
                    .stream(stream)
                    .keep_samples(true)
                    .progress(self.watch.progress)
                    .stop(self.watch.stop);
                let Self { mechanism, at, modes, tolerances, .. } = *self;
                let run = monte_carlo(mechanism, at, modes, tolerances, &sampling)?;
                if self.watch.stopped() {
                    return Err(Error::Stopped);
                }
                stream += 1;
                counts.merge(&run.counts);
                elsewhere += run.left_nominal_branch;
                each = operations(self.modes, run.side_by_side);
                for sample in run.all.iter().flatten() {
                    self.look_at(sample, predictions, &mut pairs);
                    for (group, exchanged) in groups.iter().zip(&mut exchanged) {
                        *exchanged += usize::from(!self.in_order(group, sample));
                    }
                }
            }
            let open = |(prediction, paired): (&Prediction<'_>, &Paired)| {
                let decisive = if prediction.doubtful { DECISIVE_IN_DOUBT } else { DECISIVE };
                check(prediction, paired).is_some_and(|check| stage < decisive || !decided(&check))
            };
            if !predictions.iter().zip(&pairs).any(open) {
                break;
            }
        }
        let samples = counts.total();
        if samples == 0 {
            let operations = DECISIVE as f64 * each;
            return Ok(outcome(&pairs, exchanged, Sampling::TooDear { operations, budget }));
        }
        let other_branch = (self.at.stability.holds()).then(|| Chance::new(elsewhere, samples)).transpose()?;
        let sampled = Sampled::new(&counts, other_branch)?;
        Ok(outcome(&pairs, exchanged, Sampling::Done(sampled)))
    }

    fn look_at(&self, sample: &Sample, predictions: &[Prediction<'_>], pairs: &mut [Paired]) {
        let change: Vector =
            (sample.design.iter().zip(&self.at.design)).map(|(value, nominal)| value - nominal).collect();
        for (prediction, paired) in predictions.iter().zip(pairs) {
            let values = match prediction.quantity {
                Quantity::DampingRatio => &sample.damping_ratios,
                _ => &sample.frequencies,
            };
            let observed = values.get(prediction.mode).copied().flatten();
            let observed = observed.filter(|_| sample.outcome == Outcome::from(self.at.stability));
            let first = prediction
                .slopes
                .as_ref()
                .map_or(0.0, |slopes| slopes.iter().zip(&change).map(|(slope, x)| slope * x).sum());
            let second = prediction.second.map_or(0.0, |model| model.change(&change));
            paired.add(observed.map(|value| value - prediction.nominal), first, second);
        }
    }

    /// Whether the frequencies of these modes are in nominal order in a sample.
    fn in_order(&self, group: &[usize], sample: &Sample) -> bool {
        let both = |mode: &usize| {
            let nominal = self.modes.modes.get(*mode)?.frequency().unwrap_or(0.0);
            Some((nominal, sample.frequencies.get(*mode).copied().flatten()?))
        };
        let frequencies: Vec<(f64, f64)> = group.iter().filter_map(both).collect();
        let pairs = (0..frequencies.len()).flat_map(|i| (0..i).map(move |j| (i, j)));
        let turned =
            |(i, j): (usize, usize)| (frequencies[i].0 < frequencies[j].0) != (frequencies[i].1 < frequencies[j].1);
        !pairs.into_iter().any(turned)
    }
}

/// Checks a prediction against the samples; `None` if there are too few, or if nothing varies.
fn check(prediction: &Prediction<'_>, paired: &Paired) -> Option<Check> {
    let (count, sigma) = (paired.count(), paired.sigma()?);
    if count < FEWEST || sigma.value <= ROUNDING * prediction.size {
        return None;
    }
    let error = |ratio: Measured| Measured { value: ratio.value - 1.0, ..ratio };
    let representative = prediction.slopes.is_none() || paired.represents(prediction.sigma);
    let (first, second) = (prediction.slopes.as_deref(), prediction.second);
    let first = first.filter(|_| representative);
    let second = second.filter(|_| representative);
    Some(Check {
        representative,
        quantity: prediction.quantity,
        samples: paired.samples(),
        count,
        mean: prediction.nominal + paired.mean()?,
        sigma,
        first_order_error: first.and_then(|_| paired.first_ratio()).map(error),
        second_order_error: second.and_then(|_| paired.second_ratio()).map(error),
    })
}

fn decided(check: &Check) -> bool {
    check.representative
        && check.first_order_error.is_none_or(|error| {
            let beyond = (error.value.abs() - LIMIT).abs();
            beyond > CLEARLY * error.standard_error || error.standard_error < FINE
        })
}

/// What samples say about first order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Finding {
    Right,
    Wrong,
    /// Too few samples to tell.
    Open,
}

/// Judges the error of a standard deviation: right if it is below the limit and, with two standard errors, below
/// [`TRUSTED_SIGMA_ERROR`].
pub(super) fn finding(error: Measured) -> Finding {
    let (size, uncertain) = (error.value.abs(), 2.0 * error.standard_error);
    if size <= LIMIT && size + uncertain <= TRUSTED_SIGMA_ERROR {
        Finding::Right
    } else if size > LIMIT && size - uncertain >= GOOD {
        Finding::Wrong
    } else {
        Finding::Open
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn measured(value: f64, standard_error: f64) -> Measured {
        Measured { value, standard_error }
    }

    #[test]
    fn an_error_decides_when_it_is_clear_or_fine() {
        let decides = |first_order_error| {
            decided(&Check {
                quantity: Quantity::Frequency,
                samples: 1024,
                count: 1024,
                mean: 1.0,
                sigma: measured(0.1, 0.002),
                first_order_error,
                second_order_error: None,
                representative: true,
            })
        };
        assert!(decides(None));
        for (value, error, decided) in [
            (0.03, 0.0039, true),
            (0.03, 0.0041, false),
            (0.0, 0.0074, true),
            (0.0, 0.0076, false),
            (-0.07, 0.0099, true),
            (-0.07, 0.0101, false),
        ] {
            assert_eq!(decides(Some(measured(value, error))), decided, "{value} {error}");
        }
    }

    #[test]
    fn findings_take_the_uncertainty_into_account() {
        for (value, error, expected) in [
            (0.0, 0.024, Finding::Right),
            (0.0, 0.026, Finding::Open),
            (-0.029, 0.01, Finding::Right),
            (-0.029, 0.011, Finding::Open),
            (0.031, 0.01, Finding::Wrong),
            (0.031, 0.011, Finding::Open),
            (-0.2, 0.09, Finding::Wrong),
            (-0.2, 0.1, Finding::Open),
        ] {
            assert_eq!(finding(measured(value, error)), expected, "{value} {error}");
        }
    }
}
