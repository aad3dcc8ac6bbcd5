//! Frames and the joints between them.

use std::collections::VecDeque;

use super::Branch;
use crate::base::ids::{BodyId, JointId};
use crate::model::mechanism::{Frame, Joint, Mechanism};

/// A graph of frames and joints, kept a forest. The ground is node 0, body `i` is node `i + 1`.
pub(super) struct Graph {
    /// Joints at each node in order of declaration: the joint, the other node, and whether it is declared from the
    /// other node.
    joints: Vec<Vec<(JointId, usize, bool)>>,
}

pub(super) fn node(frame: Frame) -> usize {
    match frame {
        Frame::Ground => 0,
        Frame::Body(id) => id.index() + 1,
    }
}

fn frame(node: usize) -> Frame {
    match node {
        0 => Frame::Ground,
        body => Frame::Body(BodyId::new(body - 1)),
    }
}

impl Graph {
    /// Frames without joints, with the ground and this number of bodies.
    pub(super) fn new(bodies: usize) -> Self {
        Self { joints: vec![Vec::new(); bodies + 1] }
    }

    pub(super) fn add(&mut self, joint: &Joint, id: JointId) {
        let (from, to) = (node(joint.from), node(joint.to));
        self.joints[from].push((id, to, false));
        self.joints[to].push((id, from, true));
    }

    /// Cuts one joint and restores another.
    pub(super) fn exchange(&mut self, mechanism: &Mechanism, cut: JointId, restored: JointId) {
        self.remove(cut);
        self.add(&mechanism.joints[restored.index()], restored);
        self.joints.iter_mut().for_each(|list: &mut Vec<(JointId, usize, bool)>| list.sort());
    }

    /// The joints on the way between the ends of a joint.
    pub(super) fn between(&self, joint: &Joint) -> Vec<JointId> {
        self.path(node(joint.from), node(joint.to)).unwrap_or_default()
    }

    /// Number of beams that are carried by their tips.
    pub(super) fn turned(&self, mechanism: &Mechanism) -> usize {
        let branches = self.branches_from(0).into_iter();
        let turned = |branch: &Branch| branch.reversed && mechanism.joints[branch.joint.index()].flexure.is_some();
        branches.filter(turned).count()
    }

    pub(super) fn remove(&mut self, joint: JointId) {
        for list in &mut self.joints {
            list.retain(|&(id, ..)| id != joint);
        }
    }

    /// The joints between two nodes, if these are connected.
    pub(super) fn path(&self, from: usize, to: usize) -> Option<Vec<JointId>> {
        let mut reached: Vec<Option<(JointId, usize)>> = vec![None; self.joints.len()];
        let mut waiting = VecDeque::from([from]);
        while let Some(current) = waiting.pop_front() {
            if current == to {
                let mut path = Vec::new();
                let mut at = to;
                while let Some((joint, before)) = reached[at].filter(|_| at != from) {
                    path.push(joint);
                    at = before;
                }
                path.reverse();
                return Some(path);
            }
            for &(joint, other, _) in &self.joints[current] {
                if other != from && reached[other].is_none() {
                    reached[other] = Some((joint, current));
                    waiting.push_back(other);
                }
            }
        }
        None
    }

    /// The bodies connected to a node, parents before children, nearest first.
    pub(super) fn branches_from(&self, root: usize) -> Vec<Branch> {
        let mut branches = Vec::new();
        let mut seen = vec![false; self.joints.len()];
        seen[root] = true;
        let mut waiting = VecDeque::from([root]);
        while let Some(current) = waiting.pop_front() {
            for &(joint, other, reversed) in &self.joints[current] {
                if seen[other] {
                    continue;
                }
                seen[other] = true;
                waiting.push_back(other);
                if let Frame::Body(body) = frame(other) {
                    branches.push(Branch { body, parent: frame(current), joint, reversed });
                }
            }
        }
        branches
    }
}
