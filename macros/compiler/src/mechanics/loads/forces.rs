//! The force laws: loads of the force elements on coordinates and bodies.
//!
//! # Forces of a pair stop at the last common ancestor
//!
//! The two ends of a spring between bodies do no work on joints nearer the ground; summing them there would leave
//! rounding errors, which a stiff bearing makes visible (`mechanics/loads/forces.rs`). Rates of lengths and bushings
//! are taken over the joints between the two ends (`mechanics/motion/tree.rs`), so a common drive leaves no trace.

use crate::algebra::{ExprId, Graph, Matrix3, Vector3, gradient};
use crate::base::ids::{BeamId, ForceId, PointId};
use crate::mechanics::motion::Wrench;
use crate::mechanics::setup::{ForceSelection, State};
use crate::model::expression::Expr;
use crate::model::mechanism::{Force, ForceLaw, Frame};

use super::applied::AppliedForces;
use super::distributed::PerLength;
use super::force_context::ForceContext;

/// Evaluates the force elements.
pub(crate) fn applied_forces(g: &mut Graph, force_context: &ForceContext, selection: ForceSelection) -> AppliedForces {
    let mechanism = force_context.context.mechanism;
    let mut applied = AppliedForces::none(g, mechanism);
    for (index, force) in mechanism.forces.iter().enumerate() {
        if selection.forces.contains(ForceId::new(index)) {
            applied.act(g, force_context, force);
        }
    }
    applied
}

impl AppliedForces {
    fn act(&mut self, g: &mut Graph, force_context: &ForceContext, force: &Force) {
        let ForceContext { context, kinematics, .. } = *force_context;
        let values = context.values;
        let name = force.name.to_string();
        match &force.law {
            // Q = -stiffness (q - rest)
            ForceLaw::CoordinateSpring { coordinate, stiffness, rest } => {
                let (stiffness, rest) = (values.scalar(g, stiffness), values.scalar(g, rest));
                let position = kinematics.coordinates[coordinate.index()].position;
                let stretch = g.sub(position, rest);
                let load = g.mul(stiffness, stretch);
                g.set_name(load, || name);
                let slot = &mut self.on_coordinates[coordinate.index()];
                *slot = g.sub(*slot, load);
            }
            // Q = -damping qdot
            ForceLaw::CoordinateDamper { coordinate, damping } => {
                let damping = values.scalar(g, damping);
                let velocity = kinematics.coordinates[coordinate.index()].velocity;
                let load = g.mul(damping, velocity);
                g.set_name(load, || name);
                let slot = &mut self.on_coordinates[coordinate.index()];
                *slot = g.sub(*slot, load);
            }
            // Q = -inertance qddot
            ForceLaw::CoordinateInerter { coordinates: [one, other], inertance } => {
                let inertance = values.scalar(g, inertance);
                for (on, of) in [(one, other), (other, one)].into_iter().take(if one == other { 1 } else { 2 }) {
                    let acceleration = kinematics.coordinates[of.index()].acceleration;
                    let load = g.mul(inertance, acceleration);
                    g.set_name(load, || name.clone());
                    let slot = &mut self.on_coordinates[on.index()];
                    *slot = g.sub(*slot, load);
                }
            }
            ForceLaw::Generalized { coordinate, value } => {
                let load = values.scalar_at(g, value, kinematics);
                g.set_name(load, || name);
                let slot = &mut self.on_coordinates[coordinate.index()];
                *slot = g.add(*slot, load);
            }
            // Q_i = -dV/dq_i
            ForceLaw::Potential { energy } => {
                let energy = values.scalar_at(g, energy, kinematics);
                let free = context.topology.free.len();
                let slopes = gradient(g, energy, &context.symbols.q.ids[..free]);
                for (id, slope) in context.topology.free.iter().zip(slopes) {
                    let slot = &mut self.on_coordinates[id.index()];
                    *slot = g.sub(*slot, slope);
                }
            }
            ForceLaw::SpringDamper { .. } | ForceLaw::Tension { .. } => {
                if let Some((line, tension)) = tension(g, force_context, force) {
                    self.pull(g, force_context, &line, tension, &name);
                }
            }
            ForceLaw::Bushing { from, to, .. } => {
                if let Some(Wrench { force, moment }) = resistance(g, force_context, force) {
                    self.bushing(g, force_context, (*from, *to), [force, moment], &name);
                }
            }
            ForceLaw::Load { point, force, moment, following } => {
                let (force, moment) = (values.vector(g, force), values.vector(g, moment));
                let axes = force_context.point(*point).axes;
                let load = if *following {
                    Wrench { force: axes.apply(g, force), moment: axes.apply(g, moment) }
                } else {
                    Wrench { force, moment }
                };
                self.apply(g, force_context, *point, load, Frame::Ground);
            }
            ForceLaw::Distributed { on, force, follower, damping } => {
                let load = PerLength { force, follower, damping };
                let beams = context.mechanism.beams.iter().enumerate();
                for (index, _) in beams.filter(|(_, beam)| beam.whole == *on) {
                    self.distribute(g, force_context, BeamId::new(index), &load);
                }
            }
            // force = -damping v, moment = -turning_damping omega, both absolute
            ForceLaw::Drag { point, damping, turning_damping } => {
                let [damping, turning_damping] = [damping, turning_damping].map(|value| values.scalar(g, value));
                let position = force_context.point(*point).position;
                let (velocity, angular) =
                    force_context.velocity(g, force_context.frame(*point), position, Frame::Ground);
                let force = velocity.scale(g, damping).set_name(g, &format!("minus_{name}_force"));
                let moment = angular.scale(g, turning_damping);
                let load = Wrench { force, moment }.neg(g);
                self.apply(g, force_context, *point, load, Frame::Ground);
            }
        }
    }

    /// Opposite forces along the line between two points.
    fn pull(&mut self, g: &mut Graph, force_context: &ForceContext, line: &Line, tension: ExprId, name: &str) {
        g.set_name(tension, || format!("{name}_tension"));
        let density = g.div(tension, line.distance);
        let force = line.vector.scale(g, density).set_name(g, &format!("{name}_force"));
        let pull = Wrench { force, moment: Vector3::zero(g) };
        let push = pull.neg(g);
        self.apply(g, force_context, line.from, pull, line.closing);
        self.apply(g, force_context, line.to, push, line.closing);
    }

    /// The resistance of a bushing on `to`, and the opposite on `from` at the place of `to`.
    fn bushing(
        &mut self,
        g: &mut Graph,
        force_context: &ForceContext,
        (from, to): (PointId, PointId),
        resistance: [Vector3; 2],
        name: &str,
    ) {
        let [start, end] = [from, to].map(|id| force_context.point(id));
        let frames = [from, to].map(|id| force_context.frame(id));
        let closing = force_context.tree.common_ancestor(frames[0], frames[1]);
        let gap = end.position.sub(g, start.position);
        let [force, moment] = resistance.map(|vector| start.axes.apply(g, vector));
        let force = force.set_name(g, &format!("{name}_force"));
        let moment = moment.set_name(g, &format!("{name}_moment"));
        // At the place of `to`, seen from the origin of `from`, the force on `from` adds a moment.
        let lever = gap.cross(g, force);
        let on_from = Wrench { force, moment: moment.add(g, lever) };
        self.apply(g, force_context, from, on_from, closing);
        let on_to = Wrench { force, moment }.neg(g);
        self.apply(g, force_context, to, on_to, closing);
    }
}

/// What a force element exerts; see [`Expr::Exerted`].
pub(crate) fn exerted(g: &mut Graph, force_context: &ForceContext, force: &Force) -> [ExprId; 6] {
    let zero = g.zero();
    if let Some((_, tension)) = tension(g, force_context, force) {
        return [tension, zero, zero, zero, zero, zero];
    }
    let Some(resistance) = resistance(g, force_context, force) else {
        return [zero; 6];
    };
    let Wrench { force, moment } = resistance.neg(g);
    let ([a, b, c], [d, e, f]) = (force.0, moment.0);
    [a, b, c, d, e, f]
}

/// The tension between two points: of a spring damper, `stiffness (distance - length) + damping d(distance)/dt`.
fn tension(g: &mut Graph, force_context: &ForceContext, force: &Force) -> Option<(Line, ExprId)> {
    let values = force_context.context.values;
    let name = force.name.to_string();
    match &force.law {
        ForceLaw::SpringDamper { from, to, stiffness, damping, length } => {
            let line = Line::new(g, force_context, *from, *to, &name);
            let [stiffness, damping, length] = [stiffness, damping, length].map(|value| values.scalar(g, value));
            let stretch = g.sub(line.distance, length);
            let (elastic, viscous) = (g.mul(stiffness, stretch), g.mul(damping, line.rate));
            let tension = g.add(elastic, viscous);
            Some((line, tension))
        }
        ForceLaw::Tension { from, to, tension } => {
            let line = Line::new(g, force_context, *from, *to, &name);
            let tension = values.scalar_at(g, tension, &line);
            Some((line, tension))
        }
        _ => None,
    }
}

/// Force and moment with which a bushing resists the displacement and rotation of `to` relative to `from`, in the axes
/// of `from`.
fn resistance(g: &mut Graph, force_context: &ForceContext, force: &Force) -> Option<Wrench> {
    let ForceLaw::Bushing { from, to, stiffness, damping, turning_stiffness, turning_damping } = &force.law else {
        return None;
    };
    let values = force_context.context.values;
    let [stiffness, damping, turning_stiffness, turning_damping] =
        [stiffness, damping, turning_stiffness, turning_damping].map(|value| values.matrix(g, value));
    let [start, end] = [*from, *to].map(|id| force_context.point(id));
    let frames = [*from, *to].map(|id| force_context.frame(id));
    let closing = force_context.tree.common_ancestor(frames[0], frames[1]);
    let to_axes = start.axes.transpose();
    let gap = end.position.sub(g, start.position);
    let displacement = to_axes.apply(g, gap);
    // Seen from `from`, the point of its body at the place of `to` is at rest.
    let [(carrier, carrier_turn), (absolute, own_turn)] =
        frames.map(|frame| force_context.velocity(g, frame, end.position, closing));
    let velocity = absolute.sub(g, carrier);
    let velocity = to_axes.apply(g, velocity);
    let turning = own_turn.sub(g, carrier_turn);
    let turning = to_axes.apply(g, turning);
    let relative = to_axes.multiply(g, end.axes);
    let rotation = half_antisymmetric(g, relative);
    let rotation_rate = half_antisymmetric_rate(g, relative, turning);
    let mut law = |stiffness: Rows, x: Vector3, damping: Rows, rate: Vector3| {
        Vector3(std::array::from_fn(|i| {
            let elastic = stiffness[i].dot(g, x);
            let viscous = damping[i].dot(g, rate);
            g.add(elastic, viscous)
        }))
    };
    Some(Wrench {
        force: law(stiffness, displacement, damping, velocity),
        moment: law(turning_stiffness, rotation, turning_damping, rotation_rate),
    })
}

/// A matrix by rows.
type Rows = [Vector3; 3];

/// The line between two points, and the rate at which it grows.
struct Line {
    from: PointId,
    to: PointId,
    /// Vector from the first point to the second.
    vector: Vector3,
    distance: ExprId,
    rate: ExprId,
    /// The last common ancestor frame of both ends.
    closing: Frame,
}

impl Line {
    fn new(g: &mut Graph, force_context: &ForceContext, from: PointId, to: PointId, name: &str) -> Self {
        let ends = [from, to].map(|id| (force_context.frame(id), force_context.point(id).position));
        let closing = force_context.tree.common_ancestor(ends[0].0, ends[1].0);
        let vector = ends[1].1.sub(g, ends[0].1);
        let distance = vector.norm(g);
        g.set_name(distance, || format!("{name}_length"));
        let [start, end] = ends.map(|(frame, position)| force_context.velocity(g, frame, position, closing).0);
        let growth = end.sub(g, start).dot(g, vector);
        let rate = g.div(growth, distance);
        Self { from, to, vector, distance, rate, closing }
    }
}

impl State for Line {
    fn leaf(&self, leaf: &Expr) -> ExprId {
        match leaf {
            Expr::Length => self.distance,
            Expr::LengthRate => self.rate,
            _ => unreachable!("resolution admits {leaf:?} elsewhere only"),
        }
    }
}

/// `r = vee((R - R^T) / 2)`: the rotation vector of a small rotation.
fn half_antisymmetric(g: &mut Graph, rotation: Matrix3) -> Vector3 {
    let entry = |i: usize, j: usize| rotation.0[j].0[i];
    let mut half_difference = |a, b| {
        let difference = g.sub(a, b);
        g.scale(0.5, difference)
    };
    Vector3([
        half_difference(entry(2, 1), entry(1, 2)),
        half_difference(entry(0, 2), entry(2, 0)),
        half_difference(entry(1, 0), entry(0, 1)),
    ])
}

/// Rate of [`half_antisymmetric`] while the rotation turns with `omega` (in the axes in which it is written):
/// `R' = [omega]x R`.
fn half_antisymmetric_rate(g: &mut Graph, rotation: Matrix3, omega: Vector3) -> Vector3 {
    let rate = Matrix3(rotation.0.map(|column| omega.cross(g, column)));
    half_antisymmetric(g, rate)
}
