//! A free coordinate must move mass: otherwise no equation determines its motion.

use super::Topology;
use crate::base::diagnostics::Diagnostics;
use crate::model::mechanism::{Frame, JointKind, Mechanism, Motion, Shape};

/// Reports free coordinates beyond which everything is massless.
pub(super) fn check(mechanism: &Mechanism, topology: &Topology, diagnostics: &mut Diagnostics) {
    let mut carries_mass = vec![false; mechanism.bodies.len()];
    // Children come after their parents, so that backwards every body knows what hangs on it.
    for branch in topology.branches.iter().rev() {
        let body = branch.body.index();
        if mechanism.bodies[body].shape != Shape::Massless {
            carries_mass[body] = true;
        }
        if let (true, Frame::Body(parent)) = (carries_mass[body], branch.parent) {
            carries_mass[parent.index()] = true;
        }
    }
    for branch in &topology.branches {
        let joint = &mechanism.joints[branch.joint.index()];
        let (JointKind::Revolute { coordinate, .. } | JointKind::Prismatic { coordinate, .. }) =
            joint.kind
        else {
            continue;
        };
        let is_free = mechanism.coordinates[coordinate.index()].motion == Motion::Free;
        if is_free && !carries_mass[branch.body.index()] {
            let name = &joint.name;
            diagnostics.error_with_help(
                name,
                format!("`{name}` moves no mass: nothing determines its motion"),
                "give a body beyond it a mass, or drive it, or make it `fixed`",
            );
        }
    }
}
