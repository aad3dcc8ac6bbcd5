//! Elasticity and damping of the material of beams.

use crate::algebra::{Direction, ExprId, Graph, SymbolId, Unary, Vector3, derivatives_along, gradient};
use crate::base::ids::{BeamId, PointId};
use crate::mechanics::motion::{self, bend, bend_powers};
use crate::mechanics::setup::{Context, OfBeam, Sections};

use super::strained_at::strained_at;

/// What strains at a section, and the stiffness against it: curvatures along its own axes times the length, stretch and
/// shear, each with the stiffness that gives energy over the length that the section stands for, and stiffness that
/// couples two of them.
struct Strain {
    values: Vec<ExprId>,
    stiffness: Vec<ExprId>,
    coupling: Vec<(usize, usize, ExprId)>,
}

/// Places of what strains along the second and the third axis.
const BENDING: (usize, usize) = (1, 2);
const SHEAR: (usize, usize) = (4, 5);

fn strains(g: &mut Graph, context: &Context, id: BeamId, turns: &OfBeam<ExprId>) -> Vec<Strain> {
    let beam = &context.mechanism.beams[id.index()];
    let values = context.values;
    let length = values.scalar(g, &beam.length);
    let stretched = motion::strains(g, context, id, turns);
    let sections = beam.sections.iter().zip(&turns.rotations).zip(&turns.slopes);
    sections
        .zip(stretched)
        .map(|((((_, weight, section), turn), slope), stretched)| {
            let bent = bend(g, Vector3(*turn), Vector3(*slope));
            let bent = motion::curved(g, values, section).transpose().apply(g, bent);
            let twist = values.scalar(g, &section.twist);
            let [_, shear_y, shear_z] = stretched;
            let [bent_y, bent_z] = along_own_axes(g, [bent.0[1], bent.0[2]], twist);
            let [shear_y, shear_z] = along_own_axes(g, [shear_y, shear_z], twist);
            let mut strain = Strain {
                values: vec![bent.0[0], bent_y, bent_z, stretched[0], shear_y, shear_z],
                stiffness: Vec::new(),
                coupling: Vec::new(),
            };
            for stiffness in &section.stiffness {
                let stiffness = values.scalar(g, stiffness);
                let share = g.scale(*weight, stiffness);
                strain.stiffness.push(g.div(share, length));
            }
            for stiffness in &section.against_strain {
                let stiffness = values.scalar(g, stiffness);
                let share = g.scale(*weight, stiffness);
                strain.stiffness.push(g.mul(share, length));
            }
            for (i, j, stiffness) in &section.coupling {
                let stiffness = values.scalar(g, stiffness);
                let share = g.scale(*weight, stiffness);
                let coupled = match (*i < 3, *j < 3) {
                    (true, true) => g.div(share, length),
                    (false, false) => g.mul(share, length),
                    _ => share,
                };
                strain.coupling.push((*i, *j, coupled));
            }
            strain
        })
        .collect()
}

/// Components along axes that have been turned by an angle.
fn along_own_axes(g: &mut Graph, [y, z]: [ExprId; 2], angle: ExprId) -> [ExprId; 2] {
    let (sine, cosine) = (g.unary(Unary::Sin, angle), g.unary(Unary::Cos, angle));
    let (a, b) = (g.mul(cosine, y), g.mul(sine, z));
    let (c, d) = (g.mul(sine, y), g.mul(cosine, z));
    [g.add(a, b), g.sub(d, c)]
}

impl Strain {
    /// Half the sum of stiffness times squared strain.
    fn energy(&self, g: &mut Graph) -> ExprId {
        let pairs = self.values.iter().zip(&self.stiffness);
        let terms: Vec<ExprId> = pairs
            .map(|(&value, &stiffness)| {
                let square = g.mul(value, value);
                let twice = g.mul(stiffness, square);
                g.scale(0.5, twice)
            })
            .collect();
        let mut energy = g.sum(terms);
        for &(i, j, stiffness) in &self.coupling {
            let product = g.mul(self.values[i], self.values[j]);
            let share = g.mul(stiffness, product);
            energy = g.add(energy, share);
        }
        energy
    }

    /// Stresses of strains of any values.
    fn stresses(&self, g: &mut Graph, values: &[ExprId]) -> Vec<ExprId> {
        let mut stresses: Vec<ExprId> = values.iter().zip(&self.stiffness).map(|(&a, &b)| g.mul(a, b)).collect();
        for &(i, j, stiffness) in &self.coupling {
            for (on, by) in [(i, j), (j, i)] {
                let share = g.mul(stiffness, values[by]);
                stresses[on] = g.add(stresses[on], share);
            }
        }
        stresses
    }
}

/// Stresses at the sections of a beam, each with its strain: elastic, and if the material lags, those proportional to
/// the strain and `lag` times its rate.
fn stressed(g: &mut Graph, context: &Context, id: BeamId) -> Vec<(Strain, Vec<ExprId>)> {
    let sections = context.sections;
    let beam = &context.mechanism.beams[id.index()];
    let turns = sections.by_themselves(g, id).map(|of_beam| of_beam.position);
    let spin = context.values.scalar(g, &beam.spin);
    let lag = context.values.scalar(g, &beam.lag);
    let moving = sections.position.with(&sections.velocity.values);
    let moving = Direction::new("_rate", moving.collect());
    let strains = strains(g, context, id, &turns);
    strains
        .into_iter()
        .map(|strain| {
            let mut stresses = strain.stresses(g, &strain.values);
            if !g.is(lag, 0.0) {
                let mut rates = derivatives_along(g, &strain.values, &moving);
                // material that spins beside its section sees the strain turn backwards
                for (y, z) in [BENDING, SHEAR] {
                    let (along_y, along_z) = (strain.values[y], strain.values[z]);
                    let (forwards, backwards) = (g.mul(spin, along_z), g.mul(spin, along_y));
                    rates[y] = g.add(rates[y], forwards);
                    rates[z] = g.sub(rates[z], backwards);
                }
                let lagging = strain.stresses(g, &rates);
                for (stress, lagging) in stresses.iter_mut().zip(lagging) {
                    let lagging = g.mul(lag, lagging);
                    *stress = g.add(*stress, lagging);
                }
            }
            (strain, stresses)
        })
        .collect()
}

/// Power of the stresses of all beams while the rows of the sections move at some rates.
pub(crate) fn strain_power(g: &mut Graph, context: &Context, rates: &[ExprId]) -> ExprId {
    let direction = context.sections.position.with(rates);
    let direction = Direction::new("_virtual", direction.collect());
    let mut terms = Vec::new();
    for id in (0..context.mechanism.beams.len()).map(BeamId::new) {
        for (strain, stresses) in stressed(g, context, id) {
            let rates = derivatives_along(g, &strain.values, &direction);
            terms.extend(stresses.into_iter().zip(rates).map(|(a, b)| g.mul(a, b)));
        }
    }
    g.sum(terms)
}

/// Forces of the stresses along the rows of the sections, with the sign of inertia.
pub(crate) fn strained(g: &mut Graph, context: &Context) -> Vec<ExprId> {
    let sections = context.sections;
    let mut along = vec![g.zero(); sections.rows.len()];
    for id in (0..context.mechanism.beams.len()).map(BeamId::new) {
        let turns = sections.by_themselves(g, id).map(|of_beam| of_beam.position);
        let beam = &context.mechanism.beams[id.index()];
        let rows = sections.of(id);
        for (k, (strain, stresses)) in stressed(g, context, id).into_iter().enumerate() {
            let section_rows = rows.of_section(k);
            let ids: Vec<SymbolId> = section_rows.iter().map(|&row| sections.position.ids[row]).collect();
            let section = &beam.sections[k].2;
            let twist = context.values.scalar(g, &section.twist);
            let back = g.neg(twist);
            let [y, z] = along_own_axes(g, [stresses[1], stresses[2]], back);
            let moment = motion::curved(g, context.values, section).apply(g, Vector3([stresses[0], y, z]));
            let [turn, slope] = [&turns.rotations[k], &turns.slopes[k]].map(|x| Vector3(*x));
            let powers = bend_powers(g, turn, slope, moment);
            let turning = rows.rotations[k].iter().chain(&rows.slopes[k]);
            for (row, power) in turning.zip(powers) {
                if let Some(row) = *row {
                    along[row] = g.add(along[row], power);
                }
            }
            for (&value, &stress) in strain.values.iter().zip(&stresses).skip(3) {
                for (&row, slope) in section_rows.iter().zip(gradient(g, value, &ids)) {
                    let share = g.mul(stress, slope);
                    along[row] = g.add(along[row], share);
                }
            }
        }
    }
    along
}

/// Twist rate, curvatures and elastic moment of a beam at a point of it; see
/// [`Expr::Bent`](crate::model::expression::Expr::Bent).
pub(crate) fn bent_at(g: &mut Graph, context: &Context, point: PointId) -> [ExprId; 6] {
    let Some((beam, fraction, section)) = context.mechanism.section_at(point) else {
        return [g.zero(); 6];
    };
    let [turn, slope] = Sections::at(g, context.symbols, context.topology, beam, fraction);
    let values = context.values;
    let length = values.scalar(g, &beam.length);
    let bent = bend(g, Vector3(turn), Vector3(slope));
    let bent = bent.0.map(|x| g.div(x, length));
    let lag = values.scalar(g, &beam.lag);
    let spin = values.scalar(g, &beam.spin);
    let (unknowns, rates) = (&context.symbols.q, &context.symbols.velocity);
    let moving = Direction::new("_rate", unknowns.with(&rates.values).collect());
    let rates = derivatives_along(g, &bent, &moving);
    // material that spins beside its section sees the strain turn backwards
    let (forwards, backwards) = (g.mul(spin, bent[2]), g.mul(spin, bent[1]));
    let rates = [rates[0], g.add(rates[1], forwards), g.sub(rates[2], backwards)];
    let [x, y, z] = [0, 1, 2].map(|k| {
        let lagging = g.mul(lag, rates[k]);
        g.add(bent[k], lagging)
    });
    let twist = values.scalar(g, &section.twist);
    let [against_twist, about_y, about_z] = section.stiffness.each_ref().map(|stiffness| values.scalar(g, stiffness));
    let curved = motion::curved(g, values, section);
    let [x, y, z] = curved.transpose().apply(g, Vector3([x, y, z])).0;
    let curvatures = along_own_axes(g, [y, z], twist);
    let strains = strained_at(g, context, point);
    let rates = derivatives_along(g, &strains, &moving);
    let [stretch, shear_y, shear_z] = [0, 1, 2].map(|k| {
        let lagging = g.mul(lag, rates[k]);
        g.add(strains[k], lagging)
    });
    let [shear_y, shear_z] = along_own_axes(g, [shear_y, shear_z], twist);
    let all = [x, curvatures[0], curvatures[1], stretch, shear_y, shear_z];
    let mut moments = [g.mul(against_twist, x), g.mul(about_y, curvatures[0]), g.mul(about_z, curvatures[1])];
    for (i, j, stiffness) in &section.coupling {
        let stiffness = values.scalar(g, stiffness);
        for (on, by) in [(*i, *j), (*j, *i)] {
            if let Some(moment) = moments.get_mut(on) {
                let share = g.mul(stiffness, all[by]);
                *moment = g.add(*moment, share);
            }
        }
    }
    let [mx, my, mz] = moments;
    let back = g.neg(twist);
    let [my, mz] = along_own_axes(g, [my, mz], back);
    let [mx, my, mz] = curved.apply(g, Vector3([mx, my, mz])).0;
    [bent[0], bent[1], bent[2], mx, my, mz]
}

/// Elastic energy of all beams, in terms of the unknowns.
pub(crate) fn elastic_energy(g: &mut Graph, context: &Context) -> ExprId {
    let mut terms = Vec::new();
    for id in (0..context.mechanism.beams.len()).map(BeamId::new) {
        let turns = context.sections.by_unknowns(g, context.symbols, id);
        let turns = turns.map(|turn| turn.position);
        for strain in strains(g, context, id, &turns) {
            terms.push(strain.energy(g));
        }
    }
    g.sum(terms)
}
