//! Failure probabilities from design points.

use core::cell::Cell;

use eigentol_statistics::normal;
use eigentol_statistics::reliability::lines::Direction;
use eigentol_statistics::reliability::{FormSettings, failure_regions};

use super::design_point::DesignPoint;
use super::kinds::Requirement;
use super::limit_at::LimitAt;
use super::requirements::{Limit, Requirements, least};
use crate::algebra::{Vector, dot};
use crate::deviations::Deviations;
use crate::judge::{Distance, Event, Judgement, Lines, Unjudged, distances};
use crate::response::Response;
use crate::sensitivity::Quantity;
use crate::tolerance::Sampling;
use crate::{Description, Error, Shared};

/// A limit and its design points.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct LimitReliability {
    /// Position of the requirement that sets it.
    pub requirement: usize,
    /// The limit as a requirement of its own: of a band to stay within, each end is one.
    pub limit: Requirement,
    /// Its design points, most probable first, at least one; or the reason why there are none, for example because no
    /// design within reach fails, or because the centre of the distribution lies inside a forbidden band that can be
    /// left on both sides.
    pub design_points: Result<Vec<DesignPoint>, Error>,
    /// The failure probability by designs solved anew, which holds with and without design points, and judges them.
    pub judgement: Judgement,
}

impl LimitReliability {
    /// First-order failure probability, summed over all failure regions (at most 1), or that of the first alone if the
    /// centre of the distribution fails; `None` without design points.
    #[must_use]
    pub fn probability(&self) -> Option<f64> {
        let points = self.design_points.as_ref().ok()?;
        let first = points.first()?;
        if first.beta() < 0.0 {
            return Some(first.probability());
        }
        let sum: f64 = points.iter().map(DesignPoint::probability).sum();
        Some(sum.min(1.0))
    }

    /// Whether designs solved anew confirm the first-order failure probability
    /// ([`Judged::confirms`](crate::judge::Judged::confirms)): tangent planes describe all of the failure.
    #[must_use]
    pub fn verified(&self) -> bool {
        let claimed = self.probability();
        claimed.is_some_and(|claimed| self.judgement.confirms(claimed))
            && (self.design_points.iter().flatten()).all(|point| point.verified)
    }

    /// Whether the design points describe the failure: the limit is crossed at each, and designs solved anew do not refute
    /// the failure probability that they give.
    fn described(&self) -> bool {
        self.probability().is_some_and(|claimed| self.judgement.agrees(claimed))
            && (self.design_points.iter().flatten()).all(|point| point.verified)
    }

    /// Whether there are no design points because no design within reach fails.
    #[must_use]
    pub fn out_of_reach(&self) -> bool {
        matches!(&self.design_points, Err(Error::NoReliability(error)) if out_of_reach(error))
    }

    /// The reliability index of the most probable design point.
    #[must_use]
    pub fn beta(&self) -> Option<f64> {
        Some(self.design_points.as_ref().ok()?.first()?.beta())
    }
}

/// Reliability of a design.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Reliability {
    /// Every limit that the requirements set.
    pub limits: Vec<LimitReliability>,
    /// Requirements without a limit: [`Requirement::Stable`](super::Requirement::Stable).
    pub left_out: Vec<usize>,
    /// Probability of failing any requirement, those without a limit included, by designs solved anew.
    pub judgement: Judgement,
    /// The inputs of the operating point, SI.
    pub inputs: Vector,
    /// The mechanism it belongs to.
    pub description: Shared<Description>,
}

impl Reliability {
    /// First-order reliability index of a requirement, `-Phi^-1` of the summed probabilities of its limits; `None` if
    /// it has no design point.
    #[must_use]
    pub fn beta_of(&self, requirement: usize) -> Option<f64> {
        let parts: Vec<f64> = self
            .limits
            .iter()
            .filter(|limit| limit.requirement == requirement)
            .filter_map(LimitReliability::probability)
            .collect();
        (!parts.is_empty()).then(|| -normal::quantile(parts.iter().sum::<f64>().min(1.0)))
    }

    /// Whether every requirement has a limit, and every limit design points that are verified.
    #[must_use]
    pub fn verified(&self) -> bool {
        self.left_out.is_empty() && self.limits.iter().all(LimitReliability::verified)
    }
}

impl Requirements<'_> {
    /// Failure probabilities by first-order reliability, with design points and exact derivatives, judged
    /// by designs solved anew.
    ///
    /// # Errors
    /// [`Error::Setting`] if no requirement sets a limit on a response, if nothing varies, or for variables without a
    /// density. A limit without a design point carries its own error.
    pub fn reliability(&self, settings: &FormSettings) -> Result<Reliability, Error> {
        check(self, self.deviations())?;
        let mut reliability = reliability_of(self, self.deviations(), settings)?;
        judge(self, self.deviations(), &mut reliability)?;
        Ok(reliability)
    }
}

/// Like [`Requirements::reliability`], for given deviations and without judgement.
pub(crate) fn reliability_of(
    requirements: &Requirements<'_>,
    deviations: &Deviations<'_>,
    settings: &FormSettings,
) -> Result<Reliability, Error> {
    let state = requirements.responses().nominal();
    let limits = requirements.limits();
    let limit_reliabilities: Vec<LimitReliability> = limits
        .iter()
        .map(|limit| LimitReliability {
            requirement: limit.requirement,
            limit: limit.alone,
            design_points: design_points(requirements, deviations, limit, settings),
            judgement: Judgement::Open(Unjudged::NotAsked),
        })
        .collect();
    requirements.responses().go_on()?;
    let has_limit = |k: &usize| limits.iter().any(|limit| limit.requirement == *k);
    Ok(Reliability {
        limits: limit_reliabilities,
        left_out: (0..requirements.wanted().len()).filter(|k| !has_limit(k)).collect(),
        judgement: Judgement::Open(Unjudged::NotAsked),
        inputs: state.inputs.clone(),
        description: state.description.clone(),
    })
}

/// Rejects problems that certainly have no design point.
pub(crate) fn check(requirements: &Requirements<'_>, deviations: &Deviations<'_>) -> Result<(), Error> {
    deviations.check_densities(&requirements.responses().nominal().description)?;
    if requirements.limits().is_empty() {
        return Err(Error::Setting {
            setting: "requirements",
            reason:
                "stability alone has no design point: require a critical value beyond the operating point, or sample"
                    .to_owned(),
        });
    }
    if deviations.tolerances().normal_dimensions().is_empty() {
        return Err(Error::setting("tolerances", "nothing varies: at least one tolerance must be positive"));
    }
    Ok(())
}

/// Whether a search found no failure, and no design without a value.
pub(crate) fn out_of_reach(error: &eigentol_statistics::Error) -> bool {
    match error {
        eigentol_statistics::Error::NoDesignPoint { closest, .. } => {
            closest.value > 0.0 && closest.evaluations.without_value == 0
        }
        _ => false,
    }
}

fn design_points(
    requirements: &Requirements<'_>,
    deviations: &Deviations<'_>,
    limit: &Limit,
    settings: &FormSettings,
) -> Result<Vec<DesignPoint>, Error> {
    let at = |alone| LimitAt::new(requirements.responses(), limit.place, alone, deviations);
    let limit = at(limit.alone);
    let design_points = failure_regions(&limit, settings)?.design_points;
    let inside = design_points.first().is_some_and(|point| point.beta < 0.0);
    let sides = limit.sides();
    if inside && !sides.is_empty() && (sides.into_iter()).all(|side| failure_regions(&at(side), settings).is_ok()) {
        return Err(Error::setting(
            "forbidden band",
            "the centre of the distribution lies inside, with designs on both sides: sample",
        ));
    }
    design_points.into_iter().map(|point| DesignPoint::new(&limit, deviations, point)).collect()
}

/// How many times the usual budget a probability is worth that was asked for by itself.
const EFFORT: f64 = 10.0;
/// Number of modes whose way to instability is searched.
const LEAST_STABLE: usize = 3;

/// Judges design points by designs solved anew.
pub(crate) fn judge(
    requirements: &Requirements<'_>,
    deviations: &Deviations<'_>,
    reliability: &mut Reliability,
) -> Result<(), Error> {
    let about = About::new(requirements, deviations, 0, (0, 0));
    let all = about.judge_limits(reliability)?;
    reliability.judgement = match (&reliability.limits[..], &reliability.left_out[..]) {
        ([only], []) => only.judgement,
        _ => about.judge_any(reliability, all)?,
    };
    Ok(())
}

/// Judges design points, each requirement, and all of them together, by designs solved anew, at least as many as samples
/// are asked for each. Returns the judgement of each requirement, then that of all, each with whether design points describe the
/// failure.
pub(super) fn judge_requirements(
    requirements: &Requirements<'_>,
    sampling: &Sampling<'_>,
    reliability: &mut Reliability,
) -> Result<Vec<(Judgement, bool)>, Error> {
    let (worth, sequence) = (sampling.samples as u64, (sampling.seed, sampling.stream));
    let about = About::new(requirements, requirements.deviations(), worth, sequence);
    let all = about.judge_limits(reliability)?;
    let count = requirements.wanted().len();
    let mut judgements = Vec::with_capacity(count + 1);
    for k in 0..count {
        let of_requirement: Vec<_> = reliability.limits.iter().zip(&all).filter(|(x, _)| x.requirement == k).collect();
        let described = !of_requirement.is_empty() && of_requirement.iter().all(|(x, _)| x.described());
        let known = match &of_requirement[..] {
            [(only, _)] => Some(only.judgement),
            [(low, _), (high, _)] => about.either(low, high),
            _ => None,
        };
        let judgement = match known {
            Some(judgement) => judgement,
            None => {
                let lines = about.together(of_requirement.iter().map(|(_, lines)| *lines), of_requirement.is_empty());
                about.event(&lines, &|design, realisation| requirements.distances(design, realisation)[k])?
            }
        };
        judgements.push((judgement, described));
    }
    reliability.judgement = match &judgements[..] {
        [(only, _)] => *only,
        _ => about.judge_any(reliability, all)?,
    };
    let described = judgements.iter().all(|(_, described)| *described);
    judgements.push((reliability.judgement, described));
    Ok(judgements)
}

/// What is judged.
struct About<'a> {
    requirements: &'a Requirements<'a>,
    deviations: &'a Deviations<'a>,
    worth: u64,
    sequence: (u64, u64),
    /// Where modes lose their stability.
    unstable: Vec<Direction>,
    /// Whether a design without a state that stays was among those solved for limits.
    lost: Cell<bool>,
}

impl<'a> About<'a> {
    fn new(
        requirements: &'a Requirements<'a>,
        deviations: &'a Deviations<'a>,
        worth: u64,
        sequence: (u64, u64),
    ) -> Self {
        let unstable = ways_to_instability(requirements, deviations);
        Self { requirements, deviations, worth, sequence, unstable, lost: Cell::new(false) }
    }

    /// Judges every limit; returns along which lines.
    fn judge_limits(&self, reliability: &mut Reliability) -> Result<Vec<Lines>, Error> {
        let mut all = Vec::new();
        let limits = self.requirements.limits();
        let responses = self.requirements.responses();
        for (limit, Limit { place: index, alone, .. }) in reliability.limits.iter_mut().zip(limits) {
            let mut lines = Lines {
                worth: self.worth,
                effort: EFFORT,
                sequence: self.sequence,
                ..lines(self.requirements, self.deviations, index, limit)
            };
            if alone.response().is_some_and(Response::of_state) {
                let known = limit.design_points.as_ref().is_ok_and(|all| !all.is_empty());
                let farthest = if known { lines.farthest() } else { f64::INFINITY };
                lines.directions.extend(self.unstable_within(farthest));
            }
            limit.judgement = self.event(&lines, &|design, realisation| {
                let value = realisation.values.get(index).copied().flatten();
                self.lost.set(self.lost.get() || realisation.outcome.lost());
                alone.distance(responses, design, realisation.outcome, value)
            })?;
            let described = limit.described();
            for point in limit.design_points.iter_mut().flatten() {
                point.verified &= described;
            }
            all.push(lines);
        }
        Ok(all)
    }

    /// The judgement of a band by those of its ends, of which a design fails one at most unless it is lost; `None` where
    /// they do not tell.
    fn either(&self, low: &LimitReliability, high: &LimitReliability) -> Option<Judgement> {
        let (low, high) = (low.judgement.judged()?, high.judgement.judged()?);
        (low.settled && high.settled && !self.lost.get()).then(|| Judgement::Judged(low.or(high)))
    }

    /// Judges all requirements together.
    fn judge_any(&self, reliability: &Reliability, all: Vec<Lines>) -> Result<Judgement, Error> {
        let lines = self.together(all.iter(), !reliability.left_out.is_empty());
        self.event(&lines, &|design, realisation| least(&self.requirements.distances(design, realisation)))
    }

    fn event(&self, lines: &Lines, distance: &Distance<'_>) -> Result<Judgement, Error> {
        Event::new(self.requirements.responses(), self.deviations, distance).judge(lines)
    }

    /// Lines along all these directions, and towards instability if that matters too.
    fn together<'l>(&self, all: impl Iterator<Item = &'l Lines>, stability: bool) -> Lines {
        let mut lines = Lines { directions: Vec::new(), worth: self.worth, effort: EFFORT, sequence: self.sequence };
        for part in all {
            lines.directions.extend(part.directions.iter().cloned());
        }
        if stability {
            lines.directions.extend(self.unstable_within(f64::INFINITY));
        }
        lines
    }

    /// The directions in which stability is lost no less probably than within this distance.
    fn unstable_within(&self, distance: f64) -> impl Iterator<Item = Direction> {
        self.unstable.iter().filter(move |way| way.distance <= distance).cloned()
    }
}

/// Where to look for failure: towards the design points, or else along the gradient at the centre.
fn lines(
    requirements: &Requirements<'_>,
    deviations: &Deviations<'_>,
    index: usize,
    limit_reliability: &LimitReliability,
) -> Lines {
    let directions: Vec<Direction> = limit_reliability
        .design_points
        .iter()
        .flatten()
        .map(|point| Direction { along: point.normal.direction.clone(), distance: point.beta() })
        .collect();
    if !directions.is_empty() {
        return Lines { directions, worth: 0, effort: 0.0, sequence: (0, 0) };
    }
    let limit = LimitAt::new(requirements.responses(), index, limit_reliability.limit, deviations);
    let origin = vec![0.0; deviations.dimension()];
    let (value, slopes) = limit.by_design(&origin).unwrap_or((0.0, origin.clone()));
    let slope = deviations.gradient(&origin, &slopes);
    Lines::along(deviations, &slopes, value / dot(&slope, &slope).sqrt())
}

/// Directions in which the least stable modes lose their stability.
fn ways_to_instability(requirements: &Requirements<'_>, deviations: &Deviations<'_>) -> Vec<Direction> {
    let Ok(first) = distances(requirements.responses(), deviations.tolerances()) else {
        return Vec::new();
    };
    let mut ways = Vec::new();
    for mode in first.modes.iter().filter(|mode| !mode.clustered) {
        ways.push((mode.distance_to_critical, mode.lambda.by_design.clone()));
        if let Some(growth) = mode.of(Quantity::Growth) {
            ways.push((mode.distance_to_instability, growth.by_design));
        }
    }
    ways.retain(|(distance, _)| distance.is_finite());
    ways.sort_by(|(a, _), (b, _)| a.abs().total_cmp(&b.abs()));
    let origin = vec![0.0; deviations.dimension()];
    let ways = ways.iter().take(LEAST_STABLE);
    ways.map(|(distance, slopes)| Direction { along: deviations.gradient(&origin, slopes), distance: *distance })
        .collect()
}
