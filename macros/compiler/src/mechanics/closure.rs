//! Constraints between two frames: what they demand of the place of one side as seen from the other.

use crate::algebra::{Graph, Matrix3, Operator, Vector3};
use crate::base::ids::{ExprId, PointId};
use crate::model::expression::{Expr, Vector};
use crate::model::mechanism::{Frame, Joint};

use super::kinematics::PointMotion;
use super::problem::Problem;
use super::setting::Setting;

/// A place fixed in a frame.
#[derive(Clone, Copy)]
pub(super) struct Side {
    pub(super) frame: Frame,
    pub(super) at: PointMotion,
}

/// One equation between two sides, with the pair that belongs to it: the derivative of the equation by the velocity and the
/// angular velocity of `to` relative to `from`, at the place where the pair acts.
pub(super) struct Demand {
    /// Which equation of its constraint; empty for the only one.
    pub(super) label: &'static str,
    pub(super) value: ExprId,
    pub(super) force: Vector3,
    pub(super) moment: Vector3,
    pub(super) of_velocities: bool,
}

/// Two sides and what is demanded of them.
pub(super) struct Pair {
    pub(super) from: Side,
    pub(super) to: Side,
    /// From the point of `to` to the place where the pair acts.
    pub(super) reach: Vector3,
    pub(super) demands: Vec<Demand>,
}

impl Pair {
    /// From the point of `from` to the place where the pair acts.
    pub(super) fn gap(&self, g: &mut Graph) -> Vector3 {
        let between = self.to.at.position.sub(g, self.from.at.position);
        between.add(g, self.reach)
    }

    fn new(g: &mut Graph, from: Side, to: Side, demands: Vec<Demand>) -> Self {
        let reach = Vector3::zero(g);
        Self {
            from,
            to,
            reach,
            demands,
        }
    }
}

/// Axes of `from` along which two places coincide.
pub(super) fn coincident(
    g: &mut Graph,
    setting: &Setting,
    (from, to): (PointId, PointId),
    along: [bool; 3],
) -> Pair {
    let [from, to] = [from, to].map(|id| setting.side(id));
    let demands = (0..3)
        .filter(|&k| along[k])
        .map(|k| apart(g, from, to, from.at.axes.0[k], AXES[k]))
        .collect();
    Pair::new(g, from, to, demands)
}

const AXES: [&str; 3] = ["x", "y", "z"];

/// The displacement along a direction fixed in `from`, given in the common frame.
fn apart(g: &mut Graph, from: Side, to: Side, direction: Vector3, label: &'static str) -> Demand {
    let gap = to.at.position.sub(g, from.at.position);
    Demand {
        label,
        value: direction.dot(g, gap),
        force: direction,
        moment: Vector3::zero(g),
        of_velocities: false,
    }
}

/// All axes of two places, or one direction in both, agree.
pub(super) fn aligned(
    g: &mut Graph,
    setting: &Setting,
    (from, to): (PointId, PointId),
    axis: Option<&Vector>,
) -> Pair {
    let [from, to] = [from, to].map(|id| setting.side(id));
    let demands = match axis {
        Some(axis) => {
            let axis = setting.problem.values.vector(g, axis);
            tilts(g, setting.problem, [from.at.axes, to.at.axes], axis)
        }
        None => turns(g, from.at.axes, to.at.axes),
    };
    Pair::new(g, from, to, demands)
}

/// The three small rotations between two sets of axes. Each is an angle, so that only equal axes satisfy all three.
fn turns(g: &mut Graph, from: Matrix3, to: Matrix3) -> Vec<Demand> {
    [("about_x", 2, 1), ("about_y", 0, 2), ("about_z", 1, 0)]
        .into_iter()
        .map(|(label, across, along)| angle(g, label, from.0[across], from.0[along], to.0[along]))
        .collect()
}

/// The two small rotations that tilt a direction.
fn tilts(g: &mut Graph, problem: &Problem, [from, to]: [Matrix3; 2], axis: Vector3) -> Vec<Demand> {
    let across = perpendiculars(g, problem, axis);
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

/// The angle by which `b`, fixed in `to`, has left `a` towards `across`, both fixed in `from`: `atan2(across . b, a . b)`.
fn angle(g: &mut Graph, label: &'static str, across: Vector3, a: Vector3, b: Vector3) -> Demand {
    let (sine, cosine) = (across.dot(g, b), a.dot(g, b));
    // Also where the sine is nothing: of opposite directions the angle is half a turn.
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

/// Two unit vectors that form a right-handed set with a unit vector, itself the third. The first leans towards the axis of the
/// frame that is farthest from it at the nominal design: towards one along it there would be no direction.
pub(super) fn perpendiculars(g: &mut Graph, problem: &Problem, axis: Vector3) -> [Vector3; 2] {
    let leaning = axis.0.map(|component| {
        let is_variable = g.constant_value(component).is_none();
        (problem.nominal(g, component).abs(), is_variable)
    });
    let least = (1..3).fold(0, |least, k| {
        if leaning[k] < leaning[least] {
            k
        } else {
            least
        }
    });
    let unit = Matrix3::identity(g).0[least];
    let along = axis.scale(g, axis.0[least]);
    let first = unit.sub(g, along);
    let first = if g.is(axis.0[least], 0.0) {
        first
    } else {
        let one = g.constant(1.0);
        let length = first.norm(g);
        let inverse = g.div(one, length);
        first.scale(g, inverse)
    };
    [first, axis.cross(g, first)]
}

/// Two places keep a distance. The demand is on what the distance lacks, so that its reaction is a tension.
pub(super) fn distance(
    g: &mut Graph,
    setting: &Setting,
    (from, to): (PointId, PointId),
    length: &Expr,
) -> Pair {
    let [from, to] = [from, to].map(|id| setting.side(id));
    let length = setting.problem.values.scalar(g, length);
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

/// What a joint allows its `to` side, as equations. Its kinds are those of [`crate::topology::cut::CLOSING`].
pub(super) fn joint_demands(g: &mut Graph, setting: &Setting, joint: &Joint) -> Pair {
    let from = setting.placed(g, joint.from, &joint.from_placement);
    let to = setting.placed(g, joint.to, &joint.to_placement);
    let axes: Vec<Vector3> = joint
        .steps
        .iter()
        .map(|step| setting.problem.values.vector(g, &step.axis))
        .collect();
    let mut demands = Vec::new();
    let every = [
        ("x", from.at.axes.0[0]),
        ("y", from.at.axes.0[1]),
        ("z", from.at.axes.0[2]),
    ];
    let directions: Vec<(&'static str, Vector3)> = match joint.word {
        "prismatic" | "cylindrical" => {
            let across = perpendiculars(g, setting.problem, axes[0]);
            ["across_1", "across_2"]
                .into_iter()
                .zip(across.map(|direction| from.at.axes.apply(g, direction)))
                .collect()
        }
        "planar" => vec![("normal", from.at.axes.apply(g, axes[2]))],
        _ => every.to_vec(),
    };
    for (label, direction) in directions {
        demands.push(apart(g, from, to, direction, label));
    }
    let (own, other) = (from.at.axes, to.at.axes);
    demands.extend(match joint.word {
        "fixed" | "prismatic" => turns(g, own, other),
        "revolute" => tilts(g, setting.problem, [own, other], axes[0]),
        "cylindrical" => tilts(g, setting.problem, [own, other], axes[1]),
        "planar" => tilts(g, setting.problem, [own, other], axes[2]),
        "universal" => vec![between(g, own, other, axes[0], axes[1])],
        _ => Vec::new(),
    });
    Pair::new(g, from, to, demands)
}

/// The axes of a universal joint keep their angle.
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
