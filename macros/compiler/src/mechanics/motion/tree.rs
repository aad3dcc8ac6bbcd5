//! The path from a frame to the ground: common ancestors, and velocities relative to them.

use crate::algebra::{Graph, Vector3};
use crate::base::ids::BodyId;
use crate::model::mechanism::{Frame, Mechanism};
use crate::topology::{Branch, Topology};

use super::kinematics::Kinematics;

/// The branches by body, for walking towards the ground.
pub(crate) struct Tree {
    branch: Vec<Option<Branch>>,
}

impl Tree {
    pub(crate) fn new(mechanism: &Mechanism, topology: &Topology) -> Self {
        let mut branch = vec![None; mechanism.bodies.len()];
        for b in &topology.branches {
            branch[b.body.index()] = Some(*b);
        }
        Self { branch }
    }

    /// The branch that connects a body to its parent.
    pub(crate) fn branch(&self, body: BodyId) -> Option<Branch> {
        self.branch[body.index()]
    }

    fn parent(&self, frame: Frame) -> Option<Branch> {
        match frame {
            Frame::Ground => None,
            Frame::Body(body) => self.branch(body),
        }
    }

    /// The frame and all its ancestors, up to the ground.
    pub(crate) fn path(&self, frame: Frame) -> Vec<Frame> {
        let mut path = vec![frame];
        let mut at = frame;
        while let Some(branch) = self.parent(at) {
            at = branch.parent;
            path.push(at);
        }
        path
    }

    /// The last common ancestor of two frames.
    pub(crate) fn common_ancestor(&self, a: Frame, b: Frame) -> Frame {
        let path = self.path(a);
        self.path(b).into_iter().find(|frame| path.contains(frame)).unwrap_or(Frame::Ground)
    }

    /// Velocity of a point of `frame`, given by its position, and angular velocity of `frame`, relative to an ancestor
    /// frame: the sum over the joints between them.
    pub(crate) fn relative_velocity(
        &self,
        g: &mut Graph,
        kinematics: &Kinematics,
        (frame, position): (Frame, Vector3),
        relative_to: Frame,
    ) -> (Vector3, Vector3) {
        let (mut velocity, mut angular) = (Vector3::zero(g), Vector3::zero(g));
        let mut at = frame;
        while at != relative_to {
            let Some(branch) = self.parent(at) else { break };
            let motion = kinematics.of(branch.body);
            let arm = position.sub(g, motion.frame.position);
            if let Some((beam, station)) = motion.flexure {
                let station = &kinematics.beams[beam.index()].stations[station];
                let turning = station.section.relative.cross(g, arm);
                velocity = velocity.add(g, station.velocity).add(g, turning);
                angular = angular.add(g, station.section.relative);
            }
            for step in &motion.steps {
                let rate = kinematics.coordinates[step.coordinate.index()].velocity;
                let share = step.velocity(g, arm).scale(g, rate);
                velocity = velocity.add(g, share);
                if let Some(axis) = step.turn {
                    let share = axis.scale(g, rate);
                    angular = angular.add(g, share);
                }
            }
            at = branch.parent;
        }
        (velocity, angular)
    }
}
