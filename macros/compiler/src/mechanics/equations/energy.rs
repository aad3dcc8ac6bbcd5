//! Kinetic and potential energy, for outputs.

use crate::algebra::{ExprId, Graph};
use crate::base::ids::{BeamId, BodyId};
use crate::mechanics::inertia::BeamInertia;
use crate::mechanics::loads::elastic_energy;
use crate::mechanics::motion::Kinematics;
use crate::mechanics::setup::{Context, MassDistribution};
use crate::model::mechanism::ForceLaw;

/// `integral |v_O + omega x rho|^2 dm / 2` over all bodies, and `inertance qdot^2 / 2` of inerters.
pub(crate) fn kinetic(g: &mut Graph, context: &Context, kinematics: &Kinematics) -> ExprId {
    let mut twice = g.zero();
    for (index, motion) in kinematics.bodies.iter().enumerate() {
        let (v, omega) = (motion.frame.velocity, motion.frame.angular_velocity);
        for piece in MassDistribution::of(g, context, BodyId::new(index)) {
            let rates: Vec<_> = piece
                .arms
                .iter()
                .map(|arm| {
                    let (arm, _) = motion.frame.carry(g, arm.direction);
                    omega.cross(g, arm)
                })
                .collect();
            let speed = v.dot(g, v);
            let turning = omega.dot(g, omega);
            let double_isotropic = g.scale(2.0, piece.isotropic);
            let mut terms = vec![g.mul(piece.mass, speed), g.mul(double_isotropic, turning)];
            for (arm, rate) in piece.arms.iter().zip(&rates) {
                let along = v.dot(g, *rate);
                let double_first = g.scale(2.0, arm.first);
                terms.push(g.mul(double_first, along));
                for (&second, other) in arm.second.iter().zip(&rates) {
                    let product = rate.dot(g, *other);
                    terms.push(g.mul(second, product));
                }
            }
            let sum = g.sum(terms);
            twice = g.add(twice, sum);
        }
    }
    for (index, beam) in context.mechanism.beams.iter().enumerate() {
        let inertia = BeamInertia::new(g, context, BeamId::new(index));
        let v = kinematics.of(beam.body).frame.velocity;
        let share = inertia.twice_kinetic(g, &kinematics.beams[index], v);
        twice = g.add(twice, share);
    }
    for force in &context.mechanism.forces {
        if let ForceLaw::CoordinateInerter { coordinates: [one, other], inertance } = &force.law {
            let inertance = context.values.scalar(g, inertance);
            let [velocity, across] = [one, other].map(|id| kinematics.coordinates[id.index()].velocity);
            let square = g.mul(velocity, across);
            let both = g.scale(if one == other { 1.0 } else { 2.0 }, square);
            let share = g.mul(inertance, both);
            twice = g.add(twice, share);
        }
    }
    g.scale(0.5, twice)
}

/// Energy of gravity, springs and declared potentials; zero at the ground's origin and at the free lengths. The
/// resolver rejects it if some force has no potential.
pub(crate) fn potential(g: &mut Graph, context: &Context, kinematics: &Kinematics) -> ExprId {
    let values = context.values;
    let gravity = values.vector(g, &context.mechanism.gravity);
    let mut energy = g.zero();
    for (index, motion) in kinematics.bodies.iter().enumerate() {
        for piece in MassDistribution::of(g, context, BodyId::new(index)) {
            let mut first = motion.frame.position.scale(g, piece.mass);
            for arm in &piece.arms {
                let (direction, _) = motion.frame.carry(g, arm.direction);
                let share = direction.scale(g, arm.first);
                first = first.add(g, share);
            }
            let work = gravity.dot(g, first);
            energy = g.sub(energy, work);
        }
    }
    for (index, beam) in context.mechanism.beams.iter().enumerate() {
        let inertia = BeamInertia::new(g, context, BeamId::new(index));
        let mut first = kinematics.of(beam.body).frame.position.scale(g, inertia.mass);
        let arms = kinematics.beams[index].arms();
        for ((_, arm), &share) in arms.zip(&inertia.first) {
            let share = arm.vector.scale(g, share);
            first = first.add(g, share);
        }
        let work = gravity.dot(g, first);
        energy = g.sub(energy, work);
    }
    let strained = elastic_energy(g, context);
    energy = g.add(energy, strained);
    for force in &context.mechanism.forces {
        let share = match &force.law {
            ForceLaw::CoordinateSpring { coordinate, stiffness, rest } => {
                let (stiffness, rest) = (values.scalar(g, stiffness), values.scalar(g, rest));
                let position = kinematics.coordinates[coordinate.index()].position;
                quadratic(g, stiffness, position, rest)
            }
            ForceLaw::SpringDamper { from, to, stiffness, length, .. } => {
                let (stiffness, length) = (values.scalar(g, stiffness), values.scalar(g, length));
                let [start, end] = [from, to].map(|id| kinematics.points[id.index()].position);
                let distance = end.sub(g, start).norm(g);
                quadratic(g, stiffness, distance, length)
            }
            ForceLaw::Potential { energy } => values.scalar_at(g, energy, kinematics),
            ForceLaw::CoordinateDamper { .. }
            | ForceLaw::CoordinateInerter { .. }
            | ForceLaw::Tension { .. }
            | ForceLaw::Generalized { .. }
            | ForceLaw::Bushing { .. }
            | ForceLaw::Load { .. }
            | ForceLaw::Distributed { .. }
            | ForceLaw::Drag { .. } => continue,
        };
        energy = g.add(energy, share);
    }
    energy
}

/// `stiffness (x - rest)^2 / 2`.
fn quadratic(g: &mut Graph, stiffness: ExprId, x: ExprId, rest: ExprId) -> ExprId {
    let stretch = g.sub(x, rest);
    let square = g.mul(stretch, stretch);
    let twice = g.mul(stiffness, square);
    g.scale(0.5, twice)
}
