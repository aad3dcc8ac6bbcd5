//! Constraints between two frames, as equations for the position and orientation of one side relative to the other.
//!
//! # Constraints act as pairs of forces
//!
//! A geometric constraint is a list of equations, each with the force and moment that are its derivative by the
//! relative velocity (`mechanics/loads/closure.rs`, `rolling.rs`); multipliers times these enter the recursion as
//! loads. This makes the reactions of all joints right, costs O(n), and checks itself: `Khat` comes out symmetric only
//! if the loads are the derivatives of the equations. Rotations are constrained as angles (`atan2`), not cosines, which
//! excludes wrong-way solutions. Equations that always hold, as three of five do in a planar loop, are dropped.

use crate::algebra::{Graph, Matrix3, Operator, Vector3};
use crate::base::ids::PointId;
use crate::mechanics::setup::Context;
use crate::model::expression::{Expr, Vector};
use crate::model::mechanism::{Closing, Joint};

use super::force_context::ForceContext;
use super::pair::{Demand, Pair, Side};
use super::perpendiculars::perpendiculars;

/// Requires two places to coincide along some axes of `from`.
pub(crate) fn coincident(
    g: &mut Graph,
    force_context: &ForceContext,
    (from, to): (PointId, PointId),
    along: [bool; 3],
) -> Pair {
    let [from, to] = [from, to].map(|id| force_context.side(id));
    let demands = (0..3).filter(|&k| along[k]).map(|k| apart(g, from, to, from.at.axes.0[k], AXES[k])).collect();
    Pair::new(g, from, to, demands)
}

const AXES: [&str; 3] = ["x", "y", "z"];

/// The displacement along a direction fixed in `from`, given in the common frame.
fn apart(g: &mut Graph, from: Side, to: Side, direction: Vector3, label: &'static str) -> Demand {
    let gap = to.at.position.sub(g, from.at.position);
    Demand { label, value: direction.dot(g, gap), force: direction, moment: Vector3::zero(g), of_velocities: false }
}

/// Requires all axes of two places, or one direction in both, to agree.
pub(crate) fn aligned(
    g: &mut Graph,
    force_context: &ForceContext,
    (from, to): (PointId, PointId),
    axis: Option<&Vector>,
) -> Pair {
    let [from, to] = [from, to].map(|id| force_context.side(id));
    let demands = match axis {
        Some(axis) => {
            let axis = force_context.context.values.vector(g, axis);
            tilts(g, force_context.context, [from.at.axes, to.at.axes], axis)
        }
        None => turns(g, from.at.axes, to.at.axes),
    };
    Pair::new(g, from, to, demands)
}

/// The three small rotations between two sets of axes. Each is an angle, so only equal axes satisfy all three.
fn turns(g: &mut Graph, from: Matrix3, to: Matrix3) -> Vec<Demand> {
    [("about_x", 2, 1), ("about_y", 0, 2), ("about_z", 1, 0)]
        .into_iter()
        .map(|(label, across, along)| angle(g, label, from.0[across], from.0[along], to.0[along]))
        .collect()
}

/// The two small rotations that tilt a direction.
fn tilts(g: &mut Graph, context: &Context, [from, to]: [Matrix3; 2], axis: Vector3) -> Vec<Demand> {
    let across = perpendiculars(g, context, axis);
    let [own, other] = [from, to].map(|axes| axes.apply(g, axis));
    ["tilt_1", "tilt_2"]
        .into_iter()
        .zip(across)
        .map(|(label, direction)| {
            let direction = from.apply(g, direction);
            angle(g, label, direction, own, other)
        })
        .collect()
}

/// The angle by which `b`, fixed in `to`, has moved from `a` towards `across`, both fixed in `from`:
/// `atan2(across . b, a . b)`.
fn angle(g: &mut Graph, label: &'static str, across: Vector3, a: Vector3, b: Vector3) -> Demand {
    let (sine, cosine) = (across.dot(g, b), a.dot(g, b));
    // This also holds where the sine is zero: between opposite directions the angle is half a turn.
    let value = g.binary(Operator::Atan2, sine, cosine);
    // d(a . b) = (b x a) . omega for b turning with omega relative to a
    let [by_sine, by_cosine] = [across, a].map(|fixed| b.cross(g, fixed));
    let squares = [sine, cosine].map(|x| g.mul(x, x));
    let square = g.add(squares[0], squares[1]);
    let first = by_sine.scale(g, cosine);
    let second = by_cosine.scale(g, sine);
    let one = g.constant(1.0);
    let inverse = g.div(one, square);
    Demand {
        label,
        value,
        force: Vector3::zero(g),
        moment: first.sub(g, second).scale(g, inverse),
        of_velocities: false,
    }
}

/// Requires two places to keep a distance. The demand is declared length minus distance, so its reaction is a tension.
pub(crate) fn distance(
    g: &mut Graph,
    force_context: &ForceContext,
    (from, to): (PointId, PointId),
    length: &Expr,
) -> Pair {
    let [from, to] = [from, to].map(|id| force_context.side(id));
    let length = force_context.context.values.scalar(g, length);
    let gap = to.at.position.sub(g, from.at.position);
    let distance = gap.norm(g);
    let one = g.constant(1.0);
    let inverse = g.div(one, distance);
    let demand = Demand {
        label: "",
        value: g.sub(length, distance),
        force: gap.scale(g, inverse).neg(g),
        moment: Vector3::zero(g),
        of_velocities: false,
    };
    Pair::new(g, from, to, vec![demand])
}

/// The demands of a joint on its `to` side, as equations.
pub(crate) fn joint_demands(g: &mut Graph, force_context: &ForceContext, joint: &Joint) -> Pair {
    let context = force_context.context;
    let from = force_context.placed(g, joint.from, &joint.from_placement);
    let to = force_context.placed(g, joint.to, &joint.to_placement);
    let axes: Vec<Vector3> = joint.steps.iter().map(|step| context.values.vector(g, &step.axis)).collect();
    let Some(closing) = joint.closing else {
        unreachable!("resolution and topology cut no {} joint", joint.word);
    };
    let (own, other) = (from.at.axes, to.at.axes);
    let directions: Vec<(&'static str, Vector3)> = match closing {
        Closing::Prismatic | Closing::Cylindrical => {
            let across = perpendiculars(g, context, axes[0]);
            ["across_1", "across_2"].into_iter().zip(across.map(|direction| own.apply(g, direction))).collect()
        }
        Closing::Planar => vec![("normal", own.apply(g, axes[2]))],
        Closing::Fixed | Closing::Revolute | Closing::Universal | Closing::Spherical => {
            AXES.into_iter().zip(own.0).collect()
        }
    };
    let mut demands: Vec<Demand> =
        directions.into_iter().map(|(label, direction)| apart(g, from, to, direction, label)).collect();
    demands.extend(match closing {
        Closing::Fixed | Closing::Prismatic => turns(g, own, other),
        Closing::Revolute => tilts(g, context, [own, other], axes[0]),
        Closing::Cylindrical => tilts(g, context, [own, other], axes[1]),
        Closing::Planar => tilts(g, context, [own, other], axes[2]),
        Closing::Universal => vec![between(g, own, other, axes[0], axes[1])],
        Closing::Spherical => Vec::new(),
    });
    Pair::new(g, from, to, demands)
}

/// Requires the axes of a universal joint to keep their angle.
fn between(g: &mut Graph, from: Matrix3, to: Matrix3, first: Vector3, second: Vector3) -> Demand {
    let declared = first.dot(g, second);
    let (a, b) = (from.apply(g, first), to.apply(g, second));
    let cosine = a.dot(g, b);
    Demand {
        label: "cross",
        value: g.sub(cosine, declared),
        force: Vector3::zero(g),
        moment: b.cross(g, a),
        of_velocities: false,
    }
}
