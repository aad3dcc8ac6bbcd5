//! The search for the cheapest tolerances.

use core::cell::RefCell;

use eigentol_statistics::normal;
use slsqp::{Func, StopTols, minimize};

use super::choices::Choices;
use super::problem::{Evaluated, Problem, Reached, Search};
use crate::requirement::{Chances, FormSettings, Reliability, Requirements, chances_of, check, judge, reliability_of};
use crate::tolerance::Sampling;
use crate::{Description, Error, Shared, Vector, Watch};

/// A shortfall of the reliability index up to this value is accepted.
const ENOUGH: f64 = 1e-6;
/// Penalty on a reliability-index shortfall of 1, as a multiple of the cost.
const PENALTY: f64 = 1e3;
/// Maximum number of evaluations of the optimiser.
const EVALUATIONS: usize = 500;
/// Samples refute an allocation if the interval of this confidence lies above the allowed probability.
const CONFIDENCE: f64 = 0.99;

/// The cheapest tolerances found.
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
    /// Sum of the costs of the tolerances at the start.
    pub cost_before: f64,
    /// Maximum failure probability of each requirement.
    pub failure: Vec<f64>,
    /// Reliability of the result, with all design points searched anew.
    pub reliability: Reliability,
    /// Probabilities of meeting the requirements, from samples of the result.
    pub chances: Chances,
    /// Requirements refuted by the samples: their 99 % Clopper-Pearson interval lies above the allowed probability.
    /// First order has then failed; allow a smaller probability.
    pub refuted: Vec<usize>,
    /// Number of choices tried.
    pub evaluations: usize,
    /// Whether the search was stopped, so that cheaper choices may exist.
    pub stopped: bool,
    /// The inputs of the operating point, SI.
    pub inputs: Vector,
    /// The mechanism it belongs to.
    pub description: Shared<Description>,
}

/// Finds the cheapest of the allowed tolerances, starting from those of `requirements`.
///
/// Each requirement fails with at most the allowed probability to first order; if it has several limits or failure
/// regions, their probabilities are summed. A requirement without a limit
/// ([`Requirement::Stable`](crate::requirement::Requirement::Stable)) is checked by samples only.
///
/// # Errors
/// [`Error::Infeasible`] if no choice is reliable enough; [`Error::Setting`], [`Error::WrongLength`] and
/// [`Error::UnknownHandle`] for invalid choices or a cost that is not finite; the errors of
/// [`Requirements::reliability`]; [`Error::NoReliability`] if a limit has no design point at the start although designs
/// may fail; [`Error::Stopped`] if the search is stopped ([`Sampling::stop`]) before any choice was reliable enough. If
/// stopped later, it returns the best choice so far.
pub fn allocate(
    requirements: &Requirements<'_>,
    choices: &Choices<'_>,
    sampling: &Sampling<'_>,
) -> Result<Allocation, Error> {
    choices.check(requirements)?;
    let deviations = requirements.deviations();
    check(requirements, deviations)?;
    let state = requirements.responses().nominal();
    let (nominal, half_widths) = choices.start(&state.design, deviations.tolerances().half_widths());
    let mut problem =
        Problem { search: Search::Single, limits: requirements.limits(), requirements, choices, nominal, half_widths };
    let watch = sampling.watch();
    let reliability_at = |design: &(Vector, Vector)| {
        let moved = deviations.moved(&design.0, &design.1);
        reliability_of(requirements, &moved, &FormSettings::default())
    };
    let mut optimum = search(&problem, watch)?;
    let mut reliability = reliability_at(&problem.design(&optimum.x))?;
    let mut evaluations = optimum.evaluations;
    if !watch.stopped() && !reaches(&reliability, &choices.failure) {
        problem.search = Search::Thorough;
        optimum = search(&problem, watch)?;
        reliability = reliability_at(&problem.design(&optimum.x))?;
        evaluations += optimum.evaluations;
    }
    let (nominal, half_widths) = problem.design(&optimum.x);
    let stopped = watch.stopped();
    if let Some(worst) = optimum.best.worst().filter(|reached| reached.shortfall() > ENOUGH) {
        if stopped {
            return Err(Error::Stopped);
        }
        return Err(Error::Infeasible {
            nominal: nominal.into(),
            half_widths: half_widths.into(),
            requirement: worst.requirement,
            probability: normal::cdf(-worst.beta),
            wanted: choices.failure[worst.requirement],
        });
    }
    let moved = deviations.moved(&nominal, &half_widths);
    judge(requirements, &moved, &mut reliability)?;
    let chances = chances_of(requirements, &moved, sampling)?;
    let mut refuted = Vec::new();
    for (k, (tally, allowed)) in chances.each.iter().zip(&choices.failure).enumerate() {
        if tally.clopper_pearson(CONFIDENCE)?.lower > *allowed {
            refuted.push(k);
        }
    }
    Ok(Allocation {
        reliability,
        nominal,
        half_widths,
        cost: optimum.best.cost,
        cost_before: optimum.cost_before,
        failure: choices.failure.clone(),
        chances,
        refuted,
        evaluations,
        stopped,
        inputs: state.inputs.clone(),
        description: state.description.clone(),
    })
}

/// Whether each requirement is as reliable as it must be, all failure regions taken together.
fn reaches(reliability: &Reliability, failure: &[f64]) -> bool {
    let enough = |(k, allowed): (usize, &f64)| {
        let beta = reliability.beta_of(k);
        beta.is_none_or(|beta| -normal::quantile(*allowed) - beta <= 2.0 * ENOUGH)
    };
    failure.iter().enumerate().all(enough)
}

/// The result of a search: the best choice, its evaluation, the cost at the start, and the number of choices tried.
struct Optimum {
    x: Vec<f64>,
    best: Evaluated,
    cost_before: f64,
    evaluations: usize,
}

fn search(problem: &Problem<'_>, watch: Watch<'_>) -> Result<Optimum, Error> {
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
        let Some(evaluation) = progress.at(problem, watch, x) else {
            return f64::INFINITY;
        };
        if let Some(gradient) = gradient {
            for (entry, slope) in gradient.iter_mut().zip(&evaluation.cost_slopes) {
                *entry = slope / scale;
            }
        }
        evaluation.cost / scale
    };
    let constraints: Vec<_> = (0..constrained)
        .map(|k| {
            let progress = &progress;
            move |x: &[f64], gradient: Option<&mut [f64]>, (): &mut ()| {
                let mut progress = progress.borrow_mut();
                let Some(requirement) =
                    progress.at(problem, watch, x).and_then(|evaluation| evaluation.requirements.get(k))
                else {
                    return f64::INFINITY;
                };
                if let Some(gradient) = gradient {
                    for (entry, slope) in gradient.iter_mut().zip(&requirement.slopes) {
                        *entry = -slope;
                    }
                }
                shortfall(requirement)
            }
        })
        .collect();
    let constraints: Vec<&dyn Func<()>> = constraints.iter().map(|constraint| constraint as &dyn Func<()>).collect();
    let stop = StopTols { xtol_abs: vec![1e-10; start.len()], ..StopTols::default() };
    // However the optimiser ends, the best choice on the way counts: it mistakes rounding for a violated constraint.
    let _ = minimize(objective, &start, &bounds, &constraints, (), EVALUATIONS, Some(stop));
    let progress = progress.into_inner();
    let (x, best) = progress.best;
    Ok(Optimum { x, best, cost_before: before, evaluations: progress.tried })
}

/// The shortfall passed to the optimiser: finite even if nothing fails.
fn shortfall(reached: &Reached) -> f64 {
    reached.shortfall().max(-1e3)
}

/// Caches the last evaluation, because the optimiser queries cost and constraints of a choice one after the other.
struct Progress {
    last_choice: Vec<f64>,
    last: Option<Evaluated>,
    /// The cheapest choice that is reliable enough, or else the most reliable one.
    best: (Vec<f64>, Evaluated),
    tried: usize,
}

impl Progress {
    /// Evaluates a choice; returns nothing once the search is stopped, which soon ends it.
    fn at(&mut self, problem: &Problem<'_>, watch: Watch<'_>, x: &[f64]) -> Option<&Evaluated> {
        if watch.stopped() {
            return None;
        }
        if self.last_choice != x {
            watch.advance(1);
            self.last_choice = x.to_vec();
            self.tried += 1;
            self.last = x.iter().all(|x| x.is_finite()).then(|| problem.evaluate(x).ok()).flatten();
            if let Some(last) = &self.last
                && better(last, &self.best.1)
            {
                self.best = (x.to_vec(), last.clone());
            }
        }
        self.last.as_ref()
    }
}

/// Whether `new` is better: of two sufficiently reliable choices the cheaper one, with a penalty on shortfall that
/// outweighs its savings.
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
