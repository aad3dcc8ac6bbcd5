//! What force laws and constraints read: the motion, and the places of points in it.

use crate::algebra::{Graph, Vector3};
use crate::base::ids::PointId;
use crate::model::mechanism::{Frame, Placement};

use super::closure::Side;
use super::kinematics::{Kinematics, PointMotion};
use super::path::Tree;
use super::problem::Problem;

/// What every force law and constraint reads.
pub(super) struct Setting<'a> {
    pub(super) problem: &'a Problem<'a>,
    pub(super) kinematics: &'a Kinematics,
    pub(super) tree: Tree,
}

impl<'a> Setting<'a> {
    pub(super) fn new(problem: &'a Problem<'a>, kinematics: &'a Kinematics) -> Self {
        Self {
            problem,
            kinematics,
            tree: Tree::new(problem.mechanism, problem.topology),
        }
    }

    /// A named point as one side of a constraint.
    pub(super) fn side(&self, point: PointId) -> Side {
        Side {
            frame: self.frame(point),
            at: self.point(point),
        }
    }

    /// A place in a frame as one side of a constraint.
    pub(super) fn placed(&self, g: &mut Graph, frame: Frame, placement: &Placement) -> Side {
        let at = self
            .kinematics
            .place(g, self.problem.values, frame, placement);
        Side { frame, at }
    }

    /// Velocity of the second of two frames relative to the first, at a position.
    pub(super) fn relative_velocity(
        &self,
        g: &mut Graph,
        (from, to): (Frame, Frame),
        position: Vector3,
    ) -> Vector3 {
        let closing = self.tree.common_ancestor(from, to);
        let [from, to] = [from, to].map(|frame| self.velocity(g, frame, position, closing).0);
        to.sub(g, from)
    }

    pub(super) fn frame(&self, point: PointId) -> Frame {
        self.problem.mechanism.points[point.index()].frame
    }

    pub(super) fn point(&self, point: PointId) -> PointMotion {
        self.kinematics.points[point.index()]
    }

    /// Velocity and angular velocity, relative to `closing`, of the point of `frame` that is at `position`.
    pub(super) fn velocity(
        &self,
        g: &mut Graph,
        frame: Frame,
        position: Vector3,
        closing: Frame,
    ) -> (Vector3, Vector3) {
        self.tree
            .relative_velocity(g, self.kinematics, (frame, position), closing)
    }
}
