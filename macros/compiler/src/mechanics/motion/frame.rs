//! Motion of one frame, and how it follows from the motion of the previous frame.

use crate::algebra::{Graph, Matrix3, Vector3};
use crate::census::taken;
use crate::mechanics::setup::CoordinateMotion;

use super::orientation::Orientation;

/// Motion of a frame. All vectors are written in the same axes: those of the common frame or those of the layout.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FrameMotion {
    pub(crate) orientation: Orientation,
    /// Position of the origin from the ground's origin.
    pub(crate) position: Vector3,
    /// Position of the origin from the origin of the previous body.
    pub(crate) offset: Vector3,
    pub(crate) velocity: Vector3,
    pub(crate) acceleration: Vector3,
    pub(crate) angular_velocity: Vector3,
    pub(crate) angular_acceleration: Vector3,
    /// Angular velocity and acceleration before the last turn, or before all turns of a run.
    pub(super) before_turn: (Vector3, Vector3),
    /// `W = [alpha]x + [omega]x [omega]x`: takes a body-fixed vector to its second time derivative.
    pub(super) second_rate: Matrix3,
    /// Second time derivatives of the axes: `W` applied to each.
    pub(super) axes_second_rate: Matrix3,
}

impl FrameMotion {
    /// The inertial frame, or one accelerated against gravity.
    pub(crate) fn ground(g: &mut Graph, acceleration: Vector3) -> Self {
        let zero = Vector3::zero(g);
        let still = Matrix3([zero; 3]);
        Self {
            orientation: Orientation::aligned(g),
            position: zero,
            offset: zero,
            velocity: zero,
            acceleration,
            angular_velocity: zero,
            angular_acceleration: zero,
            before_turn: (zero, zero),
            second_rate: still,
            axes_second_rate: still,
        }
    }

    /// A frame with its motion written in its own axes.
    pub(crate) fn moving(g: &mut Graph, [angular_velocity, angular_acceleration, acceleration]: [Vector3; 3]) -> Self {
        let second_rate = second_rate(g, angular_velocity, angular_acceleration);
        Self {
            angular_velocity,
            angular_acceleration,
            before_turn: (angular_velocity, angular_acceleration),
            second_rate,
            axes_second_rate: second_rate,
            ..Self::ground(g, acceleration)
        }
    }

    /// A body-fixed vector in the axes of the motion, and its second time derivative. A vector along a body axis shares
    /// the work with every other vector along that axis.
    pub(crate) fn carry(&self, g: &mut Graph, vector: Vector3) -> (Vector3, Vector3) {
        let nonzero: Vec<usize> = (0..3).filter(|&k| !g.is(vector.0[k], 0.0)).collect();
        taken(|| format!("frame: arm with {} components", nonzero.len()));
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

    /// The body axes and their second time derivatives.
    pub(crate) fn axes(&self) -> [(Vector3, Vector3); 3] {
        std::array::from_fn(|k| (self.orientation.axes.0[k], self.axes_second_rate.0[k]))
    }

    /// The same frame with zero offset, as the start for the next body.
    pub(crate) fn departing(self, g: &mut Graph) -> Self {
        Self { offset: Vector3::zero(g), ..self }
    }

    /// The frame with its origin moved by a body-fixed vector.
    pub(crate) fn displaced(self, g: &mut Graph, vector: Vector3) -> Self {
        let (arm, second_rate) = self.carry(g, vector);
        let rate = self.angular_velocity.cross(g, arm);
        Self {
            offset: self.offset.add(g, arm),
            velocity: self.velocity.add(g, rate),
            acceleration: self.acceleration.add(g, second_rate),
            ..self
        }
    }

    /// The frame turned by a constant rotation.
    pub(crate) fn rotated(self, g: &mut Graph, rotation: Option<Matrix3>) -> Self {
        let orientation = self.orientation.then_fixed(g, rotation);
        Self { orientation, axes_second_rate: self.second_rate.multiply(g, orientation.axes), ..self }
    }

    /// The frame after a translation by `direction` (in the axes of the motion) per unit of the coordinate:
    /// `a += W d q + 2 omega x d qdot + d qddot`.
    pub(crate) fn slid(self, g: &mut Graph, direction: Vector3, motion: CoordinateMotion) -> Self {
        let CoordinateMotion { position, velocity, acceleration } = motion;
        let travel = direction.scale(g, position);
        let turning = self.angular_velocity.cross(g, direction);
        let carried = turning.scale(g, position);
        let speed = direction.scale(g, velocity);
        let rate = carried.add(g, speed);
        let centripetal = self.second_rate.apply(g, direction).scale(g, position);
        let double_speed = g.scale(2.0, velocity);
        let coriolis = turning.scale(g, double_speed);
        let growth = direction.scale(g, acceleration);
        let mut second_rate = centripetal;
        for term in [coriolis, growth] {
            second_rate = second_rate.add(g, term);
        }
        Self {
            offset: self.offset.add(g, travel),
            velocity: self.velocity.add(g, rate),
            acceleration: self.acceleration.add(g, second_rate),
            ..self
        }
    }

    /// The frame after a translation along `direction`, which turns with the frame, at the coordinate's rate:
    /// `v += d qdot`, `a += d qddot + omega x d qdot`.
    pub(crate) fn glided(self, g: &mut Graph, direction: Vector3, motion: CoordinateMotion) -> Self {
        let travel = direction.scale(g, motion.position);
        let speed = direction.scale(g, motion.velocity);
        let growth = direction.scale(g, motion.acceleration);
        let turning = self.angular_velocity.cross(g, speed);
        let second_rate = growth.add(g, turning);
        Self {
            offset: self.offset.add(g, travel),
            velocity: self.velocity.add(g, speed),
            acceleration: self.acceleration.add(g, second_rate),
            ..self
        }
    }

    /// The frame after a rotation about its own unit vector `axis`, which is `direction` in the axes of the motion:
    /// `omega += d qdot`, `alpha += d qddot + omega x d qdot`.
    pub(crate) fn turned(
        self,
        g: &mut Graph,
        (axis, direction): (Vector3, Vector3),
        motion: CoordinateMotion,
        name: &str,
    ) -> Self {
        let before = (self.angular_velocity, self.angular_acceleration);
        let orientation = self.orientation.then_turned(g, axis, motion.position, name);
        self.spun(g, before, direction, motion, orientation, name)
    }

    /// The frame turned by a rotation that changes: `omega += relative`, `alpha += growth + omega x relative`.
    pub(crate) fn bent(
        self,
        g: &mut Graph,
        (rotation, relative, growth): (Matrix3, Vector3, Vector3),
        name: &str,
    ) -> Self {
        let before = (self.angular_velocity, self.angular_acceleration);
        let gyroscopic = before.0.cross(g, relative);
        let omega = before.0.add(g, relative);
        let alpha = before.1.add(g, growth).add(g, gyroscopic);
        let angular_velocity = omega.set_name(g, &format!("{name}_angular_velocity"));
        let angular_acceleration = alpha.set_name(g, &format!("{name}_angular_acceleration"));
        let orientation = self.orientation.then_fixed(g, Some(rotation));
        let second_rate = second_rate(g, angular_velocity, angular_acceleration);
        Self {
            orientation,
            angular_velocity,
            angular_acceleration,
            before_turn: (angular_velocity, angular_acceleration),
            second_rate,
            axes_second_rate: second_rate.multiply(g, orientation.axes),
            ..self
        }
    }

    /// The frame after one more turn of a run about the same axis; `motion` is the sum over the run.
    pub(crate) fn turned_on(
        self,
        g: &mut Graph,
        (axis, direction): (Vector3, Vector3),
        motion: CoordinateMotion,
        name: &str,
    ) -> Self {
        let orientation = self.orientation.turned_on(g, axis, motion.position, name);
        self.spun(g, self.before_turn, direction, motion, orientation, name)
    }

    /// `omega = omega_before + d qdot`, `alpha = alpha_before + d qddot + omega_before x d qdot`.
    fn spun(
        self,
        g: &mut Graph,
        before: (Vector3, Vector3),
        direction: Vector3,
        motion: CoordinateMotion,
        orientation: Orientation,
        name: &str,
    ) -> Self {
        let spin = direction.scale(g, motion.velocity);
        let growth = direction.scale(g, motion.acceleration);
        let gyroscopic = before.0.cross(g, spin);
        let relative = growth.add(g, gyroscopic);
        let omega = before.0.add(g, spin);
        let alpha = before.1.add(g, relative);
        let angular_velocity = omega.set_name(g, &format!("{name}_angular_velocity"));
        let angular_acceleration = alpha.set_name(g, &format!("{name}_angular_acceleration"));
        let second_rate = second_rate(g, angular_velocity, angular_acceleration);
        Self {
            orientation,
            angular_velocity,
            angular_acceleration,
            before_turn: before,
            second_rate,
            axes_second_rate: second_rate.multiply(g, orientation.axes),
            ..self
        }
    }

    /// The frame with its motion written in its own axes; the offset stays in the old axes.
    pub(crate) fn along_own_axes(self, g: &mut Graph) -> Self {
        let to_own = self.orientation.axes.transpose();
        let mut turn = |vector: Vector3| to_own.apply(g, vector);
        let [velocity, acceleration, angular_velocity, angular_acceleration] =
            [self.velocity, self.acceleration, self.angular_velocity, self.angular_acceleration].map(&mut turn);
        Self {
            position: self.position,
            offset: self.offset,
            velocity,
            ..Self::moving(g, [angular_velocity, angular_acceleration, acceleration])
        }
    }

    /// Names the frame's vectors, for readable code.
    pub(crate) fn set_names(&self, g: &mut Graph, name: &str) {
        self.position.set_name(g, &format!("{name}_position"));
        self.velocity.set_name(g, &format!("{name}_velocity"));
        self.acceleration.set_name(g, &format!("{name}_acceleration"));
        for (column, axis) in ["x", "y", "z"].into_iter().enumerate() {
            self.orientation.axes.0[column].set_name(g, &format!("{name}_axis_{axis}"));
            self.axes_second_rate.0[column].set_name(g, &format!("{name}_axis_{axis}_second_rate"));
        }
    }
}

/// `[alpha]x + omega omega^T - |omega|^2 1`.
pub(crate) fn second_rate(g: &mut Graph, omega: Vector3, alpha: Vector3) -> Matrix3 {
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
