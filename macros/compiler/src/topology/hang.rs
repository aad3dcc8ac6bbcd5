//! Lets every beam hang on its root.
//!
//! The joints that are cut leave a tree in which some beam may be carried by its tip. Another cut of the same loop can
//! mend that: a cut joint is restored, and one on the way between its ends is cut instead.

use std::cmp::Reverse;

use super::graph::Graph;
use crate::base::ids::JointId;
use crate::model::mechanism::Mechanism;

/// What to prefer, the least first: beams that are carried by their tips, then less freedom of the joint that is cut, then
/// its place in the declaration.
type Rank = (usize, Reverse<(usize, JointId)>);

/// Exchanges cut joints for others that are not `needed`, as long as fewer beams are then carried by their tips; of
/// several the one whose cut leaves the most freedom, in a tie the last declared.
pub(super) fn by_roots(mechanism: &Mechanism, graph: &mut Graph, cut: &mut [JointId], needed: &[bool]) {
    let mut left = graph.turned(mechanism);
    while left > 0 {
        let mut best: Option<(Rank, usize, JointId)> = None;
        for (k, &restored) in cut.iter().enumerate() {
            let joint = &mechanism.joints[restored.index()];
            if joint.cut {
                continue;
            }
            for removed in graph.between(joint) {
                let other = &mechanism.joints[removed.index()];
                if other.flexure.is_some() || needed[removed.index()] {
                    continue;
                }
                graph.exchange(mechanism, removed, restored);
                let rank = (graph.turned(mechanism), Reverse((other.steps.len(), removed)));
                graph.exchange(mechanism, restored, removed);
                if best.is_none_or(|(least, ..)| rank < least) {
                    best = Some((rank, k, removed));
                }
            }
        }
        match best {
            Some(((turned, _), k, removed)) if turned < left => {
                graph.exchange(mechanism, removed, cut[k]);
                (left, cut[k]) = (turned, removed);
            }
            _ => break,
        }
    }
    cut.sort();
}
