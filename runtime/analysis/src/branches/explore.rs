//! Finds all reachable branches: follows each from its start, and enters the other branch at every branch point.

use std::collections::VecDeque;

use super::curve::{ContinuationFailure, Curve};
use super::curve_point::CurvePoint;
use super::local_scaling::CurvePosition;
use super::settings::Continuation;
use super::special::{Junction, SpecialKind};
use super::walk::{Pass, SAME, Walk};
use super::{Branch, BranchEnd, BranchPoint, Branches};
use crate::algebra::Vector;
use crate::equilibrium::{Policy, Search, SolvedState, equilibrium, find_equilibria};
use crate::kernels::DirectionalKernels;
use crate::{Equilibrium, Error, Stability, Watch};

/// Fraction of the range by which a start at a singular state is moved.
const NUDGE: f64 = 1e-6;

/// A state without the modes that its judgement may have needed.
fn unjudged(state: Equilibrium) -> SolvedState {
    SolvedState { state, modes: Vec::new() }
}

/// A branch and its branch points, each with a flag that tells whether the branch is an arm that ends there.
type Followed = (Branch, Vec<(Junction, bool)>);

/// A place from which to follow a branch.
enum Lead {
    /// In both directions from a regular point.
    Start(CurvePoint),
    /// In both directions through a junction.
    Through(Junction, CurvePosition),
    /// Along one arm of a pitchfork.
    Arm(Junction, CurvePosition),
}

/// Follows, in both directions, the branch through the stable equilibrium at `settings.low` that is found from `start`.
///
/// `u` are the inputs (`settings.input` is replaced), `b` the design variables, `start` the coordinates, all SI.
/// Branches that cross this one appear as special points but are not followed; use [`branches`] for that.
///
/// # Errors
/// [`Error::Setting`], [`Error::UnknownHandle`], and the errors of [`equilibrium`] at the low end of the range.
pub fn branch(
    mechanism: &dyn DirectionalKernels,
    u: &[f64],
    b: &[f64],
    start: &[f64],
    settings: &Continuation,
) -> Result<Branch, Error> {
    let curve = Curve::new(mechanism, u, b, settings)?;
    let inputs = curve.inputs_at(settings.low);
    let state = equilibrium(mechanism, &inputs, b, start, Policy::Stable)?;
    let curve = curve.about(&state);
    Ok(match curve.begin(&state) {
        Ok(station) => curve.both_ways(&station).0,
        Err(trouble) => curve.lone_point(state, trouble),
    })
}

/// Finds the branches of equilibria over a range of one input.
///
/// The search starts with the equilibria found from `start` at the low end of the range, at the high end if there are
/// none at the low end, and at both ends with those that `search` finds. It then follows every branch and enters every
/// branch that crosses one. The arms of a pitchfork are separate branches. A branch that is not connected to any of
/// these and passes neither end near a start is not found: completeness is not guaranteed.
///
/// # Errors
/// [`Error::Setting`], [`Error::UnknownHandle`], [`Error::NotFinite`]; the errors of [`equilibrium`] if there is no
/// equilibrium at either end.
pub fn branches(
    mechanism: &dyn DirectionalKernels,
    u: &[f64],
    b: &[f64],
    start: &[f64],
    settings: &Continuation,
    search: Option<&Search>,
) -> Result<Branches, Error> {
    let nobody = Watch::default();
    branches_each(mechanism, (u, b), start, (settings, search), nobody, |_| {})
}

/// Like [`branches`], but passes every branch to `each` as soon as it is complete.
///
/// A search that is stopped returns the branches found so far, the last of which ends with [`BranchEnd::Stopped`].
///
/// # Errors
/// As [`branches`].
pub fn branches_each(
    mechanism: &dyn DirectionalKernels,
    (u, b): (&[f64], &[f64]),
    start: &[f64],
    (settings, search): (&Continuation, Option<&Search>),
    watch: Watch<'_>,
    each: impl FnMut(&Branch),
) -> Result<Branches, Error> {
    let curve = Curve::new(mechanism, u, b, settings)?.watched(watch);
    let none = Search::at(start);
    let search_or_none = search.unwrap_or(&none);
    // Its steps are points of branches.
    let stop = Watch::default().stop(watch.stop);
    let mut states = Vec::new();
    let mut refused = None;
    for value in [settings.low, settings.high] {
        if search.is_none() && !states.is_empty() {
            break;
        }
        let inputs = curve.inputs_at(value);
        match find_equilibria(mechanism, &inputs, b, start, search_or_none, stop) {
            Ok(equilibria) => states.extend(equilibria),
            Err(error) => _ = refused.get_or_insert(error),
        }
    }
    if states.is_empty() {
        if let Some(error) = refused {
            return Err(error);
        }
        let inputs = curve.inputs_at(settings.low);
        states.push(equilibrium(mechanism, &inputs, b, start, Policy::Stable)?);
    }
    let curve = match states.first() {
        Some(state) => curve.about(state),
        None => curve,
    };
    Ok(curve.explore(states, each))
}

/// Share of the input by which points of a branch may differ and have the same value.
const STANDS: f64 = 1e-9;

/// Along a branch on which the input stands still, the mechanism rests anywhere: the eigenvalue of that direction is
/// zero, and its sign is rounding.
fn rest_where_the_input_stands(points: &mut [BranchPoint]) {
    let values = || points.iter().map(|point| point.value);
    let least = values().fold(f64::INFINITY, f64::min);
    let most = values().fold(f64::NEG_INFINITY, f64::max);
    if points.len() < 3 || most - least > STANDS * least.abs().max(most.abs()) {
        return;
    }
    let negative = |point: &BranchPoint| match point.equilibrium.stability {
        Stability::Stable | Stability::Neutral { .. } => Some(0),
        Stability::Divergent { negative } => Some(negative),
        _ => None,
    };
    let counts: Option<Vec<usize>> = points.iter().map(negative).collect();
    let Some(negative) = counts.and_then(|counts| counts.into_iter().min()) else {
        return;
    };
    for point in points {
        point.equilibrium.stability = match negative {
            0 => Stability::Neutral { zero: 1 },
            _ => Stability::Divergent { negative },
        };
    }
}

impl Curve<'_> {
    /// The station at an equilibrium, or next to it if branches cross there.
    pub(crate) fn begin(&self, state: &Equilibrium) -> Result<CurvePoint, ContinuationFailure> {
        self.first_station(unjudged(state.clone())).or_else(|trouble| match self.beside(state, NUDGE) {
            Ok(beside) => self.first_station(beside),
            Err(_) => Err(trouble),
        })
    }

    /// The branch through a station, followed in both directions, and its junctions.
    fn both_ways(&self, station: &CurvePoint) -> Followed {
        let front = self.walk(station, &station.place, |_, _, _| Pass::On);
        let back = if front.end == BranchEnd::Closed {
            nothing(BranchEnd::Closed)
        } else {
            self.walk(&station.reversed(), &station.place, |_, _, _| Pass::On)
        };
        self.joined(back, Some(self.point(station)), front)
    }

    /// Joins two walks from one place into a branch.
    fn joined(&self, back: Walk, start: Option<BranchPoint>, front: Walk) -> Followed {
        let mut points: Vec<_> = back.points.into_iter().rev().map(BranchPoint::reversed).collect();
        points.extend(start);
        points.extend(front.points);
        rest_where_the_input_stands(&mut points);
        let mut special: Vec<_> = back.special.into_iter().rev().collect();
        special.extend(front.special);
        let mut junctions = back.junctions;
        junctions.extend(front.junctions);
        let branch = Branch {
            input: self.settings.input,
            points,
            special,
            ends: [back.end, front.end],
            description: self.description.clone(),
        };
        (branch, junctions)
    }

    /// A branch of which only one point is known.
    fn lone_point(&self, state: Equilibrium, trouble: ContinuationFailure) -> Branch {
        let end = self.broken_off(trouble, &state);
        Branch {
            input: self.settings.input,
            points: vec![BranchPoint {
                value: state.inputs[self.settings.input.index()],
                outputs: self.outputs(&state),
                equilibrium: state,
                tangent: Vector::zeros(self.size()),
                input_tangent: 0.0,
            }],
            special: Vec::new(),
            ends: [end.clone(), end],
            description: self.description.clone(),
        }
    }

    fn explore(&self, states: Vec<Equilibrium>, mut each: impl FnMut(&Branch)) -> Branches {
        let mut all_branches: Vec<Branch> = Vec::new();
        let mut leads = VecDeque::new();
        for state in states {
            match self.begin(&state) {
                Ok(station) => leads.push_back(Lead::Start(station)),
                Err(trouble) => {
                    let alone = self.lone_point(state, trouble);
                    each(&alone);
                    all_branches.push(alone);
                }
            }
        }
        let mut entered: Vec<CurvePosition> = Vec::new();
        while let Some(lead) = leads.pop_front() {
            let Some((branch, junctions)) = self.follow(&lead, &all_branches) else {
                continue;
            };
            if all_branches.len() >= self.settings.max_branches {
                return Branches { branches: all_branches, truncated: true };
            }
            for (junction, ends_arm) in junctions {
                let near = |known: &CurvePosition| junction.frame.local(known).norm() <= SAME;
                if entered.iter().any(near) {
                    continue;
                }
                entered.push(junction.frame.origin.clone());
                let (incoming, other) = (junction.incoming.clone(), junction.other.clone());
                if ends_arm {
                    leads.push_back(Lead::Through(junction.clone(), other));
                    leads.push_back(Lead::Arm(junction, incoming));
                } else if matches!(junction.special.kind, SpecialKind::Pitchfork { .. }) {
                    let opposite = other.scaled(-1.0);
                    leads.push_back(Lead::Arm(junction.clone(), other));
                    leads.push_back(Lead::Arm(junction, opposite));
                } else {
                    leads.push_back(Lead::Through(junction, other));
                }
            }
            each(&branch);
            let stopped = branch.ends.contains(&BranchEnd::Stopped);
            all_branches.push(branch);
            if stopped {
                return Branches { branches: all_branches, truncated: true };
            }
        }
        Branches { branches: all_branches, truncated: false }
    }

    /// The branch of a lead; `None` if there is none or it is already known.
    fn follow(&self, lead: &Lead, known: &[Branch]) -> Option<Followed> {
        let fresh = |station: &CurvePoint| !self.known(known, &station.place);
        let from = |junction: &Junction, station: &CurvePoint| {
            let mut walk = self.walk(station, &junction.frame.origin, |_, _, _| Pass::On);
            walk.points.insert(0, self.point(station));
            walk
        };
        let at = |junction: &Junction, direction: &CurvePosition| {
            let direction = junction.frame.stretched(direction);
            Some(self.special_point(&junction.special, &direction))
        };
        let (mut branch, junctions, index) = match lead {
            Lead::Start(station) => {
                return fresh(station).then(|| self.both_ways(station));
            }
            Lead::Arm(junction, direction) => {
                let station = self.depart(junction, direction).filter(fresh)?;
                let front = from(junction, &station);
                let back = nothing(BranchEnd::BranchPoint);
                let (branch, junctions) = self.joined(back, at(junction, direction), front);
                (branch, junctions, 0)
            }
            Lead::Through(junction, direction) => {
                let forward = (self.settings.high - self.settings.low).signum();
                let direction = &direction.scaled(forward * direction.p.signum());
                let behind = direction.scaled(-1.0);
                let ahead = self.depart(junction, direction);
                let behind = self.depart(junction, &behind);
                if !ahead.iter().chain(&behind).all(fresh) {
                    return None;
                }
                let front = ahead.map(|station| from(junction, &station));
                let closed = front.as_ref().is_some_and(|walk| walk.end == BranchEnd::Closed);
                let back = behind.filter(|_| !closed).map(|station| from(junction, &station));
                if front.is_none() && back.is_none() {
                    return None;
                }
                let stopped = || nothing(if closed { BranchEnd::Closed } else { BranchEnd::BranchPoint });
                let index = back.as_ref().map_or(0, |walk| walk.special.len());
                let (branch, junctions) =
                    self.joined(back.unwrap_or_else(stopped), at(junction, direction), front.unwrap_or_else(stopped));
                (branch, junctions, index)
            }
        };
        let special = junction_of(lead).map(|junction| junction.special.clone());
        branch.special.splice(index..index, special);
        Some((branch, junctions))
    }
}

fn junction_of(lead: &Lead) -> Option<&Junction> {
    match lead {
        Lead::Start(_) => None,
        Lead::Through(junction, _) | Lead::Arm(junction, _) => Some(junction),
    }
}

fn nothing(end: BranchEnd) -> Walk {
    Walk { points: Vec::new(), special: Vec::new(), junctions: Vec::new(), end }
}
