//! What turns a body.

use crate::algebra::{Graph, Vector3, substitute};
use crate::base::ids::{BodyId, CoordinateId};
use crate::mechanics::setup::Context;
use crate::model::mechanism::Frame;

use super::kinematics::Kinematics;

/// The nearest running coordinate that turns a body, and its axis in the body's frame.
pub(crate) fn turning(
    g: &mut Graph,
    context: &Context,
    kinematics: &Kinematics,
    body: BodyId,
) -> Option<(CoordinateId, Vector3)> {
    let runs = |id: CoordinateId| context.mechanism.coordinates[id.index()].motion.runs();
    let mut carrier = body;
    loop {
        let motion = kinematics.of(carrier);
        let step = motion.steps.iter().rev().find(|step| step.turn.is_some() && runs(step.coordinate));
        if let Some(step) = step {
            if carrier == body {
                return Some((step.coordinate, step.own_axis));
            }
            let axis = kinematics.of(body).frame.orientation.axes.transpose().apply(g, step.turn?);
            let zeros = vec![g.zero(); context.symbols.q.ids.len()];
            let straight: Vec<_> = context.symbols.q.with(&zeros).collect();
            let axis = substitute(g, &axis.0, &straight);
            return Some((step.coordinate, Vector3([axis[0], axis[1], axis[2]])));
        }
        let branch = context.topology.branches.iter().find(|branch| branch.body == carrier)?;
        let Frame::Body(parent) = branch.parent else {
            return None;
        };
        carrier = parent;
    }
}
