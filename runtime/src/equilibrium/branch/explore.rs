//! All branches that can be reached: along each from its start, and at every branch point into the other one.

use std::collections::VecDeque;

use super::super::multistart::{Search, find_equilibria};
use super::super::{Policy, Problem, equilibrium, settle};
use super::curve::{Curve, Trouble};
use super::frame::Place;
use super::settings::Continuation;
use super::special::{Junction, SpecialKind};
use super::station::Station;
use super::walk::{SAME, Walk};
use super::{Branch, BranchEnd, BranchPoint, Branches};
use crate::{Equilibrium, Error, Mechanism};

/// Share of the range by which a start on a singular state is moved.
const NUDGE: f64 = 1e-6;

/// A branch and the branch points passed on it, each with whether the branch is an arm that ends there.
type Followed<const N: usize, const U: usize, const P: usize> =
    (Branch<N, U, P>, Vec<(Junction<N, U, P>, bool)>);

/// What is still to be followed.
enum Lead<const N: usize, const U: usize, const P: usize> {
    /// Both ways from a regular point.
    Start(Station<N, U, P>),
    /// Both ways through a junction.
    Through(Junction<N, U, P>, Place<N>),
    /// One arm of a pitchfork.
    Arm(Junction<N, U, P>, Place<N>),
}

/// Follows the branch through the stable equilibrium at `settings.low` that is found from `start`, in both directions.
///
/// `u` inputs (of which `settings.input` is replaced), `b` design variables, `start` coordinates, all SI. Branches that
/// cross it are told by its special points, but not followed: [`branches`] does.
///
/// # Errors
/// [`Error::Setting`], [`Error::UnknownHandle`], and those of [`equilibrium`] at the low end.
pub fn branch<M, const N: usize, const U: usize, const P: usize, const O: usize>(
    mechanism: &M,
    u: &[f64; U],
    b: &[f64; P],
    start: &[f64; N],
    settings: &Continuation,
) -> Result<Branch<N, U, P>, Error>
where
    M: Mechanism<N, U, P, O>,
{
    settings.check::<U>(M::DESCRIPTION.name)?;
    let curve = Curve::new(mechanism, u, b, settings);
    let inputs = curve.inputs_at(settings.low);
    let state = equilibrium(mechanism, &inputs, b, start, Policy::Stable)?;
    let curve = curve.about(&state);
    Ok(match curve.begin(state) {
        Ok(station) => curve.both_ways(&station).0,
        Err(trouble) => curve.lone_point(state, trouble),
    })
}

/// Finds the branches of equilibria over a range of one input.
///
/// Starts at the low end of the range with the equilibria found from `start`, at the high end where there are none, and
/// at both ends with those that `search` finds; then follows every branch and enters every other branch that crosses
/// one. The arms of a pitchfork are branches of their own. A branch that is connected to none of these and passes
/// neither end near a start is not found: completeness is not promised.
///
/// # Errors
/// [`Error::Setting`], [`Error::UnknownHandle`], [`Error::NotFinite`]; those of [`equilibrium`] when there is no
/// equilibrium at either end.
pub fn branches<M, const N: usize, const U: usize, const P: usize, const O: usize>(
    mechanism: &M,
    u: &[f64; U],
    b: &[f64; P],
    start: &[f64; N],
    settings: &Continuation,
    search: Option<&Search<N>>,
) -> Result<Branches<N, U, P>, Error>
where
    M: Mechanism<N, U, P, O>,
{
    settings.check::<U>(M::DESCRIPTION.name)?;
    let curve = Curve::new(mechanism, u, b, settings);
    let none = Search {
        lower: *start,
        upper: *start,
        starts: 0,
        seed: 0,
    };
    let search_or_none = search.unwrap_or(&none);
    let mut states = Vec::new();
    let mut refused = None;
    for value in [settings.low, settings.high] {
        if search.is_none() && !states.is_empty() {
            break;
        }
        let inputs = curve.inputs_at(value);
        match find_equilibria(mechanism, &inputs, b, start, search_or_none) {
            Ok(found) => states.extend(found),
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
    Ok(curve.explore(states))
}

impl<M, const N: usize, const U: usize, const P: usize, const O: usize> Curve<'_, M, N, U, P, O>
where
    M: Mechanism<N, U, P, O>,
{
    /// The station at an equilibrium, or beside it where branches cross there.
    pub(crate) fn begin(
        &self,
        state: Equilibrium<N, U, P>,
    ) -> Result<Station<N, U, P>, Trouble<N>> {
        self.first_station(state).or_else(|trouble| {
            let (low, high) = (self.settings.low, self.settings.high);
            let value = state.inputs[self.settings.input.0];
            let target = if value == low { high } else { low };
            let inputs = self.inputs_at(value + NUDGE * (target - value));
            let problem = Problem::unchecked(self.mechanism, &inputs, self.design);
            match settle(&problem, &state.coordinates, Policy::Nearest) {
                Ok(beside) => self.first_station(beside),
                Err(_) => Err(trouble),
            }
        })
    }

    /// The branch through a station, and the junctions on it.
    fn both_ways(&self, station: &Station<N, U, P>) -> Followed<N, U, P> {
        let front = self.walk(station, &station.place, |_, _| false);
        let back = if front.end == BranchEnd::Closed {
            nothing(BranchEnd::Closed)
        } else {
            self.walk(&station.reversed(), &station.place, |_, _| false)
        };
        self.joined(back, Some(self.point(station)), front)
    }

    /// One branch of two walks from one place.
    fn joined(
        &self,
        back: Walk<N, U, P>,
        start: Option<BranchPoint<N, U, P>>,
        front: Walk<N, U, P>,
    ) -> Followed<N, U, P> {
        let mut points: Vec<_> = back
            .points
            .into_iter()
            .rev()
            .map(BranchPoint::reversed)
            .collect();
        points.extend(start);
        points.extend(front.points);
        let mut special: Vec<_> = back.special.into_iter().rev().collect();
        special.extend(front.special);
        let mut junctions = back.junctions;
        junctions.extend(front.junctions);
        let branch = Branch {
            input: self.settings.input,
            points,
            special,
            ends: [back.end, front.end],
            description: Self::DESCRIPTION,
        };
        (branch, junctions)
    }

    /// A branch of which nothing but one point is known.
    fn lone_point(&self, state: Equilibrium<N, U, P>, trouble: Trouble<N>) -> Branch<N, U, P> {
        let end = self.broken_off(trouble, &state);
        Branch {
            input: self.settings.input,
            points: vec![BranchPoint {
                value: state.inputs[self.settings.input.0],
                equilibrium: state,
                tangent: [0.0; N],
                input_tangent: 0.0,
            }],
            special: Vec::new(),
            ends: [end.clone(), end],
            description: Self::DESCRIPTION,
        }
    }

    fn explore(&self, states: Vec<Equilibrium<N, U, P>>) -> Branches<N, U, P> {
        let mut found: Vec<Branch<N, U, P>> = Vec::new();
        let mut leads = VecDeque::new();
        for state in states {
            match self.begin(state) {
                Ok(station) => leads.push_back(Lead::Start(station)),
                Err(trouble) => found.push(self.lone_point(state, trouble)),
            }
        }
        let mut entered: Vec<Place<N>> = Vec::new();
        while let Some(lead) = leads.pop_front() {
            let Some((branch, junctions)) = self.follow(&lead, &found) else {
                continue;
            };
            if found.len() >= self.settings.max_branches {
                return Branches {
                    branches: found,
                    truncated: true,
                };
            }
            for (junction, ends_arm) in junctions {
                let place = junction.frame.origin;
                let near = |known: &Place<N>| junction.frame.local(known).norm() <= SAME;
                if entered.iter().any(near) {
                    continue;
                }
                entered.push(place);
                if ends_arm {
                    leads.push_back(Lead::Through(junction, junction.other));
                    leads.push_back(Lead::Arm(junction, junction.own));
                } else if matches!(junction.special.kind, SpecialKind::Pitchfork { .. }) {
                    leads.push_back(Lead::Arm(junction, junction.other));
                    leads.push_back(Lead::Arm(junction, junction.other.scaled(-1.0)));
                } else {
                    leads.push_back(Lead::Through(junction, junction.other));
                }
            }
            found.push(branch);
        }
        Branches {
            branches: found,
            truncated: false,
        }
    }

    /// The branch of a lead; `None` where there is none or it is known.
    fn follow(&self, lead: &Lead<N, U, P>, known: &[Branch<N, U, P>]) -> Option<Followed<N, U, P>> {
        let fresh = |station: &Station<N, U, P>| !self.known(known, &station.place);
        let from = |junction: &Junction<N, U, P>, station: &Station<N, U, P>| {
            let mut walk = self.walk(station, &junction.frame.origin, |_, _| false);
            walk.points.insert(0, self.point(station));
            walk
        };
        let at = |junction: &Junction<N, U, P>, direction: &Place<N>| {
            let direction = junction.frame.stretched(direction);
            Some(self.special_point(&junction.special, &direction))
        };
        let (mut branch, junctions, place) = match lead {
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
                let closed = front
                    .as_ref()
                    .is_some_and(|walk| walk.end == BranchEnd::Closed);
                let back = behind
                    .filter(|_| !closed)
                    .map(|station| from(junction, &station));
                if front.is_none() && back.is_none() {
                    return None;
                }
                let stopped = || {
                    nothing(if closed {
                        BranchEnd::Closed
                    } else {
                        BranchEnd::BranchPoint
                    })
                };
                let place = back.as_ref().map_or(0, |walk| walk.special.len());
                let (branch, junctions) = self.joined(
                    back.unwrap_or_else(stopped),
                    at(junction, direction),
                    front.unwrap_or_else(stopped),
                );
                (branch, junctions, place)
            }
        };
        let special = junction_of(lead).map(|junction| junction.special);
        branch.special.splice(place..place, special);
        Some((branch, junctions))
    }
}

fn junction_of<const N: usize, const U: usize, const P: usize>(
    lead: &Lead<N, U, P>,
) -> Option<&Junction<N, U, P>> {
    match lead {
        Lead::Start(_) => None,
        Lead::Through(junction, _) | Lead::Arm(junction, _) => Some(junction),
    }
}

fn nothing<const N: usize, const U: usize, const P: usize>(end: BranchEnd) -> Walk<N, U, P> {
    Walk {
        points: Vec::new(),
        special: Vec::new(),
        junctions: Vec::new(),
        end,
    }
}
