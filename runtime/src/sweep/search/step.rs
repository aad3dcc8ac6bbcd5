//! The events of one step along a branch, each located to rounding.

use std::rc::Rc;

use super::cubic::{Passage, Zero};
use super::divide::{Division, States, divide};
use super::node::{Node, Question};
use super::scalars::{Candidate, Kind, Wanted, difference};
use super::spectrum::Spectrum;
use crate::branches::{Curve, CurvePoint, CurvePosition, Located, SpecialKind, SpecialPoint};
use crate::sweep::condition::{Change, Condition, Line};
use crate::{Behaviour, Complex};

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
        special: SpecialPoint,
        change: Change,
        /// Whether all stiffness was positive before.
        loses: bool,
    },
    /// A mode meets a condition.
    Met {
        condition: Condition,
        node: Rc<Node>,
        /// Position of the mode at the node.
        mode: usize,
        change: Change,
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
/// Below this size, a step that does not shrink has reached rounding.
const ROUNDING: f64 = 1e-9;
/// Distance of two events, as a share of the step, below which they are one for several modes.
const SAME: f64 = 1e-9;
/// Distance from an event at which the states on either side of it are told apart.
const BESIDE: f64 = 1e-10;

impl States for Step<'_, '_> {
    fn state(&mut self, t: f64) -> Option<Rc<Spectrum>> {
        let node = self.node(t)?;
        let spectrum = node.spectrum.clone();
        let mut all = spectrum.roots.iter().chain(&spectrum.stiffness);
        let inner = t > 0.0 && t < 1.0;
        let known = |root: &super::spectrum::Root| root.slope.is_finite() || root.neutral;
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
        let place = self.nodes.partition_point(|node| node.spectrum.t < t);
        if let Some(known) = self.nodes.get(place).filter(|node| node.spectrum.t == t) {
            return Some(known.clone());
        }
        *self.left = self.left.checked_sub(1)?;
        let point = match t {
            0.0 => self.ends[0].clone(),
            1.0 => self.ends[1].clone(),
            _ => self.curve.between(self.ends[0], self.ends[1], t).ok()?,
        };
        let tangent = self.ends[0].frame.direction(&point.direction());
        let rate = self.length / tangent.dot(&self.normal);
        if !(rate > 0.0 && rate.is_finite()) {
            return None;
        }
        let node = Rc::new(self.question.node(point, t, rate).ok()?);
        self.nodes.insert(place, node.clone());
        Some(node)
    }

    /// The events of the step, in order; `located` are the special points that the walk has found on it. The end is part
    /// of the step only if it `closes` the search.
    pub(super) fn findings(
        &mut self,
        wanted: &Wanted,
        located: &[Located],
        closes: bool,
        finest: f64,
    ) -> Option<Findings> {
        let ends = [self.state(0.0)?, self.state(1.0)?];
        let Division {
            events,
            doubts,
            states,
        } = divide(self, wanted, ends, closes, finest / self.length);
        let mut found = Findings {
            doubts: doubts.iter().map(|own| (own.between, own.kind)).collect(),
            places: states.iter().map(|state| state.t).collect(),
            ..Findings::default()
        };
        let widths = found.places.windows(2).map(|pair| pair[1] - pair[0]);
        found.finest = widths.fold(1.0, f64::min) * self.length;
        let (critical, met): (Vec<_>, Vec<_>) =
            (events.into_iter()).partition(|event| event.kind == Kind::Critical);
        for candidate in &met {
            match self.meet(wanted, candidate) {
                Some(event) => found.events.push(event),
                None if candidate.zero.passage == Passage::Touches => {}
                None => found.doubts.push((candidate.zero.between, candidate.kind)),
            }
        }
        self.criticals(critical, located, &mut found);
        found.events.sort_by(|a, b| a.0.total_cmp(&b.0));
        Some(found)
    }

    /// Locates the state at which a mode meets a condition.
    fn meet(&mut self, wanted: &Wanted, candidate: &Candidate) -> Option<(f64, Event)> {
        let Candidate { kind, zero, near } = *candidate;
        let condition = match kind {
            Kind::Line(k) => Condition::Line(wanted.lines[k]),
            _ => Condition::FlutterOnset,
        };
        let t = self.root(wanted, kind, zero, near)?;
        let (mut t, near) = t;
        let mut node = self.node(t)?;
        if kind == Kind::Merging {
            // On the side where both keep their amplitude, both are there.
            let calm = |node: &Node| growing(node) == 0 || growing(node) <= least(self, zero);
            if !calm(&node) {
                let side = if zero.passage == Passage::Rises { -1.0 } else { 1.0 };
                let shifted = t + side * BESIDE / self.length;
                if (0.0..=1.0).contains(&shifted) {
                    (t, node) = (shifted, self.node(shifted)?);
                }
            }
        }
        let [mode, other] = nearest(&node.spectrum, near, (wanted.undamped, kind))?;
        let mode = if kind == Kind::Merging { mode.min(other) } else { mode };
        let met = match kind {
            Kind::Merging => true,
            _ => condition.is_met(&node.modes.modes[mode], node.spectrum.input[0]),
        };
        let change = match (kind, zero.passage) {
            (_, Passage::Touches) => Change::Touch,
            (Kind::Line(_), _) => Change::Pass,
            (_, Passage::Rises) => Change::Onset,
            (_, Passage::Falls) => Change::End,
        };
        met.then_some((
            t,
            Event::Met {
                condition,
                node,
                mode,
                change,
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
            let node = self.node(t)?;
            let spectrum = &node.spectrum;
            let [first, second] = nearest(spectrum, near, (wanted.undamped, kind))?;
            let roots = [first, second].map(|r| spectrum.roots[r]);
            let [u, du] = spectrum.input;
            let (value, slope) = match kind {
                Kind::Line(k) => {
                    let Line { ratio, offset } = wanted.lines[k];
                    let line = ratio * u + offset;
                    let (own, rate) = (roots[0].value, roots[0].slope);
                    match wanted.undamped {
                        true => (own.re - line * line, rate.re - 2.0 * line * ratio * du),
                        false => (own.im - line, rate.im - ratio * du),
                    }
                }
                Kind::Merging => {
                    let jet = difference(&roots[0], &roots[1]);
                    (jet.value, jet.slope)
                }
                _ => (roots[0].value.re, roots[0].slope.re),
            };
            if value == 0.0 {
                return Some((t, roots.map(|root| root.value)));
            }
            if (value > 0.0) == rises {
                high = high.min(t);
            } else {
                low = low.max(t);
            }
            let newton = t - value / slope;
            let next = match newton > low && newton < high {
                true => newton,
                // At an end of the step, or where the number is not smooth.
                false if zero.between[0] == zero.between[1] => newton.clamp(0.0, 1.0),
                false => 0.5 * (low + high),
            };
            let size = (next - t).abs();
            near = roots.map(|root| {
                let moved = root.value + root.slope * (next - t);
                if moved.is_finite() && size < ROUNDING.sqrt() { moved } else { root.value }
            });
            if size <= LAST_STEP || (size < ROUNDING && size >= 0.5 * last) {
                return Some((t, roots.map(|root| root.value)));
            }
            (t, last) = (next, size);
        }
        None
    }

    /// Resolves the places where stiffness vanishes into special points of the branch.
    fn criticals(&mut self, candidates: Vec<Candidate>, located: &[Located], found: &mut Findings) {
        let (touching, mut crossing): (Vec<_>, Vec<_>) =
            (candidates.into_iter()).partition(|own| own.zero.passage == Passage::Touches);
        crossing.sort_by(|a, b| a.zero.at.total_cmp(&b.zero.at));
        let mut specials: Vec<(f64, SpecialPoint)> = (located.iter())
            .map(|own| (self.place_of(&own.special), own.special.clone()))
            .collect();
        let several = |special: &SpecialPoint| special.kind == SpecialKind::Degenerate;
        let known = specials.len();
        if crossing.len() > known && !specials.iter().any(|(_, own)| several(own)) {
            specials = self.separated(&crossing);
        }
        for own in touching {
            if let Some(special) = self.degenerate(own.zero.at, 1) {
                let change = Change::Touch;
                let loses = self.before(own.zero.at).is_none_or(|node| node.point.stiff());
                found.events.push((
                    own.zero.at,
                    Event::Critical {
                        special,
                        change,
                        loses,
                    },
                ));
            }
        }
        for (t, special) in specials {
            let (before, after) = (self.before(t), self.after(t));
            let counts = [&before, &after].map(|node| node.as_deref().map(divergent));
            let change = match counts {
                [Some(before), Some(after)] if before < after => Change::Onset,
                [Some(before), Some(after)] if before > after => Change::End,
                _ => Change::Pass,
            };
            let holds = |node: &Node| {
                let diverges = crate::Stability::Divergent { negative: 1 };
                let verdict = node.point.equilibrium.stability;
                node.point.stiff()
                    && core::mem::discriminant(&verdict) != core::mem::discriminant(&diverges)
            };
            let loses = before.as_deref().is_none_or(holds);
            found.events.push((
                t,
                Event::Critical {
                    special,
                    change,
                    loses,
                },
            ));
        }
    }

    /// The special points at several places, each sought between the middles of the ways to its neighbours.
    fn separated(&mut self, crossing: &[Candidate]) -> Vec<(f64, SpecialPoint)> {
        let mut found = Vec::new();
        let mut rest = crossing;
        while let Some(first) = rest.first() {
            let same = |own: &&Candidate| own.zero.at - first.zero.at <= SAME;
            let count = rest.iter().take_while(same).count();
            let (group, after) = rest.split_at(count);
            let last = &group[count - 1];
            let mut between = [first.zero.between[0], last.zero.between[1]];
            if let Some(next) = after.first() {
                between[1] = between[1].min(0.5 * (last.zero.at + next.zero.at));
            }
            let [low, high] = match between[0] == between[1] {
                // At a state itself: between its neighbours.
                true => [
                    self.before(between[0]).map_or(0.0, |node| node.spectrum.t),
                    self.after(between[1]).map_or(1.0, |node| node.spectrum.t),
                ],
                false => between,
            };
            let ends = [self.node(low), self.node(high)];
            let mut located = Vec::new();
            if let [Some(a), Some(b)] = &ends
                && low < first.zero.at
                && high > last.zero.at
            {
                let _ = self.curve.locate(&a.point, &b.point, &mut located);
            }
            let at: Vec<(f64, SpecialPoint)> = (located.into_iter())
                .map(|own| (self.place_of(&own.special), own.special))
                .collect();
            match at.is_empty() {
                false => found.extend(at),
                true => {
                    let t = first.zero.at;
                    found.extend(self.degenerate(t, count).map(|special| (t, special)));
                }
            }
            rest = after;
        }
        found
    }

    /// A special point that is not resolved further.
    fn degenerate(&mut self, t: f64, zero: usize) -> Option<SpecialPoint> {
        let (from, to) = (self.ends[0], self.ends[1]);
        let place = match self.node(t) {
            Some(node) => node.point.place.clone(),
            None => from.frame.place(&from.frame.local(&to.place).scaled(t)),
        };
        let tangent = (&from.frame, &self.normal);
        self.curve.degenerate(&place, tangent, zero).ok()
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
        let place = self.nodes.partition_point(|node| node.spectrum.t < t - SAME);
        self.nodes.get(place.checked_sub(1)?).cloned()
    }

    /// The first known state after a place.
    fn after(&self, t: f64) -> Option<Rc<Node>> {
        let place = self.nodes.partition_point(|node| node.spectrum.t <= t + SAME);
        self.nodes.get(place).cloned()
    }
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

/// The smaller number of growing oscillations on either side of an event.
fn least(step: &Step<'_, '_>, zero: Zero) -> usize {
    let sides = [step.before(zero.at), step.after(zero.at)];
    let counts = sides.iter().flatten().map(|node| growing(node));
    counts.min().unwrap_or(0)
}

/// Positions of the two eigenvalues nearest to two given ones; twice that of the first if only one is meant.
fn nearest(
    spectrum: &Spectrum,
    near: [Complex; 2],
    (undamped, kind): (bool, Kind),
) -> Option<[usize; 2]> {
    let pick = |to: Complex, but: Option<usize>| {
        let all = spectrum.roots.iter().enumerate();
        let wanted = all.filter(|(r, root)| (undamped || root.paired) && Some(*r) != but);
        let apart = |root: &super::spectrum::Root| (root.value - to).norm();
        wanted
            .min_by(|a, b| apart(a.1).total_cmp(&apart(b.1)))
            .map(|(r, _)| r)
    };
    let first = pick(near[0], None)?;
    let second = match kind {
        Kind::Merging => pick(near[1], Some(first))?,
        _ => first,
    };
    Some([first, second])
}
