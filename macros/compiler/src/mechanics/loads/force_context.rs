//! The data that force laws and constraints read: the motion, and the position of points in it.

use crate::algebra::{Graph, Vector3};
use crate::base::ids::PointId;
use crate::mechanics::motion::{Kinematics, PointMotion, Tree};
use crate::mechanics::setup::Context;
use crate::model::mechanism::{Frame, Placement};

use super::pair::Side;

/// The data that every force law and constraint reads.
pub(crate) struct ForceContext<'a> {
    pub(crate) context: &'a Context<'a>,
    pub(crate) kinematics: &'a Kinematics,
    pub(crate) tree: Tree,
}

impl<'a> ForceContext<'a> {
    pub(crate) fn new(context: &'a Context<'a>, kinematics: &'a Kinematics) -> Self {
        Self { context, kinematics, tree: Tree::new(context.mechanism, context.topology) }
    }

    /// A named point as one side of a constraint.
    pub(crate) fn side(&self, point: PointId) -> Side {
        Side { frame: self.frame(point), at: self.point(point) }
    }

    /// A place in a frame as one side of a constraint.
    pub(crate) fn placed(&self, g: &mut Graph, frame: Frame, placement: &Placement) -> Side {
        let at = self.kinematics.place(g, self.context.values, frame, placement);
        Side { frame, at }
    }

    /// Velocity of the second of two frames relative to the first, at a position.
    pub(crate) fn relative_velocity(&self, g: &mut Graph, (from, to): (Frame, Frame), position: Vector3) -> Vector3 {
        let closing = self.tree.common_ancestor(from, to);
        let [from, to] = [from, to].map(|frame| self.velocity(g, frame, position, closing).0);
        to.sub(g, from)
    }

    pub(crate) fn frame(&self, point: PointId) -> Frame {
        self.context.mechanism.points[point.index()].frame
    }

    pub(crate) fn point(&self, point: PointId) -> PointMotion {
        self.kinematics.points[point.index()]
    }

    /// Velocity and angular velocity, relative to `closing`, of the point of `frame` that is at `position`.
    pub(crate) fn velocity(
        &self,
        g: &mut Graph,
        frame: Frame,
        position: Vector3,
        closing: Frame,
    ) -> (Vector3, Vector3) {
        self.tree.relative_velocity(g, self.kinematics, (frame, position), closing)
    }
}
