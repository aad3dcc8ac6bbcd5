//! From joints to a spanning forest; joints that close loops are cut.

use std::collections::VecDeque;

use super::{Branch, Topology, cut, hang, massless};
use crate::base::diagnostics::Diagnostics;
use crate::base::ids::{BodyId, CoordinateId, JointId};
use crate::model::mechanism::{Frame, Joint, Mechanism, Motion};

/// Finds how every body is connected to the ground.
pub fn build(mechanism: &Mechanism) -> Result<Topology, Diagnostics> {
    let mut diagnostics = Diagnostics::new();
    let (graph, cut) = Graph::new(mechanism, &mut diagnostics);
    let branches = graph.branches_from(0);
    report_unreached(mechanism, &graph, &branches, &mut diagnostics);
    let of_tree = |id: &CoordinateId| {
        let joint = mechanism.coordinates[id.index()].joint;
        !cut.contains(&joint)
    };
    let with = |is: fn(&Motion) -> bool| {
        (0..mechanism.coordinates.len())
            .map(CoordinateId::new)
            .filter(of_tree)
            .filter(|id| is(&mechanism.coordinates[id.index()].motion))
            .collect()
    };
    let topology = Topology {
        branches,
        free: with(|motion| *motion == Motion::Free),
        coasting: with(|motion| *motion == Motion::Coasting),
        driven: with(|motion| matches!(motion, Motion::Driven(_))),
        cut,
    };
    for branch in &topology.branches {
        let joint = &mechanism.joints[branch.joint.index()];
        if joint.flexure.is_some() && branch.reversed {
            let beam = &mechanism.bodies[branch.body.index()].name;
            diagnostics.error_with_help(
                beam,
                format!("nothing holds `{beam}` at its root"),
                "a beam is carried by its root; what holds its tip or a place along it closes a loop: turn the beam around",
            );
        }
        if mechanism.glides(joint) && (branch.parent != Frame::Ground || branch.reversed) {
            diagnostics.error_with_help(
                &joint.name,
                "a planar joint can coast on the ground only",
                format!(
                    "declare it `from ground to {}`",
                    mechanism.bodies[branch.body.index()].name
                ),
            );
        }
    }
    // If loops close, a massless link may carry masses through the constraint.
    let open = topology.cut.is_empty() && mechanism.constraints.is_empty();
    if diagnostics.is_empty() && open && !mechanism.kernels_only {
        massless::check(mechanism, &topology, &mut diagnostics);
    }
    diagnostics.into_result(topology)
}

/// A graph of frames and joints, kept a forest. The ground is node 0, body `i` is node `i + 1`.
pub(super) struct Graph {
    /// Joints at each node in order of declaration: the joint, the other node, and whether it is declared from the
    /// other node.
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
    /// Adds joints in order of declaration and cuts one in every loop; returns the forest and the cut joints.
    fn new(mechanism: &Mechanism, diagnostics: &mut Diagnostics) -> (Self, Vec<JointId>) {
        let mut graph = Self {
            joints: vec![Vec::new(); mechanism.bodies.len() + 1],
        };
        let mut cut = Vec::new();
        let needed = cut::needed(mechanism);
        for (index, joint) in mechanism.joints.iter().enumerate() {
            let (from, to) = (node(joint.from), node(joint.to));
            let id = JointId::new(index);
            if joint.cut {
                cut.push(id);
                continue;
            }
            if let Some(path) = graph.path(from, to) {
                let mut closing = path;
                match joint.flexure {
                    None => closing.push(id),
                    // A beam hangs on its root: what may be cut lies between the ground and its station.
                    Some(_) => {
                        let inwards = graph.path(from, 0).unwrap_or_default();
                        let pairs = closing.iter().zip(&inwards);
                        let shared = pairs.take_while(|(x, other)| x == other).count();
                        closing.drain(..shared);
                    }
                }
                match cut::choose(mechanism, &closing, &needed, diagnostics) {
                    None => continue,
                    Some(chosen) => {
                        cut.push(chosen);
                        if chosen == id {
                            continue;
                        }
                        graph.remove(chosen);
                    }
                }
            }
            graph.add(joint, id);
        }
        hang::by_roots(mechanism, &mut graph, &mut cut, &needed);
        (graph, cut)
    }

    fn add(&mut self, joint: &Joint, id: JointId) {
        let (from, to) = (node(joint.from), node(joint.to));
        self.joints[from].push((id, to, false));
        self.joints[to].push((id, from, true));
    }

    /// Cuts one joint and restores another.
    pub(super) fn exchange(&mut self, mechanism: &Mechanism, cut: JointId, restored: JointId) {
        self.remove(cut);
        self.add(&mechanism.joints[restored.index()], restored);
        let in_order = |list: &mut Vec<(JointId, usize, bool)>| list.sort();
        self.joints.iter_mut().for_each(in_order);
    }

    /// The joints on the way between the ends of a joint.
    pub(super) fn between(&self, joint: &Joint) -> Vec<JointId> {
        self.path(node(joint.from), node(joint.to))
            .unwrap_or_default()
    }

    /// Number of beams that are carried by their tips.
    pub(super) fn turned(&self, mechanism: &Mechanism) -> usize {
        let branches = self.branches_from(0).into_iter();
        let turned = |branch: &Branch| {
            branch.reversed && mechanism.joints[branch.joint.index()].flexure.is_some()
        };
        branches.filter(turned).count()
    }

    fn remove(&mut self, joint: JointId) {
        for list in &mut self.joints {
            list.retain(|&(id, ..)| id != joint);
        }
    }

    /// The joints between two nodes, if these are connected.
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

    /// The bodies connected to a node, parents before children, nearest first.
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

/// Reports bodies that nothing holds to the ground: they have no equilibrium. Bodies joined to each other count as one
/// mistake.
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
        if let Some(joint) = mechanism
            .joints
            .iter()
            .filter(|joint| joint.cut)
            .find(|joint| [joint.from, joint.to].contains(&Frame::Body(BodyId::new(index))))
        {
            diagnostics.error_with_help(
                name,
                format!(
                    "only the cut joint `{}` leads from body `{name}` to the ground",
                    joint.name
                ),
                "a cut joint closes a loop and carries nothing: remove `cut`",
            );
            continue;
        }
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
