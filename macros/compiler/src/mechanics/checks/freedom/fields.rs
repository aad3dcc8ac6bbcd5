//! Candidates for motions that leave the equations as they are, as vector fields over the free coordinates.
//!
//! A coordinate alone is one, `zeta = e_i`. Others are motions of space, as far as the joints between the ground and a
//! body allow them: with `J` the derivatives of the body's twist about the ground's origin by the rates of these
//! coordinates, `J zeta = xi` for a constant twist `xi`. Everything that the body carries moves with it. The derivatives
//! of the field follow from `dJ zeta + J dzeta = 0`.

use crate::algebra::{Disturbed, Graph};
use crate::base::ids::{BodyId, ExprId};
use crate::mechanics::motion::{Kinematics, StepAxis, in_common_frame_at_zero};
use crate::mechanics::setup::{Context, by_symbol};
use crate::model::mechanism::Frame;

/// Number of independent motions of space: three rotations, three translations.
pub(super) const RIGID: usize = 6;

/// Three angular velocities, then three velocities.
type Twist<T> = [T; RIGID];

/// The candidates: each free coordinate, and the motions of space of some bodies.
pub(super) struct Fields {
    /// Number of free coordinates.
    pub(super) free: usize,
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
}

impl Fields {
    pub(super) fn new(g: &mut Graph, context: &Context) -> Self {
        let topology = context.topology;
        let kinematics = in_common_frame_at_zero(g, context);
        let mut paths: Vec<Vec<(usize, StepAxis, BodyId)>> =
            vec![Vec::new(); context.mechanism.bodies.len()];
        let mut carriers = Vec::new();
        for branch in &topology.branches {
            let before = match branch.parent {
                Frame::Ground => Vec::new(),
                Frame::Body(parent) => paths[parent.index()].clone(),
            };
            let own = kinematics.of(branch.body).steps.iter();
            let own = own.filter_map(|step| {
                let place = topology.free.iter().position(|&id| id == step.coordinate)?;
                Some((place, *step, branch.body))
            });
            let path: Vec<_> = before.iter().copied().chain(own).take(RIGID + 1).collect();
            let turns = path.iter().any(|(_, step, _)| step.turn.is_some());
            if turns && path.len() > before.len() && (2..=RIGID).contains(&path.len()) {
                carriers.push(Carrier::new(g, context, &kinematics, branch.body, &path));
            }
            paths[branch.body.index()] = path;
        }
        Self {
            free: topology.free.len(),
            carriers,
        }
    }

    /// Number of candidates.
    pub(super) fn len(&self) -> usize {
        self.free + RIGID * self.carriers.len()
    }

    /// The expressions that [`Self::at`] reads.
    pub(super) fn roots(&self) -> Vec<ExprId> {
        let all = self.carriers.iter().flat_map(|carrier| {
            let slopes = carrier.slopes.iter().flatten();
            carrier.twists.iter().chain(slopes)
        });
        all.flatten().copied().collect()
    }

    /// The candidates at a state, from the values of the expressions.
    pub(super) fn at(&self, values: &[Disturbed], operations: usize) -> Vec<Field> {
        let mut fields: Vec<Field> = (0..self.free).map(Field::unit).collect();
        let mut values = values.chunks_exact(RIGID);
        let mut next =
            |count: usize| -> Vec<&[Disturbed]> { values.by_ref().take(count).collect() };
        for carrier in &self.carriers {
            let n = carrier.coordinates.len();
            let (twists, slopes) = (next(n), next(n * n));
            let inverse = Inverse::new(&twists, operations);
            for component in 0..RIGID {
                let mut wanted = [Disturbed::exact(0.0); RIGID];
                wanted[component] = Disturbed::exact(1.0);
                let Some(inverse) = &inverse else {
                    // coordinates that do the same
                    fields.push(Field::impossible(wanted));
                    continue;
                };
                let rates = inverse.times(&wanted);
                let reached = combined(&twists, &rates);
                let missed = wanted.iter().zip(reached);
                let slopes = slopes.chunks_exact(n).map(|slopes| {
                    let change = combined(slopes, &rates);
                    let rates = inverse.times(&change).into_iter();
                    rates.map(|rate| -rate).collect()
                });
                fields.push(Field {
                    slopes: slopes.collect(),
                    coordinates: carrier.coordinates.clone(),
                    missed: missed.map(|(&wanted, reached)| wanted - reached).collect(),
                    rates,
                });
            }
        }
        fields
    }
}

impl Carrier {
    fn new(
        g: &mut Graph,
        context: &Context,
        kinematics: &Kinematics,
        body: BodyId,
        path: &[(usize, StepAxis, BodyId)],
    ) -> Self {
        let twists: Vec<Twist<ExprId>> = path
            .iter()
            .map(|(_, step, body)| {
                let origin = kinematics.of(*body).frame.position;
                let to_ground = origin.neg(g);
                let velocity = step.velocity(g, to_ground);
                let zero = g.zero();
                let turn = step.turn.map_or([zero; 3], |turn| turn.0);
                let [a, b, c] = turn;
                let [x, y, z] = velocity.0;
                [a, b, c, x, y, z]
            })
            .collect();
        let flat: Vec<ExprId> = twists.iter().flatten().copied().collect();
        let slopes = path.iter().map(|(place, ..)| {
            let change = by_symbol(g, &flat, context.symbols.q.ids[*place]);
            let change = change.chunks_exact(RIGID);
            change
                .map(|twist| std::array::from_fn(|k| twist[k]))
                .collect()
        });
        Self {
            body,
            slopes: slopes.collect(),
            coordinates: path.iter().map(|(place, ..)| *place).collect(),
            twists,
        }
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
        Self {
            coordinates: Vec::new(),
            rates: Vec::new(),
            slopes: Vec::new(),
            missed: twist.into(),
        }
    }
}

/// The least-squares inverse of the twists: `(J^T J)^-1 J^T`.
struct Inverse<'a> {
    twists: &'a [&'a [Disturbed]],
    /// `J^T J = L D L^T`: `L` below the diagonal, and `D` on it.
    factors: Vec<Vec<Disturbed>>,
}

impl<'a> Inverse<'a> {
    fn new(twists: &'a [&'a [Disturbed]], operations: usize) -> Option<Self> {
        let n = twists.len();
        let mut factors: Vec<Vec<Disturbed>> = (0..n)
            .map(|i| (0..n).map(|j| product(twists[i], twists[j])).collect())
            .collect();
        for k in 0..n {
            let pivot = factors[k][k];
            if pivot.is_rounding(operations) {
                return None;
            }
            for i in k + 1..n {
                let factor = factors[i][k] / pivot;
                for j in k + 1..=i {
                    factors[i][j] = factors[i][j] - factor * factors[j][k];
                }
            }
            for row in &mut factors[k + 1..] {
                row[k] = row[k] / pivot;
            }
        }
        Some(Self { twists, factors })
    }

    fn times(&self, twist: &[Disturbed]) -> Vec<Disturbed> {
        let n = self.twists.len();
        let mut x: Vec<Disturbed> = self.twists.iter().map(|own| product(own, twist)).collect();
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
    let terms = a.iter().zip(b).map(|(&a, &b)| a * b);
    terms.fold(Disturbed::exact(0.0), |sum, term| sum + term)
}

/// `sum_k rates_k twists_k`.
fn combined(twists: &[&[Disturbed]], rates: &[Disturbed]) -> Twist<Disturbed> {
    let mut sum = [Disturbed::exact(0.0); RIGID];
    for (twist, &rate) in twists.iter().zip(rates) {
        for (sum, &component) in sum.iter_mut().zip(*twist) {
            *sum = *sum + rate * component;
        }
    }
    sum
}
