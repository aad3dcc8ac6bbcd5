//! Positions, velocities and accelerations of all bodies, from the ground outwards.
//!
//! Every vector is expressed in one common frame: the ground frame at the instant at which all driven coordinates are
//! zero. (A recursion in body frames would turn every vector at every joint and cost about twice as much.)

use crate::algebra::{Graph, Matrix3, Vector3};
use crate::base::ids::{BodyId, CoordinateId, ExprId, PointId};
use crate::model::mechanism::{Frame, JointKind, Mechanism};
use crate::topology::{Branch, Topology};

use super::orientation::Orientation;
use super::values::{State, Values};

/// A joint coordinate and its two time derivatives.
#[derive(Clone, Copy, Debug)]
pub(super) struct CoordinateMotion {
    pub(super) position: ExprId,
    pub(super) velocity: ExprId,
    pub(super) acceleration: ExprId,
}

/// Motion of a frame, everything in the common frame.
#[derive(Clone, Copy, Debug)]
pub(super) struct FrameMotion {
    pub(super) orientation: Orientation,
    /// Origin from the ground's origin.
    pub(super) position: Vector3,
    pub(super) angular_velocity: Vector3,
    pub(super) angular_acceleration: Vector3,
    /// Acceleration of the origin.
    pub(super) acceleration: Vector3,
    /// `W = [alpha]x + [omega]x [omega]x`: takes a body-fixed vector to its second time derivative.
    second_rate: Matrix3,
    /// Second time derivatives of the body axes: `W` applied to each.
    axes_second_rate: Matrix3,
}

/// Motion of a body, and of the joint that carries it.
#[derive(Clone, Copy, Debug)]
pub(super) struct BodyMotion {
    pub(super) frame: FrameMotion,
    /// Origin from the parent's origin.
    pub(super) from_parent: Vector3,
    /// Joint axis; zero for a fixed joint.
    pub(super) joint_axis: Vector3,
    /// The joint's origin from the body's origin.
    pub(super) joint_point: Vector3,
}

/// Motion of every frame of a mechanism.
pub(super) struct Kinematics {
    pub(super) coordinates: Vec<CoordinateMotion>,
    pub(super) ground: FrameMotion,
    /// By body id.
    pub(super) bodies: Vec<BodyMotion>,
    /// Offset of each named point from its frame's origin, and its position.
    pub(super) points: Vec<(Vector3, Vector3)>,
}

impl Kinematics {
    /// Runs the recursion. `coordinates` is by coordinate id.
    pub(super) fn new(
        g: &mut Graph,
        mechanism: &Mechanism,
        topology: &Topology,
        values: &Values,
        coordinates: Vec<CoordinateMotion>,
    ) -> Self {
        let ground = FrameMotion::ground(g);
        let placeholder = BodyMotion {
            frame: ground,
            from_parent: ground.position,
            joint_axis: ground.position,
            joint_point: ground.position,
        };
        let mut this = Self {
            coordinates,
            ground,
            bodies: vec![placeholder; mechanism.bodies.len()],
            points: Vec::new(),
        };
        for branch in &topology.branches {
            let parent = *this.frame(branch.parent);
            let motion = this.body(g, mechanism, values, branch, &parent);
            this.bodies[branch.body.index()] = motion;
        }
        for point in &mechanism.points {
            let frame = *this.frame(point.frame);
            let offset = values.vector(g, &point.position);
            let arm = frame.orientation.express(g, offset);
            let position = frame
                .position
                .add(g, arm)
                .set_name(g, &point.name.to_string());
            this.points.push((arm, position));
        }
        this
    }

    /// Motion of a frame.
    pub(super) fn frame(&self, frame: Frame) -> &FrameMotion {
        match frame {
            Frame::Ground => &self.ground,
            Frame::Body(body) => &self.bodies[body.index()].frame,
        }
    }

    /// Motion of a body.
    pub(super) fn of(&self, body: BodyId) -> &BodyMotion {
        &self.bodies[body.index()]
    }

    fn body(
        &self,
        g: &mut Graph,
        mechanism: &Mechanism,
        values: &Values,
        branch: &Branch,
        parent: &FrameMotion,
    ) -> BodyMotion {
        let joint = &mechanism.joints[branch.joint.index()];
        let name = mechanism.bodies[branch.body.index()].name.to_string();
        let (inboard, outboard) = if branch.reversed {
            (&joint.to_placement, &joint.from_placement)
        } else {
            (&joint.from_placement, &joint.to_placement)
        };
        let (inboard_offset, inboard_rotation) = values.placement(g, inboard);
        let (outboard_offset, outboard_rotation) = values.placement(g, outboard);
        let joint_orientation = parent.orientation.then_fixed(g, inboard_rotation);

        let mut orientation = joint_orientation;
        let mut omega = parent.angular_velocity;
        let mut alpha = parent.angular_acceleration;
        let (mut offset, mut acceleration) = parent.carry(g, inboard_offset);
        acceleration = parent.acceleration.add(g, acceleration);
        let mut joint_axis = Vector3::zero(g);

        match &joint.kind {
            JointKind::Fixed => {}
            JointKind::Revolute { axis, coordinate } => {
                let axis = values.vector(g, axis);
                let axis = oriented(g, axis, branch);
                let motion = self.coordinates[coordinate.index()];
                orientation = orientation.then_turned(g, axis, motion.position, &name);
                joint_axis = joint_orientation.express(g, axis);
                let spin = joint_axis.scale(g, motion.velocity);
                let growth = joint_axis.scale(g, motion.acceleration);
                let gyroscopic = omega.cross(g, spin);
                omega = omega.add(g, spin);
                let relative = growth.add(g, gyroscopic);
                alpha = alpha.add(g, relative);
            }
            JointKind::Prismatic { axis, coordinate } => {
                let axis = values.vector(g, axis);
                let axis = oriented(g, axis, branch);
                let motion = self.coordinates[coordinate.index()];
                joint_axis = joint_orientation.express(g, axis);
                let slide = joint_axis.scale(g, motion.position);
                let carried = parent
                    .second_rate
                    .apply(g, joint_axis)
                    .scale(g, motion.position);
                let twist = omega.cross(g, joint_axis);
                let double_speed = g.scale(2.0, motion.velocity);
                let coriolis = twist.scale(g, double_speed);
                let growth = joint_axis.scale(g, motion.acceleration);
                offset = offset.add(g, slide);
                for term in [carried, coriolis, growth] {
                    acceleration = acceleration.add(g, term);
                }
            }
        }

        orientation = orientation.then_fixed(g, outboard_rotation.map(Matrix3::transpose));
        let omega = omega.set_name(g, &format!("{name}_angular_velocity"));
        let alpha = alpha.set_name(g, &format!("{name}_angular_acceleration"));
        let mut frame = FrameMotion::new(g, orientation, omega, alpha, &name);
        let (joint_point, joint_point_rate) = frame.carry(g, outboard_offset);
        let from_parent = offset.sub(g, joint_point);
        frame.position = parent
            .position
            .add(g, from_parent)
            .set_name(g, &format!("{name}_position"));
        frame.acceleration = acceleration
            .sub(g, joint_point_rate)
            .set_name(g, &format!("{name}_acceleration"));
        BodyMotion {
            frame,
            from_parent,
            joint_axis,
            joint_point,
        }
    }
}

/// The joint axis as seen from the parent: a joint declared from the body to its parent turns the other way.
fn oriented(g: &mut Graph, axis: Vector3, branch: &Branch) -> Vector3 {
    if branch.reversed { axis.neg(g) } else { axis }
}

impl FrameMotion {
    fn ground(g: &mut Graph) -> Self {
        let zero = Vector3::zero(g);
        let orientation = Orientation::aligned(g);
        Self::new(g, orientation, zero, zero, "ground")
    }

    /// A frame turning with `omega` and `alpha`, its origin at rest in the ground's.
    fn new(
        g: &mut Graph,
        orientation: Orientation,
        omega: Vector3,
        alpha: Vector3,
        name: &str,
    ) -> Self {
        let zero = Vector3::zero(g);
        let second_rate = second_rate(g, omega, alpha);
        let axes_second_rate = second_rate.multiply(g, orientation.axes);
        for (column, axis) in ["x", "y", "z"].into_iter().enumerate() {
            orientation.axes.0[column].set_name(g, &format!("{name}_axis_{axis}"));
            axes_second_rate.0[column].set_name(g, &format!("{name}_axis_{axis}_second_rate"));
        }
        Self {
            orientation,
            position: zero,
            angular_velocity: omega,
            angular_acceleration: alpha,
            acceleration: zero,
            second_rate,
            axes_second_rate,
        }
    }

    /// A body-fixed vector in the common frame, and its second time derivative. One along a body axis shares the work
    /// with every other vector along that axis.
    pub(super) fn carry(&self, g: &mut Graph, vector: Vector3) -> (Vector3, Vector3) {
        let nonzero: Vec<usize> = (0..3).filter(|&k| !g.is(vector.0[k], 0.0)).collect();
        match nonzero[..] {
            [] => (vector, vector),
            [k] => {
                let length = vector.0[k];
                let arm = self.orientation.axes.0[k].scale(g, length);
                (arm, self.axes_second_rate.0[k].scale(g, length))
            }
            _ => {
                let arm = self.orientation.express(g, vector);
                (arm, self.second_rate.apply(g, arm))
            }
        }
    }
}

/// `[alpha]x + omega omega^T - |omega|^2 1`.
fn second_rate(g: &mut Graph, omega: Vector3, alpha: Vector3) -> Matrix3 {
    let ([wx, wy, wz], [ax, ay, az]) = (omega.0, alpha.0);
    let [xx, yy, zz] = omega.0.map(|w| {
        let square = g.mul(w, w);
        if let Some(name) = g.name(w).map(|name| format!("{name}_squared")) {
            g.set_name(square, || name);
        }
        square
    });
    let (xy, yz, zx) = (g.mul(wx, wy), g.mul(wy, wz), g.mul(wz, wx));
    let mut minus_sum = |a, b| {
        let sum = g.add(a, b);
        g.neg(sum)
    };
    let (dx, dy, dz) = (minus_sum(yy, zz), minus_sum(xx, zz), minus_sum(xx, yy));
    Matrix3([
        Vector3([dx, g.add(xy, az), g.sub(zx, ay)]),
        Vector3([g.sub(xy, az), dy, g.add(yz, ax)]),
        Vector3([g.add(zx, ay), g.sub(yz, ax), dz]),
    ])
}

impl State for Kinematics {
    fn coordinate(&self, id: CoordinateId) -> ExprId {
        self.coordinates[id.index()].position
    }

    fn point(&self, id: PointId) -> Vector3 {
        self.points[id.index()].1
    }
}
