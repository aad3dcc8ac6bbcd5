//! Loads on bodies and coordinates, and how to add a force or a pair of forces to them.

use std::collections::BTreeMap;

use crate::algebra::{ExprId, Graph, Vector3};
use crate::base::ids::PointId;
use crate::mechanics::motion::Wrench;
use crate::model::mechanism::{Frame, Mechanism};

use super::force_context::ForceContext;
use super::pair::Pair;

/// Loads on one body, grouped by the frame at which each closes: a force pair between two bodies does no work on the
/// joints below their last common ancestor, and adding it up there would only leave rounding errors.
pub(crate) type Loads = BTreeMap<Frame, Wrench>;

/// Adds a load to those that close at the same frame.
pub(crate) fn add_load(g: &mut Graph, loads: &mut Loads, closing: Frame, load: Wrench) {
    let sum = match loads.get(&closing) {
        Some(so_far) => so_far.add(g, load),
        None => load,
    };
    loads.insert(closing, sum);
}

/// Applied loads of a mechanism.
pub(crate) struct AppliedForces {
    /// By body id.
    pub(crate) on_bodies: Vec<Loads>,
    /// Generalised force by coordinate id.
    pub(crate) on_coordinates: Vec<ExprId>,
    /// By beam and section: the force on the direction there, times its share in the places where forces act.
    pub(crate) on_directions: Vec<Vec<Vector3>>,
}

impl AppliedForces {
    /// No load anywhere.
    pub(crate) fn none(g: &mut Graph, mechanism: &Mechanism) -> Self {
        Self {
            on_bodies: vec![Loads::new(); mechanism.bodies.len()],
            on_coordinates: vec![g.zero(); mechanism.coordinates.len()],
            on_directions: mechanism.beams.iter().map(|beam| vec![Vector3::zero(g); beam.sections.len()]).collect(),
        }
    }

    /// Applies a force and a moment at a named point.
    pub(crate) fn apply(
        &mut self,
        g: &mut Graph,
        force_context: &ForceContext,
        point: PointId,
        load: Wrench,
        closing: Frame,
    ) {
        let frame = force_context.frame(point);
        let arm = force_context.point(point).arm;
        self.apply_at(g, (frame, arm), load, closing);
    }

    /// Applies a force and a moment to one side of a constraint, and the opposite to the other side at the same place.
    pub(crate) fn apply_pair(&mut self, g: &mut Graph, force_context: &ForceContext, pair: &Pair, load: Wrench) {
        let Pair { from, to, reach, .. } = pair;
        let closing = force_context.tree.common_ancestor(from.frame, to.frame);
        let arm = to.at.arm.add(g, *reach);
        self.apply_at(g, (to.frame, arm), load, closing);
        let gap = pair.gap(g);
        let arm = from.at.arm.add(g, gap);
        let opposite = load.neg(g);
        self.apply_at(g, (from.frame, arm), opposite, closing);
    }

    /// Applies a force and a moment at a given arm from the origin of a frame.
    fn apply_at(&mut self, g: &mut Graph, (frame, arm): (Frame, Vector3), load: Wrench, closing: Frame) {
        let Frame::Body(body) = frame else { return };
        if frame == closing {
            return;
        }
        let lever = arm.cross(g, load.force);
        let load = Wrench { force: load.force, moment: load.moment.add(g, lever) };
        add_load(g, &mut self.on_bodies[body.index()], closing, load);
    }
}
