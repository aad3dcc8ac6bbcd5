//! Inertia and weight along every coordinate: Newton-Euler recursion over augmented bodies.

use crate::algebra::{ExprId, Graph, Vector3};
use crate::base::ids::BeamId;
use crate::mechanics::motion::{BeamMotion, FrameMotion, Kinematics, Wrench, for_inertia};
use crate::mechanics::setup::{Context, ForceSelection};
use crate::model::mechanism::Frame;

use super::augmented::{AugmentedBody, augmented_bodies, rides_on_seat};
use super::flexible::{BeamInertia, BeamLoad, FromStations};

/// Inertia minus weight.
pub(crate) struct Inertial {
    /// By coordinate id: along the coordinate, or along the absolute angle if its body continues a run.
    pub(crate) along: Vec<ExprId>,
    /// By row of the sections of beams.
    pub(crate) along_sections: Vec<ExprId>,
    pub(crate) beams: Vec<BeamForces>,
    /// By body id: for the body and everything it carries, about its origin, in the axes of its motion.
    pub(crate) wrenches: Vec<Wrench>,
}

/// A beam in motion, with the forces that this requires.
pub(crate) struct BeamForces {
    pub(crate) id: BeamId,
    pub(crate) motion: BeamMotion,
    pub(crate) load: BeamLoad,
}

/// Contributions that a body has gathered from the bodies it carries.
#[derive(Clone)]
struct Gathered {
    /// Forces of bodies that do not ride on a seat, and the remainders of those that do.
    rest: Vector3,
    /// By body axis `e_k`: `sum_c s_ck rest_c`, with which the axis forms a cross product.
    brackets: [Vector3; 3],
    /// About the origin: from bodies that do not continue a run with this one, and from those that do.
    moment: Vector3,
    moment_of_run: Vector3,
}

/// [`inertial`] with the running coordinates at `running`.
pub(crate) fn inertial_at(g: &mut Graph, context: &Context, running: &[ExprId], selection: ForceSelection) -> Inertial {
    let kinematics = for_inertia(g, context, running, selection);
    inertial(g, context, &kinematics, selection)
}

/// Sums inertia minus weight from the leaves towards the ground. `kinematics` is written in the layout of runs, with
/// the ground accelerated against gravity, so that weight needs no terms of its own.
///
/// A body and everything it carries on seats has the augmented mass `m`, moments `first` and `second`, and seats at
/// `s_c`. Integrating `a(rho) = a_O + W rho` over the mass gives
///
/// - `force = m a_O + rest`, `rest = W first + sum rest_c`,
/// - `moment = 2 isotropic alpha + sum_k e_k x (first_k a_O + sum_j second_kj W e_j + sum_c s_ck rest_c) + sum moment_c`.
///
/// The absolute angle of a body turns only this body of its run, so the moments of the bodies that continue the run do
/// no work along it.
pub(crate) fn inertial(
    g: &mut Graph,
    context: &Context,
    kinematics: &Kinematics,
    selection: ForceSelection,
) -> Inertial {
    let mechanism = context.mechanism;
    let zero = Vector3::zero(g);
    let bodies = augmented_bodies(g, context, kinematics, selection);
    let nothing = Gathered { rest: zero, brackets: [zero; 3], moment: zero, moment_of_run: zero };
    let mut gathered = vec![nothing; mechanism.bodies.len()];
    let mut along = vec![g.zero(); mechanism.coordinates.len()];
    let nothing = Wrench { force: zero, moment: zero };
    let mut wrenches = vec![nothing; mechanism.bodies.len()];
    let mut along_sections = vec![g.zero(); context.sections.rows.len()];
    let mut beams = Vec::new();
    let mut from_stations = FromStations::nothing(g, context);
    for branch in context.topology.branches.iter().rev() {
        let index = branch.body.index();
        let motion = kinematics.of(branch.body);
        let name = mechanism.bodies[index].name.to_string();
        let mut wrench = own_load(g, &bodies[index], &motion.frame, &gathered[index]);
        if let Some(id) = mechanism.beam(branch.body) {
            let (beam, from) = (&kinematics.beams[id.index()], &from_stations[id.index()]);
            let load = if selection.gravity || selection.inertia.contains(branch.body) {
                BeamInertia::new(g, context, id).load(g, beam, &motion.frame, from)
            } else {
                from.turning(g, beam)
            };
            load.add_along(g, context.sections, id, beam, &mut along_sections);
            wrench.force = wrench.force.add(g, load.force);
            wrench.moment = wrench.moment.add(g, load.moment);
            beams.push(BeamForces { id, motion: beam.clone(), load });
        }
        let rest = wrench.force.set_name(g, &format!("{name}_rest_of_force"));
        let by_mass = motion.frame.acceleration.scale(g, bodies[index].mass);
        let force = by_mass.add(g, rest).set_name(g, &format!("{name}_inertia_force"));
        let turning = wrench.moment.add(g, gathered[index].moment).set_name(g, &format!("{name}_inertia_moment"));
        for step in &motion.steps {
            along[step.coordinate.index()] = step.project(g, force, turning);
        }
        let moment = turning.add(g, gathered[index].moment_of_run);
        wrenches[index] = Wrench { force, moment };

        let Frame::Body(parent) = branch.parent else {
            continue;
        };
        let rides = rides_on_seat(g, motion);
        let mut write = |vector: Vector3| match motion.to_parent {
            Some(rotation) => rotation.apply(g, vector),
            None => vector,
        };
        let handed = write(if rides { rest } else { force });
        let moment = write(moment);
        let at = &mut gathered[parent.index()];
        at.rest = at.rest.add(g, handed);
        if let Some((beam, station)) = motion.flexure {
            let beam = beam.index();
            from_stations[beam].add(g, &kinematics.beams[beam], station, [handed, moment]);
        } else if rides {
            for (bracket, &arm) in at.brackets.iter_mut().zip(&motion.seat.arm.0) {
                let share = handed.scale(g, arm);
                *bracket = bracket.add(g, share);
            }
        } else {
            let shift = motion.frame.offset.cross(g, handed);
            at.moment = at.moment.add(g, shift);
        }
        let slot =
            if context.runs.layout.of(branch.body).continues_run { &mut at.moment_of_run } else { &mut at.moment };
        *slot = slot.add(g, moment);
    }
    Inertial { along, along_sections, beams, wrenches }
}

/// The part of the force that does not depend on the origin's acceleration, and the moment without the moments passed
/// on by other bodies.
fn own_load(g: &mut Graph, body: &AugmentedBody, motion: &FrameMotion, gathered: &Gathered) -> Wrench {
    let mut force = gathered.rest;
    let twice = g.scale(2.0, body.isotropic);
    let mut moment = motion.angular_acceleration.scale(g, twice);
    let axes: [(Vector3, Vector3); 3] = motion.axes();
    for k in 0..3 {
        let (axis, _) = axes[k];
        let mut bracket = motion.acceleration.scale(g, body.first.0[k]);
        for (&second, (_, rate)) in body.second[k].iter().zip(&axes) {
            let share = rate.scale(g, second);
            bracket = bracket.add(g, share);
        }
        bracket = bracket.add(g, gathered.brackets[k]);
        let share = axis.cross(g, bracket);
        moment = moment.add(g, share);
        let share = axes[k].1.scale(g, body.first.0[k]);
        force = force.add(g, share);
    }
    Wrench { force, moment }
}
