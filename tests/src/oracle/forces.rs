//! Applied forces `Q` on the bodies: for each a force and a moment about its centre of mass, in the ground frame.
//!
//! A spring or damper on a coordinate acts as a pair of opposite moments (or forces) on the two bodies of its joint, so
//! that the transformation `B_R^T Q` itself has to find that only one coordinate feels it.

use super::bodies::{value, vector};
use super::kinematics::Configuration;
use super::space::{Matrix, Vector};
use super::{Oracle, Scalar};
use crate::model::{Force, ForceLaw, Frame, JointKind};

/// Where the bodies are and how fast they go.
pub(crate) struct Moving<'a, D> {
    pub(crate) at: &'a Configuration<D>,
    /// `xdot`, arranged as the rows of `B`.
    pub(crate) velocities: &'a [D],
    /// Coordinate and speed of every joint.
    pub(crate) joints: &'a [(D, D)],
    pub(crate) design: &'a [D],
}

/// The components of one body: of its centre of mass, then of its rotation.
pub(crate) fn of_body<D: Scalar>(rows: &[D], body: usize) -> (Vector<D>, Vector<D>) {
    let three = |start: usize| Vector([rows[start], rows[start + 1], rows[start + 2]]);
    (three(6 * body), three(6 * body + 3))
}

impl Oracle<'_> {
    /// `Q`, arranged as the rows of `B`.
    pub(crate) fn applied_forces<D: Scalar>(&self, moving: &Moving<D>, mass: &[D]) -> Vec<D> {
        let mut forces = vec![D::zero(); moving.velocities.len()];
        let gravity = Matrix::constant(self.ground) * vector(&self.model.gravity, moving.design);
        for (body, &mass) in mass.iter().enumerate() {
            let weight = gravity.scaled(mass);
            push(
                &mut forces,
                moving.at,
                Frame::Body(body),
                weight,
                moving.at.centers[body],
            );
        }
        for force in &self.model.forces {
            self.element(&mut forces, moving, force);
        }
        forces
    }

    fn element<D: Scalar>(&self, forces: &mut [D], moving: &Moving<D>, force: &Force) {
        let get = |v| value(v, moving.design);
        match force.law {
            // Q = -k (q - q0)
            ForceLaw::Spring {
                joint,
                stiffness,
                rest,
            } => {
                let (position, _) = moving.joints[joint];
                let effort = get(stiffness) * (get(rest) - position);
                self.act_on_joint(forces, moving.at, joint, effort);
            }
            // Q = -c qdot
            ForceLaw::Damper { joint, damping } => {
                let (_, speed) = moving.joints[joint];
                self.act_on_joint(forces, moving.at, joint, -get(damping) * speed);
            }
            // tension = k (d - L) + c ddot, with d = |r|, ddot = r . rdot / d
            ForceLaw::SpringDamper {
                from,
                to,
                stiffness,
                damping,
                length,
            } => {
                let (start, start_velocity) = self.point(moving, from);
                let (end, end_velocity) = self.point(moving, to);
                let span = end - start;
                let distance = span.dot(span).sqrt();
                let direction = span.scaled(distance.recip());
                let rate = direction.dot(end_velocity - start_velocity);
                let tension = get(stiffness) * (distance - get(length)) + get(damping) * rate;
                let pull = direction.scaled(tension);
                let points = &self.model.points;
                push(forces, moving.at, points[from].frame, pull, start);
                push(
                    forces,
                    moving.at,
                    points[to].frame,
                    Vector::zero() - pull,
                    end,
                );
            }
        }
    }

    /// Opposite moments or forces along a joint's axis on the bodies it joins.
    fn act_on_joint<D: Scalar>(
        &self,
        forces: &mut [D],
        at: &Configuration<D>,
        joint: usize,
        effort: D,
    ) {
        let branch = self
            .tree
            .iter()
            .find(|branch| branch.joint == joint)
            .expect("a tree joint");
        let (axis, origin) = at.axes[joint];
        let (effort, back) = (axis.scaled(effort), axis.scaled(-effort));
        let outer = Frame::Body(branch.body);
        if matches!(self.model.joints[joint].kind, JointKind::Revolute(_)) {
            turn(forces, outer, effort);
            turn(forces, branch.parent, back);
        } else {
            push(forces, at, outer, effort, origin);
            push(forces, at, branch.parent, back, origin);
        }
    }

    /// Position and velocity of a point: `v = v_c + omega x (p - c)`.
    fn point<D: Scalar>(&self, moving: &Moving<D>, point: usize) -> (Vector<D>, Vector<D>) {
        let point = &self.model.points[point];
        let position = moving
            .at
            .pose(point.frame)
            .point(vector(&point.position, moving.design));
        let velocity = match point.frame {
            Frame::Ground => Vector::zero(),
            Frame::Body(body) => {
                let (velocity, spin) = of_body(moving.velocities, body);
                velocity + spin.cross(position - moving.at.centers[body])
            }
        };
        (position, velocity)
    }
}

/// Adds a force that acts at a point; on the ground it does nothing.
fn push<D: Scalar>(
    forces: &mut [D],
    at: &Configuration<D>,
    frame: Frame,
    force: Vector<D>,
    point: Vector<D>,
) {
    if let Frame::Body(body) = frame {
        for (sum, component) in forces[6 * body..6 * body + 3].iter_mut().zip(force.0) {
            *sum += component;
        }
        turn(forces, frame, (point - at.centers[body]).cross(force));
    }
}

/// Adds a moment; on the ground it does nothing.
fn turn<D: Scalar>(forces: &mut [D], frame: Frame, moment: Vector<D>) {
    if let Frame::Body(body) = frame {
        for (sum, component) in forces[6 * body + 3..6 * body + 6].iter_mut().zip(moment.0) {
            *sum += component;
        }
    }
}
