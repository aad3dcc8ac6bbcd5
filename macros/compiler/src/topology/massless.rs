//! A free coordinate must move mass: otherwise no equation determines its motion.

use super::Topology;
use crate::base::diagnostics::Diagnostics;
use crate::model::mechanism::{Frame, Mechanism, Motion};

/// Reports free coordinates beyond which everything is massless.
pub(super) fn check(mechanism: &Mechanism, topology: &Topology, diagnostics: &mut Diagnostics) {
    let mut carries_mass = vec![false; mechanism.bodies.len()];
    // Children come after their parents, so in reverse order the mass beyond each body is already known.
    for branch in topology.branches.iter().rev() {
        let body = branch.body.index();
        if mechanism.has_mass(branch.body) {
            carries_mass[body] = true;
        }
        if let (true, Frame::Body(parent)) = (carries_mass[body], branch.parent) {
            carries_mass[parent.index()] = true;
        }
    }
    for branch in &topology.branches {
        if carries_mass[branch.body.index()] {
            continue;
        }
        let joint = &mechanism.joints[branch.joint.index()];
        let coordinates = joint.steps.iter().map(|step| &mechanism.coordinates[step.coordinate.index()]);
        let free: Vec<_> = coordinates
            .filter(|coordinate| coordinate.motion == Motion::Free)
            .map(|coordinate| &coordinate.name)
            .collect();
        let Some(first) = free.first() else {
            continue;
        };
        let names: Vec<String> = free.iter().map(|name| format!("`{name}`")).collect();
        let message = match names.as_slice() {
            [one] => format!("{one} moves no mass: nothing determines its motion"),
            several => format!("{} move no mass: nothing determines their motion", several.join(", ")),
        };
        let help = "give a body beyond it a mass, or drive it, or make it `fixed`";
        diagnostics.error_with_help(*first, message, help);
    }
}
