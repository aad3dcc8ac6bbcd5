//! Rolling without slip of a thin disk or a ball on a plane.

use crate::algebra::{Graph, Vector3};
use crate::base::ids::PointId;
use crate::model::expression::{Expr, Vector};

use super::force_context::ForceContext;
use super::pair::{Demand, Pair};
use super::perpendiculars::perpendiculars;
use super::slip_axes::slip_axes;

/// Contact along the normal, as an equation of positions; no slip forward and sideways, as equations of velocities.
///
/// With `n` the normal, `a` the axle and `c` the centre, the lowest point of a disk is `c + r d`,
/// `d = -(n - (n . a) a) / |n - (n . a) a|`; forward is `a x n / |a x n|`. A ball has no axle: forward is fixed in the
/// plane, or where its slip is steady.
pub(crate) fn rolling(
    g: &mut Graph,
    force_context: &ForceContext,
    wheel: PointId,
    axis: Option<&Vector>,
    radius: &Expr,
    on: PointId,
    normal: &Vector,
) -> Pair {
    let values = force_context.context.values;
    let (plane, wheel) = (force_context.side(on), force_context.side(wheel));
    let radius = values.scalar(g, radius);
    let local = values.vector(g, normal);
    let normal = plane.at.axes.apply(g, local);
    let (outward, forward) = match axis {
        Some(axis) => {
            let axis = values.vector(g, axis);
            let axle = wheel.at.axes.apply(g, axis);
            let lean = normal.dot(g, axle);
            let along = axle.scale(g, lean);
            let up = normal.sub(g, along);
            let one = g.constant(1.0);
            let size = up.norm(g);
            let inverse = g.div(one, size);
            (up.scale(g, inverse), axle.cross(g, normal).scale(g, inverse))
        }
        None => {
            let sides = (plane.frame, wheel.frame);
            let turned = slip_axes(g, force_context, sides, wheel.at.position, normal);
            let axes = turned.unwrap_or(plane.at.axes);
            let local = match turned {
                Some(axes) => axes.transpose().apply(g, normal),
                None => local,
            };
            let [first, _] = perpendiculars(g, force_context.context, local);
            (normal, axes.apply(g, first))
        }
    };
    let sideways = normal.cross(g, forward);
    let reach = outward.scale(g, radius).neg(g);
    let contact = wheel.at.position.add(g, reach);
    let height = {
        let gap = contact.sub(g, plane.at.position);
        normal.dot(g, gap)
    };
    let slip = force_context.relative_velocity(g, (plane.frame, wheel.frame), contact);
    let zero = Vector3::zero(g);
    let mut demands =
        vec![Demand { label: "normal", value: height, force: normal, moment: zero, of_velocities: false }];
    for (label, direction) in [("forward", forward), ("lateral", sideways)] {
        demands.push(Demand {
            label,
            value: direction.dot(g, slip),
            force: direction,
            moment: zero,
            of_velocities: true,
        });
    }
    Pair { from: plane, to: wheel, reach, demands }
}
