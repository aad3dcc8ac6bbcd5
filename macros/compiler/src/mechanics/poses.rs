//! How far joints of three turns are from the poses in which their coordinates fail.

use crate::algebra::{Graph, Vector3};

use super::functions::Pose;
use super::problem::Problem;

/// Every joint with three turns.
pub(super) fn poses(g: &mut Graph, problem: &Problem) -> Vec<Pose> {
    let kinematics = problem.kinematics_at_zero(g);
    let mut poses = Vec::new();
    for branch in &problem.topology.branches {
        let motion = kinematics.of(branch.body);
        let turns: Vec<Vector3> = motion.steps.iter().filter_map(|step| step.turn).collect();
        if let [first, second, third] = turns[..] {
            let normal = first.cross(g, second);
            let volume = normal.dot(g, third);
            let joint = problem.mechanism.joints[branch.joint.index()]
                .name
                .to_string();
            poses.push(Pose { joint, volume });
        }
    }
    poses
}
