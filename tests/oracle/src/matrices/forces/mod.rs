//! Applied forces `Q` on the bodies: for each body a force and a moment about its centre of mass, in the ground frame;
//! and forces along coordinates, which by definition do work on their own coordinate only.
//!
//! Velocities are time derivatives of positions: the whole mechanism is placed a second time, in dual numbers along the
//! motion.

mod at_points;
mod between_points;
mod expressions;

use num_dual::Dual;

use super::bodies::{placement, value, vector};
use super::kinematics::Configuration;
use super::scalar::still;
use super::space::{Matrix, Pose, Vector};
use super::{Oracle, Scalar, State};
use crate::model::{Coordinate, Force, ForceLaw, Frame, Value, Values};

/// Positions and velocities of the bodies.
pub(crate) struct Moving<'a, D> {
    pub(crate) at: &'a Configuration<D>,
    /// The same configuration with its time rate.
    pub(crate) moving: &'a Configuration<Dual<D>>,
    /// Driven coordinates and their speeds.
    pub(crate) driven: (&'a [D], &'a [D]),
    pub(crate) state: &'a State<D>,
}

/// A sum of forces.
struct Efforts<'a, D> {
    at: &'a Configuration<D>,
    /// `Q`, ordered as the rows of `B`.
    bodies: Vec<D>,
    /// Forces along the free coordinates.
    free: Vec<D>,
}

impl<D: Scalar> Efforts<'_, D> {
    /// Adds a force that acts at a point; no effect on the ground.
    fn push(&mut self, frame: Frame, force: Vector<D>, point: Vector<D>) {
        if let Frame::Body(body) = frame {
            let rows = &mut self.bodies[6 * body..6 * body + 3];
            for (sum, component) in rows.iter_mut().zip(force.0) {
                *sum += component;
            }
            self.turn(frame, (point - self.at.centers[body]).cross(force));
        }
    }

    /// Adds a moment; no effect on the ground.
    fn turn(&mut self, frame: Frame, moment: Vector<D>) {
        if let Frame::Body(body) = frame {
            let rows = &mut self.bodies[6 * body + 3..6 * body + 6];
            for (sum, component) in rows.iter_mut().zip(moment.0) {
                *sum += component;
            }
        }
    }
}

impl Oracle<'_> {
    /// `Q`, ordered as the rows of `B`, and the forces along the free coordinates.
    pub(crate) fn applied_forces<D: Scalar>(&self, moving: &Moving<D>, mass: &[D]) -> (Vec<D>, Vec<D>) {
        let mut efforts =
            Efforts { at: moving.at, bodies: vec![D::zero(); 6 * mass.len()], free: vec![D::zero(); self.free.len()] };
        let gravity = self.in_ground(vector(&self.model.gravity, &moving.state.design));
        for (body, &mass) in mass.iter().enumerate() {
            let (weight, center) = (gravity.scaled(mass), moving.at.centers[body]);
            efforts.push(Frame::Body(body), weight, center);
        }
        for force in &self.model.forces {
            self.element(&mut efforts, moving, force);
        }
        for beam in &self.model.beams {
            for (coordinate, effort) in self.elastic(beam, moving) {
                self.act(&mut efforts, coordinate, effort);
            }
        }
        (efforts.bodies, efforts.free)
    }

    fn element<D: Scalar>(&self, efforts: &mut Efforts<D>, moving: &Moving<D>, force: &Force) {
        let get = |v: Value| value(v, &moving.state.design);
        let all = |v: &Values| vector(v, &moving.state.design);
        let rows = |m: &[Values; 3]| Matrix(m.each_ref().map(|row| all(row).0));
        match &force.law {
            // Q = -k (q - q0)
            &ForceLaw::Spring { coordinate, stiffness, rest } => {
                let position = self.position(moving, coordinate);
                let effort = get(stiffness) * (get(rest) - position);
                self.act(efforts, coordinate, effort);
            }
            // Q = -c qdot
            &ForceLaw::Damper { coordinate, damping } => {
                let speed = self.speed(moving, coordinate);
                self.act(efforts, coordinate, -get(damping) * speed);
            }
            // With the mass matrix.
            ForceLaw::Inerter { .. } => {}
            ForceLaw::Generalized { coordinate, value } => {
                let effort = self.of_motion(moving, value);
                self.act(efforts, *coordinate, effort);
            }
            ForceLaw::Potential { energy } => self.potential(efforts, moving, energy),
            // tension = k (d - L) + c ddot
            &ForceLaw::SpringDamper { from, to, stiffness, damping, length } => {
                self.tension(efforts, moving, [from, to], |distance, rate| {
                    get(stiffness) * (distance - get(length)) + get(damping) * rate
                })
            }
            ForceLaw::Tension { from, to, tension } => {
                self.tension(efforts, moving, [*from, *to], |distance, rate| {
                    self.of_length(moving, tension, distance, rate)
                });
            }
            ForceLaw::Bushing { from, to, stiffness, damping, turning_stiffness, turning_damping } => {
                let linear = [rows(stiffness), rows(damping)];
                let turning = [rows(turning_stiffness), rows(turning_damping)];
                self.bushing(efforts, moving, [*from, *to], linear, turning);
            }
            ForceLaw::Load { point, force, moment, following } => {
                self.load(efforts, moving, *point, [all(force), all(moment)], *following)
            }
            &ForceLaw::Drag { point, damping, turning_damping } => {
                self.drag(efforts, moving, point, [get(damping), get(turning_damping)])
            }
        }
    }

    /// A force along a coordinate. A driven coordinate follows its drive regardless of force.
    fn act<D: Scalar>(&self, efforts: &mut Efforts<D>, coordinate: Coordinate, effort: D) {
        if let Some(index) = self.free.iter().position(|&other| other == coordinate) {
            efforts.free[index] += effort;
        }
    }

    fn position<D: Scalar>(&self, moving: &Moving<D>, coordinate: Coordinate) -> D {
        self.coordinate(coordinate, &moving.state.position, moving.driven.0)
    }

    fn speed<D: Scalar>(&self, moving: &Moving<D>, coordinate: Coordinate) -> D {
        self.coordinate(coordinate, &moving.state.velocity, moving.driven.1)
    }

    /// Converts components along the axes of the declared ground to the frame of computation.
    pub(super) fn in_ground<D: Scalar>(&self, components: Vector<D>) -> Vector<D> {
        Matrix::constant(self.ground) * components
    }

    /// The frame of a point with its time rate.
    fn point<D: Scalar>(&self, moving: &Moving<D>, point: usize) -> Pose<Dual<D>> {
        let point = &self.model.points[point];
        let design = still(&moving.state.design);
        moving.moving.pose(point.frame) * placement(&point.placement, &design)
    }

    fn frame_of(&self, point: usize) -> Frame {
        self.model.points[point].frame
    }
}
