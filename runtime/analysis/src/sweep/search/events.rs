//! The events that a search finds, and what it has searched.

use crate::sweep::condition::{Change, Condition, Crossing};
use crate::sweep::points::{CriticalState, SweepPoint};
use crate::{Behaviour, Description, Error, Input, Modes, Shared};

/// A stretch of the input in which an event may lie that was not resolved, or several that were not separated.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Unresolved {
    /// Where it begins, SI.
    pub from: f64,
    /// Where it ends, SI.
    pub to: f64,
    /// The condition that a mode may meet there; `None` for vanishing stiffness.
    pub condition: Option<Condition>,
}

/// A stretch of the input without an equilibrium to follow.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Gap {
    /// Where it begins, SI.
    pub from: f64,
    /// Where it ends, SI.
    pub to: f64,
    /// Why there is none.
    pub reason: Error,
}

/// What a search for events has covered.
///
/// Every event changes an integer of a single state, such as the number of growing oscillations. Between two states with
/// different integers there is an event; a stretch with the same ones is divided until the eigenvalues and their
/// derivatives at its states exclude that an even number of events hides there. What the list of events does not explain
/// is unresolved.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Searched {
    /// Where the search began, SI.
    pub low: f64,
    /// Where it ended, SI.
    pub high: f64,
    /// Number of states solved.
    pub states: usize,
    /// Events closer to each other than this are not separated, SI.
    pub resolution: f64,
    /// Stretches that are not resolved.
    pub unresolved: Vec<Unresolved>,
    /// Stretches without an equilibrium.
    pub gaps: Vec<Gap>,
}

/// The events along an input, each at a value that depends on the mechanism only.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Events {
    /// The varied input.
    pub input: Input,
    /// States where stiffness vanishes, in the order of the search.
    pub critical: Vec<CriticalState>,
    /// States where a mode meets a condition, in the order of the search.
    pub crossings: Vec<Crossing>,
    /// What was searched.
    pub searched: Searched,
    /// The mechanism they belong to.
    pub description: Shared<Description>,
}

/// The path searched for events: states so close together that every state on the path is near one of them.
#[derive(Clone, Debug, Default)]
pub(crate) struct Route {
    /// In the order of the search.
    pub(super) points: Vec<SweepPoint>,
    /// The branches on the way: the position of the first point of each, and the value up to which it is followed.
    pub(super) pieces: Vec<(usize, f64)>,
    /// The smallest label not used on the way.
    pub(crate) unused: usize,
}

impl Searched {
    /// Joins unresolved stretches that are no farther apart than they are long.
    pub(super) fn join(&mut self) {
        let mut all: Vec<Unresolved> = Vec::new();
        for stretch in self.unresolved.drain(..) {
            let length = |x: &Unresolved| (x.to - x.from).abs();
            let follows = |x: &&mut Unresolved| {
                let apart = (stretch.from - x.to).abs();
                x.condition == stretch.condition && apart <= length(x).max(length(&stretch))
            };
            match all.iter_mut().find(follows) {
                Some(last) => last.to = stretch.to,
                None => all.push(stretch),
            }
        }
        self.unresolved = all;
    }
}

/// Share of the range within which an event and a state are at one value.
const SAME: f64 = 1e-9;

/// A state along the way: its value, its growing oscillations, and its motions that grow without oscillation.
pub(crate) type Growing = (f64, [usize; 2]);

/// How many motions grow.
pub(crate) fn growing(value: f64, modes: &Modes) -> Growing {
    let count = |of: fn(&Behaviour) -> bool| modes.modes.iter().filter(|mode| of(&mode.behaviour)).count();
    let flutter = count(|behaviour| matches!(behaviour, Behaviour::Flutter(_)));
    let divergent = count(|behaviour| matches!(behaviour, Behaviour::Divergent(_)));
    (value, [flutter, divergent])
}

impl Events {
    /// Adds to what is unresolved each stretch between neighbouring states whose growing motions the events between them
    /// do not explain: list and states never contradict each other.
    pub(crate) fn compared_with(mut self, states: &[Growing]) -> Self {
        let Searched { low, high, .. } = self.searched;
        let slack = SAME * (high - low).abs();
        for two in states.windows(2) {
            let ((from, before), (to, after)) = (two[0], two[1]);
            let (least, most) = (from.min(to) - slack, from.max(to) + slack);
            let inside = |value: f64| value >= least && value <= most;
            let at_end = |value: f64| inside(value) && !(value > least + 2.0 * slack && value < most - 2.0 * slack);
            let gap = |gap: &Gap| gap.from.min(gap.to) <= most && gap.from.max(gap.to) >= least;
            // There the way goes on along another branch.
            let leaves =
                self.critical.iter().any(|critical| inside(critical.value)) || self.searched.gaps.iter().any(gap);
            let growth = || self.crossings.iter().filter(|x| x.condition == Condition::FlutterOnset && inside(x.value));
            if leaves || growth().any(|x| at_end(x.value)) {
                continue;
            }
            let mut expected = before.map(usize::cast_signed);
            for crossing in growth() {
                let [flutter, divergent] = match crossing.change {
                    Change::Onset => [1, 0],
                    Change::End => [-1, 0],
                    Change::ToDivergence => [-1, 2],
                    Change::ToFlutter => [1, -2],
                    Change::Pass | Change::Touch => [0, 0],
                };
                expected = [expected[0] + flutter, expected[1] + divergent];
            }
            let conditions = [Some(Condition::FlutterOnset), None];
            for (k, condition) in conditions.into_iter().enumerate() {
                let known = |x: &Unresolved| {
                    let overlaps = x.from.min(x.to) <= most && x.from.max(x.to) >= least;
                    overlaps && x.condition == condition
                };
                let explained = expected[k] == after[k].cast_signed();
                if !explained && !self.searched.unresolved.iter().any(known) {
                    self.searched.unresolved.push(Unresolved { from, to, condition });
                }
            }
        }
        self
    }

    /// The events up to a value at which the work was stopped.
    pub(crate) fn until(mut self, value: f64) -> Self {
        let Searched { low, high, .. } = self.searched;
        let within = |x: f64| (value - x) * (high - low) >= 0.0;
        self.critical.retain(|critical| within(critical.value));
        self.crossings.retain(|crossing| within(crossing.value));
        self.searched.high = value;
        self.searched.unresolved.retain(|x| within(x.from));
        self.searched.gaps.retain(|gap| within(gap.from));
        self
    }
}

impl Route {
    /// Whether it passes no states.
    pub(crate) fn is_empty(&self) -> bool {
        self.points.is_empty()
    }

    /// Up to three points of one branch near a value, the nearest last; `None` if the value is as near to `last`, a
    /// point on the same branch, as the points of the route are to each other.
    pub(crate) fn towards(&self, last: Option<f64>, value: f64) -> Option<Vec<&SweepPoint>> {
        let (first, end) = (self.points.first()?, self.points.last()?);
        let forward = if end.value < first.value { -1.0 } else { 1.0 };
        let piece = |value: f64| {
            let reaches = |piece: &&(usize, f64)| (piece.1 - value) * forward >= 0.0;
            self.pieces.iter().position(|piece| reaches(&piece)).unwrap_or(self.pieces.len().saturating_sub(1))
        };
        let index = piece(value);
        let from = self.pieces.get(index)?.0;
        let to = (self.pieces.get(index + 1)).map_or(self.points.len(), |piece| piece.0);
        let mut near: Vec<&SweepPoint> = self.points[from..to].iter().collect();
        let apart = |point: &SweepPoint| (point.value - value).abs();
        near.sort_by(|a, b| apart(a).total_cmp(&apart(b)));
        near.truncate(3);
        if let (Some(last), [nearest, next, ..]) = (last, &near[..])
            && piece(last) == index
            && (value - last).abs() <= (0.5 * (nearest.value - next.value).abs()).max(apart(nearest))
        {
            return None;
        }
        near.reverse();
        Some(near)
    }
}
