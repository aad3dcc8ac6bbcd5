//! Following one equilibrium and its modes while an input changes: each solve starts at the last equilibrium, and modes
//! keep their identity.

use super::points::SweepPoint;
use crate::algebra::Vector;
use crate::batched::algebra::{Square, small};
use crate::batched::{Block, KERNELS, Workspace, possible};
use crate::equilibrium::{OperatingPoint, Path, Policy, solve_from_prediction, solve_into};
use crate::kernels::{BatchKernels, Kernels};
use crate::modes::{CLUSTER_GAP, Family, match_with_assurance, merged, near_another, position};
use crate::scalar::{Batch, Instructions, WIDTH};
use crate::setters::setters;
use crate::{Description, Equilibrium, Error, Input, Mode, Modes, Shared, Stability};

/// Assurance below which a mode counts as not recognised, so that a smaller step is tried.
const RECOGNISED: f64 = 0.8;
/// How often a step may be halved.
const HALVINGS: usize = 6;

/// What is followed, and how.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Following {
    /// Which equilibrium.
    pub policy: Policy,
    /// Which modes; `None` for the family that leaves nothing out ([`Family::of`]).
    pub family: Option<Family>,
    /// The vector instructions with which neighbouring values of a sweep are solved side by side where the mechanism allows
    /// it; `None` solves each alone. Results are the same up to rounding.
    pub vectors: Option<Instructions>,
}

impl Following {
    setters!(policy: Policy, family: Option<Family>, vectors: Option<Instructions>);
}

impl Default for Following {
    fn default() -> Self {
        Policy::default().into()
    }
}

impl From<Policy> for Following {
    fn from(policy: Policy) -> Self {
        Self {
            policy,
            family: None,
            vectors: Some(Instructions::best()),
        }
    }
}

/// Follows an equilibrium along an input.
pub(crate) struct Tracker<'a> {
    pub(crate) mechanism: &'a dyn Kernels,
    pub(crate) description: Shared<Description>,
    pub(crate) input: Input,
    inputs: Vector,
    design: Vector,
    policy: Policy,
    family: Family,
    vectors: Option<Instructions>,
    /// Where the next solve starts.
    from: Vector,
    /// The way so far, which tells where it goes on.
    path: Path,
    /// The first label that no mode has had: one that has ended does not lend its label to another.
    unused: usize,
    /// The last advance ended where the way before led, and no stiffness came near to zero: it passed no critical state.
    pub(crate) smooth: bool,
    /// The last point that has modes.
    pub(crate) last: Option<Box<SweepPoint>>,
    /// What the next point is written over.
    spare: Option<Box<SweepPoint>>,
}

impl<'a> Tracker<'a> {
    /// What the input is where it is set to a value: its deviation is added.
    pub(crate) fn actual(&self, value: f64) -> f64 {
        value + self.mechanism.deviation(self.input.index(), &self.design)
    }

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
            from: start.into(),
            path: Path::default(),
            unused: 0,
            smooth: false,
            last: None,
            spare: None,
        }
    }

    /// Which modes are followed.
    pub(crate) fn family(&self) -> Family {
        self.family
    }

    /// The inputs at a value of the one that varies.
    pub(super) fn inputs_at(&self, value: f64) -> Vector {
        let mut inputs = self.inputs.clone();
        if let Some(place) = inputs.get_mut(self.input.index()) {
            *place = value;
        }
        inputs
    }

    /// Writes the equilibrium at a value of the input over `state`, from `from`, or from where the way leads if it is found there at
    /// once: then true. Returns its general modes where its stability was judged by them.
    fn equilibrium_into(
        &self,
        value: f64,
        from: &[f64],
        predicted: Option<&[f64]>,
        state: &mut Equilibrium,
    ) -> Result<(Vec<Mode>, bool), Error> {
        let inputs = self.inputs_at(value);
        let point = OperatingPoint::new(self.mechanism, &inputs, &self.design)?;
        point.check_start(from)?;
        state.inputs.clone_from(&inputs);
        let predicted = predicted.filter(|_| self.policy == Policy::Stable);
        if let Some(modes) = predicted.and_then(|to| solve_from_prediction(&point, from, to, state))
        {
            return Ok((modes, true));
        }
        solve_into(&point, from, self.policy, state)
            .map(|modes| (modes, false))
            .map_err(|failure| failure.explain(&point.description))
    }

    /// A state and its modes, to be written over.
    fn blank(&self) -> (Equilibrium, Modes) {
        (
            Equilibrium::blank(&self.description, &self.inputs, &self.design),
            Modes::empty(self.family, &self.description),
        )
    }

    /// Equilibrium and modes at a value, near to others, in the order and with the labels of their modes.
    pub(crate) fn near(
        &self,
        value: f64,
        (state, modes): (&Equilibrium, &Modes),
    ) -> Result<(Equilibrium, Modes), Error> {
        let (mut equilibrium, mut found) = self.blank();
        let from = &state.coordinates;
        let (judged, _) = self.equilibrium_into(value, from, None, &mut equilibrium)?;
        found.solve_at(&equilibrium, judged)?;
        let modes = found.continuing(modes, &equilibrium.linear, self.unused);
        Ok((equilibrium, modes))
    }

    /// Whether values may be solved side by side, as far as is known before any of them.
    pub(super) fn side_by_side(&self) -> bool {
        let wanted = self.policy == Policy::Stable && self.family == Family::Undamped;
        wanted && self.vectors.is_some() && possible(&self.description, &KERNELS)
    }

    /// What values are solved side by side in.
    pub(super) fn workspace<'m>(
        &self,
        memory: &'m mut Vec<Batch>,
        with_slopes: bool,
    ) -> Workspace<'m> {
        let values = (&*self.inputs, &*self.design);
        *memory = Workspace::memory(self.mechanism.sizes(), with_slopes);
        Workspace::new(memory, self.mechanism, values, with_slopes)
    }

    /// Solves the first of `values` side by side where the way so far is smooth: how many of them in a row are what solving
    /// them one by one would find.
    pub(super) fn solve_block(
        &self,
        kernels: &dyn BatchKernels,
        workspace: &mut Workspace<'_>,
        values: &[f64],
    ) -> usize {
        let (Some(vectors), Some(last), Some(past)) =
            (self.vectors, &self.last, self.path.last_three())
        else {
            return 0;
        };
        let sound = |(state, modes): &(&Equilibrium, &Modes)| {
            state.stability == Stability::Stable
                && modes.modes.len() == self.from.len()
                && last.value == past[0].0
        };
        let Some((_, modes)) = last.solved().ok().filter(sound) else {
            return 0;
        };
        let mut inputs = self.inputs.clone();
        let possible = |value: &&f64| {
            inputs[self.input.index()] = **value;
            self.mechanism.violation(&inputs, &self.design).is_none()
        };
        let number = values.iter().take(WIDTH).take_while(possible).count();
        let values = (self.input, &values[..number]);
        let shapes: Square<f64> = small(&modes.real_shapes());
        workspace.solve((kernels, vectors), values, past, &shapes)
    }

    /// The way goes on to the last of the first `number` states of a block, which is the last point already.
    pub(super) fn commit(&mut self, block: &Block<'_>, number: usize) {
        for lane in number.saturating_sub(3)..number {
            let state = block.state_of(lane);
            self.path.go(block.values.0[lane], &state);
            self.from.clone_from(&state);
        }
    }

    /// Goes on to a value of the input; modes that are not recognised at once are followed in smaller steps. The point is
    /// [`Self::last`]; one without modes comes back instead.
    pub(crate) fn advance(&mut self, value: f64) -> Option<SweepPoint> {
        let (equilibrium, error) = match self.go(value) {
            Ok(None) => return None,
            Ok(Some((point, error))) => (point.equilibrium, error),
            Err(error) => (Err(error.clone()), error),
        };
        Some(SweepPoint {
            value,
            equilibrium,
            modes: Err(error),
        })
    }

    /// Like [`Self::advance`]: a state whose modes fail comes back.
    fn go(&mut self, value: f64) -> Result<Option<(Box<SweepPoint>, Error)>, Error> {
        // Where to go next, how often the way may still be halved, and what comes after it.
        let (mut next, mut halvings) = (value, HALVINGS);
        let mut after = Vec::new();
        let mut smooth = true;
        loop {
            let step = self.step(next, halvings);
            smooth &= self.smooth;
            match step {
                Ok(step) => match (step, after.pop()) {
                    (Step::TooFar(middle), place) => {
                        after.extend(place);
                        halvings -= 1;
                        after.push((next, halvings));
                        next = middle;
                    }
                    (_, Some(place)) => (next, halvings) = place,
                    (Step::WithoutModes(point, error), None) => return Ok(Some((point, error))),
                    (Step::Arrived, None) => {
                        self.smooth = smooth;
                        return Ok(None);
                    }
                },
                Err(error) => match after.pop() {
                    None => return Err(error),
                    // Taken as it is, doubtful or not.
                    Some((place, _)) => (next, halvings) = (place, 0),
                },
            }
        }
    }

    fn step(&mut self, value: f64, halvings: usize) -> Result<Step, Error> {
        let predicted = self.path.at(value);
        let mut point = self.spare.take().unwrap_or_else(|| {
            let (equilibrium, modes) = self.blank();
            Box::new(SweepPoint {
                value,
                equilibrium: Ok(equilibrium),
                modes: Ok(modes),
            })
        });
        point.value = value;
        let (state, found) = point.solved_mut().map_err(|error| error.clone())?;
        let (judged, confirmed) =
            self.equilibrium_into(value, &self.from, predicted.as_deref(), state)?;
        if let Err(error) = found.solve_at(state, judged) {
            self.from.clone_from(&state.coordinates);
            self.path.go(value, &state.coordinates);
            return Ok(Step::WithoutModes(point, error));
        }
        self.smooth = false;
        if let Some(last) = &self.last
            && let Ok(modes) = &last.modes
        {
            self.smooth = confirmed
                && self.family == Family::Undamped
                && even(modes.least_lambda(), found.least_lambda());
            let order = match_with_assurance(modes, found, &state.linear);
            // Modes with equal eigenvalues have no shapes of their own: no step is small enough to recognise them.
            let repeated = |r: usize| merged(found, r) || near_another(found, r, CLUSTER_GAP);
            let doubtful = order
                .iter()
                .flatten()
                .any(|&(position, assurance)| assurance < RECOGNISED && !repeated(position));
            let middle = 0.5 * (last.value + value);
            let between = (middle - last.value) * (value - middle) > 0.0;
            if doubtful && halvings > 0 && between {
                self.spare = Some(point);
                return Ok(Step::TooFar(middle));
            }
            let order = order.map(position);
            found.arrange(modes, &order, self.unused);
        }
        self.from.clone_from(&state.coordinates);
        self.path.go(value, &state.coordinates);
        let labels = found.modes.iter().map(|mode| mode.label + 1);
        self.unused = labels.fold(self.unused, usize::max);
        self.spare = self.last.replace(point);
        Ok(Step::Arrived)
    }
}

/// Whether the least eigenvalues of two sets of undamped modes are positive and nearly the same.
pub(super) fn even(a: f64, b: f64) -> bool {
    /// Share of the greater of the two that the lesser one keeps.
    const KEPT: f64 = 0.75;
    a.min(b) > 0.0 && a.min(b) >= KEPT * a.max(b)
}

/// How a step ended.
enum Step {
    /// At a state with modes: the last one.
    Arrived,
    /// At a state without; what it has for modes is none.
    WithoutModes(Box<SweepPoint>, Error),
    /// Modes are not recognised; a value on the way.
    TooFar(f64),
}
