//! The path on which events are sought. It starts at the equilibrium at the low end and follows its branch; where the branch
//! ends or loses stability, it continues from the state the mechanism settles into.

use core::ops::ControlFlow;

use super::count::{Kind, Wanted};
use super::events::{Events, Gap, Route, Searched, Unresolved};
use super::node::{Node, Question, has_stiffness};
use super::step::{Event, Step};
use crate::branches::{
    BranchEnd, Continuation, ContinuationFailure, Curve, CurvePoint, CurvePosition, Located, Pass, SpecialKind,
    SpecialPoint,
};
use crate::equilibrium::{Held, OperatingPoint, Policy, equilibrium_into};
use crate::error::NotFound;
use crate::kernels::DirectionalKernels;
use crate::modes::{CLUSTER_GAP, Family, match_with_assurance, merged, near_another, position};
use crate::sweep::condition::{Change, Condition, Crossing, Line};
use crate::sweep::points::{CriticalState, SweepPoint};
use crate::sweep::range::Range;
use crate::{DampingKind, Equilibrium, Error, Kernels, Modes, Stability, Vector};

/// What to look for.
#[derive(Clone, Debug, Default)]
pub(crate) struct Sought {
    /// Lines that frequencies meet.
    pub(crate) lines: Vec<Line>,
    /// Oscillations that start or stop growing.
    pub(crate) flutter: bool,
    /// Vanishing stiffness.
    pub(crate) critical: bool,
}

/// Where and how to search.
#[derive(Clone)]
pub(crate) struct Along<'a> {
    pub(crate) mechanism: &'a dyn DirectionalKernels,
    pub(crate) values: (&'a [f64], &'a [f64]),
    pub(crate) start: &'a [f64],
    pub(crate) policy: Policy,
    pub(crate) family: Family,
    pub(crate) range: Range,
    /// The unknowns that hold a member of a family of steady motions.
    pub(crate) held: Vec<Held>,
}

/// An event as it is found.
pub(crate) enum Met<'a> {
    /// Stiffness vanishes, and whether all of it was positive before.
    Critical(&'a CriticalState, bool),
    Crossing(&'a Crossing),
    /// There is no equilibrium to follow.
    Gap,
}

/// Maximum number of states of a search.
const MOST_STATES: usize = 4000;
/// What one step may take of those that are left: what is not resolved there must not hide what is behind it.
const OF_STEP: usize = 8;
/// Part of the range below which a step that has taken all it may is not shortened any more.
const COARSE: f64 = 1.0 / 32.0;
/// Maximum number of pieces of the way: a safeguard.
const MOST_PIECES: usize = 64;
/// Bounds on the largest step along a branch.
const FINEST_STEP: f64 = 1e-4;
const COARSEST_STEP: f64 = 0.1;
/// Maximum number of points of one branch.
const MOST_POINTS: usize = 50_000;
/// Events are not separated below this share of the range.
const RESOLUTION: f64 = 1e-10;
/// Shares of the range behind a critical state at which the equilibrium that follows is sought.
const BEHIND: [f64; 4] = [1e-6, 1e-5, 1e-4, 1e-3];
/// Share of the range within which a critical state at the end is the last one found.
const SAME: f64 = 1e-9;
/// Assurance below which a mode counts as not recognised, and a state between is sought.
const RECOGNISED: f64 = 0.8;
/// Maximum number of times the way to a state is halved to recognise its modes.
const HALVINGS: usize = 6;

/// Finds the events along a range; the search ends early if `enough` says so.
///
/// # Errors
/// [`Error::UnknownHandle`], [`Error::Setting`]. A range without any equilibrium is one gap.
pub(crate) fn search(
    along: &Along<'_>,
    sought: &Sought,
    enough: impl FnMut(Met<'_>) -> bool,
) -> Result<(Events, Route), Error> {
    let description = along.mechanism.description();
    let Range { input, low, high, steps } = along.range;
    along.range.check(&description)?;
    for Line { ratio, offset } in &sought.lines {
        if !(ratio.is_finite() && offset.is_finite()) {
            return Err(Error::setting("line", format!("{ratio} times the input + {offset} rad/s is not finite")));
        }
    }
    let settings = Continuation {
        max_step: (1.0 / steps as f64).clamp(FINEST_STEP, COARSEST_STEP),
        max_points: MOST_POINTS,
        ..Continuation::new(input, low, high)
    };
    let undamped = along.family == Family::Undamped;
    let symmetric = {
        let (u, b) = along.values;
        has_stiffness(&Equilibrium::blank(&description, u, b))
    };
    let kernels: &dyn Kernels = along.mechanism;
    let question = Question {
        mechanism: along.mechanism,
        family: along.family,
        input: input.index(),
        deviation: kernels.deviation(input.index(), along.values.1),
        stiffness: symmetric && !undamped && sought.critical,
    };
    let wanted = Wanted {
        lines: sought.lines.clone(),
        growth: sought.flutter && !undamped,
        critical: sought.critical,
        undamped,
        symmetric,
        conservative: symmetric && description.damping != DampingKind::General,
    };
    let mut search = Search {
        along,
        settings: &settings,
        question: &question,
        wanted: &wanted,
        enough,
        left: MOST_STATES,
        last: None,
        route: Route::default(),
        events: Events {
            input,
            critical: Vec::new(),
            crossings: Vec::new(),
            searched: Searched { low, high, states: 0, resolution: 0.0, unresolved: Vec::new(), gaps: Vec::new() },
            description,
        },
    };
    search.run();
    let mut events = search.events;
    events.searched.states = MOST_STATES - search.left;
    events.searched.join();
    events.searched.resolution = RESOLUTION * (high - low).abs();
    Ok((events, search.route))
}

struct Search<'a, F> {
    along: &'a Along<'a>,
    settings: &'a Continuation,
    question: &'a Question<'a>,
    wanted: &'a Wanted,
    enough: F,
    left: usize,
    /// The last modes on the way, with their labels.
    last: Option<Modes>,
    route: Route,
    events: Events,
}

/// How the search continues.
enum Next {
    /// It does not.
    Done,
    /// From this state.
    From(Box<Equilibrium>),
    /// From this station.
    Along(Box<CurvePoint>),
    /// Wherever there is a state behind a value; the state before it, and why there is none.
    Seek(f64, Vector, Error),
}

impl<F: FnMut(Met<'_>) -> bool> Search<'_, F> {
    fn run(&mut self) {
        let low = self.settings.low;
        let mut next = match self.solve(low, self.along.start, self.along.policy) {
            Ok(state) => Next::From(Box::new(state)),
            Err(error) => Next::Seek(low, self.along.start.into(), error),
        };
        for _ in 0..MOST_PIECES {
            next = match next {
                Next::Done => break,
                Next::From(state) => self.follow(&state, None),
                Next::Along(point) => self.follow(&point.equilibrium, Some(&point)),
                Next::Seek(value, from, error) => self.seek(value, &from, error),
            };
        }
    }

    fn solve(&self, value: f64, from: &[f64], policy: Policy) -> Result<Equilibrium, Error> {
        let (u, b) = self.along.values;
        let mut inputs = Vector::from(u);
        inputs[self.settings.input.index()] = value;
        let mechanism = self.along.mechanism;
        let point = OperatingPoint::new(mechanism, &inputs, b)?.held_by(&self.along.held);
        let mut state = Equilibrium::blank(&mechanism.description(), &inputs, b);
        equilibrium_into(&point, from, policy, &mut state)?;
        Ok(state)
    }

    /// The direction of the search.
    fn forward(&self) -> f64 {
        (self.settings.high - self.settings.low).signum()
    }

    /// Follows the branch through a state, or on from a station of it, and finds the events on it.
    fn follow(&mut self, state: &Equilibrium, from: Option<&CurvePoint>) -> Next {
        let (u, b) = self.along.values;
        let value = state.inputs[self.settings.input.index()];
        let curve = match Curve::new(self.along.mechanism, u, b, self.settings) {
            Ok(curve) => curve.about(state),
            Err(error) => return Next::Seek(value, state.coordinates.clone(), error),
        };
        let begun = match from {
            Some(point) => Ok(point.clone()),
            None => curve.begin(state),
        };
        let station = match begun {
            Ok(station) => station,
            Err(trouble) => {
                let error = reason(&curve, curve.broken_off(trouble, state), state);
                return Next::Seek(value, state.coordinates.clone(), error);
            }
        };
        if from.is_none() && value == self.settings.low && station.place.p != value {
            self.critical_at_start(&curve, state, &station);
        }
        let begin = self.route.points.len();
        let mut next = None;
        let mut reached = station.clone();
        let mut behind = station.clone();
        let walk = curve.walk(&station, &station.place, |before, after, located| {
            match self.step(&curve, [before, after], located) {
                ControlFlow::Continue(pass) => {
                    if pass == Pass::On {
                        reached = after.clone();
                        behind = before.clone();
                    }
                    pass
                }
                ControlFlow::Break(end) => {
                    next = Some(end);
                    Pass::Stop
                }
            }
        });
        let until = match (&next, self.events.critical.last()) {
            (Some(Next::From(_) | Next::Seek(..)), Some(critical)) => critical.value,
            _ => reached.place.p,
        };
        if self.route.points.len() > begin {
            self.route.pieces.push((begin, until));
        }
        if let Some(next) = next {
            return next;
        }
        let (value, from) = (reached.place.p, reached.place.q.clone());
        match walk.end {
            end if end == curve.end_at(self.settings.high) => {
                if let Some(end) = walk.points.last() {
                    let beside = if reached.place.p == self.settings.high { &behind } else { &reached };
                    self.critical_at_end(&curve, &end.equilibrium, beside);
                }
                Next::Done
            }
            BranchEnd::BranchPoint => self.behind(value, &from),
            end => Next::Seek(value, from, reason(&curve, end, &reached.equilibrium)),
        }
    }

    /// The start itself lacks stiffness.
    fn critical_at_start(&mut self, curve: &Curve<'_>, state: &Equilibrium, beside: &CurvePoint) {
        let curve_position = CurvePosition { q: state.coordinates.clone(), p: self.settings.low };
        let zero = zeros(state).max(1);
        let shapes = (&*beside.direction().q, &*beside.direction().q);
        if self.wanted.critical
            && zero > zeros(&beside.equilibrium)
            && let Ok(special) = curve.degenerate(&curve_position, &beside.frame, shapes, zero)
        {
            self.critical(special, Change::Pass, false);
        }
    }

    /// The end itself lacks stiffness that a point beside it has.
    fn critical_at_end(&mut self, curve: &Curve<'_>, end: &Equilibrium, beside: &CurvePoint) {
        let zero = zeros(end);
        let curve_position = CurvePosition { q: end.coordinates.clone(), p: self.settings.high };
        let Continuation { low, high, .. } = *self.settings;
        let near = |critical_state: &CriticalState| (critical_state.value - high).abs() <= SAME * (high - low).abs();
        let known = self.events.critical.last().is_some_and(near);
        let shapes = (&*beside.direction().q, &*beside.direction().q);
        if self.wanted.critical
            && !known
            && zero > zeros(&beside.equilibrium)
            && let Ok(special) = curve.degenerate(&curve_position, &beside.frame, shapes, zero)
        {
            self.critical(special, Change::Pass, beside.stiff());
        }
    }

    /// Finds the events of one step; returns early, with how the search continues, if the path leaves the branch.
    fn step(
        &mut self,
        curve: &Curve<'_>,
        [before, after]: [&CurvePoint; 2],
        located: &[Located],
    ) -> ControlFlow<Next, Pass> {
        let closes = after.place.p == self.settings.high;
        let outer = [self.route.points.is_empty(), closes];
        let turns = before.signs.falling != after.signs.falling;
        let share = self.left.div_ceil(OF_STEP);
        let mut left = share;
        let step = Step::new(curve, self.question, [before, after], &mut left);
        let Some(mut step) = step else {
            return ControlFlow::Continue(Pass::On);
        };
        let findings = if step.follows() { step.findings(self.wanted, located, outer, RESOLUTION) } else { None };
        let shorter = step.can_be_shorter();
        let Some(findings) = findings else {
            drop(step);
            self.left -= share - left;
            let Continuation { low, high, .. } = *self.settings;
            let resolves = left > 0 || (after.place.p - before.place.p).abs() > COARSE * (high - low).abs();
            if shorter && resolves && self.left > 0 {
                return ControlFlow::Continue(Pass::Shorter);
            }
            self.doubt([before.place.p, after.place.p], None);
            // Special points are known nevertheless.
            for point in located {
                self.critical(point.special.clone(), Change::Pass, before.stiff());
                let settled = after.equilibrium.stability.holds();
                if let Some(next) = self.goes_on(&point.special, turns || point.ends_arm, settled) {
                    return ControlFlow::Break(next);
                }
            }
            return ControlFlow::Continue(Pass::On);
        };
        let value = |t: f64| before.place.p + t * (after.place.p - before.place.p);
        let mut places = findings.places.into_iter().peekable();
        let mut next = None;
        let criticals = findings.events.iter();
        let criticals = criticals.filter(|event| matches!(event.1, Event::Critical { .. }));
        let criticals: Vec<f64> = criticals.map(|(t, _)| *t).collect();
        // Between a critical state and the next one, or the end of the step.
        let settled = |step: &mut Step<'_, '_>, t: f64| {
            let behind = step.node(0.5 * (t + criticals.iter().find(|other| **other > t).unwrap_or(&1.0)));
            behind.as_ref().map_or(after, |node| &node.point).equilibrium.stability.holds()
        };
        for (t, event) in findings.events {
            while let Some(fraction) = places.next_if(|fraction| *fraction <= t) {
                self.pass(&mut step, fraction);
            }
            match event {
                Event::Critical { special, change, loses } => {
                    let stop = self.critical((*special).clone(), change, loses);
                    let last = located.last().map(|x| &x.special);
                    let ends = |located: &Located| located.ends_arm && located.special == *special;
                    let arm = located.iter().any(ends) || turns && last == Some(&*special);
                    next = if stop { Some(Next::Done) } else { self.goes_on(&special, arm, settled(&mut step, t)) };
                }
                Event::Met { value, condition, node, modes, change, merging } => {
                    let ends = (t == 0.0 && self.route.points.len() <= 1, t == 1.0 && closes);
                    if counts(condition, change, &node, ends)
                        && self.crossing((value, condition, change), (&node, modes, merging))
                    {
                        next = Some(Next::Done);
                    }
                }
            }
            if next.is_some() {
                break;
            }
        }
        if next.is_none() {
            for fraction in places {
                self.pass(&mut step, fraction);
            }
        }
        for (between, kind) in findings.doubts {
            let condition = match kind {
                Kind::Critical => None,
                Kind::Line(k) => Some(Condition::Line(self.wanted.lines[k])),
                Kind::Growth => Some(Condition::FlutterOnset),
            };
            self.doubt(between.map(value), condition);
        }
        drop(step);
        self.left -= share - left;
        match next {
            Some(next) => ControlFlow::Break(next),
            None => ControlFlow::Continue(Pass::On),
        }
    }

    fn doubt(&mut self, [from, to]: [f64; 2], condition: Option<Condition>) {
        let all = &mut self.events.searched.unresolved;
        all.push(Unresolved { from, to, condition });
    }

    /// Passes a state: its modes get the labels of those before.
    fn pass(&mut self, step: &mut Step<'_, '_>, fraction: f64) {
        let Some(node) = step.node(fraction) else {
            return;
        };
        let from = self.route.points.last().map(|point| point.value);
        self.recognise(step, (0.0, fraction), HALVINGS);
        if from == Some(node.point.place.p) {
            return;
        }
        let modes = self.labelled(&node);
        self.route.unused = modes.modes.iter().map(|mode| mode.label + 1).fold(self.route.unused, usize::max);
        self.last = Some(modes.clone());
        self.route.points.push(SweepPoint {
            value: node.point.place.p,
            equilibrium: Ok(node.point.equilibrium.clone()),
            modes: Ok(modes),
        });
    }

    /// Passes states between two places until all modes at the second are recognised.
    fn recognise(&mut self, step: &mut Step<'_, '_>, (from, to): (f64, f64), halvings: usize) {
        let (Some(last), Some(node)) = (&self.last, step.node(to)) else {
            return;
        };
        let node_modes = &node.modes;
        let order = match_with_assurance(last, node_modes, &node.point.equilibrium.linear);
        // Modes with equal eigenvalues have no unique shapes: no step is small enough to recognise them.
        let repeated = |r: usize| merged(node_modes, r) || near_another(node_modes, r, CLUSTER_GAP);
        let doubtful =
            (order.iter().flatten()).any(|&(position, assurance)| assurance < RECOGNISED && !repeated(position));
        if !doubtful || halvings == 0 {
            return;
        }
        let middle = 0.5 * (from + to);
        self.recognise(step, (from, middle), halvings - 1);
        if let Some(node) = step.node(middle) {
            let modes = self.labelled(&node);
            self.route.unused = modes.modes.iter().map(|mode| mode.label + 1).fold(self.route.unused, usize::max);
            self.last = Some(modes);
        }
        self.recognise(step, (middle, to), halvings - 1);
    }

    /// The modes of a state with the order and labels of the last ones.
    fn labelled(&self, node: &Node) -> Modes {
        let mut modes = node.modes.clone();
        if let Some(last) = &self.last {
            let order = match_with_assurance(last, &modes, &node.point.equilibrium.linear);
            modes.arrange(last, &order.map(position), self.route.unused);
        }
        modes
    }

    /// Adds a critical state; returns whether it is enough.
    fn critical(&mut self, special: SpecialPoint, change: Change, loses: bool) -> bool {
        if !self.wanted.critical {
            return false;
        }
        let state = CriticalState {
            input: special.input,
            value: special.value,
            kind: special.kind,
            change,
            equilibrium: special.equilibrium,
            v: special.v,
            w: special.w,
        };
        let stop = (self.enough)(Met::Critical(&state, loses));
        self.events.critical.push(state);
        stop
    }

    /// How the search continues past the last critical state; leaving the branch does not count as the onset of
    /// instability.
    fn goes_on(&mut self, special: &SpecialPoint, arm: bool, settled: bool) -> Option<Next> {
        let next = self.leaves(special, arm, settled)?;
        if let Some(last) = self.events.critical.last_mut()
            && last.value == special.value
        {
            last.change = Change::Pass;
        }
        Some(next)
    }

    /// Adds a crossing; returns whether it is enough.
    fn crossing(
        &mut self,
        (value, condition, change): (f64, Condition, Change),
        (node, pair, merging): (&Node, [usize; 2], bool),
    ) -> bool {
        let modes = self.labelled(node);
        let places = pair.map(|k| {
            let mode = &node.modes.modes[k];
            modes.modes.iter().position(|other| other.s == mode.s && other.shape == mode.shape).unwrap_or(k)
        });
        // Of two that merge, each could pass for either: the event is the first one's.
        let mode = places.into_iter().min_by_key(|index: &usize| modes.modes[*index].label).unwrap_or(pair[0]);
        let crossing = Crossing {
            input: self.events.input,
            value,
            condition,
            change,
            merging,
            mode,
            equilibrium: node.point.equilibrium.clone(),
            modes,
        };
        let stop = (self.enough)(Met::Crossing(&crossing));
        self.events.crossings.push(crossing);
        stop
    }

    /// How the way goes on where it leaves the branch at a special point, if it does.
    fn leaves(&self, special: &SpecialPoint, arm: bool, settled: bool) -> Option<Next> {
        let from = &special.equilibrium.coordinates;
        let turns = special.kind == SpecialKind::Fold;
        if turns || arm {
            return Some(self.behind(special.value, from));
        }
        let potential = has_stiffness(&special.equilibrium);
        if self.along.policy != Policy::Stable || !potential || settled {
            return None;
        }
        // Right behind it the stable state is too close to the branch to be told from it.
        BEHIND.iter().find_map(|share| {
            let value = special.value + share * (self.settings.high - self.settings.low);
            let inside = (self.settings.high - value) * self.forward() > 0.0;
            let state = inside.then(|| self.solve(value, from, Policy::Stable))?;
            let state = state.ok().filter(|state| state.stability.holds())?;
            Some(Next::From(Box::new(state)))
        })
    }

    /// The state behind a value at which a branch ends.
    fn behind(&self, value: f64, from: &[f64]) -> Next {
        let next = value + BEHIND[0] * (self.settings.high - self.settings.low);
        if (self.settings.high - next) * self.forward() <= 0.0 {
            return Next::Done;
        }
        match self.solve(next, from, self.along.policy) {
            Ok(state) => Next::From(Box::new(state)),
            Err(error) => Next::Seek(value, from.into(), error),
        }
    }

    /// Looks for the next value at which there is a state, and for the beginning of its branch.
    fn seek(&mut self, value: f64, from: &[f64], error: Error) -> Next {
        if (self.enough)(Met::Gap) {
            self.gap(value, self.settings.high, error);
            return Next::Done;
        }
        let high = self.settings.high;
        let step = self.settings.max_step * (high - self.settings.low);
        let mut trial = value;
        let mut resumed = None;
        while trial != high && resumed.is_none() {
            trial = if (high - trial - step) * self.forward() > 0.0 { trial + step } else { high };
            resumed = self.solve(trial, from, self.along.policy).ok();
        }
        let Some(state) = resumed else {
            self.gap(value, high, error);
            return Next::Done;
        };
        self.backwards(value, &state, error)
    }

    fn gap(&mut self, from: f64, to: f64, reason: Error) {
        if from != to {
            let gaps = &mut self.events.searched.gaps;
            gaps.push(Gap { from, to, reason });
        }
    }

    /// The first station, behind `limit`, of the branch through a state.
    fn backwards(&mut self, limit: f64, state: &Equilibrium, error: Error) -> Next {
        let (u, b) = self.along.values;
        let Ok(curve) = Curve::new(self.along.mechanism, u, b, self.settings) else {
            return Next::Done;
        };
        let curve = curve.about(state);
        let Ok(station) = curve.begin(state) else {
            let value = state.inputs[self.settings.input.index()];
            self.gap(limit, value, error);
            return if value == self.settings.high {
                Next::Done
            } else {
                Next::Seek(value, state.coordinates.clone(), Error::CriticalState)
            };
        };
        let mut begin = station.clone();
        let mut fold = None;
        let home = station.place.clone();
        curve.walk(&station.reversed(), &home, |_, after, located| {
            let turns = |located: &&Located| located.special.kind == SpecialKind::Fold;
            fold = located.iter().find(turns).map(|x| x.special.clone());
            if fold.is_some() || (after.place.p - limit) * self.forward() < 0.0 {
                return Pass::Stop;
            }
            begin = after.reversed();
            Pass::On
        });
        let value = fold.as_ref().map_or(begin.place.p, |special| special.value);
        self.gap(limit, value, error);
        if let Some(special) = fold {
            self.critical(special, Change::Pass, false);
        }
        // What lies between the fold and the station is part of the way.
        Next::Along(Box::new(begin))
    }
}

/// Why a branch ends before the range does.
fn reason(curve: &Curve<'_>, end: BranchEnd, last: &Equilibrium) -> Error {
    let missed = match end {
        BranchEnd::Domain(error) | BranchEnd::Lost(error) => return error,
        BranchEnd::Escape => NotFound::Escape,
        _ => NotFound::IterationLimit,
    };
    match curve.broken_off(ContinuationFailure::Missed(missed), last) {
        BranchEnd::Lost(error) => error,
        _ => Error::CriticalState,
    }
}

/// Whether an event at an end of the range counts: growth of a motion must begin or end within the range, or beyond one
/// of its ends, at which other motions are damped.
fn counts(condition: Condition, change: Change, node: &Node, (first, last): (bool, bool)) -> bool {
    if matches!(condition, Condition::Line(_)) || !(first || last) {
        return true;
    }
    let mut modes = node.modes.modes.iter();
    let undamped = modes.all(|mode| mode.s.re.abs() <= mode.error);
    match change {
        Change::Onset => first || !undamped,
        Change::End => last || !undamped,
        Change::ToDivergence | Change::ToFlutter => true,
        _ => false,
    }
}

/// Number of motions that nothing resists.
fn zeros(state: &Equilibrium) -> usize {
    match state.stability {
        Stability::Neutral { zero } => zero,
        _ => 0,
    }
}
