//! The search for the cheapest tolerances.

use core::cell::RefCell;

use slsqp::{Func, StopTols, minimize};

use super::choices::Choices;
use super::problem::{Evaluated, Problem, Reached};
use crate::requirement::{
    Chances, FormSettings, Reliability, Requirements, chances_of, check, reliability_of,
};
use crate::tolerance::Sampling;
use crate::{Description, Error, Shared, Vector, Watch};

/// A reliability index that falls short by this is reached.
const ENOUGH: f64 = 1e-6;
/// What is missing of a reliability index of 1 counts as so many times the cost.
const PENALTY: f64 = 1e3;
/// Evaluations of the optimiser.
const EVALUATIONS: usize = 500;
/// Samples refute an allocation when the interval of this confidence lies above the allowed probability.
const CONFIDENCE: f64 = 0.99;

/// The cheapest tolerances that were found.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Allocation {
    /// Nominal values of all design variables, SI.
    pub nominal: Vector,
    /// Half-widths of all design variables, SI.
    pub half_widths: Vector,
    /// Sum of the costs.
    pub cost: f64,
    /// The same for the tolerances at the start.
    pub cost_before: f64,
    /// Greatest probability of failing each requirement.
    pub failure: Vec<f64>,
    /// Reliability there, with all design points searched for anew.
    pub reliability: Reliability,
    /// Chances there, from samples.
    pub chances: Chances,
    /// Requirements that the samples refute: the interval of Clopper and Pearson of 99 % lies above what is allowed. First order has
    /// then failed; allow less.
    pub refuted: Vec<usize>,
    /// Choices that the search tried.
    pub evaluations: usize,
    /// The search was stopped: there may be cheaper ones.
    pub stopped: bool,
    /// The inputs it belongs to, SI.
    pub inputs: Vector,
    /// The mechanism it belongs to.
    pub description: Shared<Description>,
}

/// The cheapest of the tolerances that may be chosen, starting from those of `requirements`. Each requirement fails with at most the
/// allowed probability to first order, that of several limits of one being summed; one without a limit
/// ([`Requirement::Stable`](crate::requirement::Requirement::Stable)) is sampled only.
///
/// # Errors
/// [`Error::Infeasible`] where no choice is reliable enough; [`Error::Setting`], [`Error::WrongLength`] and [`Error::UnknownHandle`]
/// for choices that make no sense and a cost that is not finite; what [`Requirements::reliability`] refuses;
/// [`Error::NoReliability`] where a limit has no design point at the start although designs may fail; [`Error::Stopped`] where the
/// search is stopped ([`Sampling::stop`]) before any choice was reliable enough. Later it ends with the best choice until then.
pub fn allocate(
    requirements: &Requirements<'_>,
    choices: &Choices<'_>,
    sampling: &Sampling<'_>,
) -> Result<Allocation, Error> {
    choices.check(requirements)?;
    let deviations = requirements.deviations();
    check(requirements, deviations)?;
    let state = requirements.responses().nominal();
    let (nominal, half_widths) =
        choices.start(&state.design, deviations.tolerances().half_widths());
    let problem = Problem {
        limits: requirements.limits(),
        requirements,
        choices,
        nominal,
        half_widths,
    };
    let watch = sampling.watch();
    let (x, best, before, evaluations) = search(&problem, watch)?;
    let (nominal, half_widths) = problem.design(&x);
    let stopped = watch.stopped();
    if let Some(worst) = best.worst().filter(|own| own.shortfall() > ENOUGH) {
        if stopped {
            return Err(Error::Stopped);
        }
        return Err(Error::Infeasible {
            nominal: nominal.into(),
            half_widths: half_widths.into(),
            requirement: worst.requirement,
            probability: eigentol_statistics::normal::cdf(-worst.beta),
            wanted: choices.failure[worst.requirement],
        });
    }
    let moved = deviations.moved(&nominal, &half_widths);
    let chances = chances_of(requirements, &moved, sampling)?;
    let mut refuted = Vec::new();
    for (k, (tally, allowed)) in chances.each.iter().zip(&choices.failure).enumerate() {
        if tally.clopper_pearson(CONFIDENCE)?.lower > *allowed {
            refuted.push(k);
        }
    }
    Ok(Allocation {
        reliability: reliability_of(requirements, &moved, &FormSettings::default())?,
        nominal,
        half_widths,
        cost: best.cost,
        cost_before: before,
        failure: choices.failure.clone(),
        chances,
        refuted,
        evaluations,
        stopped,
        inputs: state.inputs.clone(),
        description: state.description.clone(),
    })
}

/// The best choice, what it comes to, the cost at the start, and how many were tried.
fn search(
    problem: &Problem<'_>,
    watch: Watch<'_>,
) -> Result<(Vec<f64>, Evaluated, f64, usize), Error> {
    let (start, bounds) = problem.start();
    let first = problem.evaluate(&start)?;
    let (before, scale) = (first.cost, first.cost.abs().max(f64::MIN_POSITIVE));
    let constrained = first.requirements.len();
    let progress = RefCell::new(Progress {
        last: Some(first.clone()),
        last_choice: start.clone(),
        best: (start.clone(), first),
        tried: 1,
    });
    let objective = |x: &[f64], gradient: Option<&mut [f64]>, (): &mut ()| {
        let mut progress = progress.borrow_mut();
        let Some(found) = progress.at(problem, watch, x) else {
            return f64::INFINITY;
        };
        if let Some(gradient) = gradient {
            for (entry, slope) in gradient.iter_mut().zip(&found.cost_slopes) {
                *entry = slope / scale;
            }
        }
        found.cost / scale
    };
    let constraints: Vec<_> = (0..constrained)
        .map(|k| {
            let progress = &progress;
            move |x: &[f64], gradient: Option<&mut [f64]>, (): &mut ()| {
                let mut progress = progress.borrow_mut();
                let Some(own) = progress
                    .at(problem, watch, x)
                    .and_then(|found| found.requirements.get(k))
                else {
                    return f64::INFINITY;
                };
                if let Some(gradient) = gradient {
                    for (entry, slope) in gradient.iter_mut().zip(&own.slopes) {
                        *entry = -slope;
                    }
                }
                shortfall(own)
            }
        })
        .collect();
    let constraints: Vec<&dyn Func<()>> =
        constraints.iter().map(|own| own as &dyn Func<()>).collect();
    let stop = StopTols {
        xtol_abs: vec![1e-10; start.len()],
        ..StopTols::default()
    };
    // Whatever it ends with, the best choice on the way counts: the library takes rounding for a violated constraint.
    let _ = minimize(
        objective,
        &start,
        &bounds,
        &constraints,
        (),
        EVALUATIONS,
        Some(stop),
    );
    let progress = progress.into_inner();
    let (x, best) = progress.best;
    Ok((x, best, before, progress.tried))
}

/// As the optimiser sees it: finite also where nothing fails.
fn shortfall(own: &Reached) -> f64 {
    own.shortfall().max(-1e3)
}

/// Cost and constraints are asked for at the same choice one after the other.
struct Progress {
    last_choice: Vec<f64>,
    last: Option<Evaluated>,
    /// The cheapest that is reliable enough, or else the most reliable.
    best: (Vec<f64>, Evaluated),
    tried: usize,
}

impl Progress {
    /// What a choice comes to; nothing any more when the search is stopped, which ends it soon.
    fn at(&mut self, problem: &Problem<'_>, watch: Watch<'_>, x: &[f64]) -> Option<&Evaluated> {
        if watch.stopped() {
            return None;
        }
        if self.last_choice != x {
            watch.advance(1);
            self.last_choice = x.to_vec();
            self.tried += 1;
            let finite = x.iter().all(|x| x.is_finite());
            self.last = finite.then(|| problem.evaluate(x).ok()).flatten();
            if let Some(last) = &self.last
                && better(last, &self.best.1)
            {
                self.best = (x.to_vec(), last.clone());
            }
        }
        self.last.as_ref()
    }
}

/// Of two choices that are reliable enough the cheaper one, what is missing counted at more than it can save.
fn better(new: &Evaluated, old: &Evaluated) -> bool {
    match (new.shortfall() <= ENOUGH, old.shortfall() <= ENOUGH) {
        (true, true) => {
            let unit = PENALTY * new.cost.abs().max(old.cost.abs());
            new.cost + unit * new.shortfall().max(0.0) < old.cost + unit * old.shortfall().max(0.0)
        }
        (false, false) => new.shortfall() < old.shortfall(),
        (new, _) => new,
    }
}
