//! The effect of applied forces and constraints along the coordinates: loads are summed from the leaves towards the
//! ground and projected on the joint axes.

use crate::algebra::{ExprId, Graph, Vector3};
use crate::base::ids::BeamId;
use crate::mechanics::inertia::FromStations;
use crate::mechanics::motion::{Kinematics, Wrench};
use crate::mechanics::setup::{Context, ForceSelection};
use crate::model::mechanism::Frame;

use super::applied::{Loads, add_load};
use super::constraints::constraints;
use super::force_context::ForceContext;
use super::forces::applied_forces;

/// Loads along the coordinates, and the loads that the joints transmit, with the sign of inertia.
pub(crate) struct Transmitted {
    /// By coordinate id.
    pub(crate) along: Vec<ExprId>,
    /// By row: the constraint equations.
    pub(crate) constraints: Vec<ExprId>,
    /// By body id: the load that the parent exerts on the body and everything it carries, about the body's origin.
    pub(crate) wrenches: Vec<Wrench>,
}

/// Sums the negative of applied forces from the leaves towards the ground.
pub(crate) fn transmitted(
    g: &mut Graph,
    context: &Context,
    kinematics: &Kinematics,
    selection: ForceSelection,
) -> Transmitted {
    let Context { mechanism, topology, .. } = *context;
    let force_context = ForceContext::new(context, kinematics);
    let mut applied = applied_forces(g, &force_context, selection);
    let constraints = if selection.constraints {
        constraints(g, &force_context, &mut applied)
    } else {
        vec![g.zero(); context.rows.len()]
    };
    let mut loads: Vec<Loads> = applied.on_bodies.iter().map(|on| negated(g, on)).collect();

    let zero = Vector3::zero(g);
    let mut along: Vec<ExprId> = applied.on_coordinates.iter().map(|&force| g.neg(force)).collect();
    let nothing = Wrench { force: zero, moment: zero };
    let mut wrenches = vec![nothing; mechanism.bodies.len()];
    let mut on_stations = FromStations::nothing(g, context);
    for (on, forces) in on_stations.iter_mut().zip(&applied.on_directions) {
        on.subtract_distributed(g, forces);
    }
    for branch in topology.branches.iter().rev() {
        let body = branch.body.index();
        let name = mechanism.bodies[body].name.to_string();
        let motion = kinematics.of(branch.body);
        let carried = std::mem::take(&mut loads[body]);
        for (&closing, &load) in &carried {
            load.force.set_name(g, &format!("{name}_total_force"));
            load.moment.set_name(g, &format!("{name}_total_moment"));
            wrenches[body] = wrenches[body].add(g, load);
            if let Some((beam, station)) = motion.flexure {
                let beam = beam.index();
                let load = [load.force, load.moment];
                on_stations[beam].add(g, &kinematics.beams[beam], station, load);
            }
            for step in &motion.steps {
                let power = step.project(g, load.force, load.moment);
                let slot = &mut along[step.coordinate.index()];
                *slot = g.add(*slot, power);
            }
            if let Frame::Body(parent) = branch.parent
                && closing != branch.parent
            {
                let shift = motion.frame.offset.cross(g, load.force);
                let moved = Wrench { force: load.force, moment: load.moment.add(g, shift) };
                add_load(g, &mut loads[parent.index()], closing, moved);
            }
        }
    }
    let mut along_sections = vec![g.zero(); context.sections.rows.len()];
    for (index, on) in on_stations.iter().enumerate() {
        let (id, beam) = (BeamId::new(index), &kinematics.beams[index]);
        on.turning(g, beam).add_along(g, context.sections, id, beam, &mut along_sections);
    }
    let all = [vec![g.zero(); topology.free.len()], along_sections].concat();
    for (id, share) in topology.free.iter().zip(context.sections.forces(g, &all)) {
        along[id.index()] = g.add(along[id.index()], share);
    }
    Transmitted { along, constraints, wrenches }
}

fn negated(g: &mut Graph, loads: &Loads) -> Loads {
    loads.iter().map(|(&closing, load)| (closing, load.neg(g))).collect()
}
