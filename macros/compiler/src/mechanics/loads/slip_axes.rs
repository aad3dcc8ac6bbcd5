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
    normal: Vector3,
) -> Option<Matrix3> {
    let tree = &force_context.tree;
    let closing = tree.common_ancestor(plane, wheel);
    let below = |frame: Frame| {
        let path = tree.path(frame).into_iter();
        path.take_while(|own| *own != closing).collect::<Vec<_>>()
    };
    let outwards = below(wheel).into_iter().rev();
    let carrier = last_turning(g, force_context, outwards, normal);
    let still = match carrier {
        Some(_) => None,
        None => last_turning(g, force_context, below(plane).into_iter(), normal)
            .and_then(|turning| tree.path(turning).get(1).copied()),
    };
    let axes = force_context.kinematics.frame(carrier.or(still)?);
    Some(axes.orientation.axes)
}

/// The last frame that its joint keeps turning about the normal, before one that is turned about another direction.
fn last_turning(
    g: &mut Graph,
    force_context: &ForceContext,
    frames: impl Iterator<Item = Frame>,
    normal: Vector3,
) -> Option<Frame> {
    let mut last = None;
    for frame in frames {
        let Frame::Body(body) = frame else { break };
        let mut runs = false;
        for step in &force_context.kinematics.of(body).steps {
            let Some(axis) = step.turn else { continue };
            let across = axis.cross(g, normal).0;
            if vanish(g, force_context.context, &across).contains(&false) {
                return last;
            }
            let coordinates = &force_context.context.mechanism.coordinates;
            runs |= coordinates[step.coordinate.index()].motion.runs();
        }
        if runs {
            last = Some(frame);
        }
    }
    last
}
