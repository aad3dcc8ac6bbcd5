//! Finds the events of a step: between any two states whose integers ([`super::count`]) differ there is one.
//!
//! First states are solved until none of the numbers behind the integers can pass its threshold and come back unseen
//! ([`super::hidden`]). Then each change of an integer is enclosed: by Newton's method where it stays within the bracket,
//! by halves elsewhere, until the states on either side of a place show the change.

use std::rc::Rc;

use super::count::{Kind, Wanted};
use super::spectrum::{Root, Spectrum};
use crate::Complex;

/// Solves states along a step.
pub(super) trait States {
    /// The state at a place; `None` if it is not found there, if an eigenvalue has no slope, or if no more states may be
    /// solved.
    fn state(&mut self, t: f64) -> Option<Rc<Spectrum>>;
    /// All states solved so far, in order.
    fn all(&self) -> Vec<Rc<Spectrum>>;
}

/// An event of a step.
#[derive(Clone, Debug)]
pub(super) struct Found {
    pub(super) kind: Kind,
    pub(super) t: f64,
    /// The states before and behind it.
    pub(super) sides: [Rc<Spectrum>; 2],
    /// About the eigenvalue there.
    pub(super) near: Complex,
    /// Whether more count behind it; `None` if it is but a touch.
    pub(super) rises: Option<bool>,
    /// Whether two eigenvalues merge there.
    pub(super) merging: bool,
}

impl Found {
    /// Whether this is but a growing pair that becomes real there, or the reverse; one of both may also lose its growth.
    pub(super) fn turns(&self, wanted: &Wanted) -> bool {
        let [a, b] = self.sides.each_ref().map(|state| {
            let flutter = wanted.count(Kind::Growth, state);
            [flutter, state.divergent()].map(usize::cast_signed)
        });
        let [flutter, divergent] = [b[0] - a[0], b[1] - a[1]];
        match self.kind {
            Kind::Growth => flutter * divergent < 0,
            _ => flutter != 0 && divergent == -2 * flutter,
        }
    }
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
    pub(super) events: Vec<Found>,
    pub(super) doubts: Vec<Doubt>,
    /// Whether a state between two others was not found.
    pub(super) broken: bool,
    /// The places of the states that divide the step, in order.
    pub(super) places: Vec<f64>,
}

/// Places at which a state between two others is sought, as shares of the distance.
const MIDDLES: [f64; 3] = [0.5, 0.44, 0.57];
/// Share of a stretch within which a wanted place counts as the middle.
const NEAR: f64 = 0.02;
/// Share of a stretch from an end within which a place is close to it.
const ASIDE: f64 = 0.1;
/// Distance of two states of a step below which rounding may make them one.
const CLOSEST: f64 = 8.0 * f64::EPSILON;
/// A Newton step of at most so many times the resolution leads to the event.
const NEWTON: f64 = 1e3;
/// Share of the distance from a place below which a last step of Newton's method has found the event.
const CONVERGED: f64 = 0.1;
/// How much farther than the resolution the error of an eigenvalue may move the place at which its integer changes.
const DOUBT: f64 = 4e4;
/// Most states solved for one event.
const MOST: usize = 200;
/// Distance of two places, as a share of the step, at which a number may be within its error between them.
const TOUCH: f64 = 1e-4;
/// Relative error of an eigenvalue beyond which its touching a threshold may be rounding.
const KNOWN: f64 = 1e-9;

/// A stretch between two states.
pub(super) struct Interval {
    pub(super) ends: [Rc<Spectrum>; 2],
    /// Whether the search begins or ends with it: what happens at that state belongs to it.
    pub(super) outer: [bool; 2],
}

/// Finds the events between two states, no finer than `finest`.
pub(super) fn divide(source: &mut impl States, wanted: &Wanted, interval: Interval, finest: f64) -> Division {
    let mut division = Division::default();
    let Interval { ends: [first, last], outer } = interval;
    let (begin, end) = (first.t, last.t);
    division.places.push(begin);
    let mut open = vec![(first, last)];
    while let Some((a, b)) = open.pop() {
        let width = b.t - a.t;
        let middle = MIDDLES.iter().find_map(|share| source.state(a.t + share * width));
        let Some(middle) = middle else {
            division.broken = true;
            division.doubt([a.t, b.t], Kind::Critical);
            division.places.push(b.t);
            continue;
        };
        match wanted.hidden([&a, &middle, &b]) {
            None => division.places.extend([middle.t, b.t]),
            Some((_, kind)) if width <= finest => {
                division.doubt([a.t, b.t], kind);
                division.places.push(b.t);
            }
            Some((t, _)) => {
                let off = (t - a.t).min(b.t - t);
                let distinct = (t - middle.t).abs() > NEAR * width && off > CLOSEST;
                let at = distinct.then(|| source.state(t)).flatten();
                let mut states = vec![a, b];
                // A place close to an end does not divide the rest.
                if at.is_none() || off < ASIDE * width {
                    states.push(middle);
                }
                states.extend(at);
                states.sort_by(|a, b| b.t.total_cmp(&a.t));
                open.extend(states.windows(2).map(|two| (two[1].clone(), two[0].clone())));
            }
        }
    }
    for kind in wanted.kinds() {
        let within = |state: &Rc<Spectrum>| (begin..=end).contains(&state.t);
        let states: Vec<_> = source.all().into_iter().filter(within).collect();
        let sure = division.touches(wanted, kind, &states, outer);
        for two in sure.windows(2) {
            let bracket = [two[0].clone(), two[1].clone()];
            enclose(source, wanted, kind, bracket, finest, &mut division);
        }
    }
    division.events.sort_by(|a, b| a.t.total_cmp(&b.t));
    division.join_touches(source, wanted);
    // A doubt next to an event is that event; what touches its threshold is close to it for a while.
    let Division { events, doubts, .. } = &mut division;
    doubts.retain(|Doubt { between, kind }| {
        let same = |event: &Found| {
            let slack = event.rises.map_or(TOUCH, |_| 4.0 * finest);
            let [from, to] = [between[0] - slack, between[1] + slack];
            event.kind == *kind && event.t >= from && event.t <= to
        };
        !events.iter().any(same)
    });
    division
}

impl Division {
    fn doubt(&mut self, between: [f64; 2], kind: Kind) {
        self.doubts.push(Doubt { between, kind });
    }

    /// The states that are at no event. At the others a number touches its threshold, if the states around it show no
    /// change; at an end of the search it may also pass.
    fn touches(&mut self, wanted: &Wanted, kind: Kind, states: &[Rc<Spectrum>], outer: [bool; 2]) -> Vec<Rc<Spectrum>> {
        let doubtful = |state: &Rc<Spectrum>| wanted.doubtful(kind, state);
        let groups: Vec<&[Rc<Spectrum>]> = (states.chunk_by(|a, b| doubtful(a) == doubtful(b))).collect();
        let last = groups.len() - 1;
        let mut sure = Vec::new();
        for (k, group) in groups.iter().enumerate() {
            let around = [k.checked_sub(1), (k < last).then_some(k + 1)];
            let around = around.map(|k| k.map(|k| groups[k]));
            let most = around.iter().flatten().map(|other| doubtful(&other[0])).max();
            let new = most.map_or(0, |most| doubtful(&group[0]).saturating_sub(most));
            let (begins, ends) = (around[0].is_none(), around[1].is_none());
            // Between two bands of flutter everything may be neutral.
            let counts = |state: &Rc<Spectrum>| wanted.count(kind, state);
            let below = |side: &[Rc<Spectrum>]| counts(&side[0]) == counts(&group[0]);
            let touch = kind != Kind::Growth || around.iter().flatten().all(|side| below(side));
            if new == 0 || begins || ends || !touch {
                sure.extend(group.iter().cloned());
            }
            let at = match (begins, ends) {
                (true, _) => 0,
                (_, true) => group.len() - 1,
                _ => group.len() / 2,
            };
            let (state, outer) = (&group[at], begins && outer[0] || ends && outer[1]);
            if new == 0 || !touch || (begins || ends) && !outer {
                continue;
            }
            let sides = [
                around[0].map_or(state, |before| &before[before.len() - 1]),
                around[1].map_or(state, |after| &after[0]),
            ];
            let [before, after] = sides.map(counts);
            let touches = |root: &&Root| {
                let known = wanted.real(kind) || root.error <= KNOWN * root.value.norm();
                known && wanted.touches(kind, state, root)
            };
            let roots = wanted.roots(kind, state).iter().filter(touches);
            for root in roots.take(if before == after { new } else { 0 }) {
                self.events.push(Found {
                    kind,
                    t: state.t,
                    sides: sides.map(Rc::clone),
                    near: root.value,
                    rises: (begins || ends).then_some(ends),
                    merging: false,
                });
            }
        }
        sure
    }
}

/// Adds the events between two states, as many as the integer changes by.
fn enclose(
    source: &mut impl States,
    wanted: &Wanted,
    kind: Kind,
    bracket: [Rc<Spectrum>; 2],
    finest: f64,
    division: &mut Division,
) {
    let mut open = vec![(bracket, false)];
    let mut left = MOST;
    while let Some(([low, high], halve)) = open.pop() {
        let [before, after] = [&low, &high].map(|state| wanted.count(kind, state));
        if before == after || !(wanted.meets(kind, &low) || wanted.meets(kind, &high)) {
            continue;
        }
        let (width, middle) = (high.t - low.t, 0.5 * (low.t + high.t));
        let aims = [&low, &high].map(|state| wanted.aim(kind, state, [low.t, high.t], NEWTON * finest));
        let aim = aims.into_iter().flatten().min_by(|a, b| a.step.total_cmp(&b.step));
        let reach = aim.map_or(finest, |aim| finest.max(4.0 * aim.error));
        if width <= 2.0 * reach {
            let aim = aim.map_or((middle, false), |aim| (aim.t, aim.merging));
            let at = wanted.polished(source, kind, aim, reach);
            division.found(wanted, kind, at, [low, high]);
            continue;
        }
        // Newton's method, and at last both sides of where it leads; every other time at least half is gained.
        let places = match aim {
            Some(aim) if !halve && aim.step < NEWTON * finest => vec![aim.t - reach, aim.t + reach],
            Some(aim) if !halve => vec![aim.t],
            _ => vec![middle],
        };
        let inside = |t: &f64| *t > low.t + CLOSEST && *t < high.t - CLOSEST;
        let mut states: Vec<_> = (places.into_iter().filter(inside)).filter_map(|t| source.state(t)).collect();
        if states.is_empty() {
            let mut places = MIDDLES.iter().map(|share| low.t + share * width);
            states.extend(places.find_map(|t| source.state(t)));
        }
        left -= 1;
        if states.is_empty() || left == 0 {
            division.doubt([low.t, high.t], kind);
            continue;
        }
        if let (Some(aim), [a, b]) = (aim, &states[..])
            && wanted.count(kind, a) == before
            && wanted.count(kind, b) == after
        {
            let at = wanted.polished(source, kind, (aim.t, aim.merging), reach);
            division.found(wanted, kind, at, [a.clone(), b.clone()]);
            continue;
        }
        states.insert(0, low);
        states.push(high);
        let brackets = states.windows(2).map(|two| [two[0].clone(), two[1].clone()]);
        open.extend(brackets.map(|two| {
            let slow = two[1].t - two[0].t > 0.5 * width;
            (two, slow && !halve)
        }));
    }
}

/// Where Newton's method leads from a state.
#[derive(Clone, Copy, Debug)]
struct Aim {
    t: f64,
    /// How far that is.
    step: f64,
    /// The error of the place.
    error: f64,
    /// Whether two eigenvalues merge there.
    merging: bool,
}

/// Relative distance of two eigenvalues that may merge.
const MERGING: f64 = 1e-3;
/// Share by which `(s_1 - s_2)^2` may miss the real axis where two eigenvalues merge on a threshold.
const REAL: f64 = 1e-6;

impl Wanted {
    /// A place close to an event, moved to it by Newton's method where that converges within its error, and whether two
    /// eigenvalues merge there.
    fn polished(&self, source: &mut impl States, kind: Kind, (from, merging): (f64, bool), reach: f64) -> (f64, bool) {
        let everywhere = ([f64::NEG_INFINITY, f64::INFINITY], f64::INFINITY);
        // Near where two merge, the number of either is a root whose slope is no more than rounding.
        let starts = [true, false].map(|merging| [from, from - reach, from + reach].map(|t| (t, merging)));
        let mut places = starts.into_iter().flatten().filter_map(|(start, merging)| {
            let (mut t, mut last, mut known) = (start, f64::INFINITY, reach);
            while let Some(state) = source.state(t.clamp(0.0, 1.0))
                && let Some(aim) = self.aims(kind, &state, everywhere, merging)
                && aim.step < 0.5 * last
            {
                known = reach.max((4.0 * aim.error).min(DOUBT * reach));
                if (aim.t - from).abs() > 2.0 * known {
                    return None;
                }
                (t, last) = (aim.t, aim.step);
            }
            // Where two merge, the place of a single one is not known from its error.
            let resolved = if matches!(kind, Kind::Line(_)) { known } else { reach };
            (last < CONVERGED * resolved).then_some((t, merging))
        });
        places.next().unwrap_or((from, merging))
    }

    /// The nearest place between two others at which an eigenvalue, or two that merge, meet the threshold, if it is
    /// `known` that well.
    fn aim(&self, kind: Kind, state: &Spectrum, ends: [f64; 2], known: f64) -> Option<Aim> {
        let aims = [false, true].map(|merging| self.aims(kind, state, (ends, known), merging));
        aims.into_iter().flatten().min_by(|a, b| a.step.total_cmp(&b.step))
    }

    /// The nearest such place of single eigenvalues, or of two that merge.
    fn aims(&self, kind: Kind, state: &Spectrum, ([low, high], known): ([f64; 2], f64), merging: bool) -> Option<Aim> {
        let aim = |[value, slope]: [f64; 2], error: f64| {
            let t = state.t - value / slope;
            let error = error / slope.abs();
            let aim = Aim { t, step: (t - state.t).abs(), error, merging };
            let inside = t >= low - CLOSEST && t <= high + CLOSEST;
            (inside && error <= known).then_some(aim)
        };
        let roots = self.roots(kind, state);
        let relevant = roots.iter().filter(|root| !merging && self.relevant(kind, root));
        let grows = !self.real(kind) && !matches!(kind, Kind::Line(_));
        let single = relevant.filter_map(|root| {
            let (jet, error) = self.number(kind, state, root);
            // Next to another eigenvalue a number within its error has a slope of rounding.
            let close = |other: &&Root| (other.value - root.value).norm() <= MERGING * root.value.norm();
            let known = !grows || jet[0].abs() > error || roots.iter().filter(close).count() == 1;
            known.then(|| aim(jet, error))?
        });
        let merges = merging && grows;
        let both = (0..roots.len())
            .filter(|_| merges)
            .flat_map(|i| {
                let conjugate = roots[i].paired.then(|| roots[i].conjugate());
                conjugate.into_iter().chain(roots[i + 1..].iter().copied()).map(move |other| (i, other))
            })
            .filter_map(|(i, other)| {
                let (distance, error) = (roots[i].value - other.value, roots[i].error + other.error);
                let square = distance * distance;
                let slope = 2.0 * (distance * (roots[i].slope - other.slope)).re;
                let of_square = error * (2.0 * distance.norm() + error);
                let real = square.im.abs() <= REAL * square.re.abs() + of_square;
                real.then(|| aim([square.re, slope], of_square))?
            });
        single.chain(both).min_by(|a, b| a.step.total_cmp(&b.step))
    }
}

impl Division {
    /// Makes an end of growth and the onset behind it one touch, if the state between them is at the threshold.
    fn join_touches(&mut self, source: &mut impl States, wanted: &Wanted) {
        let mut k = 0;
        while k + 1 < self.events.len() {
            let (a, b) = (&self.events[k], &self.events[k + 1]);
            let opposite = a.kind == b.kind && (a.rises, b.rises) == (Some(false), Some(true));
            if opposite
                && b.t - a.t < TOUCH
                && !a.merging
                && let Some(state) = source.state(0.5 * (a.t + b.t))
                && let Some(root) = (wanted.roots(a.kind, &state).iter())
                    .find(|root| wanted.touches(a.kind, &state, root) && root.error <= KNOWN * root.value.norm())
            {
                let touch = Found {
                    t: state.t,
                    sides: [a.sides[0].clone(), b.sides[1].clone()],
                    near: root.value,
                    rises: None,
                    ..a.clone()
                };
                self.events.splice(k..k + 2, [touch]);
            }
            k += 1;
        }
        // Rounding may part the places at which one number is within its error.
        let known = self.events.clone();
        self.events.retain(|event| {
            let is_rounding = |other: &Found| match other.rises {
                Some(_) => (event.t - other.t).abs() <= other.sides[1].t - other.sides[0].t,
                None => other.t < event.t && event.t - other.t < TOUCH,
            };
            event.rises.is_some() || !known.iter().any(|other| other.kind == event.kind && is_rounding(other))
        });
    }

    /// Adds an event for each of the eigenvalues that count on one side only.
    fn found(&mut self, wanted: &Wanted, kind: Kind, (t, merging): (f64, bool), sides: [Rc<Spectrum>; 2]) {
        let [mut before, mut after] = sides.each_ref().map(|state| {
            let roots = wanted.roots(kind, state);
            wanted.counted(kind, state).into_iter().map(|r| roots[r].value).collect::<Vec<Complex>>()
        });
        let rises = after.len() > before.len();
        let (more, fewer) = if rises { (&mut after, &before) } else { (&mut before, &after) };
        for value in fewer {
            let apart = |other: &Complex| (*other - *value).norm();
            let nearest = more.iter().enumerate().min_by(|a, b| apart(a.1).total_cmp(&apart(b.1)));
            if let Some(r) = nearest.map(|(r, _)| r) {
                more.remove(r);
            }
        }
        self.events.extend(more.iter().map(|near| Found {
            kind,
            t,
            sides: sides.clone(),
            near: *near,
            rises: Some(rises),
            merging,
        }));
    }
}

#[cfg(test)]
#[path = "divide_tests.rs"]
mod tests;
