//! Divides a step until every stretch of it shows its events.

use std::rc::Rc;

use super::cubic::{Passage, Zero};
use super::scalars::{Candidate, Kind, Stretch, Wanted};
use super::spectrum::{Root, Spectrum};
use crate::sweep::condition::Line;

/// Solves states along a step.
pub(super) trait States {
    /// The state at a place; `None` if it is not found there, if an eigenvalue has no slope, or if no more states may be
    /// solved.
    fn state(&mut self, t: f64) -> Option<Rc<Spectrum>>;
}

/// A stretch whose events are not resolved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Doubt {
    pub(super) between: [f64; 2],
    pub(super) kind: Kind,
}

/// The events of a step.
#[derive(Debug, Default)]
pub(super) struct Division {
    pub(super) events: Vec<Candidate>,
    pub(super) doubts: Vec<Doubt>,
    /// Whether a state between two others was not found.
    pub(super) broken: bool,
    /// The states that divide the step, in order.
    pub(super) states: Vec<Rc<Spectrum>>,
}

/// Places at which a state between two others is sought, as shares of the distance.
const MIDDLES: [f64; 3] = [0.5, 0.44, 0.57];
/// Share of a stretch within which a wanted place counts as the middle.
const NEAR: f64 = 0.02;
/// Distance of two states of a step below which rounding may make them one.
const CLOSEST: f64 = 8.0 * f64::EPSILON;

/// A stretch between two states.
pub(super) struct Interval {
    pub(super) ends: [Rc<Spectrum>; 2],
    /// Whether what happens at its first state belongs to it.
    pub(super) opens: bool,
    /// Whether what happens at its last state belongs to it.
    pub(super) closes: bool,
}

/// Finds the events in a stretch, no finer than `finest`.
pub(super) fn divide(
    source: &mut impl States,
    wanted: &Wanted,
    interval: Interval,
    finest: f64,
) -> Division {
    let mut division = Division::default();
    let [first, last] = interval.ends;
    let (begin, end) = (first.t, last.t);
    division.states.push(first.clone());
    let mut open = vec![(first, last)];
    while let Some((a, b)) = open.pop() {
        let width = b.t - a.t;
        let middle = MIDDLES
            .iter()
            .find_map(|share| source.state(a.t + share * width));
        let Some(middle) = middle else {
            division.broken = true;
            division.doubts.push(Doubt {
                between: [a.t, b.t],
                kind: Kind::Critical,
            });
            division.states.push(b);
            continue;
        };
        match wanted.events([&a, &middle, &b], interval.closes && b.t == end) {
            Stretch::Events(events) => {
                division.events.extend(events);
                division.states.extend([middle, b]);
            }
            Stretch::Divide(_, kind) if width <= finest => {
                settle(wanted, [&a, &middle, &b], kind, &mut division);
                division.states.push(b);
            }
            Stretch::Divide(t, _) => {
                let off = (t - a.t).min(b.t - t);
                let distinct = (t - middle.t).abs() > NEAR * width && off > CLOSEST;
                let at = distinct
                    .then(|| source.state(t))
                    .flatten()
                    .unwrap_or(middle);
                open.extend([(at.clone(), b), (a, at)]);
            }
        }
    }
    if !interval.opens {
        division
            .events
            .retain(|event| event.zero.between != [begin; 2]);
    }
    // Beside a root of a root nothing is smooth: such a doubt belongs to the event.
    let Division { events, doubts, .. } = &mut division;
    doubts.retain(|doubt| {
        let [from, to] = [
            doubt.between[0] - 4.0 * finest,
            doubt.between[1] + 4.0 * finest,
        ];
        let beside =
            |event: &Candidate| event.zero.between[1] >= from && event.zero.between[0] <= to;
        !events.iter().any(beside)
    });
    division
}

/// Decides about a stretch as narrow as the search resolves: what changes by counting is an event, anything else is in
/// doubt.
fn settle(wanted: &Wanted, states: [&Rc<Spectrum>; 3], kind: Kind, division: &mut Division) {
    let [a, middle, b] = states;
    let between = [a.t, b.t];
    let mut kinds = vec![kind];
    if matches!(kind, Kind::Growth | Kind::Line(_)) {
        // The eigenvalues were not followed: any event may be there.
        kinds.extend((0..wanted.lines.len()).map(Kind::Line));
        kinds.extend(wanted.growth.then_some(Kind::Growth));
        kinds.sort_by_key(|kind| format!("{kind:?}"));
        kinds.dedup();
    }
    let known = division.events.len();
    for kind in kinds {
        let counts = [a, b].map(|state| wanted.count(kind, state));
        let passage = match counts[1] > counts[0] {
            true => Passage::Rises,
            false => Passage::Falls,
        };
        for _ in 0..counts[0].abs_diff(counts[1]) {
            let near = wanted.nearest(kind, middle);
            division.events.push(Candidate {
                kind,
                zero: Zero {
                    between,
                    at: middle.t,
                    passage,
                },
                near: [near.value; 2],
            });
        }
    }
    // Two that come together within the resolution, and grow nowhere, cross.
    let growing = states.map(|state| wanted.count(Kind::Growth, state));
    let crosses = kind == Kind::Merging && growing == [growing[0]; 3];
    if division.events.len() == known && !crosses && wanted.doubtful(kind, states) {
        division.doubts.push(Doubt { between, kind });
    }
}

impl Wanted {
    /// The number that an eigenvalue makes zero at an event, positive beyond it.
    fn excess(&self, kind: Kind, state: &Spectrum, root: &Root) -> f64 {
        match kind {
            Kind::Line(k) => {
                let Line { ratio, offset } = self.lines[k];
                let line = ratio * state.input[0] + offset;
                match self.undamped {
                    true => root.value.re - line * line,
                    false => root.value.im - line,
                }
            }
            Kind::Growth | Kind::Merging | Kind::Turning => root.value.re - root.error,
            Kind::Critical => root.value.re,
        }
    }

    /// The eigenvalues that an event of this kind is about.
    fn of<'a>(&self, kind: Kind, state: &'a Spectrum) -> Vec<&'a Root> {
        match kind {
            Kind::Critical if self.symmetric && !self.undamped => state.stiffness.iter().collect(),
            Kind::Critical => state.roots.iter().filter(|root| !root.paired).collect(),
            _ if self.undamped => state.roots.iter().collect(),
            _ => state.roots.iter().filter(|root| root.paired).collect(),
        }
    }

    fn count(&self, kind: Kind, state: &Spectrum) -> usize {
        let beyond = |root: &&Root| self.excess(kind, state, root) > 0.0;
        self.of(kind, state).into_iter().filter(beyond).count()
    }

    fn nearest(&self, kind: Kind, state: &Spectrum) -> Root {
        let all = self.of(kind, state).into_iter();
        let distance = |root: &&Root| self.excess(kind, state, root).abs();
        let nearest = all.min_by(|a, b| distance(a).total_cmp(&distance(b)));
        nearest.copied().unwrap_or(Root {
            value: crate::Complex::ZERO,
            slope: crate::Complex::ZERO,
            error: f64::INFINITY,
            paired: false,
            neutral: false,
        })
    }

    /// Whether the eigenvalues move so much between the states that one may pass the event and come back.
    fn doubtful(&self, kind: Kind, [a, middle, b]: [&Rc<Spectrum>; 3]) -> bool {
        let nearest = self.nearest(kind, middle);
        let moved = |root: &&Root| {
            let others = self.of(kind, b).into_iter();
            let apart = others.map(|other| (other.value - root.value).norm());
            apart.fold(f64::INFINITY, f64::min)
        };
        let all = self.of(kind, a);
        let moved = all.iter().map(moved).fold(0.0, f64::max);
        self.excess(kind, middle, &nearest).abs() <= 4.0 * moved + nearest.error
    }
}

#[cfg(test)]
#[path = "divide_tests.rs"]
mod tests;
