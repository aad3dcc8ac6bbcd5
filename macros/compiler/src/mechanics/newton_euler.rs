//! The residual of the equations of motion: forces and moments summed from the leaves towards the ground and projected
//! on the joint axes.

use crate::algebra::{Graph, Vector3};
use crate::base::ids::{BodyId, ExprId};
use crate::model::mechanism::{Frame, JointKind, Mechanism};
use crate::topology::Topology;

use super::forces::{AppliedForces, Loads, Wrench};
use super::inertia::MassDistribution;
use super::kinematics::{FrameMotion, Kinematics};
use super::sources::Sources;
use super::values::Values;

/// `g(qddot, qdot, q; u, b)` by coordinate id (THEORY eq. 12): inertia less applied forces along each coordinate.
pub(super) fn residual(
    g: &mut Graph,
    mechanism: &Mechanism,
    topology: &Topology,
    values: &Values,
    kinematics: &Kinematics,
    sources: Sources,
) -> Vec<ExprId> {
    let gravity = if sources.gravity {
        values.vector(g, &mechanism.gravity)
    } else {
        Vector3::zero(g)
    };
    let applied = AppliedForces::new(g, mechanism, topology, values, kinematics, sources);
    let mut loads: Vec<Loads> = applied.on_bodies.iter().map(|on| negated(g, on)).collect();
    for (index, body) in mechanism.bodies.iter().enumerate() {
        let with_inertia = sources.inertia.contains(BodyId::new(index));
        if !with_inertia && !sources.gravity {
            continue;
        }
        if let Some(mass) = MassDistribution::new(g, values, &body.shape) {
            mass.set_names(g, &body.name.to_string());
            let motion = &kinematics.bodies[index].frame;
            let load = inertia_wrench(g, &mass, motion, gravity, with_inertia);
            add(g, &mut loads[index], Frame::Ground, load);
        }
    }

    let mut residual: Vec<ExprId> = applied
        .on_coordinates
        .iter()
        .map(|&force| g.neg(force))
        .collect();
    for branch in topology.branches.iter().rev() {
        let name = mechanism.bodies[branch.body.index()].name.to_string();
        let motion = *kinematics.of(branch.body);
        let carried = std::mem::take(&mut loads[branch.body.index()]);
        let joint = &mechanism.joints[branch.joint.index()];
        for (&closing, &load) in &carried {
            load.force.set_name(g, &format!("{name}_total_force"));
            load.moment.set_name(g, &format!("{name}_total_moment"));
            let along = match &joint.kind {
                JointKind::Fixed => None,
                JointKind::Revolute { coordinate, .. } => {
                    let shift = motion.joint_point.cross(g, load.force);
                    let moment = load.moment.sub(g, shift);
                    Some((coordinate, motion.joint_axis.dot(g, moment)))
                }
                JointKind::Prismatic { coordinate, .. } => {
                    Some((coordinate, motion.joint_axis.dot(g, load.force)))
                }
            };
            if let Some((coordinate, projection)) = along {
                let slot = &mut residual[coordinate.index()];
                *slot = g.add(*slot, projection);
            }
            if let Frame::Body(parent) = branch.parent
                && closing != branch.parent
            {
                let shift = motion.from_parent.cross(g, load.force);
                let moved = Wrench {
                    force: load.force,
                    moment: load.moment.add(g, shift),
                };
                add(g, &mut loads[parent.index()], closing, moved);
            }
        }
    }
    for (index, &value) in residual.iter().enumerate() {
        g.set_name(value, || {
            format!("residual_{}", mechanism.coordinates[index].name)
        });
    }
    residual
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

fn add(g: &mut Graph, loads: &mut Loads, closing: Frame, load: Wrench) {
    let sum = match loads.get(&closing) {
        Some(so_far) => so_far.add(g, load),
        None => load,
    };
    loads.insert(closing, sum);
}

fn negated(g: &mut Graph, loads: &Loads) -> Loads {
    loads
        .iter()
        .map(|(&closing, load)| {
            (
                closing,
                Wrench {
                    force: load.force.neg(g),
                    moment: load.moment.neg(g),
                },
            )
        })
        .collect()
}
