//! Elasticity and damping of the material of beams.

use crate::algebra::{Direction, Graph, Unary, Vector3, derivatives_along, gradient};
use crate::base::ids::{BeamId, ExprId, SymbolId};
use crate::mechanics::motion::curvature;
use crate::mechanics::setup::{Context, OfBeam};

/// The curvatures of a section along its own axes, times the length, and its stiffnesses over the length times its
/// share of it.
struct Strain {
    curvatures: [ExprId; 3],
    stiffness: [ExprId; 3],
}

fn strains(g: &mut Graph, context: &Context, id: BeamId, turns: &OfBeam<ExprId>) -> Vec<Strain> {
    let beam = &context.mechanism.beams[id.index()];
    let values = context.values;
    let length = values.scalar(g, &beam.length);
    let sections = beam
        .sections
        .iter()
        .zip(&turns.rotations)
        .zip(&turns.slopes);
    sections
        .map(|(((_, weight, section), turn), slope)| {
            let bent = curvature(g, Vector3(*turn), Vector3(*slope));
            let twist = values.scalar(g, &section.twist);
            let (sine, cosine) = (g.unary(Unary::Sin, twist), g.unary(Unary::Cos, twist));
            let [x, y, z] = bent.0;
            let (ay, az) = (g.mul(cosine, y), g.mul(sine, z));
            let (by, bz) = (g.mul(sine, y), g.mul(cosine, z));
            let curvatures = [x, g.add(ay, az), g.sub(bz, by)];
            let stiffness = section.stiffness.each_ref().map(|stiffness| {
                let stiffness = values.scalar(g, stiffness);
                let share = g.scale(*weight, stiffness);
                g.div(share, length)
            });
            Strain {
                curvatures,
                stiffness,
            }
        })
        .collect()
}

impl Strain {
    /// `sum D kappa^2 / 2` over the length that the section stands for.
    fn energy(&self, g: &mut Graph) -> ExprId {
        let terms: Vec<ExprId> = self
            .curvatures
            .iter()
            .zip(&self.stiffness)
            .map(|(&curvature, &stiffness)| {
                let square = g.mul(curvature, curvature);
                let twice = g.mul(stiffness, square);
                g.scale(0.5, twice)
            })
            .collect();
        g.sum(terms)
    }
}

/// Forces along the rows of the sections, with the sign of inertia: elastic, and if the material lags, those of
/// moments `D (kappa + lag kappa')`.
pub(crate) fn strained(g: &mut Graph, context: &Context) -> Vec<ExprId> {
    let sections = context.sections;
    let mut along = vec![g.zero(); sections.rows.len()];
    for id in (0..context.mechanism.beams.len()).map(BeamId::new) {
        let turns = sections.by_themselves(g, id).map(|own| own.position);
        let lag = context
            .values
            .scalar(g, &context.mechanism.beams[id.index()].lag);
        let rows = sections.of(id);
        let rows = rows.rotations.iter().zip(&rows.slopes);
        for (strain, (turn, slope)) in strains(g, context, id, &turns).iter().zip(rows) {
            let own: Vec<usize> = turn.iter().chain(slope).flatten().copied().collect();
            let ids: Vec<SymbolId> = own.iter().map(|&row| sections.position.ids[row]).collect();
            let energy = strain.energy(g);
            let mut forces = gradient(g, energy, &ids);
            if !g.is(lag, 0.0) {
                let rates = own
                    .iter()
                    .map(|&row| (sections.position.ids[row], sections.velocity.values[row]));
                let direction = Direction::new("_rate", rates.collect());
                let rates = derivatives_along(g, &strain.curvatures, &direction);
                for k in 0..3 {
                    let moment = g.mul(strain.stiffness[k], rates[k]);
                    let moment = g.mul(lag, moment);
                    let slopes = gradient(g, strain.curvatures[k], &ids);
                    for (force, slope) in forces.iter_mut().zip(slopes) {
                        let share = g.mul(moment, slope);
                        *force = g.add(*force, share);
                    }
                }
            }
            for (row, force) in own.into_iter().zip(forces) {
                along[row] = g.add(along[row], force);
            }
        }
    }
    along
}

/// Elastic energy of all beams, in terms of the unknowns.
pub(crate) fn elastic_energy(g: &mut Graph, context: &Context) -> ExprId {
    let mut terms = Vec::new();
    for id in (0..context.mechanism.beams.len()).map(BeamId::new) {
        let turns = context.sections.by_unknowns(g, context.symbols, id);
        let turns = turns.map(|own| own.position);
        for strain in strains(g, context, id, &turns) {
            terms.push(strain.energy(g));
        }
    }
    g.sum(terms)
}
