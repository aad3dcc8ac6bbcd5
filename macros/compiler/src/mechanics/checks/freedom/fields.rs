//! Candidates for motions that leave the equations as they are, as vector fields over the free coordinates.
//!
//! A coordinate alone is one, `zeta = e_i`. Others are motions of space, as far as the joints between the ground and a
//! body allow them: with `J` the derivatives of the body's twist about its own origin `p` by the rates of these
//! coordinates, `J zeta = (omega, v + omega x p)` for a constant twist `(omega, v)`. Everything that the body carries moves
//! with it. The derivatives of the field follow from `dJ zeta + J dzeta = (0, omega x dp)`. About its own origin, `J` is
//! as well conditioned far from the ground's origin as near it. A ball that rolls may also spin about its own centre `c`,
//! with the twist `(omega, omega x (p - c))`.

use crate::algebra::{Disturbed, ExprId, Graph};
use crate::base::ids::BodyId;
use crate::mechanics::motion::{Kinematics, StepAxis};
use crate::mechanics::setup::{Context, by_symbol};
use crate::model::mechanism::{ConstraintLaw, Frame};

use super::units::Units;

/// Number of independent motions of space: three rotations, three translations.
pub(super) const RIGID: usize = 6;

/// Three angular velocities, then three velocities.
type Twist<T> = [T; RIGID];

/// The candidates: each free coordinate, and the motions of space of some bodies.
pub(super) struct Fields {
    /// Number of free coordinates.
    pub(super) free: usize,
    /// Rates of coordinates are in these.
    pub(super) units: Units,
    pub(super) carriers: Vec<Carrier>,
}

/// A body that its joints may let move with space.
pub(super) struct Carrier {
    pub(super) body: BodyId,
    /// The free coordinates of the joints between the ground and the body, by their place among the unknowns.
    pub(super) coordinates: Vec<usize>,
    /// By coordinate, the twist per unit rate.
    twists: Vec<Twist<ExprId>>,
    /// `slopes[i][k]`: derivative of `twists[k]` by coordinate `i`.
    slopes: Vec<Vec<Twist<ExprId>>>,
    /// The body's origin, and its derivative by each coordinate.
    places: Vec<[ExprId; 3]>,
    /// From the centre of a ball that rolls to that origin, and the derivative by each coordinate.
    offsets: Vec<[ExprId; 3]>,
}

impl Carrier {
    /// Number of candidates: the motions of space, and the spins of a ball.
    pub(super) fn len(&self) -> usize {
        if self.offsets.is_empty() { RIGID } else { RIGID + 3 }
    }
}

impl Fields {
    pub(super) fn new(g: &mut Graph, context: &Context, kinematics: &Kinematics, units: Units) -> Self {
        let topology = context.topology;
        let mut paths: Vec<Vec<(usize, StepAxis, BodyId)>> = vec![Vec::new(); context.mechanism.bodies.len()];
        let mut carriers = Vec::new();
        for branch in &topology.branches {
            let before = match branch.parent {
                Frame::Ground => Vec::new(),
                Frame::Body(parent) => paths[parent.index()].clone(),
            };
            let free_steps = kinematics.of(branch.body).steps.iter().filter_map(|step| {
                let index = topology.free.iter().position(|&id| id == step.coordinate)?;
                Some((index, *step, branch.body))
            });
            let path: Vec<_> = before.iter().copied().chain(free_steps).take(RIGID + 1).collect();
            let of_blades = path.iter().any(|(k, ..)| context.multiblade.name(*k).is_some());
            if path.len() > before.len() && path.len() <= RIGID && !of_blades {
                carriers.push(Carrier::new(g, context, kinematics, branch.body, &path));
            }
            paths[branch.body.index()] = path;
        }
        Self { free: topology.free.len(), units, carriers }
    }

    /// Number of candidates.
    pub(super) fn len(&self) -> usize {
        self.free + self.carriers.iter().map(Carrier::len).sum::<usize>()
    }

    /// The expressions that [`Self::at`] reads.
    pub(super) fn roots(&self) -> Vec<ExprId> {
        self.carriers
            .iter()
            .flat_map(|carrier| {
                let slopes = carrier.slopes.iter().flatten();
                let twists = carrier.twists.iter().chain(slopes).flatten();
                twists.chain(carrier.places.iter().chain(&carrier.offsets).flatten())
            })
            .copied()
            .collect()
    }

    /// The candidates at a state, from the values of the expressions.
    pub(super) fn at(&self, mut values: &[Disturbed], operations: usize) -> Vec<Field> {
        let mut next = |count: usize| {
            let (head, rest) = values.split_at(count);
            values = rest;
            head
        };
        let mut fields: Vec<Field> = (0..self.free).map(Field::unit).collect();
        for carrier in &self.carriers {
            let n = carrier.coordinates.len();
            let unit = |k: usize| self.units.unknowns[carrier.coordinates[k]];
            // Nothing, or the derivatives by one coordinate after the other.
            let by = |k: usize| k.checked_sub(1).map_or(1.0, unit);
            let length = 1.0 / self.units.length;
            let twist = |values: &[Disturbed], unit: f64| -> Vec<Disturbed> {
                let components = values.iter().enumerate();
                let unit = |k: usize| if k < 3 { unit } else { unit * length };
                components.map(|(k, x)| x.scaled(unit(k))).collect()
            };
            let arms = |values: &[Disturbed]| -> Vec<Vec<Disturbed>> {
                let arms = values.chunks(3).enumerate();
                let arm = |(k, arm): (usize, &[Disturbed])| arm.iter().map(|x| x.scaled(by(k) * length)).collect();
                arms.map(arm).collect()
            };
            let twists = next(n * RIGID).chunks_exact(RIGID).enumerate();
            let twists: Vec<_> = twists.map(|(k, x)| twist(x, unit(k))).collect();
            let slopes = next(n * n * RIGID).chunks_exact(RIGID).enumerate();
            let slopes: Vec<_> = slopes.map(|(k, x)| twist(x, unit(k / n) * unit(k % n))).collect();
            let places = arms(next(3 + 3 * n));
            let offsets = arms(next(3 * carrier.offsets.len()));
            let inverse = Inverse::new(&twists, operations);
            for component in 0..carrier.len() {
                let wanted = match component.checked_sub(RIGID) {
                    None => wanted(component, &places),
                    Some(axis) => wanted(axis, &offsets),
                };
                let Some(inverse) = &inverse else {
                    // coordinates that do the same
                    fields.push(Field::impossible(wanted[0]));
                    continue;
                };
                let rates = inverse.times(&wanted[0]);
                let missed = difference(&wanted[0], &combined(&twists, &rates));
                let slopes = slopes.chunks_exact(n).zip(&wanted[1..]).map(|(slopes, wanted)| {
                    let change = combined(slopes, &rates);
                    inverse.times(&difference(wanted, &change))
                });
                fields.push(Field {
                    slopes: slopes.collect(),
                    coordinates: carrier.coordinates.clone(),
                    missed: missed.into(),
                    rates,
                });
            }
        }
        fields
    }
}

/// The twist of a candidate, and its derivatives by the coordinates: a rotation at the end of these arms, or a
/// translation.
fn wanted(component: usize, arms: &[Vec<Disturbed>]) -> Vec<Twist<Disturbed>> {
    let zero = Disturbed::exact(0.0);
    let mut twists = vec![[zero; RIGID]; arms.len()];
    twists[0][component] = Disturbed::exact(1.0);
    if component < 3 {
        let (next, last) = ((component + 1) % 3, (component + 2) % 3);
        for (twist, arm) in twists.iter_mut().zip(arms) {
            // e_component x arm
            twist[3 + next] = -arm[last];
            twist[3 + last] = arm[next];
        }
    }
    twists
}

fn difference(a: &Twist<Disturbed>, b: &Twist<Disturbed>) -> Twist<Disturbed> {
    std::array::from_fn(|k| a[k] - b[k])
}

impl Carrier {
    fn new(
        g: &mut Graph,
        context: &Context,
        kinematics: &Kinematics,
        body: BodyId,
        path: &[(usize, StepAxis, BodyId)],
    ) -> Self {
        let place = kinematics.of(body).frame.position;
        let twists: Vec<Twist<ExprId>> = path
            .iter()
            .map(|(_, step, body)| {
                let arm = place.sub(g, kinematics.of(*body).frame.position);
                let velocity = step.velocity(g, arm);
                let zero = g.zero();
                let turn = step.turn.map_or([zero; 3], |turn| turn.0);
                let [a, b, c] = turn;
                let [x, y, z] = velocity.0;
                [a, b, c, x, y, z]
            })
            .collect();
        let flat: Vec<ExprId> = twists.iter().flatten().copied().collect();
        let slopes = path.iter().map(|(index, ..)| {
            let change = by_symbol(g, &flat, context.symbols.q.ids[*index]);
            change.chunks_exact(RIGID).map(|twist| std::array::from_fn(|k| twist[k])).collect()
        });
        let slopes = slopes.collect();
        let wheel = context.mechanism.constraints.iter().find_map(|constraint| {
            let ConstraintLaw::Rolling { wheel, axis: None, .. } = &constraint.law else {
                return None;
            };
            let on_body = context.mechanism.points[wheel.index()].frame == Frame::Body(body);
            on_body.then_some(*wheel)
        });
        let with_slopes = |g: &mut Graph, vector: [ExprId; 3]| -> Vec<[ExprId; 3]> {
            let ids = path.iter().map(|(index, ..)| context.symbols.q.ids[*index]);
            let slopes = ids.map(|id| by_symbol(g, &vector, id));
            let slopes = slopes.map(|slope| std::array::from_fn(|k| slope[k]));
            std::iter::once(vector).chain(slopes).collect()
        };
        let places = with_slopes(g, place.0);
        let offsets = wheel.map_or(Vec::new(), |wheel| {
            let offset = place.sub(g, kinematics.points[wheel.index()].position);
            with_slopes(g, offset.0)
        });
        Self { body, slopes, places, offsets, coordinates: path.iter().map(|(index, ..)| *index).collect(), twists }
    }
}

/// A vector field at a state.
pub(super) struct Field {
    pub(super) coordinates: Vec<usize>,
    /// By coordinate.
    pub(super) rates: Vec<Disturbed>,
    /// `slopes[i][k]`: derivative of `rates[k]` by coordinate `i`.
    pub(super) slopes: Vec<Vec<Disturbed>>,
    /// The part of the twist that the joints do not allow.
    pub(super) missed: Vec<Disturbed>,
}

impl Field {
    fn unit(coordinate: usize) -> Self {
        Self {
            coordinates: vec![coordinate],
            rates: vec![Disturbed::exact(1.0)],
            slopes: Vec::new(),
            missed: Vec::new(),
        }
    }

    fn impossible(twist: Twist<Disturbed>) -> Self {
        Self { coordinates: Vec::new(), rates: Vec::new(), slopes: Vec::new(), missed: twist.into() }
    }
}

/// The least-squares inverse of the twists: `(J^T J)^-1 J^T`.
struct Inverse<'a> {
    twists: &'a [Vec<Disturbed>],
    /// `J^T J = L D L^T`: `L` below the diagonal, and `D` on it.
    factors: Vec<Vec<Disturbed>>,
}

impl<'a> Inverse<'a> {
    fn new(twists: &'a [Vec<Disturbed>], operations: usize) -> Option<Self> {
        let n = twists.len();
        let mut factors: Vec<Vec<Disturbed>> =
            (0..n).map(|i| (0..n).map(|j| product(&twists[i], &twists[j])).collect()).collect();
        for k in 0..n {
            let (above, below) = factors.split_at_mut(k + 1);
            let row = &above[k];
            if row[k].is_rounding(operations) {
                return None;
            }
            for other in below {
                let factor = other[k] / row[k];
                for (entry, &above) in other.iter_mut().zip(row).skip(k + 1) {
                    *entry = *entry - factor * above;
                }
                other[k] = factor;
            }
        }
        Some(Self { twists, factors })
    }

    fn times(&self, twist: &[Disturbed]) -> Vec<Disturbed> {
        let n = self.twists.len();
        let mut x: Vec<Disturbed> = self.twists.iter().map(|x| product(x, twist)).collect();
        for i in 0..n {
            for k in 0..i {
                x[i] = x[i] - self.factors[i][k] * x[k];
            }
        }
        for i in (0..n).rev() {
            x[i] = x[i] / self.factors[i][i];
            for k in i + 1..n {
                x[i] = x[i] - self.factors[k][i] * x[k];
            }
        }
        x
    }
}

fn product(a: &[Disturbed], b: &[Disturbed]) -> Disturbed {
    a.iter().zip(b).map(|(&a, &b)| a * b).fold(Disturbed::exact(0.0), |sum, term| sum + term)
}

/// `sum_k rates_k twists_k`.
fn combined(twists: &[Vec<Disturbed>], rates: &[Disturbed]) -> Twist<Disturbed> {
    let mut sum = [Disturbed::exact(0.0); RIGID];
    for (twist, &rate) in twists.iter().zip(rates) {
        for (sum, &component) in sum.iter_mut().zip(twist) {
            *sum = *sum + rate * component;
        }
    }
    sum
}
