//! Joints to spanning forest: cuts nothing yet, so a closed loop is an error.

use std::collections::VecDeque;

use super::{Branch, Topology, massless};
use crate::base::diagnostics::Diagnostics;
use crate::base::ids::{BodyId, CoordinateId, JointId};
use crate::model::mechanism::{Frame, Mechanism, Motion};

/// Finds how every body hangs on the ground.
pub fn build(mechanism: &Mechanism) -> Result<Topology, Diagnostics> {
    let mut diagnostics = Diagnostics::new();
    let graph = Graph::new(mechanism, &mut diagnostics);
    let branches = graph.branches_from(0);
    report_unreached(mechanism, &graph, &branches, &mut diagnostics);
    let (free, driven) = coordinates(mechanism);
    let topology = Topology {
        branches,
        free,
        driven,
    };
    if diagnostics.is_empty() {
        massless::check(mechanism, &topology, &mut diagnostics);
    }
    diagnostics.into_result(topology)
}

fn coordinates(mechanism: &Mechanism) -> (Vec<CoordinateId>, Vec<CoordinateId>) {
    let is_free = |id: &CoordinateId| mechanism.coordinates[id.index()].motion == Motion::Free;
    (0..mechanism.coordinates.len())
        .map(CoordinateId::new)
        .partition(is_free)
}

/// Frames and the joints that keep them a forest. The ground is node 0, body `i` node `i + 1`.
struct Graph {
    /// Joints at each node in order of declaration: joint, other node, declared from the other node.
    joints: Vec<Vec<(JointId, usize, bool)>>,
}

fn node(frame: Frame) -> usize {
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
    /// Takes joints in order of declaration; one that closes a loop is reported and left out.
    fn new(mechanism: &Mechanism, diagnostics: &mut Diagnostics) -> Self {
        let mut graph = Self {
            joints: vec![Vec::new(); mechanism.bodies.len() + 1],
        };
        for (index, joint) in mechanism.joints.iter().enumerate() {
            let (from, to) = (node(joint.from), node(joint.to));
            if let Some(path) = graph.path(from, to) {
                let mut closing = path;
                closing.push(JointId::new(index));
                closing.sort();
                let names: Vec<String> = closing
                    .into_iter()
                    .map(|id| format!("`{}`", mechanism.joints[id.index()].name))
                    .collect();
                diagnostics.error_with_help(
                    &joint.name,
                    format!("the joints {} close a loop", names.join(", ")),
                    "closed loops are not supported yet: remove one of these joints",
                );
                continue;
            }
            let id = JointId::new(index);
            graph.joints[from].push((id, to, false));
            graph.joints[to].push((id, from, true));
        }
        graph
    }

    /// The joints between two nodes, when they are connected.
    fn path(&self, from: usize, to: usize) -> Option<Vec<JointId>> {
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

    /// The bodies that hang on a node, parents before children, nearest first.
    fn branches_from(&self, root: usize) -> Vec<Branch> {
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
                    branches.push(Branch {
                        body,
                        parent: frame(current),
                        joint,
                        reversed,
                    });
                }
            }
        }
        branches
    }
}

/// A body that nothing holds to the ground has no equilibrium. Bodies joined to each other are one mistake.
fn report_unreached(
    mechanism: &Mechanism,
    graph: &Graph,
    branches: &[Branch],
    diagnostics: &mut Diagnostics,
) {
    let mut seen = vec![false; mechanism.bodies.len()];
    for branch in branches {
        seen[branch.body.index()] = true;
    }
    for index in 0..mechanism.bodies.len() {
        if seen[index] {
            continue;
        }
        seen[index] = true;
        let name = &mechanism.bodies[index].name;
        let mut others = Vec::new();
        for branch in graph.branches_from(index + 1) {
            seen[branch.body.index()] = true;
            others.push(format!("`{}`", mechanism.bodies[branch.body.index()].name));
        }
        let message = if others.is_empty() {
            format!("body `{name}` has no path to the ground")
        } else {
            format!(
                "body `{name}`, joined to {}, has no path to the ground",
                others.join(", ")
            )
        };
        diagnostics.error_with_help(
            name,
            message,
            format!(
                "connect it by a joint, for example `joint j: revolute(z) from ground to {name};`"
            ),
        );
    }
}
