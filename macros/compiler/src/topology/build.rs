//! From joints to a spanning forest; joints that close loops are cut.

use super::graph::{Graph, node};
use super::{Branch, Topology, cut, hang, massless};
use crate::base::diagnostics::Diagnostics;
use crate::base::ids::{BodyId, CoordinateId, JointId};
use crate::model::mechanism::{Frame, Mechanism, Motion};

/// Finds how every body is connected to the ground.
pub fn build(mechanism: &Mechanism) -> Result<Topology, Diagnostics> {
    let mut diagnostics = Diagnostics::new();
    let (graph, cut) = forest(mechanism, &mut diagnostics);
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
                format!("declare it `from ground to {}`", mechanism.bodies[branch.body.index()].name),
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

/// Adds joints in order of declaration and cuts one in every loop; returns the forest and the cut joints.
fn forest(mechanism: &Mechanism, diagnostics: &mut Diagnostics) -> (Graph, Vec<JointId>) {
    let mut graph = Graph::new(mechanism.bodies.len());
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
                    let shared = closing.iter().zip(&inwards).take_while(|(x, other)| x == other).count();
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

/// Reports bodies that nothing holds to the ground: they have no equilibrium. Bodies joined to each other count as one
/// mistake.
fn report_unreached(mechanism: &Mechanism, graph: &Graph, branches: &[Branch], diagnostics: &mut Diagnostics) {
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
                format!("only the cut joint `{}` leads from body `{name}` to the ground", joint.name),
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
            format!("body `{name}`, joined to {}, has no path to the ground", others.join(", "))
        };
        diagnostics.error_with_help(
            name,
            message,
            format!("connect it by a joint, for example `joint j: revolute(z) from ground to {name};`"),
        );
    }
}
