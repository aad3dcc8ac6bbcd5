//! The residual of the equations of motion: forces and moments summed from the leaves towards the ground and projected
//! on the joint axes.

use crate::algebra::{Graph, Vector3};
use crate::base::ids::{BodyId, ExprId};
use crate::model::mechanism::Frame;

use super::derive::Problem;
use super::forces::{AppliedForces, Loads, Wrench, add_load};
use super::frame::FrameMotion;
use super::inertia::MassDistribution;
use super::kinematics::Kinematics;
use super::sources::Sources;

/// The equations of motion, and what the joints transmit.
pub(super) struct Dynamics {
    /// `g(qddot, qdot, q; u, b)` by coordinate id (eq. 12): inertia less applied forces along each coordinate.
    pub(super) residual: Vec<ExprId>,
    /// By row: the equations of constraints.
    pub(super) constraints: Vec<ExprId>,
    /// By body id: what the parent exerts on the body and all it carries, about the body's origin.
    pub(super) transmitted: Vec<Wrench>,
}

/// Sums inertia less applied forces from the leaves towards the ground.
pub(super) fn dynamics(
    g: &mut Graph,
    problem: &Problem,
    kinematics: &Kinematics,
    sources: Sources,
) -> Dynamics {
    let Problem {
        mechanism,
        topology,
        ..
    } = *problem;
    let applied = AppliedForces::new(g, problem, kinematics, sources);
    let mut loads: Vec<Loads> = applied.on_bodies.iter().map(|on| negated(g, on)).collect();
    add_inertia(g, problem, kinematics, sources, &mut loads);

    let zero = Vector3::zero(g);
    let mut residual: Vec<ExprId> = applied
        .on_coordinates
        .iter()
        .map(|&force| g.neg(force))
        .collect();
    let mut transmitted = vec![
        Wrench {
            force: zero,
            moment: zero
        };
        mechanism.bodies.len()
    ];
    for branch in topology.branches.iter().rev() {
        let body = branch.body.index();
        let name = mechanism.bodies[body].name.to_string();
        let motion = kinematics.of(branch.body);
        let carried = std::mem::take(&mut loads[body]);
        for (&closing, &load) in &carried {
            load.force.set_name(g, &format!("{name}_total_force"));
            load.moment.set_name(g, &format!("{name}_total_moment"));
            transmitted[body] = transmitted[body].add(g, load);
            for step in &motion.steps {
                let along = step.project(g, load.force, load.moment);
                let slot = &mut residual[step.coordinate.index()];
                *slot = g.add(*slot, along);
            }
            if let Frame::Body(parent) = branch.parent
                && closing != branch.parent
            {
                let shift = motion.frame.offset.cross(g, load.force);
                let moved = Wrench {
                    force: load.force,
                    moment: load.moment.add(g, shift),
                };
                add_load(g, &mut loads[parent.index()], closing, moved);
            }
        }
    }
    for (value, coordinate) in residual.iter().zip(&mechanism.coordinates) {
        g.set_name(*value, || format!("residual_{}", coordinate.name));
    }
    Dynamics {
        residual,
        constraints: applied.constraints,
        transmitted,
    }
}

/// Adds the inertia less the weight of every body to its loads.
fn add_inertia(
    g: &mut Graph,
    problem: &Problem,
    kinematics: &Kinematics,
    sources: Sources,
    loads: &mut [Loads],
) {
    let gravity = match sources.gravity {
        true => problem.values.vector(g, &problem.mechanism.gravity),
        false => Vector3::zero(g),
    };
    for (index, body) in problem.mechanism.bodies.iter().enumerate() {
        let with_inertia = sources.inertia.contains(BodyId::new(index));
        if !with_inertia && !sources.gravity {
            continue;
        }
        let motion = &kinematics.bodies[index].frame;
        for piece in MassDistribution::of_body(g, problem.values, body) {
            let load = inertia_wrench(g, &piece, motion, gravity, with_inertia);
            add_load(g, &mut loads[index], Frame::Ground, load);
        }
    }
}

/// Inertia less weight of one body, about its origin. Gravity enters as an acceleration of the whole frame:
///
/// `force = mass a_O + sum_k first_k W d_k`,
/// `moment = 2 isotropic alpha + sum_k d_k x (first_k a_O + sum_j second_kj W d_j)`,
///
/// from `a(rho) = a_O + W rho` integrated over the mass (see `inertia`).
fn inertia_wrench(
    g: &mut Graph,
    body: &MassDistribution,
    motion: &FrameMotion,
    gravity: Vector3,
    with_inertia: bool,
) -> Wrench {
    let zero = Vector3::zero(g);
    let origin = if with_inertia {
        motion.acceleration
    } else {
        zero
    };
    let origin = origin.sub(g, gravity);
    let arms: Vec<(Vector3, Vector3)> = body
        .arms
        .iter()
        .map(|arm| {
            let (direction, rate) = motion.carry(g, arm.direction);
            (direction, if with_inertia { rate } else { zero })
        })
        .collect();

    let mut force = origin.scale(g, body.mass);
    for (arm, (_, rate)) in body.arms.iter().zip(&arms) {
        let share = rate.scale(g, arm.first);
        force = force.add(g, share);
    }
    let mut moment = zero;
    if with_inertia {
        let twice = g.scale(2.0, body.isotropic);
        moment = motion.angular_acceleration.scale(g, twice);
    }
    for (arm, (direction, _)) in body.arms.iter().zip(&arms) {
        let mut moved = origin.scale(g, arm.first);
        for (&second, (_, rate)) in arm.second.iter().zip(&arms) {
            let share = rate.scale(g, second);
            moved = moved.add(g, share);
        }
        let share = direction.cross(g, moved);
        moment = moment.add(g, share);
    }
    Wrench { force, moment }
}

fn negated(g: &mut Graph, loads: &Loads) -> Loads {
    loads
        .iter()
        .map(|(&closing, load)| (closing, load.neg(g)))
        .collect()
}
