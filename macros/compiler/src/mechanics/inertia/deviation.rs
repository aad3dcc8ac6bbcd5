//! Deviations of a body from symmetry about the axis about which it turns.

use crate::algebra::{ExprId, Graph, Vector3};
use crate::base::ids::BodyId;
use crate::mechanics::setup::{Arm, Context, MassDistribution};
use crate::model::expression::Vector;
use crate::model::mechanism::Deviation;

use super::augmented::AugmentedBody;

/// A direction across the axis, in the body frame, and the amount along it.
pub(crate) struct Direction {
    pub(crate) along: Vector3,
    pub(crate) amount: ExprId,
}

/// The change of a body's mass distribution per unit of a deviation, times `amount`. An unbalance is a first moment of
/// mass at a place: a mass far smaller than its distance is large. An eccentricity displaces the whole body, a tilt
/// turns it about its centre of mass: the second moment `S` there changes by `[tilt] S - S [tilt]`.
pub(crate) fn deviation(
    g: &mut Graph,
    context: &Context,
    body: BodyId,
    (at, kind): (&Vector, &Deviation),
    direction: &Direction,
) -> MassDistribution {
    let values = context.values;
    let whole = whole(g, context, body);
    match kind {
        Deviation::Amount(_) => {
            let at = values.vector(g, at);
            moment(g, at, direction)
        }
        Deviation::Eccentricity(_) => {
            let center = center(g, &whole);
            moment(g, center, direction)
        }
        Deviation::Tilt(_) => tilted(g, &whole, direction),
    }
}

/// What a deviation of one is multiplied by: the mass of the body for an eccentricity.
pub(crate) fn size(g: &mut Graph, context: &Context, body: BodyId, kind: &Deviation) -> ExprId {
    match kind {
        Deviation::Amount(value) | Deviation::Tilt(value) => context.values.scalar(g, value),
        Deviation::Eccentricity(value) => {
            let (value, mass) = (context.values.scalar(g, value), whole(g, context, body).mass);
            g.mul(mass, value)
        }
    }
}

fn whole(g: &mut Graph, context: &Context, body: BodyId) -> AugmentedBody {
    let mut whole = AugmentedBody::empty(g);
    let body = &context.mechanism.bodies[body.index()];
    for piece in MassDistribution::of_body(g, context.values, body) {
        whole.add(g, &piece);
    }
    whole
}

fn center(g: &mut Graph, whole: &AugmentedBody) -> Vector3 {
    Vector3(whole.first.0.map(|first| g.div(first, whole.mass)))
}

/// A first moment along a direction, at a place `p`: `integral rho rho^T dm = p e^T + e p^T`.
fn moment(g: &mut Graph, at: Vector3, direction: &Direction) -> MassDistribution {
    let zero = g.zero();
    let amount = direction.amount;
    MassDistribution {
        mass: zero,
        isotropic: zero,
        arms: vec![
            Arm { direction: direction.along, first: amount, second: vec![zero, amount] },
            Arm { direction: at, first: zero, second: vec![amount, zero] },
        ],
    }
}

fn tilted(g: &mut Graph, whole: &AugmentedBody, direction: &Direction) -> MassDistribution {
    let zero = g.zero();
    let center = center(g, whole);
    // row i of the second moment about the centre of mass, without its isotropic part, which turns into itself
    let central: [Vector3; 3] = std::array::from_fn(|i| {
        Vector3(std::array::from_fn(|j| {
            let carried = g.mul(whole.first.0[i], center.0[j]);
            g.sub(whole.second[i][j], carried)
        }))
    });
    let turn = direction.along.scale(g, direction.amount);
    let turned = central.map(|column| turn.cross(g, column));
    let unit: [Vector3; 3] = crate::algebra::Matrix3::identity(g).0;
    let arms = (0..3)
        .map(|i| Arm {
            direction: unit[i],
            first: zero,
            second: (0..3).map(|j| g.add(turned[i].0[j], turned[j].0[i])).collect(),
        })
        .collect();
    MassDistribution { mass: zero, isotropic: zero, arms }
}
