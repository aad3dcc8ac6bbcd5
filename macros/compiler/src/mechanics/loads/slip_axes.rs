//! Axes in which the slip of a ball is steady.

use crate::algebra::{Graph, Matrix3, Vector3};
use crate::mechanics::setup::vanish;
use crate::model::mechanism::Frame;

use super::force_context::ForceContext;

/// The axes in which the slip of a ball is steady although the plane, or what carries the ball, keeps turning about the
/// normal: those of the carrier, or of what carries the plane. `None` if neither does.
pub(super) fn slip_axes(
    g: &mut Graph,
    force_context: &ForceContext,
    (plane, wheel): (Frame, Frame),
    center: Vector3,
    normal: Vector3,
) -> Option<Matrix3> {
    let tree = &force_context.tree;
    let closing = tree.common_ancestor(plane, wheel);
    let below = |frame: Frame| tree.path(frame).into_iter().take_while(|frame| *frame != closing).collect::<Vec<_>>();
    let outwards = below(wheel).into_iter().rev();
    let carrier = turning(g, force_context, outwards, normal, Some(center));
    let still = match carrier {
        Some(_) => None,
        None => turning(g, force_context, below(plane).into_iter(), normal, None)
            .and_then(|turning| tree.path(turning).get(1).copied()),
    };
    let axes = force_context.kinematics.frame(carrier.or(still)?);
    Some(axes.orientation.axes)
}

/// The last frame that its joint keeps turning about the normal, before one that is turned about another direction. With
/// the centre of a ball, only if this or a later joint moves the ball: its own spin about the normal does not.
fn turning(
    g: &mut Graph,
    force_context: &ForceContext,
    frames: impl Iterator<Item = Frame>,
    normal: Vector3,
    center: Option<Vector3>,
) -> Option<Frame> {
    let context = force_context.context;
    let (mut last, mut turning) = (None, None);
    for frame in frames {
        let Frame::Body(body) = frame else { break };
        let body_motion = force_context.kinematics.of(body);
        for step in &body_motion.steps {
            if let Some(axis) = step.turn {
                let across = axis.cross(g, normal).0;
                if vanish(g, context, &across).contains(&false) {
                    return turning;
                }
                if context.mechanism.coordinates[step.coordinate.index()].motion.runs() {
                    turning = Some(frame);
                }
            }
            let moves = center.is_none_or(|center| {
                let arm = center.sub(g, body_motion.frame.position);
                let velocity = step.velocity(g, arm).0;
                vanish(g, context, &velocity).contains(&false)
            });
            if moves {
                last = turning;
            }
        }
    }
    last
}
