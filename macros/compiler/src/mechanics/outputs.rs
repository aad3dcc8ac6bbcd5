//! Outputs: what they may refer to beyond coordinates and points.

use crate::algebra::{Graph, Vector3};
use crate::base::ids::{ConstraintId, ExprId, JointId};
use crate::model::expression::Expr;
use crate::model::mechanism::{ConstraintLaw, Frame};

use super::constraints::{Source, held};
use super::energy::{kinetic, potential};
use super::forces::Wrench;
use super::kinematics::Kinematics;
use super::loads::transmitted;
use super::problem::Problem;
use super::setting::Setting;
use super::sources::Sources;
use super::values::State;

/// The declared outputs.
pub(super) fn outputs(
    g: &mut Graph,
    problem: &Problem,
    running: &[ExprId],
    kinematics: &Kinematics,
) -> Vec<ExprId> {
    let state = Everything {
        kinematics,
        reactions: reactions(g, problem, running, kinematics),
        constraints: constraint_reactions(g, problem, kinematics),
        kinetic: kinetic(g, problem, kinematics),
        potential: potential(g, problem, kinematics),
    };
    let outputs = &problem.mechanism.outputs;
    outputs
        .iter()
        .map(|output| problem.values.scalar_at(g, &output.value, &state))
        .collect()
}

/// All that an output can be made of. What none asks for costs nothing: only what results reach is generated.
struct Everything<'a> {
    kinematics: &'a Kinematics,
    /// By joint id: force and moment.
    reactions: Vec<[Vector3; 2]>,
    /// By constraint id.
    constraints: Vec<[ExprId; 6]>,
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
            Expr::KineticEnergy => self.kinetic,
            Expr::PotentialEnergy => self.potential,
            _ => self.kinematics.leaf(leaf),
        }
    }
}

/// What the `from` side of each joint exerts on its `to` side: force and moment at the origin of the joint frame on the
/// `from` side, along its axes.
fn reactions(
    g: &mut Graph,
    problem: &Problem,
    running: &[ExprId],
    kinematics: &Kinematics,
) -> Vec<[Vector3; 2]> {
    let loads = transmitted(g, problem, kinematics, Sources::ALL).wrenches;
    let inertial = inertial_wrenches(g, problem, running, kinematics);
    let zero = Vector3::zero(g);
    let mut reactions = vec![[zero; 2]; problem.mechanism.joints.len()];
    for branch in &problem.topology.branches {
        let motion = kinematics.of(branch.body);
        let index = branch.body.index();
        let load = loads[index].add(g, inertial[index]);
        let load = if branch.reversed { load.neg(g) } else { load };
        let shift = motion.from_origin.cross(g, load.force);
        let moment = load.moment.sub(g, shift);
        let to_axes = motion.from_axes.transpose();
        reactions[branch.joint.index()] = [to_axes.apply(g, load.force), to_axes.apply(g, moment)];
    }
    let setting = Setting::new(problem, kinematics);
    for &joint in &problem.topology.cut {
        if let Some(load) = held(g, &setting, Source::Joint(joint)) {
            reactions[joint.index()] = [load.force, load.moment];
        }
    }
    reactions
}

/// By body id: inertia less weight of a body and all it carries, about its origin, in the common frame.
fn inertial_wrenches(
    g: &mut Graph,
    problem: &Problem,
    running: &[ExprId],
    kinematics: &Kinematics,
) -> Vec<Wrench> {
    let wrenches = problem.inertial(g, running, Sources::ALL).wrenches;
    let mut axes = vec![kinematics.ground.orientation.axes; wrenches.len()];
    for branch in &problem.topology.branches {
        let index = branch.body.index();
        axes[index] = match (problem.runs.layout.of(branch.body).own_axes, branch.parent) {
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
    let vectors = problem.in_unknowns(g, &parts);
    let vector = |c: &[ExprId]| Vector3([c[0], c[1], c[2]]);
    vectors
        .chunks_exact(6)
        .map(|c| Wrench {
            force: vector(&c[..3]),
            moment: vector(&c[3..]),
        })
        .collect()
}

/// What each constraint exerts; see [`Expr::ConstraintReaction`].
fn constraint_reactions(
    g: &mut Graph,
    problem: &Problem,
    kinematics: &Kinematics,
) -> Vec<[ExprId; 6]> {
    let setting = Setting::new(problem, kinematics);
    let zero = g.zero();
    let ids = (0..problem.mechanism.constraints.len()).map(ConstraintId::new);
    ids.map(|id| {
        let source = Source::Constraint(id);
        let law = &problem.mechanism.constraints[id.index()].law;
        let multiplier = |component: usize| {
            let row = problem.row(source, component);
            row.map_or(zero, |row| problem.multiplier(row))
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
                let Some(Wrench { force, moment }) = held(g, &setting, source) else {
                    return [zero; 6];
                };
                let ([a, b, c], [d, e, f]) = (force.0, moment.0);
                [a, b, c, d, e, f]
            }
        }
    })
    .collect()
}
