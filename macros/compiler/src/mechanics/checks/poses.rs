//! How far joints with three turns, and beams that turn about more than one axis, are from the poses in which their
//! coordinates become singular.

use crate::algebra::{Graph, Vector3};
use crate::mechanics::functions::Pose;
use crate::mechanics::motion::Kinematics;
use crate::mechanics::setup::Context;

/// The squared cosine of half of 150 degrees: beyond, polynomials of the Rodrigues vector describe a beam badly.
const BENT_TOO_FAR: f64 = 0.066_987_298_107_780_68;

/// Every joint with three turns, and every section of the beams that turn about more than one axis.
pub(crate) fn poses(g: &mut Graph, context: &Context, kinematics: &Kinematics) -> Vec<Pose> {
    let mut poses = Vec::new();
    for branch in &context.topology.branches {
        let turns: Vec<Vector3> = kinematics.of(branch.body).steps.iter().filter_map(|step| step.turn).collect();
        if let [first, second, third] = turns[..] {
            let margin = first.cross(g, second).dot(g, third);
            let joint = context.mechanism.joints[branch.joint.index()].name.to_string();
            poses.push(Pose { joint, margin, least: 0.0 });
        }
    }
    for (beam, motion) in context.mechanism.beams.iter().zip(&kinematics.beams) {
        let stations = motion.stations.iter().map(|station| &station.section);
        let sections = motion.sections.iter().chain(stations);
        poses.extend(sections.filter_map(|section| {
            Some(Pose { joint: beam.name.clone(), margin: section.pose_margin()?, least: BENT_TOO_FAR })
        }));
    }
    poses
}
