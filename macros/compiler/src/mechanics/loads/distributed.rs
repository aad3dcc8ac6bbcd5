//! Forces per length along beams, at the places of quadrature.

use crate::algebra::{Graph, Vector3};
use crate::base::ids::BeamId;
use crate::mechanics::motion::{Wrench, curved};
use crate::model::expression::{Expr, Vector};
use crate::model::mechanism::Frame;

use super::applied::{AppliedForces, add_load};
use super::force_context::ForceContext;

/// A force per length with fixed axes and one along those of the sections, N/m, and a resistance to motion, N s/m^2.
pub(super) struct PerLength<'a> {
    pub(super) force: &'a Vector,
    pub(super) follower: &'a Vector,
    pub(super) damping: &'a Expr,
}

impl AppliedForces {
    /// Forces at `r_a = L sum_k W_ak d_k` from the root: on the root's body with their moment, and `L W_ak F_a` on each
    /// direction `d_k`.
    pub(super) fn distribute(&mut self, g: &mut Graph, force_context: &ForceContext, id: BeamId, load: &PerLength<'_>) {
        let ForceContext { context, kinematics, .. } = *force_context;
        let values = context.values;
        let beam = &context.mechanism.beams[id.index()];
        let motion = &kinematics.beams[id.index()];
        let root = &kinematics.of(beam.body).frame;
        let length = values.scalar(g, &beam.length);
        let fixed = values.vector(g, load.force);
        let follower = values.vector(g, load.follower);
        let damping = values.scalar(g, load.damping);
        let rule = beam.quadrature();
        let zero = Vector3::zero(g);
        let mut total = Wrench { force: zero, moment: zero };
        for (a, (&point, &weight)) in rule.points.iter().zip(&rule.weights).enumerate() {
            let share = g.scale(weight, length);
            let along_root = curved(g, values, &beam.sections[a].2).apply(g, follower);
            let along = motion.sections[a].frame.orientation.axes.apply(g, along_root);
            let mut force = fixed.add(g, along);
            let reach: Vec<_> = rule.integrals_to(point).into_iter().map(|part| g.scale(part, length)).collect();
            let (mut arm, mut velocity) = (zero, root.velocity);
            for (direction, &reach) in motion.directions.iter().zip(&reach) {
                let part = direction.vector.scale(g, reach);
                arm = arm.add(g, part);
                let part = direction.rate.scale(g, reach);
                velocity = velocity.add(g, part);
            }
            let resistance = velocity.scale(g, damping);
            force = force.sub(g, resistance).scale(g, share);
            for (bracket, &reach) in self.on_directions[id.index()].iter_mut().zip(&reach) {
                let part = force.scale(g, reach);
                *bracket = bracket.add(g, part);
            }
            total.force = total.force.add(g, force);
            let moment = arm.cross(g, force);
            total.moment = total.moment.add(g, moment);
        }
        let on_root = &mut self.on_bodies[beam.body.index()];
        add_load(g, on_root, Frame::Ground, total);
    }
}
