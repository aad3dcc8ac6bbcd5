//! Outputs, and the quantities that they may refer to besides coordinates and points.

use crate::algebra::{ExprId, Graph, Vector3};
use crate::base::ids::{ConstraintId, JointId, PointId};
use crate::mechanics::inertia::inertial_at;
use crate::mechanics::loads::{ForceContext, bent_at, exerted, held, strained_at, transmitted};
use crate::mechanics::motion::{Kinematics, Wrench};
use crate::mechanics::setup::{Context, ForceSelection, Source, State};
use crate::model::expression::Expr;
use crate::model::mechanism::{ConstraintLaw, Frame};

use super::energy::{kinetic, potential};

/// The declared outputs.
pub(crate) fn outputs(g: &mut Graph, context: &Context, running: &[ExprId], kinematics: &Kinematics) -> Vec<ExprId> {
    let carried = carried(g, context, running, kinematics);
    let state = Everything {
        kinematics,
        reactions: reactions(g, context, kinematics, &carried),
        constraints: constraint_reactions(g, context, kinematics),
        exerted: exerted_by_forces(g, context, kinematics),
        bent: bent_beams(g, context, kinematics, &carried),
        kinetic: kinetic(g, context, kinematics),
        potential: potential(g, context, kinematics),
    };
    let outputs = &context.mechanism.outputs;
    let outputs: Vec<ExprId> =
        outputs.iter().map(|output| context.values.scalar_at(g, &output.value, &state)).collect();
    context.multiblade.in_unknowns(g, &outputs)
}

/// Everything that an output can use. Unused quantities cost nothing: code is generated only for nodes that a result
/// depends on.
struct Everything<'a> {
    kinematics: &'a Kinematics,
    /// Force and moment, by joint id.
    reactions: Vec<[Vector3; 2]>,
    /// By constraint id.
    constraints: Vec<[ExprId; 6]>,
    /// By force id.
    exerted: Vec<[ExprId; 6]>,
    /// By point id.
    bent: Vec<[ExprId; 12]>,
    kinetic: ExprId,
    potential: ExprId,
}

impl Everything<'_> {
    fn reaction(&self, joint: JointId, component: usize) -> ExprId {
        self.reactions[joint.index()][component / 3].0[component % 3]
    }
}

impl State for Everything<'_> {
    fn leaf(&self, leaf: &Expr) -> ExprId {
        match leaf {
            Expr::Reaction(joint, component) => self.reaction(*joint, *component),
            Expr::ConstraintReaction(id, component) => self.constraints[id.index()][*component],
            Expr::Exerted(force, component) => self.exerted[force.index()][*component],
            Expr::Bent(point, component) => self.bent[point.index()][*component],
            Expr::KineticEnergy => self.kinetic,
            Expr::PotentialEnergy => self.potential,
            _ => self.kinematics.leaf(leaf),
        }
    }
}

/// What each body and everything that it carries takes to move as it does, beyond the forces on them: about its origin and
/// in the common frame, by body id.
pub(crate) fn carried(g: &mut Graph, context: &Context, running: &[ExprId], kinematics: &Kinematics) -> Vec<Wrench> {
    let loads = transmitted(g, context, kinematics, ForceSelection::ALL).wrenches;
    let inertial = inertial_wrenches(g, context, running, kinematics);
    loads.into_iter().zip(inertial).map(|(load, inertial)| load.add(g, inertial)).collect()
}

/// The force and moment that the `from` side of each joint exerts on its `to` side, at the origin of the joint frame on
/// the `from` side and in its axes.
fn reactions(g: &mut Graph, context: &Context, kinematics: &Kinematics, carried: &[Wrench]) -> Vec<[Vector3; 2]> {
    let zero = Vector3::zero(g);
    let mut reactions = vec![[zero; 2]; context.mechanism.joints.len()];
    for branch in &context.topology.branches {
        let motion = kinematics.of(branch.body);
        let load = carried[branch.body.index()];
        let load = if branch.reversed { load.neg(g) } else { load };
        let shift = motion.from_origin.cross(g, load.force);
        let moment = load.moment.sub(g, shift);
        let to_axes = motion.from_axes.transpose();
        reactions[branch.joint.index()] = [to_axes.apply(g, load.force), to_axes.apply(g, moment)];
    }
    let force_context = ForceContext::new(context, kinematics);
    for &joint in &context.topology.cut {
        if let Some(load) = held(g, &force_context, Source::Joint(joint)) {
            reactions[joint.index()] = [load.force, load.moment];
        }
    }
    reactions
}

/// Inertia minus weight of a body and everything it carries, about its origin and in the common frame, by body id.
fn inertial_wrenches(g: &mut Graph, context: &Context, running: &[ExprId], kinematics: &Kinematics) -> Vec<Wrench> {
    let wrenches = inertial_at(g, context, running, ForceSelection::ALL).wrenches;
    let mut axes = vec![kinematics.ground.orientation.axes; wrenches.len()];
    for branch in &context.topology.branches {
        let index = branch.body.index();
        axes[index] = match (context.runs.layout.of(branch.body).own_axes, branch.parent) {
            (true, _) => kinematics.of(branch.body).frame.orientation.axes,
            (false, Frame::Body(parent)) => axes[parent.index()],
            (false, Frame::Ground) => kinematics.ground.orientation.axes,
        };
    }
    let parts: Vec<ExprId> = wrenches
        .iter()
        .zip(&axes)
        .flat_map(|(wrench, axes)| [wrench.force, wrench.moment].map(|v| axes.apply(g, v).0))
        .flatten()
        .collect();
    let vectors = context.in_unknowns(g, &parts);
    let vector = |c: &[ExprId]| Vector3([c[0], c[1], c[2]]);
    vectors.chunks_exact(6).map(|c| Wrench { force: vector(&c[..3]), moment: vector(&c[3..]) }).collect()
}

/// The reaction of each constraint; see [`Expr::ConstraintReaction`].
fn constraint_reactions(g: &mut Graph, context: &Context, kinematics: &Kinematics) -> Vec<[ExprId; 6]> {
    let force_context = ForceContext::new(context, kinematics);
    let zero = g.zero();
    let ids = (0..context.mechanism.constraints.len()).map(ConstraintId::new);
    ids.map(|id| {
        let source = Source::Constraint(id);
        let law = &context.mechanism.constraints[id.index()].law;
        let multiplier = |component: usize| {
            let row = context.row(source, component);
            row.map_or(zero, |row| context.multiplier(row))
        };
        match law {
            ConstraintLaw::Distance { .. } | ConstraintLaw::Equation { .. } => {
                [multiplier(0), zero, zero, zero, zero, zero]
            }
            ConstraintLaw::Rolling { .. } => {
                let [normal, forward, lateral] = [0, 1, 2].map(multiplier);
                [forward, lateral, normal, zero, zero, zero]
            }
            ConstraintLaw::Coincident { .. } | ConstraintLaw::Aligned { .. } => {
                let Some(Wrench { force, moment }) = held(g, &force_context, source) else {
                    return [zero; 6];
                };
                let ([a, b, c], [d, e, f]) = (force.0, moment.0);
                [a, b, c, d, e, f]
            }
        }
    })
    .collect()
}

/// What the beams do at the points of which an output asks for it, see [`Expr::Bent`]; zeros elsewhere.
fn bent_beams(g: &mut Graph, context: &Context, kinematics: &Kinematics, carried: &[Wrench]) -> Vec<[ExprId; 12]> {
    let mechanism = context.mechanism;
    let mut all = vec![[g.zero(); 12]; mechanism.points.len()];
    let outputs = mechanism.outputs.iter();
    for leaf in outputs.flat_map(|output| output.value.leaves()) {
        let Expr::Bent(point, component) = leaf else {
            continue;
        };
        let values = &mut all[point.index()];
        match component / 3 {
            0 | 1 => values[..6].copy_from_slice(&bent_at(g, context, *point)),
            2 => values[6..9].copy_from_slice(&strained_at(g, context, *point)),
            _ => {
                let force = force_inside(g, context, kinematics, (*point, carried));
                values[9..].copy_from_slice(&force.0);
            }
        }
    }
    all
}

/// The force that the outer part of a beam exerts on the inner one at a point where it is divided, along the beam, across
/// it and up.
fn force_inside(
    g: &mut Graph,
    context: &Context,
    kinematics: &Kinematics,
    (point, carried): (PointId, &[Wrench]),
) -> Vector3 {
    let mechanism = context.mechanism;
    let frame = mechanism.points[point.index()].frame;
    let (Frame::Body(body), Some((beam, ..))) = (frame, mechanism.section_at(point)) else {
        return Vector3::zero(g);
    };
    let axes = kinematics.of(body).frame.orientation.axes.transpose();
    let force = axes.apply(g, carried[body.index()].force).neg(g);
    Vector3(beam.axes.each_ref().map(|axis| context.values.vector(g, axis)).map(|axis| axis.dot(g, force)))
}

/// What each force element exerts; only where an output asks for it, zeros elsewhere.
fn exerted_by_forces(g: &mut Graph, context: &Context, kinematics: &Kinematics) -> Vec<[ExprId; 6]> {
    let mechanism = context.mechanism;
    let mut all = vec![[g.zero(); 6]; mechanism.forces.len()];
    let force_context = ForceContext::new(context, kinematics);
    for leaf in mechanism.outputs.iter().flat_map(|output| output.value.leaves()) {
        if let Expr::Exerted(id, _) = leaf {
            let force = &mechanism.forces[id.index()];
            all[id.index()] = exerted(g, &force_context, force);
        }
    }
    all
}
