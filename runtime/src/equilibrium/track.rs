//! Following one equilibrium and its modes while an input changes: each solve starts at the last equilibrium, and modes
//! keep their identity.

use super::{Policy, equilibrium};
use crate::modes::{Family, clusters, match_with_assurance, modes_of};
use crate::sensitivity::CLUSTER_GAP;
use crate::{Equilibrium, Error, Input, Mechanism, Modes};

/// Assurance below which a mode counts as not recognised, so that a smaller step is tried.
const RECOGNISED: f64 = 0.8;
/// How often a step may be halved.
const HALVINGS: usize = 6;

/// What is followed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Following {
    /// Which equilibrium.
    pub policy: Policy,
    /// Which modes; `None` for the family that leaves nothing out ([`Family::of`]).
    pub family: Option<Family>,
}

impl From<Policy> for Following {
    fn from(policy: Policy) -> Self {
        Self {
            policy,
            family: None,
        }
    }
}

/// An equilibrium and its modes at a value of the input.
#[derive(Clone, Copy)]
pub(crate) struct Tracked<const N: usize, const U: usize, const P: usize> {
    pub(crate) value: f64,
    pub(crate) equilibrium: Equilibrium<N, U, P>,
    pub(crate) modes: Modes<N>,
}

/// Follows an equilibrium along an input.
pub(crate) struct Tracker<'a, M, const N: usize, const U: usize, const P: usize> {
    pub(crate) mechanism: &'a M,
    pub(crate) input: Input,
    inputs: [f64; U],
    design: [f64; P],
    policy: Policy,
    family: Family,
    /// Where the next solve starts.
    from: [f64; N],
    /// The first label that no mode has had: one that has ended does not lend its label to another.
    unused: usize,
    /// The last point that has modes.
    pub(crate) last: Option<Tracked<N, U, P>>,
}

impl<'a, M, const N: usize, const U: usize, const P: usize> Tracker<'a, M, N, U, P> {
    pub(crate) fn new<const O: usize>(
        mechanism: &'a M,
        (u, b): (&[f64; U], &[f64; P]),
        start: &[f64; N],
        following: Following,
        input: Input,
    ) -> Self
    where
        M: Mechanism<N, U, P, O>,
    {
        Self {
            mechanism,
            input,
            inputs: *u,
            design: *b,
            policy: following.policy,
            family: following.family.unwrap_or(Family::of(&M::DESCRIPTION)),
            from: *start,
            unused: 0,
            last: None,
        }
    }

    /// Which modes are followed.
    pub(crate) fn family(&self) -> Family {
        self.family
    }

    /// The equilibrium at a value of the input, from `from`.
    fn equilibrium<const O: usize>(
        &self,
        value: f64,
        from: &[f64; N],
    ) -> Result<Equilibrium<N, U, P>, Error>
    where
        M: Mechanism<N, U, P, O>,
    {
        let mut inputs = self.inputs;
        if let Some(place) = inputs.get_mut(self.input.0) {
            *place = value;
        }
        equilibrium(self.mechanism, &inputs, &self.design, from, self.policy)
    }

    /// Equilibrium and modes near a point, in the order and with the labels of its modes.
    pub(crate) fn near<const O: usize>(
        &self,
        value: f64,
        point: &Tracked<N, U, P>,
    ) -> Result<Tracked<N, U, P>, Error>
    where
        M: Mechanism<N, U, P, O>,
    {
        let equilibrium = self.equilibrium(value, &point.equilibrium.coordinates)?;
        let found = modes_of(&equilibrium.linear, self.family, equilibrium.description)?;
        Ok(Tracked {
            value,
            equilibrium,
            modes: found.continuing(&point.modes, &equilibrium.linear, self.unused),
        })
    }

    /// Goes on to a value of the input; the equilibrium comes back even where its modes fail. Modes that are not
    /// recognised at once are followed in smaller steps.
    pub(crate) fn advance<const O: usize>(
        &mut self,
        value: f64,
    ) -> Result<(Equilibrium<N, U, P>, Result<Modes<N>, Error>), Error>
    where
        M: Mechanism<N, U, P, O>,
    {
        // Where to go next, how often the way may still be halved, and what comes after it.
        let (mut next, mut halvings) = (value, HALVINGS);
        let mut after = Vec::new();
        loop {
            match self.step(next, halvings) {
                Ok(Step::Arrived(there)) => match after.pop() {
                    None => return Ok(*there),
                    Some(place) => (next, halvings) = place,
                },
                Ok(Step::TooFar(middle)) => {
                    halvings -= 1;
                    after.push((next, halvings));
                    next = middle;
                }
                Err(error) => match after.pop() {
                    None => return Err(error),
                    // Taken as it is, doubtful or not.
                    Some((place, _)) => (next, halvings) = (place, 0),
                },
            }
        }
    }

    fn step<const O: usize>(&mut self, value: f64, halvings: usize) -> Result<Step<N, U, P>, Error>
    where
        M: Mechanism<N, U, P, O>,
    {
        let state = self.equilibrium(value, &self.from)?;
        let found = match modes_of(&state.linear, self.family, state.description) {
            Ok(found) => found,
            Err(error) => {
                self.from = state.coordinates;
                return Ok(Step::Arrived(Box::new((state, Err(error)))));
            }
        };
        let Some(last) = &self.last else {
            return Ok(Step::Arrived(Box::new(self.arrive(value, state, found))));
        };
        let order = match_with_assurance(&last.modes, &found, &state.linear);
        // Modes with equal eigenvalues have no shapes of their own: no step is small enough to recognise them.
        let repeated = clusters(&found, CLUSTER_GAP);
        let doubtful = order
            .iter()
            .flatten()
            .any(|&(position, assurance)| assurance < RECOGNISED && !repeated[position]);
        let middle = 0.5 * (last.value + value);
        let between = (middle - last.value) * (value - middle) > 0.0;
        if doubtful && halvings > 0 && between {
            return Ok(Step::TooFar(middle));
        }
        let order = order.map(|pair| pair.map(|(position, _)| position));
        let found = found.arranged(&last.modes, &order, self.unused);
        Ok(Step::Arrived(Box::new(self.arrive(value, state, found))))
    }

    fn arrive(
        &mut self,
        value: f64,
        equilibrium: Equilibrium<N, U, P>,
        modes: Modes<N>,
    ) -> (Equilibrium<N, U, P>, Result<Modes<N>, Error>) {
        self.from = equilibrium.coordinates;
        let labels = modes.modes.iter().map(|mode| mode.label + 1);
        self.unused = labels.fold(self.unused, usize::max);
        self.last = Some(Tracked {
            value,
            equilibrium,
            modes,
        });
        (equilibrium, Ok(modes))
    }
}

/// What a state is, and its modes or why it has none.
type There<const N: usize, const U: usize, const P: usize> =
    (Equilibrium<N, U, P>, Result<Modes<N>, Error>);

/// How a step ended. On the heap: the states of large mechanisms would fill the stack.
enum Step<const N: usize, const U: usize, const P: usize> {
    Arrived(Box<There<N, U, P>>),
    /// Modes are not recognised; a value on the way.
    TooFar(f64),
}
