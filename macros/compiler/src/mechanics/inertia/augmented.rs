//! Bodies augmented by the mass they carry. A joint that turns about its seat passes on the mass it carries as a point
//! mass at the seat: the inertia force is this mass times the acceleration of the seat, plus a remainder that does not
//! depend on the motion of the seat. Equations over augmented bodies are shorter, and so are their derivatives.
//!
//! # Augmented bodies
//!
//! A joint passes the mass it carries to the body before it as a point mass at its seat, and only that part of the
//! force that does not depend on the seat's motion (`mechanics/inertia/augmented.rs`). The derivative of an equation by
//! an angle then involves only the body that turns, not everything it carries.

use crate::algebra::{ExprId, Graph, Vector3};
use crate::base::ids::BodyId;
use crate::census::taken;
use crate::mechanics::motion::{BeamMotion, BodyMotion, Kinematics};
use crate::mechanics::setup::{Context, ForceSelection, MassDistribution};
use crate::model::mechanism::Frame;

use super::flexible::BeamInertia;

/// A mass distribution about the origin of a body, in body axes: `integral rho dm = first` and
/// `integral rho rho^T dm = isotropic 1 + second`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct AugmentedBody {
    pub(crate) mass: ExprId,
    pub(crate) first: Vector3,
    pub(crate) isotropic: ExprId,
    pub(crate) second: [[ExprId; 3]; 3],
}

impl AugmentedBody {
    pub(super) fn empty(g: &mut Graph) -> Self {
        let zero = g.zero();
        Self { mass: zero, first: Vector3::zero(g), isotropic: zero, second: [[zero; 3]; 3] }
    }

    pub(super) fn add(&mut self, g: &mut Graph, piece: &MassDistribution) {
        self.mass = g.add(self.mass, piece.mass);
        self.isotropic = g.add(self.isotropic, piece.isotropic);
        for arm in &piece.arms {
            let share = arm.direction.scale(g, arm.first);
            self.first = self.first.add(g, share);
            for (&second, other) in arm.second.iter().zip(&piece.arms) {
                let weighted = arm.direction.scale(g, second);
                self.add_product(g, weighted, other.direction);
            }
        }
    }

    /// Adds a beam as it is bent, but for its mass, along the axes of its root. Returns the angular momentum of its
    /// material that spins beside the sections.
    pub(super) fn add_bent(&mut self, g: &mut Graph, beam: &BeamInertia, motion: &BeamMotion) -> Vector3 {
        for (((_, arm), &first), second) in motion.arms().zip(&beam.first).zip(&beam.second) {
            let share = arm.vector.scale(g, first);
            self.first = self.first.add(g, share);
            for (&second, (_, other)) in second.iter().zip(motion.arms()) {
                let weighted = arm.vector.scale(g, second);
                self.add_product(g, weighted, other.vector);
            }
        }
        let mut spinning = Vector3::zero(g);
        for ((section, inertia), &spin) in motion.sections.iter().zip(&beam.turning).zip(&beam.spin) {
            // the second moments of which the inertia tensor is `turning`
            let axes = section.frame.orientation.axes;
            let turning = axes.turn_symmetric(g, inertia.0.map(|column| column.0));
            let trace = g.sum((0..3).map(|k| turning[k][k]));
            let half = g.scale(0.5, trace);
            self.isotropic = g.add(self.isotropic, half);
            for (second, turning) in self.second.iter_mut().flatten().zip(turning.as_flattened()) {
                *second = g.sub(*second, *turning);
            }
            let momentum = axes.0[0].scale(g, spin);
            spinning = spinning.add(g, momentum);
        }
        spinning
    }

    /// Adds a point mass.
    fn add_point(&mut self, g: &mut Graph, mass: ExprId, vector: Vector3) {
        let share = vector.scale(g, mass);
        self.mass = g.add(self.mass, mass);
        self.first = self.first.add(g, share);
        self.add_product(g, share, vector);
    }

    /// Adds `a b^T`, which becomes symmetric in the sum.
    fn add_product(&mut self, g: &mut Graph, a: Vector3, b: Vector3) {
        for i in 0..3 {
            for j in 0..3 {
                let product = g.mul(a.0[i], b.0[j]);
                self.second[i][j] = g.add(self.second[i][j], product);
            }
        }
    }
}

/// Whether the inertia force of a body and everything it carries is the total mass times the acceleration of the
/// joint's seat, plus a remainder that does not depend on the motion of the seat.
pub(crate) fn rides_on_seat(g: &Graph, motion: &BodyMotion) -> bool {
    motion.flexure.is_none()
        && motion.frame.offset == motion.seat.offset
        && motion.steps.iter().all(|step| step.slide.is_none())
        && motion.steps.iter().all(|step| step.point.is_zero(g))
}

/// The augmented bodies, by body id.
pub(crate) fn augmented_bodies(
    g: &mut Graph,
    context: &Context,
    kinematics: &Kinematics,
    selection: ForceSelection,
) -> Vec<AugmentedBody> {
    let mut bodies = Vec::new();
    for id in (0..context.mechanism.bodies.len()).map(BodyId::new) {
        let mut augmented = AugmentedBody::empty(g);
        if selection.gravity || selection.inertia.contains(id) {
            for piece in MassDistribution::of(g, context, id) {
                augmented.add(g, &piece);
            }
            if let Some(beam) = context.mechanism.beam(id) {
                let mass = BeamInertia::new(g, context, beam).mass;
                augmented.mass = g.add(augmented.mass, mass);
            }
        }
        bodies.push(augmented);
    }
    for branch in context.topology.branches.iter().rev() {
        let motion = kinematics.of(branch.body);
        let name = &context.mechanism.bodies[branch.body.index()].name;
        let carried = bodies[branch.body.index()];
        g.set_name(carried.mass, || format!("{name}_carried_mass"));
        carried.first.set_name(g, &format!("{name}_augmented_first_moment"));
        for (row, i) in carried.second.into_iter().zip(["x", "y", "z"]) {
            for (entry, j) in row.into_iter().zip(["x", "y", "z"]) {
                g.set_name(entry, || format!("{name}_augmented_second_moment_{i}{j}"));
            }
        }
        if let Frame::Body(parent) = branch.parent
            && rides_on_seat(g, motion)
        {
            taken(|| "augmented: rides on its seat".into());
            bodies[parent.index()].add_point(g, carried.mass, motion.seat.arm);
        }
    }
    bodies
}
