//! Applied forces: what the force elements do to coordinates and bodies.

use std::collections::BTreeMap;

use crate::algebra::{Graph, Vector3};
use crate::base::ids::{ExprId, ForceId, PointId};
use crate::model::mechanism::{ForceLaw, Frame, JointKind, Mechanism};
use crate::topology::{Branch, Topology};

use super::kinematics::Kinematics;
use super::sources::Sources;
use super::values::Values;

/// A force and its moment about the origin of the frame it is kept for.
#[derive(Clone, Copy, Debug)]
pub(super) struct Wrench {
    pub(super) force: Vector3,
    pub(super) moment: Vector3,
}

impl Wrench {
    pub(super) fn add(self, g: &mut Graph, other: Self) -> Self {
        Self {
            force: self.force.add(g, other.force),
            moment: self.moment.add(g, other.moment),
        }
    }
}

/// Loads on one body, grouped by the frame on which each closes: a force pair between two bodies does no work on the
/// joints below their last common ancestor, and adding it up there would only leave rounding errors.
pub(super) type Loads = BTreeMap<Frame, Wrench>;

/// Applied loads of a mechanism.
pub(super) struct AppliedForces {
    /// By body id.
    pub(super) on_bodies: Vec<Loads>,
    /// Generalised force by coordinate id.
    pub(super) on_coordinates: Vec<ExprId>,
}

impl AppliedForces {
    /// Evaluates the force elements.
    pub(super) fn new(
        g: &mut Graph,
        mechanism: &Mechanism,
        topology: &Topology,
        values: &Values,
        kinematics: &Kinematics,
        sources: Sources,
    ) -> Self {
        let zero = g.zero();
        let mut this = Self {
            on_bodies: vec![Loads::new(); mechanism.bodies.len()],
            on_coordinates: vec![zero; mechanism.coordinates.len()],
        };
        let tree = Tree::new(mechanism, topology);
        for (index, force) in mechanism.forces.iter().enumerate() {
            if !sources.forces.contains(ForceId::new(index)) {
                continue;
            }
            let name = force.name.to_string();
            match &force.law {
                // Q = -stiffness (q - rest)
                ForceLaw::CoordinateSpring {
                    coordinate,
                    stiffness,
                    rest,
                } => {
                    let (stiffness, rest) = (values.scalar(g, stiffness), values.scalar(g, rest));
                    let motion = kinematics.coordinates[coordinate.index()];
                    let stretch = g.sub(motion.position, rest);
                    let load = g.mul(stiffness, stretch);
                    g.set_name(load, || name);
                    let slot = &mut this.on_coordinates[coordinate.index()];
                    *slot = g.sub(*slot, load);
                }
                // Q = -damping qdot
                ForceLaw::CoordinateDamper {
                    coordinate,
                    damping,
                } => {
                    let damping = values.scalar(g, damping);
                    let motion = kinematics.coordinates[coordinate.index()];
                    let load = g.mul(damping, motion.velocity);
                    g.set_name(load, || name);
                    let slot = &mut this.on_coordinates[coordinate.index()];
                    *slot = g.sub(*slot, load);
                }
                // tension = stiffness (distance - length) + damping d(distance)/dt
                ForceLaw::SpringDamper {
                    from,
                    to,
                    stiffness,
                    damping,
                    length,
                } => {
                    let stiffness = values.scalar(g, stiffness);
                    let damping = values.scalar(g, damping);
                    let length = values.scalar(g, length);
                    let ends = [*from, *to];
                    let [start, end] = ends.map(|id| kinematics.points[id.index()].1);
                    let line = end.sub(g, start);
                    let distance = line.norm(g);
                    g.set_name(distance, || format!("{name}_length"));
                    let stretch = g.sub(distance, length);
                    let mut tension = g.mul(stiffness, stretch);
                    let frames = ends.map(|id| mechanism.points[id.index()].frame);
                    let closing = tree.common_ancestor(frames[0], frames[1]);
                    if !g.is(damping, 0.0) {
                        let [v_start, v_end] =
                            ends.map(|id| tree.velocity(g, mechanism, kinematics, id, closing));
                        let relative = v_end.sub(g, v_start);
                        let closing_speed = relative.dot(g, line);
                        let rate = g.div(closing_speed, distance);
                        let resistance = g.mul(damping, rate);
                        tension = g.add(tension, resistance);
                    }
                    g.set_name(tension, || format!("{name}_tension"));
                    let density = g.div(tension, distance);
                    let pull = line.scale(g, density).set_name(g, &format!("{name}_force"));
                    let push = pull.neg(g);
                    for ((point, frame), force) in ends.into_iter().zip(frames).zip([pull, push]) {
                        this.apply(g, kinematics, point, frame, force, closing);
                    }
                }
            }
        }
        this
    }

    /// Applies a force at a named point.
    fn apply(
        &mut self,
        g: &mut Graph,
        kinematics: &Kinematics,
        point: PointId,
        frame: Frame,
        force: Vector3,
        closing: Frame,
    ) {
        let Frame::Body(body) = frame else { return };
        if frame == closing {
            return;
        }
        let arm = kinematics.points[point.index()].0;
        let load = Wrench {
            force,
            moment: arm.cross(g, force),
        };
        let loads = &mut self.on_bodies[body.index()];
        let sum = match loads.get(&closing) {
            Some(so_far) => so_far.add(g, load),
            None => load,
        };
        loads.insert(closing, sum);
    }
}

/// The branches by body, for walking towards the ground.
struct Tree {
    branch: Vec<Option<Branch>>,
}

impl Tree {
    fn new(mechanism: &Mechanism, topology: &Topology) -> Self {
        let mut branch = vec![None; mechanism.bodies.len()];
        for b in &topology.branches {
            branch[b.body.index()] = Some(*b);
        }
        Self { branch }
    }

    fn parent(&self, frame: Frame) -> Option<Branch> {
        match frame {
            Frame::Ground => None,
            Frame::Body(body) => self.branch[body.index()],
        }
    }

    /// The frame and all it hangs on, up to the ground.
    fn path(&self, frame: Frame) -> Vec<Frame> {
        let mut path = vec![frame];
        let mut at = frame;
        while let Some(branch) = self.parent(at) {
            at = branch.parent;
            path.push(at);
        }
        path
    }

    /// The last frame that both hang on.
    fn common_ancestor(&self, a: Frame, b: Frame) -> Frame {
        let path = self.path(a);
        self.path(b)
            .into_iter()
            .find(|frame| path.contains(frame))
            .unwrap_or(Frame::Ground)
    }

    /// Velocity of a point relative to a frame it hangs on: the sum over the joints between.
    fn velocity(
        &self,
        g: &mut Graph,
        mechanism: &Mechanism,
        kinematics: &Kinematics,
        point: PointId,
        relative_to: Frame,
    ) -> Vector3 {
        let position = kinematics.points[point.index()].1;
        let mut velocity = Vector3::zero(g);
        let mut at = mechanism.points[point.index()].frame;
        while at != relative_to {
            let Some(branch) = self.parent(at) else { break };
            let motion = kinematics.of(branch.body);
            let share = match &mechanism.joints[branch.joint.index()].kind {
                JointKind::Fixed => Vector3::zero(g),
                JointKind::Revolute { coordinate, .. } => {
                    let joint = motion.frame.position.add(g, motion.joint_point);
                    let arm = position.sub(g, joint);
                    let turn = motion.joint_axis.cross(g, arm);
                    turn.scale(g, kinematics.coordinates[coordinate.index()].velocity)
                }
                JointKind::Prismatic { coordinate, .. } => motion
                    .joint_axis
                    .scale(g, kinematics.coordinates[coordinate.index()].velocity),
            };
            velocity = velocity.add(g, share);
            at = branch.parent;
        }
        velocity
    }
}
