//! Bodies held together by fixed joints: they move as one.

use std::collections::VecDeque;

use super::mechanism::{Frame, Joint, Placement};
use super::simplify::negate;
use crate::base::ids::BodyId;
use crate::model::expression::Expr;

/// One of the bodies welded together.
#[derive(Clone, Debug)]
pub struct Member {
    /// The body.
    pub body: BodyId,
    /// Placement of its frame in the frame of the first body: nested placements, the innermost first.
    pub placements: Vec<Placement>,
}

/// All bodies except those welded to the ground, which never move, in groups that move as one: most contain a single
/// body.
pub fn groups(bodies: usize, joints: &[Joint]) -> Vec<Vec<Member>> {
    let welds: Vec<&Joint> = joints.iter().filter(|joint| joint.steps.is_empty() && joint.flexure.is_none()).collect();
    let mut seen = vec![false; bodies];
    reach(Frame::Ground, &welds, &mut seen);
    let mut groups = Vec::new();
    for index in 0..bodies {
        if !seen[index] {
            seen[index] = true;
            let first = Frame::Body(BodyId::new(index));
            groups.push(reach(first, &welds, &mut seen));
        }
    }
    groups
}

/// The bodies welded to a frame, including its own, that have not been visited yet.
fn reach(start: Frame, welds: &[&Joint], seen: &mut [bool]) -> Vec<Member> {
    let mut reached = Vec::new();
    let mut waiting = VecDeque::from([(start, Vec::new())]);
    while let Some((frame, placements)) = waiting.pop_front() {
        for joint in welds {
            let (near, far, other) = match frame {
                _ if joint.from == frame => (&joint.from_placement, &joint.to_placement, joint.to),
                _ if joint.to == frame => (&joint.to_placement, &joint.from_placement, joint.from),
                _ => continue,
            };
            if let Frame::Body(body) = other
                && let Some(seen) = seen.get_mut(body.index()).filter(|seen| !**seen)
            {
                *seen = true;
                let [back, turned_back] = inverse(far);
                let mut inside = vec![back, turned_back, near.clone()];
                inside.extend(placements.iter().cloned());
                waiting.push_back((other, inside));
            }
        }
        if let Frame::Body(body) = frame {
            reached.push(Member { body, placements });
        }
    }
    reached
}

/// The inverse of a placement: first the offset, then the rotations from the last to the first.
fn inverse(placement: &Placement) -> [Placement; 2] {
    let rotations = placement.rotations.iter().rev();
    [
        Placement { offset: placement.offset.clone().map(negate), rotations: Vec::new() },
        Placement {
            offset: [0.0; 3].map(Expr::Number),
            rotations: rotations.map(|(axis, angle)| (axis.clone(), negate(angle.clone()))).collect(),
        },
    ]
}
