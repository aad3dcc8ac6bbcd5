//! The events of one step along a branch, each located to rounding.

use std::rc::Rc;

use super::count::{Kind, Wanted};
use super::cubic::cubic;
use super::divide::{Found, Interval, States, divide};
use super::node::{Node, Question};
use super::spectrum::{Root, Spectrum};
use crate::branches::{Curve, CurvePoint, CurvePosition, Located, SpecialKind, SpecialPoint};
use crate::constraints::Structure;
use crate::sweep::condition::{Change, Condition};
use crate::{Complex, Mode, Stability, Vector, modes};

/// A step from one station of a branch to the next, and the states solved on it.
pub(super) struct Step<'a, 'b> {
    curve: &'a Curve<'b>,
    question: &'a Question<'a>,
    ends: [&'a CurvePoint; 2],
    /// Unit chord and its length, local.
    normal: CurvePosition,
    length: f64,
    /// In order.
    nodes: Vec<Rc<Node>>,
    /// Whether one of them has gained modes since its first answer.
    gained: bool,
    /// How many states may still be solved.
    left: &'a mut usize,
}

/// An event of a step.
pub(super) enum Event {
    /// Stiffness vanishes.
    Critical {
        special: Box<SpecialPoint>,
        change: Change,
        /// Whether all stiffness was positive before.
        loses: bool,
    },
    /// A mode meets a condition.
    Met {
        /// The input there, SI.
        value: f64,
        condition: Condition,
        /// The state there, or next to it where two eigenvalues merge.
        node: Rc<Node>,
        /// Positions of the mode at the node, and of the one that it merges with.
        modes: [usize; 2],
        change: Change,
        /// Whether two eigenvalues merge.
        merging: bool,
    },
}

/// Events with their places, and where they are not resolved.
#[derive(Default)]
pub(super) struct Findings {
    pub(super) events: Vec<(f64, Event)>,
    pub(super) doubts: Vec<([f64; 2], Kind)>,
    /// Places of the states that divide the step.
    pub(super) places: Vec<f64>,
}

/// Relative distance of two eigenvalues that merge at an event, and of two that do so next to a place.
const MERGED: f64 = 3e-5;
const NEARLY: f64 = 1e-3;
/// Distance of two events, as a share of the step, below which they are one for several modes.
const SAME: f64 = 1e-9;
/// A solved state may lie this far from the cubic through its neighbours: a share of their bend plus a share of the step.
const ASTRAY: f64 = 0.05;
const CLOSE: f64 = 1e-6;
/// Rounding of a solved state, local.
const ROUNDED: f64 = 1e-12;
/// Share of it by which the direction may miss that of the cubic: beyond, it is another branch, or the step is too long.
const TURNED: f64 = 0.1;
/// Distances from a special point, as shares of the step, at which the branch beside it is sought.
const ASIDE: [f64; 5] = [1e-6, 1e-5, 1e-4, 1e-3, 1e-2];
/// Local distance within which special points of several modes are located.
const ROUGHLY: f64 = 1e-6;
/// Local length of a step that is not shortened any more.
const SHORTEST: f64 = 1e-6;
/// Most times that a step is looked at anew because its states have gained modes.
const ROUNDS: usize = 8;

impl States for Step<'_, '_> {
    fn state(&mut self, t: f64) -> Option<Rc<Spectrum>> {
        let spectrum = self.node(t)?.spectrum.clone();
        let mut all = spectrum.roots.iter().chain(&spectrum.stiffness);
        let inner = t > 0.0 && t < 1.0;
        (!inner || all.all(|root: &Root| root.slope.is_finite() || root.neutral)).then_some(spectrum)
    }

    fn all(&self) -> Vec<Rc<Spectrum>> {
        self.nodes.iter().map(|node| node.spectrum.clone()).collect()
    }
}

impl<'a, 'b> Step<'a, 'b> {
    pub(super) fn new(
        curve: &'a Curve<'b>,
        question: &'a Question<'a>,
        ends: [&'a CurvePoint; 2],
        left: &'a mut usize,
    ) -> Option<Self> {
        let chord = ends[0].frame.local(&ends[1].place);
        Some(Self {
            curve,
            question,
            ends,
            length: chord.norm(),
            normal: chord.unit()?,
            nodes: Vec::new(),
            gained: false,
            left,
        })
    }

    /// The state at a place.
    pub(super) fn node(&mut self, t: f64) -> Option<Rc<Node>> {
        let index = self.nodes.partition_point(|node| node.spectrum.t < t);
        if let Some(known) = self.nodes.get(index).filter(|node| node.spectrum.t == t) {
            return Some(known.clone());
        }
        *self.left = self.left.checked_sub(1)?;
        let point = match t {
            0.0 => self.curve.completed(self.ends[0].clone()),
            1.0 => self.curve.completed(self.ends[1].clone()),
            _ => self.between(t)?,
        };
        let rate = self.rate(&point)?;
        self.nodes.insert(index, Rc::new(self.question.node(point, t, rate).ok()?));
        if !self.nodes[index].point.equilibrium.spans.is_empty() {
            self.complete(index);
        }
        Some(self.nodes[index].clone())
    }

    /// The length of the step's parameter per unit of the local tangent of a station.
    fn rate(&self, point: &CurvePoint) -> Option<f64> {
        let rate = self.length / self.ends[0].frame.direction(&point.direction()).dot(&self.normal);
        (rate > 0.0 && rate.is_finite()).then_some(rate)
    }

    /// Whether shorter steps may tell more.
    pub(super) fn can_be_shorter(&self) -> bool {
        self.length > SHORTEST
    }

    /// Whether the branch passes close to where its ends expect it in the middle.
    pub(super) fn follows(&mut self) -> bool {
        self.node(0.5).is_some()
    }

    /// The station at a place: on the cubic between the known ones, or close beside it. Where branches meet, another one
    /// may be farther from it.
    fn between(&self, t: f64) -> Option<CurvePoint> {
        let index = self.nodes.partition_point(|node| node.spectrum.t < t);
        let known = |node: Option<&Rc<Node>>, end: usize| match node {
            Some(node) => (node.spectrum.t, node.point.clone()),
            None => (end as f64, self.ends[end].clone()),
        };
        let before = known(index.checked_sub(1).and_then(|k| self.nodes.get(k)), 0);
        let after = known(self.nodes.get(index), 1);
        let frame = &self.ends[0].frame;
        let end = |(_, point): &(f64, CurvePoint)| {
            let along = point.direction().scaled(self.rate(point)?);
            Some([frame.local(&point.place), frame.direction(&along)])
        };
        let h = after.0 - before.0;
        let share = (t - before.0) / h;
        let [a, b] = [end(&before)?, end(&after)?];
        let [predicted, rate] = curve_between(&a, &b, h, share);
        let off = |curve_positions: &[CurvePosition; 2]| {
            let along = curve_positions[1].dot(&self.normal);
            curve_positions[1].plus(-along, &self.normal).norm() * h
        };
        let turn = off(&a) + off(&b);
        let slack = CLOSE * self.length * h + ROUNDED;
        let reach = ASTRAY * turn + slack;
        let corrected = (self.curve).across(self.ends[0], &predicted, &self.normal, reach);
        let corrected = corrected.ok()?;
        let tangent = frame.direction(&corrected.direction()).scaled(self.rate(&corrected)?);
        let turned = tangent.plus(-1.0, &rate).norm() * h;
        (turned <= TURNED * turn + slack).then_some(corrected)
    }

    /// Hands modes of shafts on to and from the state at a position, and from each that gains some to the next.
    fn complete(&mut self, position: usize) {
        for from in [position.checked_sub(1), Some(position + 1)].into_iter().flatten() {
            self.hand(from, position);
        }
        let ways: [Vec<usize>; 2] = [(0..position).rev().collect(), (position + 1..self.nodes.len()).collect()];
        for way in ways {
            let mut from = position;
            for to in way {
                if !self.hand(from, to) {
                    break;
                }
                from = to;
            }
        }
    }

    /// Gives a state the modes that a state beside it has and it lacks; whether there are any.
    fn hand(&mut self, from: usize, to: usize) -> bool {
        let (Some(from), node) = (self.nodes.get(from), &self.nodes[to]) else { return false };
        let found = modes::match_with_assurance(&from.modes, &node.modes, &node.point.equilibrium.linear);
        if found.iter().all(Option::is_some) {
            return false;
        }
        let point = self.curve.judged_beside(node.point.clone(), &from.modes.modes);
        let gains = point.judged.len() > node.modes.modes.len();
        let again = self.rate(&point).filter(|_| gains);
        let again = again.and_then(|rate| self.question.node(point, node.spectrum.t, rate).ok());
        self.gained |= again.is_some();
        again.map(|again| self.nodes[to] = Rc::new(again)).is_some()
    }

    /// The events of the step, in order; `located` are the special points that the walk has found on it, `outer` whether
    /// the search begins or ends with it. `None` if a shorter step tells more.
    pub(super) fn findings(
        &mut self,
        wanted: &Wanted,
        located: &[Located],
        outer: [bool; 2],
        finest: f64,
    ) -> Option<Findings> {
        // Where a state has gained modes, what was made of it before no longer holds.
        let mut findings = None;
        for _ in 0..ROUNDS {
            self.gained = false;
            findings = self.found(wanted, located, outer, finest);
            if !self.gained {
                break;
            }
        }
        findings
    }

    fn found(&mut self, wanted: &Wanted, located: &[Located], outer: [bool; 2], finest: f64) -> Option<Findings> {
        let mut findings = Findings::default();
        let mut events = Vec::new();
        let mut broken = false;
        let mut specials: Vec<(f64, &Located)> = (located.iter()).map(|x| (self.place_of(&x.special), x)).collect();
        specials.sort_by(|a, b| a.0.total_cmp(&b.0));
        // The special points that are known divide the step.
        let mut from = (self.state(0.0)?, outer[0]);
        for special in specials.iter().map(Some).chain([None]) {
            let fraction = special.map(|pair| pair.0);
            let last = match special {
                Some(point) => self.beside(point, -1.0, from.0.t),
                None => Some(self.state(1.0)?),
            };
            if let Some(last) = &last {
                let interval =
                    Interval { ends: [from.0.clone(), last.clone()], outer: [from.1, outer[1] && fraction.is_none()] };
                let division = divide(self, wanted, interval, finest / self.length);
                let doubts = division.doubts.into_iter();
                findings.doubts.extend(doubts.map(|x| (x.between, x.kind)));
                findings.places.extend(division.places);
                events.extend(division.events);
                broken |= division.broken;
            } else {
                broken = true;
                let to = fraction.unwrap_or(1.0);
                findings.doubts.push(([from.0.t, to], Kind::Critical));
            }
            if let Some(point) = special {
                let Some(next) = self.beside(point, 1.0, 1.0) else {
                    break;
                };
                // What else changes this close to a special point is not told from it.
                for kind in wanted.kinds() {
                    if let Some(last) = &last
                        && kind != Kind::Critical
                        && wanted.count(kind, last) != wanted.count(kind, &next)
                    {
                        findings.doubts.push(([last.t, next.t], kind));
                    }
                }
                from = (next, false);
            }
        }
        // A station at an event would leave half of it to the next step.
        let at_event = |kind: &Kind| {
            let end = self.nodes.last().map(|node| &node.spectrum);
            let beside = self.before(1.0);
            let doubtful = |state: &Spectrum| wanted.doubtful(*kind, state);
            let more = end.zip(beside).is_some_and(|(a, b)| doubtful(a) > doubtful(&b.spectrum));
            more && !outer[1]
        };
        broken |= wanted.kinds().iter().any(at_event);
        // A growing pair that becomes real leaves no stiffness.
        events.retain(|event| event.kind != Kind::Critical || wanted.real(event.kind) || !event.turns(wanted));
        let (critical, met): (Vec<_>, Vec<_>) = (events.into_iter()).partition(|event| event.kind == Kind::Critical);
        // Next to a special point that the walk has located, a change of the number is that point.
        let known = |group: &&[Found]| {
            let mut places = specials.iter().map(|(t, _)| (t - group[0].t).abs());
            places.any(|away| away * self.length <= ROUGHLY)
        };
        let groups: Vec<&[Found]> =
            critical.chunk_by(|a, b| b.t - a.t <= SAME && a.rises == b.rises).filter(|group| !known(group)).collect();
        // Where the sign of the determinant changes twice, or that of an eigenvalue, the walk sees it on shorter steps.
        let seen = |group: &&[Found]| {
            let told = wanted.symmetric || group.len() % 2 == 1 && !accelerates(self.ends[1]);
            group[0].rises.is_some() && told
        };
        if self.can_be_shorter() && (broken || groups.iter().any(seen)) {
            return None;
        }
        let mut taken: Vec<(f64, Kind, usize)> = Vec::new();
        for event in &met {
            match self.meet(wanted, event, &taken) {
                Some((first, met)) => {
                    taken.push((event.t, event.kind, first));
                    findings.events.push((event.t, met));
                }
                None => {
                    let between = event.sides.each_ref().map(|state| state.t);
                    findings.doubts.push((between, event.kind));
                }
            }
        }
        let mut criticals: Vec<(f64, SpecialPoint, Option<Change>)> =
            (specials.iter()).map(|(t, x)| (*t, x.special.clone(), x.ends_arm.then_some(Change::Pass))).collect();
        for group in groups {
            let t = group[0].t;
            let touches = group[0].rises.is_none().then_some(Change::Touch);
            let special = self.degenerate(&group[0], group.len());
            criticals.extend(special.map(|special| (t, special, touches)));
        }
        self.criticals(criticals, &mut findings);
        findings.events.sort_by(|a, b| a.0.total_cmp(&b.0));
        Some(findings)
    }

    /// The state at which a mode meets a condition, with the position of the mode.
    fn meet(&mut self, wanted: &Wanted, found: &Found, taken: &[(f64, Kind, usize)]) -> Option<(usize, Event)> {
        let turning = found.turns(wanted);
        let condition = match found.kind {
            Kind::Line(k) => Condition::Line(wanted.lines[k]),
            _ => Condition::FlutterOnset,
        };
        let change = match (found.kind, found.rises) {
            (_, None) => Change::Touch,
            (Kind::Line(_), _) => Change::Pass,
            (_, Some(false)) if turning => Change::ToDivergence,
            (_, Some(true)) if turning => Change::ToFlutter,
            (_, Some(true)) => Change::Onset,
            (_, Some(false)) => Change::End,
        };
        let exact = self.node(found.t);
        let value = exact.as_ref().map(|node| node.point.place.p);
        // Where two merge, both are there on one side only: before they grow, or where they oscillate.
        let side = usize::from((found.rises == Some(true)) == turning);
        let beside = self.node(found.sides[side].t);
        let node = match found.merging || turning {
            true => beside,
            false => exact.or(beside),
        }?;
        let roots = &node.spectrum.roots;
        let free = |r: &usize| {
            let oscillates = wanted.undamped || roots[*r].paired;
            oscillates && !taken.contains(&(found.t, found.kind, *r))
        };
        let apart = |r: &usize| (roots[*r].value - found.near).norm();
        let nearest = |but: Option<usize>| {
            let like = |r: &usize| but.is_some_and(|k| k == *r || roots[*r].is_like(&roots[k]));
            (0..roots.len()).filter(|r| free(r) && !like(r)).min_by(|a, b| apart(a).total_cmp(&apart(b)))
        };
        let first = nearest(None)?;
        let second = nearest(Some(first)).filter(|_| found.kind == Kind::Growth && !turning);
        let met = condition.is_met(&node.modes.modes[first], node.spectrum.input[0]);
        // Next to where two merge, neither need meet the condition to rounding.
        let distance = if met { MERGED } else { NEARLY };
        let close = |r: usize| apart(&r) < distance * roots[r].value.norm();
        let merging = turning || found.merging || second.is_some_and(close);
        let met = met || merging;
        let second = second.filter(|_| merging);
        let event = Event::Met {
            value: value.unwrap_or(node.point.place.p),
            condition,
            modes: [first, second.unwrap_or(first)],
            change,
            merging,
            node,
        };
        met.then_some((first, event))
    }

    /// Adds the special points of the branch, with what changes there if that is known.
    fn criticals(&mut self, mut specials: Vec<(f64, SpecialPoint, Option<Change>)>, findings: &mut Findings) {
        specials.sort_by(|a, b| a.0.total_cmp(&b.0));
        for (k, (t, special, change)) in specials.into_iter().enumerate() {
            let sides = [self.before(t), self.after(t)];
            let counts = sides.each_ref().map(|node| node.as_deref().map(|node| node.spectrum.divergent()));
            let change = match (change, counts) {
                (Some(change), _) => change,
                (_, [Some(before), Some(after)]) if before < after => Change::Onset,
                (_, [Some(before), Some(after)]) if before > after => Change::End,
                _ => Change::Pass,
            };
            let loses = match k {
                0 => holds(self.ends[0]),
                _ => self.holds_before(t),
            };
            findings.events.push((t, Event::Critical { special: special.into(), change, loses }));
        }
    }

    fn holds_before(&self, t: f64) -> bool {
        self.before(t).is_none_or(|node| holds(&node.point))
    }

    /// A state as near to a special point as it can be solved, on one side of it and no farther than `limit`.
    fn beside(&mut self, &(t, special): &(f64, &Located), side: f64, limit: f64) -> Option<Rc<Spectrum>> {
        let exact = special.special.kind != SpecialKind::Degenerate;
        let least = if exact { 0.0 } else { ROUGHLY / self.length };
        ASIDE.iter().find_map(|aside| {
            let near = t + side * f64::max(least, *aside);
            let inside = (limit - near) * side > 0.0;
            inside.then(|| self.state(near)).flatten()
        })
    }

    /// A special point that is not resolved further, with the shape of what counts on one side of it.
    fn degenerate(&mut self, found: &Found, zero: usize) -> Option<SpecialPoint> {
        let (from, to) = (self.ends[0], self.ends[1]);
        let position = match self.node(found.t) {
            Some(node) => node.point.place.clone(),
            None => from.frame.place(&from.frame.local(&to.place).scaled(found.t)),
        };
        let side = usize::from(found.rises != Some(false));
        let beside = self.node(found.sides[side].t)?;
        let apart = |mode: &&Mode| (mode.s - found.near).norm();
        let mode = beside.modes.modes.iter().min_by(|a, b| apart(a).total_cmp(&apart(b)))?;
        let real = |shape: &[Complex]| shape.iter().map(|x| x.re).collect::<Vector>();
        let shapes = (&*real(&mode.shape), &*real(mode.left()));
        self.curve.degenerate(&position, &from.frame, shapes, zero).ok()
    }

    /// The place of a special point along the step.
    fn place_of(&self, special: &SpecialPoint) -> f64 {
        let local =
            self.ends[0].frame.local(&CurvePosition { q: special.equilibrium.coordinates.clone(), p: special.value });
        (local.dot(&self.normal) / self.length).clamp(0.0, 1.0)
    }

    /// The last known state before a place.
    fn before(&self, t: f64) -> Option<Rc<Node>> {
        self.nodes.get(self.nodes.partition_point(|node| node.spectrum.t < t - SAME).checked_sub(1)?).cloned()
    }

    /// The first known state after a place.
    fn after(&self, t: f64) -> Option<Rc<Node>> {
        let index = self.nodes.partition_point(|node| node.spectrum.t <= t + SAME);
        self.nodes.get(index).cloned()
    }
}

/// The cubic through two positions with their derivatives, and its derivative.
fn curve_between(a: &[CurvePosition; 2], b: &[CurvePosition; 2], h: f64, share: f64) -> [CurvePosition; 2] {
    let one = |from: [f64; 2], to: [f64; 2]| cubic(from, to, h, share);
    let unknown = |i: usize| one([a[0].q[i], a[1].q[i]], [b[0].q[i], b[1].q[i]]);
    let input = one([a[0].p, a[1].p], [b[0].p, b[1].p]);
    [0, 1].map(|k| CurvePosition { q: Vector::from_fn(a[0].q.len(), |i| unknown(i)[k]), p: input[k] })
}

/// Whether all stiffness is positive, and the determinant of one that is not symmetric.
fn holds(point: &CurvePoint) -> bool {
    // Two directions without stiffness leave the determinant of a non-symmetric one positive.
    let diverges = matches!(point.equilibrium.stability, Stability::Divergent { .. });
    // What holds the member of a family decides the sign of its determinant.
    let family = !point.equilibrium.free.held.is_empty();
    (family || accelerates(point) || point.stiff()) && !diverges
}

/// Whether a load accelerates free motions: a stiffness that vanishes then leaves the determinant as it is, and makes the
/// chain of a zero longer.
fn accelerates(point: &CurvePoint) -> bool {
    let state = &point.equilibrium;
    let structure = Structure::of(&state.description);
    modes::accelerates(&state.linear, structure, state.free.count())
}
