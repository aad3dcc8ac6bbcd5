//! Follows one equilibrium and its modes while an input changes: each solve starts at the last equilibrium, and modes
//! keep their identity.
//!
//! # Sweeps own two points
//!
//! The next point overwrites the last but one, and derivatives overwrite derivatives (`Tracker`, `Adjoint`): allocating
//! and moving long results took a quarter of a sweep's time.

use super::points::SweepPoint;
use super::search::Route;
use crate::algebra::{Cholesky, Vector, largest};
use crate::batched::{Block, KERNELS, Workspace, possible};
use crate::equilibrium::{Held, Needed, OperatingPoint, Path, Policy, confirmed, solve_from_prediction, solve_into};
use crate::kernels::{BatchKernels, Kernels, Linear, RestParts};
use crate::modes::{
    CLUSTER_GAP, Family, Followed, completed, holds, match_with_assurance, merged, near_another, position,
    stay_in_place,
};
use crate::scalar::{Batch, Instructions, WIDTH};
use crate::setters;
use crate::{Description, Equilibrium, Error, Input, Mode, Modes, Shared, Stability};

/// Assurance below which a mode counts as not recognised, and a smaller step is tried.
const RECOGNISED: f64 = 0.8;
/// Maximum number of times a step may be halved.
const HALVINGS: usize = 6;

/// The kind of equilibrium and modes to follow.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Following {
    /// Which equilibrium to follow.
    pub policy: Policy,
    /// Which modes to follow; `None` for the family that neglects nothing ([`Family::of`]).
    pub family: Option<Family>,
    /// The vector instructions used to solve neighbouring values of a sweep at once, where the mechanism allows it;
    /// `None` solves each value by itself. Results agree up to rounding.
    pub vectors: Option<Instructions>,
    /// The unknowns that hold a member of a family of steady motions; empty for those that the declaration holds, or
    /// where there is no family.
    pub held: Vec<Held>,
}

impl Following {
    setters!(
        policy: Policy,
        family: Option<Family>,
        vectors: Option<Instructions>,
        held: Vec<Held>
    );
}

impl Default for Following {
    fn default() -> Self {
        Policy::default().into()
    }
}

impl From<Policy> for Following {
    fn from(policy: Policy) -> Self {
        Self { policy, family: None, vectors: Some(Instructions::best()), held: Vec::new() }
    }
}

/// Follows an equilibrium along an input.
pub(crate) struct Tracker<'a> {
    pub(crate) mechanism: &'a dyn Kernels,
    pub(crate) description: Shared<Description>,
    pub(crate) input: Input,
    /// The inputs at the value sought last.
    inputs: Vector,
    design: Vector,
    policy: Policy,
    family: Family,
    vectors: Option<Instructions>,
    held: Vec<Held>,
    needed: Needed,
    /// Start of the next solve.
    from: Vector,
    /// The path so far, used to predict the next state.
    path: Path,
    /// The smallest label not yet used; labels of modes that have ended are not reused.
    unused: usize,
    /// States along the way, found by a search for events.
    route: Route,
    /// Whether the input is known to change the equations; else, residual and matrices at the last point, once compared.
    changes: bool,
    unchanged: Option<(RestParts, Linear)>,
    /// With shafts, what the way has shown.
    followed: Followed,
    /// The last point with modes.
    pub(crate) last: Option<Box<SweepPoint>>,
    /// A buffer for the next point.
    spare: Option<Box<SweepPoint>>,
}

impl<'a> Tracker<'a> {
    pub(crate) fn new(
        mechanism: &'a dyn Kernels,
        (u, b): (&[f64], &[f64]),
        start: &[f64],
        following: Following,
        input: Input,
    ) -> Self {
        let description = mechanism.description();
        Self {
            mechanism,
            input,
            inputs: u.into(),
            design: b.into(),
            policy: following.policy,
            family: following.family.unwrap_or(Family::of(&description)),
            description,
            vectors: following.vectors,
            held: following.held,
            needed: Needed::Modes,
            from: start.into(),
            path: Path::default(),
            unused: 0,
            route: Route::default(),
            changes: false,
            unchanged: None,
            followed: Followed::default(),
            last: None,
            spare: None,
        }
    }

    /// The tracker on its way along the states that a search for events has passed.
    pub(crate) fn on(mut self, route: Route) -> Self {
        self.unused = route.unused;
        self.route = route;
        self
    }

    /// The tracker for no more than what is `needed` of its points; modes that cost nothing are there nevertheless.
    pub(super) fn only(mut self, needed: Needed) -> Self {
        if !self.side_by_side() {
            self.needed = needed;
        }
        self
    }

    /// The family of the followed modes.
    pub(crate) fn family(&self) -> Family {
        self.family
    }

    /// Gives the varied input this value.
    fn vary(&mut self, value: f64) {
        if let Some(input) = self.inputs.get_mut(self.input.index()) {
            *input = value;
        }
    }

    /// Solves the equilibrium at this value of the input into `state`, starting from the prediction if that converges at
    /// once, otherwise from `from`. Returns its general modes if they were needed to judge its stability.
    fn equilibrium_into(
        &self,
        (value, policy): (f64, Policy),
        from: &[f64],
        predicted: Option<&[f64]>,
        state: &mut Equilibrium,
    ) -> Result<Vec<Mode>, Error> {
        let mut point = OperatingPoint::unchecked(self.mechanism, &self.inputs, &self.design);
        // Behind a first point, only the input is new.
        if self.last.is_some() && value.is_finite() {
            point.check_possible()?;
        } else {
            point.check_values()?;
            point.check_start(from)?;
        }
        if !self.is_alone() {
            point = point.held_by(&self.held);
        }
        point.needed = self.needed;
        if !self.description.spans.is_empty() {
            point.nearby = self.followed.modes();
        }
        state.inputs.set(&self.inputs, |value| *value);
        let predicted = predicted.filter(|_| policy == Policy::Stable && !point.of_family());
        if let Some(modes) = predicted.and_then(|to| solve_from_prediction(&point, from, to, state)) {
            return Ok(modes);
        }
        let explained = |point: &OperatingPoint<'_>, state: &mut Equilibrium| {
            solve_into(point, from, policy, state).map_err(|failure| failure.explain(&point.description))
        };
        if self.needed == Needed::Verdict && self.followed.vouch(value) {
            let modes = explained(&point.clone().only(Needed::State), state)?;
            if holds(state) {
                state.stability = Stability::Stable;
                return Ok(modes);
            }
        }
        explained(&point, state)
    }

    /// An empty state and its modes, to be overwritten.
    fn blank(&self) -> (Equilibrium, Modes) {
        (
            Equilibrium::blank(&self.description, &self.inputs, &self.design),
            Modes::empty(self.family, &self.description),
        )
    }

    /// Whether states are no members of a family of steady motions.
    fn is_alone(&self) -> bool {
        self.held.is_empty() && self.description.held.is_empty()
    }

    /// Whether blocks of values may be solved at once, as far as can be told in advance.
    pub(super) fn side_by_side(&self) -> bool {
        let wanted = self.policy == Policy::Stable && self.family == Family::Undamped;
        wanted && self.is_alone() && self.vectors.is_some() && possible(&self.description, &KERNELS)
    }

    /// The workspace for solving blocks of values.
    pub(super) fn workspace<'m>(&self, memory: &'m mut Vec<Batch>, with_slopes: bool) -> Workspace<'m> {
        let values = (&*self.inputs, &*self.design);
        *memory = Workspace::memory(self.mechanism.sizes(), with_slopes);
        Workspace::new(memory, self.mechanism, values, with_slopes)
    }

    /// Whether the path has too few states to show where it leads.
    pub(super) fn begins(&self) -> bool {
        !self.path.bends()
    }

    /// Lays the path behind a first state along its tangent, as far apart as the next value is from it. Where the state does
    /// not move with the input, its tangent says nothing.
    fn begin(&mut self, next: f64) -> Option<()> {
        let last = self.last.as_ref()?;
        let (state, _) = last.solved().ok()?;
        let (by_input, _) = self.mechanism.residual_partials(&state.coordinates, &state.inputs, &state.design);
        let load = by_input.column(self.input.index());
        if largest(&load) == 0.0 {
            return None;
        }
        let slope = Cholesky::new(&state.linear.stiffness).ok()?.solve(&load);
        for ago in [2.0, 1.0, 0.0] {
            let back = ago * (next - last.value);
            // `Khat dq = -dg`.
            let before = state.coordinates.iter().zip(&slope).map(|(q, slope)| q + back * slope);
            self.path.go(last.value - back, before);
        }
        Some(())
    }

    /// Solves the first of `values` as one block where the path so far is smooth. Returns how many of them, counted
    /// from the first, agree with a one-by-one solution.
    pub(super) fn solve_block(
        &mut self,
        kernels: &dyn BatchKernels,
        workspace: &mut Workspace<'_>,
        values: &[f64],
    ) -> usize {
        if self.begins() && self.begin(values[0]).is_none() {
            return 0;
        }
        let (Some(vectors), Some(last)) = (self.vectors, &self.last) else {
            return 0;
        };
        let sound = |(state, modes): &(&Equilibrium, &Modes)| {
            state.stability == Stability::Stable
                && state.far_from_least_pose()
                && modes.modes.len() == self.from.len()
                && self.path.values().first() == Some(&last.value)
        };
        let Some((_, modes)) = last.solved().ok().filter(sound) else {
            return 0;
        };
        let (mut inputs, mut number) = (self.inputs.clone(), 0);
        for value in values.iter().take(WIDTH) {
            inputs[self.input.index()] = *value;
            if self.mechanism.violation(&inputs, &self.design).is_some() {
                break;
            }
            number += 1;
        }
        let values = (self.input, &values[..number]);
        workspace.solve((kernels, vectors), values, &self.path, &modes.real_shapes())
    }

    /// Extends the path to the last of the first `number` states of a block, which already is the last point.
    pub(super) fn commit(&mut self, block: &Block<'_>, number: usize) {
        for lane in number.saturating_sub(5)..number {
            let state = block.state_of(lane);
            self.path.go(block.values.0[lane], state.clone());
            self.from.assign(state);
        }
        self.unchanged = None;
    }

    /// Advances to a value of the input; modes that are not recognised at once are followed in smaller steps. The new
    /// point is [`Self::last`]; a point without modes is returned instead.
    pub(crate) fn advance(&mut self, value: f64) -> Option<SweepPoint> {
        if !self.route.is_empty() {
            self.join(value);
        }
        let (equilibrium, error) = match self.go(value) {
            Ok(None) => return None,
            Ok(Some((point, error))) => (point.equilibrium, error),
            Err(error) => (Err(error.clone()), error),
        };
        Some(SweepPoint { value, equilibrium, modes: Err(error) })
    }

    /// Goes to the state of the route nearest to a value, unless the last point is as near to that value as the states of
    /// the route are to each other.
    fn join(&mut self, value: f64) {
        let last = self.last.as_ref().map(|point| point.value);
        let Some(points) = self.route.towards(last, value) else {
            return;
        };
        self.path = Path::default();
        for point in points {
            if let Ok(state) = &point.equilibrium {
                self.path.go(point.value, state.coordinates.iter().copied());
                self.from.clone_from(&state.coordinates);
                if let Ok(modes) = &point.modes {
                    self.followed.join(&modes.modes);
                }
                self.last = Some(Box::new(point.clone()));
                self.unchanged = None;
            }
        }
    }

    /// Like [`Self::advance`], but returns a state whose modes fail together with the error.
    fn go(&mut self, value: f64) -> Result<Option<(Box<SweepPoint>, Error)>, Error> {
        // The next value, how often its step may still be halved, and the values after it.
        let (mut next, mut halvings) = (value, HALVINGS);
        let mut after = Vec::new();
        loop {
            let reached = match self.step(next, halvings) {
                Ok(Step::TooFar(middle)) => {
                    halvings -= 1;
                    after.push((next, halvings));
                    next = middle;
                    continue;
                }
                Ok(Step::Arrived) => Ok(None),
                Ok(Step::WithoutModes(point, error)) => Ok(Some((point, error))),
                Err(error) => Err(error),
            };
            match after.pop() {
                None => return reached,
                Some(pending) if reached.is_ok() => (next, halvings) = pending,
                // Accept this value, doubtful or not.
                Some((target, _)) => (next, halvings) = (target, 0),
            }
        }
    }

    /// Whether the input has changed nothing in the equations so far.
    pub(super) fn is_unchanged(&self) -> bool {
        self.unchanged.is_some()
    }

    /// Whether the input changes nothing in the equations, as the frequency of an excitation: then the last point holds at
    /// this value as well. The first value that does change them ends the question. Members of families are chosen by values
    /// beside the equations.
    fn stays(&mut self, value: f64) -> Result<bool, Error> {
        let moves = self.changes || !self.is_alone();
        let (false, Some(Ok((state, modes)))) = (moves, self.last.as_mut().map(|last| last.solved_mut())) else {
            return Ok(false);
        };
        let at = |u: &[f64]| self.mechanism.parts_and_linear(&state.coordinates, u, &self.design);
        let before = self.unchanged.take().unwrap_or_else(|| at(&state.inputs));
        if at(&self.inputs) != before {
            self.changes = true;
            return Ok(false);
        }
        OperatingPoint::new(self.mechanism, &self.inputs, &self.design)?;
        self.unchanged = Some(before);
        (state.inputs, modes.inputs) = (self.inputs.clone(), self.inputs.clone());
        self.path.go(value, state.coordinates.iter().copied());
        if let Some(last) = &mut self.last {
            last.value = value;
        }
        Ok(true)
    }

    /// A value between the last point and this one, if there is any.
    fn middle(&self, value: f64) -> Option<f64> {
        let last = self.last.as_ref()?.value;
        let middle = 0.5 * (last + value);
        ((middle - last) * (value - middle) > 0.0).then_some(middle)
    }

    // As a function of its own, it leaves its long result where it is.
    #[inline(never)]
    fn step(&mut self, value: f64, halvings: usize) -> Result<Step, Error> {
        self.vary(value);
        if self.stays(value)? {
            return Ok(Step::Arrived);
        }
        let predicted = self.path.at(value);
        let mut point = self.spare.take().unwrap_or_else(|| {
            let (equilibrium, modes) = self.blank();
            Box::new(SweepPoint { value, equilibrium: Ok(equilibrium), modes: Ok(modes) })
        });
        point.value = value;
        let (state, point_modes) = point.solved_mut().map_err(|error| error.clone())?;
        let at = (value, self.policy);
        let mut judged = self.equilibrium_into(at, &self.from, predicted.as_deref(), state)?;
        if !self.description.spans.is_empty() {
            if self.followed.is_due() {
                judged = completed(state, judged);
            }
            self.followed.take(value, &judged);
        }
        // Without modes to recognise, a state that is not where the path leads may be on another branch.
        let astray = || match &predicted {
            Some(predicted) => !confirmed(&state.coordinates, predicted, &self.from),
            None => self.path.is_far(value),
        };
        if self.needed < Needed::Modes
            && halvings > 0
            && astray()
            && let Some(middle) = self.middle(value)
        {
            self.spare = Some(point);
            return Ok(Step::TooFar(middle));
        }
        if self.needed == Needed::Modes
            && let Err(error) = point_modes.solve_at(state, judged)
        {
            self.from.clone_from(&state.coordinates);
            self.path.go(value, state.coordinates.iter().copied());
            return Ok(Step::WithoutModes(point, error));
        }
        let before = self.last.as_ref().and_then(|last| last.modes.as_ref().ok());
        if let Some(modes) = before.filter(|modes| stay_in_place(modes, point_modes, &state.linear, RECOGNISED)) {
            point_modes.continue_in_place(modes);
        } else {
            if let Some(modes) = before {
                let order = match_with_assurance(modes, point_modes, &state.linear);
                // Modes with equal eigenvalues have no unique shapes: no step is small enough to recognise them.
                let repeated = |r: usize| merged(point_modes, r) || near_another(point_modes, r, CLUSTER_GAP);
                let doubtful =
                    order.iter().flatten().any(|&(position, assurance)| assurance < RECOGNISED && !repeated(position));
                if doubtful
                    && halvings > 0
                    && let Some(middle) = self.middle(value)
                {
                    self.spare = Some(point);
                    return Ok(Step::TooFar(middle));
                }
                let order = order.map(position);
                point_modes.arrange(modes, &order, self.unused);
            }
            self.unused = point_modes.modes.iter().map(|mode| mode.label + 1).fold(self.unused, usize::max);
        }
        self.from.set(&state.coordinates, |value| *value);
        self.path.go(value, state.coordinates.iter().copied());
        self.spare = self.last.replace(point);
        Ok(Step::Arrived)
    }
}

/// The outcome of a step.
enum Step {
    /// Reached a state with modes: the last point.
    Arrived,
    /// Reached a state without modes; the modes stored in the point are invalid.
    WithoutModes(Box<SweepPoint>, Error),
    /// Modes were not recognised; an intermediate value to try.
    TooFar(f64),
}

#[cfg(test)]
mod tests {
    use eigentol::mechanism;

    use super::*;

    mechanism! {
        mechanism Governor {
            input omega: rad/s;
            gravity 9.81 m/s^2 along -z;
            body shaft: massless;
            body bar: rod(mass: 3 kg, length: 1 m, along: -z);
            joint spin:  revolute(z) from ground to shaft, driven at omega;
            joint theta: revolute(y) from shaft to bar;
        }
    }

    fn tracker() -> Tracker<'static> {
        let input = Input::new(0);
        Tracker::new(&Governor, (&[0.0], &[]), &[1.0], Policy::Stable.into(), input)
    }

    #[test]
    fn a_path_begins_along_its_tangent() {
        for next in [6.01, 5.99] {
            let mut tracker = tracker();
            assert!(tracker.advance(6.0).is_none() && tracker.begins());
            let before = tracker.from[0];
            assert!(tracker.begin(next).is_some() && !tracker.begins());
            let Some(predicted) = tracker.path.at(next) else { panic!("a tangent") };
            assert!(tracker.advance(next).is_none());
            // cos theta = 3 g / (2 omega^2 l)
            let exact = (1.5 * 9.81 / (next * next)).acos();
            assert!((tracker.from[0] - exact).abs() < 1e-12);
            assert!((predicted[0] - exact).abs() < 0.02 * (exact - before).abs(), "{predicted:?} {exact}");
        }
    }

    #[test]
    fn what_does_not_move_has_no_tangent() {
        let mut tracker = tracker();
        assert!(tracker.advance(1.0).is_none());
        assert!(tracker.begin(1.1).is_none() && tracker.begins());
    }
}
