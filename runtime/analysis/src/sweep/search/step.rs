//! The events of one step along a branch, each located to rounding.

use std::rc::Rc;

use super::cubic::{Jet, Passage, Zero, cubic};
use super::divide::{Interval, States, divide};
use super::node::{Node, Question};
use super::pick::pick;
use super::scalars::{Candidate, Kind, Wanted};
use super::spectrum::{Root, Spectrum};
use crate::branches::{Curve, CurvePoint, CurvePosition, Located, SpecialKind, SpecialPoint};
use crate::sweep::condition::{Change, Condition};
use crate::{Behaviour, Complex, Stability, Vector};

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
    /// Width of the narrowest stretch.
    pub(super) finest: f64,
}

/// Most Newton steps towards an event.
const MAX_STEPS: usize = 60;
/// A step this small, as a share of the whole, changes nothing.
const LAST_STEP: f64 = 4.0 * f64::EPSILON;
/// A Newton step this small leaves a remainder at rounding.
const NEWTON: f64 = 1e-7;
/// Distance beyond the ends of a stretch, as a share of the step, at which an event may still belong to it.
const SLACK: f64 = 1e-5;
/// Below this size, a step that does not shrink has reached rounding.
const ROUNDING: f64 = 1e-9;
/// Distance of two events, as a share of the step, below which they are one for several modes.
const SAME: f64 = 1e-9;
/// Share of what the branch bends between two known stations by which it may miss the cubic between them, and share of
/// the way by which it may miss it in addition.
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
/// Distance from an event at which the states on either side of it are told apart.
const BESIDE: f64 = 1e-10;

impl States for Step<'_, '_> {
    fn state(&mut self, t: f64) -> Option<Rc<Spectrum>> {
        let node = self.node(t)?;
        let spectrum = node.spectrum.clone();
        let mut all = spectrum.roots.iter().chain(&spectrum.stiffness);
        let inner = t > 0.0 && t < 1.0;
        let known = |root: &Root| root.slope.is_finite() || root.neutral;
        (!inner || all.all(known)).then_some(spectrum)
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
            0.0 => self.ends[0].clone(),
            1.0 => self.ends[1].clone(),
            _ => self.between(t)?,
        };
        let rate = self.rate(&point)?;
        let node = Rc::new(self.question.node(point, t, rate).ok()?);
        self.nodes.insert(index, node.clone());
        Some(node)
    }

    /// The length of the step's parameter per unit of the local tangent of a station.
    fn rate(&self, point: &CurvePoint) -> Option<f64> {
        let tangent = self.ends[0].frame.direction(&point.direction());
        let rate = self.length / tangent.dot(&self.normal);
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
        let tangent = frame
            .direction(&corrected.direction())
            .scaled(self.rate(&corrected)?);
        let turned = tangent.plus(-1.0, &rate).norm() * h;
        (turned <= TURNED * turn + slack).then_some(corrected)
    }

    /// The events of the step, in order; `located` are the special points that the walk has found on it. The end is part
    /// of the step only if it `closes` the search. `None` if a shorter step tells more.
    pub(super) fn findings(
        &mut self,
        wanted: &Wanted,
        located: &[Located],
        closes: bool,
        finest: f64,
    ) -> Option<Findings> {
        let mut findings = Findings::default();
        let mut events = Vec::new();
        let mut broken = false;
        let mut specials: Vec<(f64, &Located)> = (located.iter())
            .map(|x| (self.place_of(&x.special), x))
            .collect();
        specials.sort_by(|a, b| a.0.total_cmp(&b.0));
        // The special points that are known divide the step.
        let mut from = (self.state(0.0)?, true);
        for special in specials.iter().map(Some).chain([None]) {
            let fraction = special.map(|pair| pair.0);
            let last = match special {
                Some(point) => self.beside(point, -1.0, from.0.t),
                None => Some(self.state(1.0)?),
            };
            if let Some(last) = last {
                let interval = Interval {
                    ends: [from.0.clone(), last],
                    opens: from.1,
                    closes: closes && fraction.is_none(),
                };
                let division = divide(self, wanted, interval, finest / self.length);
                let doubts = division
                    .doubts
                    .iter()
                    .map(|doubt| (doubt.between, doubt.kind));
                findings.doubts.extend(doubts);
                findings
                    .places
                    .extend(division.states.iter().map(|state| state.t));
                events.extend(division.events);
                broken |= division.broken;
            } else {
                broken = true;
                let to = fraction.unwrap_or(1.0);
                findings.doubts.push(([from.0.t, to], Kind::Critical));
            }
            if let Some(point) = special {
                match self.beside(point, 1.0, 1.0) {
                    Some(next) => from = (next, false),
                    None => break,
                }
            }
        }
        let (critical, met): (Vec<_>, Vec<_>) =
            (events.into_iter()).partition(|event| event.kind == Kind::Critical);
        if self.can_be_shorter() && (broken || !explained(&critical)) {
            return None;
        }
        for candidate in &met {
            match self.meet(wanted, candidate) {
                Some(event) => findings.events.push(event),
                None if candidate.zero.passage == Passage::Touches => {}
                None => findings
                    .doubts
                    .push((candidate.zero.between, candidate.kind)),
            }
        }
        self.criticals(wanted, critical, &specials, &mut findings);
        findings.events.sort_by(|a, b| a.0.total_cmp(&b.0));
        Some(findings)
    }

    /// Locates the state at which a mode meets a condition.
    fn meet(&mut self, wanted: &Wanted, candidate: &Candidate) -> Option<(f64, Event)> {
        let Candidate { kind, zero, near } = *candidate;
        let condition = match kind {
            Kind::Line(k) => Condition::Line(wanted.lines[k]),
            _ => Condition::FlutterOnset,
        };
        let (t, near) = self.root(wanted, kind, zero, near)?;
        // On the side where two keep their amplitude, both are there; and a pair, where it oscillates.
        let there = |step: &Self, node: &Node| match kind {
            Kind::Merging => growing(node) <= step.least(zero),
            Kind::Turning => pick(wanted, kind, &node.spectrum, near)
                .is_some_and(|picked| picked.positions[0] == picked.positions[1]),
            _ => true,
        };
        let side = match zero.passage {
            Passage::Rises => -1.0,
            _ => 1.0,
        };
        let exact = self.node(t);
        let value = exact.as_ref().map(|node| node.point.place.p);
        let mut nearby = exact.filter(|node| there(self, node));
        let mut aside = BESIDE / self.length;
        while nearby.is_none() && aside < SAME.sqrt() {
            let beside = (t + side * aside).clamp(0.0, 1.0);
            nearby = self.node(beside).filter(|node| there(self, node));
            aside *= 10.0;
        }
        let node = nearby?;
        let value = value.unwrap_or(node.point.place.p);
        let pair = pick(wanted, kind, &node.spectrum, near)?.positions;
        let first = pair[0].min(pair[1]);
        let met = match kind {
            Kind::Merging | Kind::Turning => true,
            _ => condition.is_met(&node.modes.modes[first], node.spectrum.input[0]),
        };
        let change = match (kind, zero.passage) {
            (_, Passage::Touches) => Change::Touch,
            (Kind::Line(_), _) => Change::Pass,
            (Kind::Turning, Passage::Rises) => Change::ToDivergence,
            (Kind::Turning, Passage::Falls) => Change::ToFlutter,
            (_, Passage::Rises) => Change::Onset,
            (_, Passage::Falls) => Change::End,
        };
        met.then_some((
            t,
            Event::Met {
                value,
                condition,
                node,
                modes: pair,
                change,
                merging: matches!(kind, Kind::Merging | Kind::Turning),
            },
        ))
    }

    /// The place where the number of an event vanishes, and the eigenvalues there.
    fn root(
        &mut self,
        wanted: &Wanted,
        kind: Kind,
        zero: Zero,
        mut near: [Complex; 2],
    ) -> Option<(f64, [Complex; 2])> {
        let (mut t, [mut low, mut high]) = (zero.at, zero.between);
        if zero.passage == Passage::Touches {
            return Some((t, near));
        }
        let rises = zero.passage == Passage::Rises;
        let mut last = f64::INFINITY;
        for _ in 0..MAX_STEPS {
            let node = self.node(t);
            let spectrum = node.as_ref().map(|node| &node.spectrum);
            let picked =
                spectrum.and_then(|spectrum| Some((spectrum, pick(wanted, kind, spectrum, near)?)));
            let close = last < ROUNDING.sqrt();
            let known = picked.filter(|(_, x)| x.jet.slope.is_finite() || !close);
            let Some((spectrum, picked)) = known else {
                // Where eigenvalues merge they have no derivatives; a Newton step from beside it has led there.
                return close.then_some((t, near));
            };
            let roots = picked.positions.map(|r| spectrum.roots[r]);
            let Jet { value, slope, .. } = picked.jet;
            if value == 0.0 {
                return Some((t, roots.map(|root| root.value)));
            }
            if (value > 0.0) == rises {
                high = high.min(t);
            } else {
                low = low.max(t);
            }
            let newton = t - value / slope;
            // Right beside an end the sign is not known.
            let [before, after] = [low, high].map(|end| {
                if zero.between.contains(&end) {
                    SLACK
                } else {
                    0.0
                }
            });
            let next = match newton > low - before && newton < high + after {
                true => newton,
                false => 0.5 * (low + high),
            };
            let size = (next - t).abs();
            near = roots.map(|root| {
                let moved = root.value + root.slope * (next - t);
                match kind != Kind::Turning && moved.is_finite() && size < ROUNDING.sqrt() {
                    true => moved,
                    false => root.value,
                }
            });
            if kind == Kind::Turning && roots[0].paired {
                near[1] = near[0].conj();
            }
            if size <= LAST_STEP || (size < ROUNDING && size >= 0.5 * last) {
                return Some((t, roots.map(|root| root.value)));
            }
            (t, last) = (next, size);
        }
        None
    }

    /// Adds the special points of the branch: those that are known, and those at further places where stiffness vanishes.
    fn criticals(
        &mut self,
        wanted: &Wanted,
        candidates: Vec<Candidate>,
        known: &[(f64, &Located)],
        findings: &mut Findings,
    ) {
        let (touching, mut crossing): (Vec<_>, Vec<_>) = (candidates.into_iter())
            .partition(|candidate| candidate.zero.passage == Passage::Touches);
        for candidate in &mut crossing {
            candidate.zero.at = self.refined(wanted, candidate);
        }
        crossing.sort_by(|a, b| a.zero.at.total_cmp(&b.zero.at));
        let of_walk = (known.iter()).map(|(t, x)| (*t, x.special.clone(), x.ends_arm));
        let separated = self.separated(&crossing).into_iter();
        let mut specials: Vec<_> = separated
            .map(|(t, x)| (t, x, false))
            .chain(of_walk)
            .collect();
        specials.sort_by(|a, b| a.0.total_cmp(&b.0));
        let touching = touching.iter().map(|x| x.zero.at);
        let touching = touching.filter_map(|t| Some((t, self.degenerate(t, 1)?)));
        for (t, special) in touching.collect::<Vec<_>>() {
            findings.events.push((
                t,
                Event::Critical {
                    special: special.into(),
                    change: Change::Touch,
                    loses: self.holds_before(t),
                },
            ));
        }
        for (k, (t, special, ends_arm)) in specials.into_iter().enumerate() {
            let sides = [self.before(t), self.after(t)];
            let counts = sides.each_ref().map(|node| node.as_deref().map(divergent));
            let change = match counts {
                _ if ends_arm => Change::Pass,
                [Some(before), Some(after)] if before < after => Change::Onset,
                [Some(before), Some(after)] if before > after => Change::End,
                _ => Change::Pass,
            };
            let loses = match k {
                0 => holds(self.ends[0]),
                _ => self.holds_before(t),
            };
            findings.events.push((
                t,
                Event::Critical {
                    special: special.into(),
                    change,
                    loses,
                },
            ));
        }
    }

    /// The smaller number of growing oscillations on either side of an event.
    fn least(&self, zero: Zero) -> usize {
        let sides = [self.before(zero.at), self.after(zero.at)];
        let counts = sides.iter().flatten().map(|node| growing(node));
        counts.min().unwrap_or(0)
    }

    fn holds_before(&self, t: f64) -> bool {
        let before = self.before(t);
        before.is_none_or(|node| holds(&node.point))
    }

    /// A state as near to a special point as it can be solved, on one side of it and no farther than `limit`.
    fn beside(
        &mut self,
        &(t, special): &(f64, &Located),
        side: f64,
        limit: f64,
    ) -> Option<Rc<Spectrum>> {
        let exact = special.special.kind != SpecialKind::Degenerate;
        let least = if exact { 0.0 } else { ROUGHLY / self.length };
        ASIDE.iter().find_map(|aside| {
            let near = t + side * f64::max(least, *aside);
            let inside = (limit - near) * side > 0.0;
            inside.then(|| self.state(near)).flatten()
        })
    }

    /// The place at which stiffness vanishes, by Newton steps from states at which it does not.
    fn refined(&mut self, wanted: &Wanted, candidate: &Candidate) -> f64 {
        let Candidate { kind, zero, near } = *candidate;
        let [low, high] = zero.between;
        let mut t = zero.at;
        for _ in 0..MAX_STEPS {
            let picked = (self.node(t)).and_then(|node| pick(wanted, kind, &node.spectrum, near));
            let Some(Jet { value, slope, .. }) = picked.map(|picked| picked.jet) else {
                return t;
            };
            let next = t - value / slope;
            let size = (next - t).abs();
            if !(next > low && next < high) {
                return t;
            }
            t = next;
            if size < NEWTON {
                return t;
            }
        }
        t
    }

    /// The special points at several places, each sought between the middles of the ways to its neighbours.
    fn separated(&mut self, crossing: &[Candidate]) -> Vec<(f64, SpecialPoint)> {
        let mut special_points = Vec::new();
        let mut rest = crossing;
        let mut previous: Option<&Candidate> = None;
        while let Some(first) = rest.first() {
            let same = |candidate: &&Candidate| candidate.zero.at - first.zero.at <= SAME;
            let count = rest.iter().take_while(same).count();
            let (group, after) = rest.split_at(count);
            let last = &group[count - 1];
            let middle = |a: &Candidate, b: &Candidate| 0.5 * (a.zero.at + b.zero.at);
            let mut low = first.zero.between[0];
            let mut high = last.zero.between[1];
            if low == high {
                // At a state itself: between its neighbours.
                low = self.before(low).map_or(0.0, |node| node.spectrum.t);
                high = self.after(high).map_or(1.0, |node| node.spectrum.t);
            }
            low = previous.map_or(low, |previous| low.max(middle(previous, first)));
            high = after.first().map_or(high, |x| high.min(middle(last, x)));
            let ends = [self.node(low), self.node(high)];
            let mut located = Vec::new();
            if let [Some(a), Some(b)] = &ends
                && low < first.zero.at
                && high > last.zero.at
            {
                let _ = self.curve.locate(&a.point, &b.point, &mut located);
            }
            let at: Vec<(f64, SpecialPoint)> = (located.into_iter())
                .map(|x| (self.place_of(&x.special), x.special))
                .collect();
            match at.is_empty() {
                false => special_points.extend(at),
                true => {
                    let t = first.zero.at;
                    special_points.extend(self.degenerate(t, count).map(|special| (t, special)));
                }
            }
            (rest, previous) = (after, Some(last));
        }
        special_points
    }

    /// A special point that is not resolved further.
    fn degenerate(&mut self, t: f64, zero: usize) -> Option<SpecialPoint> {
        let (from, to) = (self.ends[0], self.ends[1]);
        let position = match self.node(t) {
            Some(node) => node.point.place.clone(),
            None => from.frame.place(&from.frame.local(&to.place).scaled(t)),
        };
        let tangent = (&from.frame, &self.normal);
        self.curve.degenerate(&position, tangent, zero).ok()
    }

    /// The place of a special point along the step.
    fn place_of(&self, special: &SpecialPoint) -> f64 {
        let local = self.ends[0].frame.local(&CurvePosition {
            q: special.equilibrium.coordinates.clone(),
            p: special.value,
        });
        (local.dot(&self.normal) / self.length).clamp(0.0, 1.0)
    }

    /// The last known state before a place.
    fn before(&self, t: f64) -> Option<Rc<Node>> {
        let index = self
            .nodes
            .partition_point(|node| node.spectrum.t < t - SAME);
        self.nodes.get(index.checked_sub(1)?).cloned()
    }

    /// The first known state after a place.
    fn after(&self, t: f64) -> Option<Rc<Node>> {
        let index = self
            .nodes
            .partition_point(|node| node.spectrum.t <= t + SAME);
        self.nodes.get(index).cloned()
    }
}

/// The cubic through two positions with their derivatives, and its derivative.
fn curve_between(
    a: &[CurvePosition; 2],
    b: &[CurvePosition; 2],
    h: f64,
    share: f64,
) -> [CurvePosition; 2] {
    let one = |from: [f64; 2], to: [f64; 2]| cubic(from, to, h, share);
    let unknown = |i: usize| one([a[0].q[i], a[1].q[i]], [b[0].q[i], b[1].q[i]]);
    let input = one([a[0].p, a[1].p], [b[0].p, b[1].p]);
    [0, 1].map(|k| CurvePosition {
        q: Vector::from_fn(a[0].q.len(), |i| unknown(i)[k]),
        p: input[k],
    })
}

/// Whether none of these places where stiffness vanishes needs a shorter step, in which the walk sees it.
fn explained(critical: &[Candidate]) -> bool {
    critical.iter().all(|item| {
        let Zero {
            between, passage, ..
        } = item.zero;
        passage == Passage::Touches || between[0] == between[1]
    })
}

/// Whether all stiffness is positive, and the determinant of one that is not symmetric.
fn holds(point: &CurvePoint) -> bool {
    // Two directions without stiffness leave the determinant of a non-symmetric one positive.
    let diverges = matches!(point.equilibrium.stability, Stability::Divergent { .. });
    // What holds the member of a family decides the sign of its determinant.
    let family = !point.equilibrium.free.held.is_empty();
    (family || point.stiff()) && !diverges
}

/// Number of growing oscillations.
fn growing(node: &Node) -> usize {
    let all = node.modes.modes.iter();
    all.filter(|mode| matches!(mode.behaviour, Behaviour::Flutter(_)))
        .count()
}

/// Number of motions that grow without oscillation.
fn divergent(node: &Node) -> usize {
    let all = node.modes.modes.iter();
    all.filter(|mode| matches!(mode.behaviour, Behaviour::Divergent(_)))
        .count()
}
