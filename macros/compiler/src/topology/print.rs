//! The forest as text, for snapshots: each body is indented below its parent.

use std::fmt::Write;

use super::Topology;
use crate::base::ids::CoordinateId;
use crate::model::mechanism::{Frame, Mechanism};

impl Topology {
    /// The forest, with the names of its mechanism.
    pub fn describe(&self, mechanism: &Mechanism) -> String {
        let mut text = String::from("ground\n");
        self.describe_below(mechanism, Frame::Ground, 1, &mut text);
        let lists = [("free", &self.free), ("coasting", &self.coasting), ("driven", &self.driven)];
        for (kind, list) in lists {
            if kind == "coasting" && list.is_empty() {
                continue;
            }
            let name = |id: &CoordinateId| mechanism.coordinates[id.index()].name.to_string();
            let names: Vec<String> = list.iter().map(name).collect();
            let _ = writeln!(text, "{kind}: {}", names.join(", "));
        }
        for joint in &self.cut {
            let _ = writeln!(text, "cut: {}", mechanism.joints[joint.index()].name);
        }
        text
    }

    fn describe_below(&self, mechanism: &Mechanism, on: Frame, depth: usize, text: &mut String) {
        for branch in self.branches.iter().filter(|branch| branch.parent == on) {
            let _ = writeln!(
                text,
                "{:indent$}{} by {}{}",
                "",
                mechanism.bodies[branch.body.index()].name,
                mechanism.joints[branch.joint.index()].name,
                if branch.reversed { ", reversed" } else { "" },
                indent = 2 * depth
            );
            self.describe_below(mechanism, Frame::Body(branch.body), depth + 1, text);
        }
    }
}
