//! The residual of the equations of motion and of the constraints.

use crate::algebra::{ExprId, Graph};
use crate::mechanics::inertia::{BeamForces, Inertial, inertial_at};
use crate::mechanics::loads::{strain_power, strained, transmitted};
use crate::mechanics::motion::Kinematics;
use crate::mechanics::setup::{Context, ForceSelection, Selection, weighted_sum};

/// The residual in two parts. The total is their sum once the first has been transformed from absolute angles to the
/// unknowns.
pub(crate) struct Residual {
    /// By unknown, then by row of the sections of beams: inertia minus weight and the strain of beams, in terms of the
    /// absolute angles and the sections.
    pub(crate) inertial: Vec<ExprId>,
    /// By unknown: forces and constraints, with the sign of inertia.
    pub(crate) applied: Vec<ExprId>,
    beams: Vec<BeamForces>,
}

impl Residual {
    /// The equations along free and coasting coordinates, followed by those of constraints. `kinematics` is the motion
    /// with the running coordinates at `running`.
    pub(crate) fn new(
        g: &mut Graph,
        context: &Context,
        running: &[ExprId],
        kinematics: &Kinematics,
        selection: ForceSelection,
    ) -> Self {
        let Inertial { along: inertial, along_sections, beams, .. } = inertial_at(g, context, running, selection);
        let strained = match selection.forces {
            Selection::All => strained(g, context),
            Selection::One(_) | Selection::None => vec![g.zero(); along_sections.len()],
        };
        let sections = along_sections.into_iter().zip(strained);
        let sections: Vec<ExprId> = sections.map(|(a, b)| g.add(a, b)).collect();
        let loads = transmitted(g, context, kinematics, selection);
        let topology = context.topology;
        let moving = || topology.free.iter().chain(&topology.coasting);
        let zeros = loads.constraints.iter().map(|_| g.zero());
        Self {
            beams,
            inertial: moving().map(|id| inertial[id.index()]).chain(zeros).chain(sections).collect(),
            applied: moving().map(|id| loads.along[id.index()]).chain(loads.constraints.iter().copied()).collect(),
        }
    }

    /// The power of all forces while the unknowns move at some rates: the sum of the equations, each times its rate. Of
    /// beams, the forces on each section are contracted before anything is differentiated.
    pub(crate) fn power(&self, g: &mut Graph, context: &Context, total: &[ExprId], rates: &[ExprId]) -> ExprId {
        if self.beams.is_empty() {
            return weighted_sum(g, rates, total);
        }
        let rates = &context.multiblade.rates(g, rates);
        let inertial = context.runs.forces(g, &self.inertial);
        let along_sections = context.sections.rates(g, rates);
        let mut terms = vec![weighted_sum(g, rates, &inertial[..rates.len()])];
        for beam in &self.beams {
            let motion = (beam.id, &beam.motion);
            terms.push(beam.load.power(g, context.sections, motion, &along_sections));
        }
        terms.push(strain_power(g, context, &along_sections));
        let sum = g.sum(terms);
        let power = context.in_unknowns(g, &[sum])[0];
        let applied = weighted_sum(g, rates, &self.applied);
        let power = g.add(power, applied);
        context.multiblade.in_unknowns(g, &[power])[0]
    }

    /// The sum of both parts.
    pub(crate) fn total(&self, g: &mut Graph, context: &Context) -> Vec<ExprId> {
        let inertial = context.runs.forces(g, &self.inertial);
        let inertial = context.sections.forces(g, &inertial);
        let inertial = context.in_unknowns(g, &inertial);
        let sums: Vec<ExprId> =
            inertial.into_iter().zip(&self.applied).map(|(inertial, &applied)| g.add(inertial, applied)).collect();
        let sums = context.multiblade.forces(g, &sums);
        let sums = context.multiblade.in_unknowns(g, &sums);
        let topology = context.topology;
        let coordinates = topology.free.iter().chain(&topology.coasting);
        for (&value, id) in sums.iter().zip(coordinates) {
            let name = &context.mechanism.coordinates[id.index()].name;
            g.set_name(value, || format!("residual_{name}"));
        }
        sums
    }
}
