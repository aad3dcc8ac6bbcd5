//! Stretch and shear of beams: the direction of a beam relative to its sections.
//!
//! The direction is `(1 + e - |g|^2 / 2, g2, g3)` along the axes of the section, of unit length to second order without
//! stretch `e`, so that shear leaves the length of the beam as it is. Stretch and shear are coordinates, or shear follows
//! statically from the change of the bending moments, `g2 = -(EI3 kappa3)' / kGA2`, `g3 = (EI2 kappa2)' / kGA3`.

use crate::algebra::{Direction, ExprId, Graph, SymbolId, Unary, Vector3, derivatives_along, gradient};
use crate::base::ids::BeamId;
use crate::mechanics::setup::{Context, OfBeam};

use super::bend::{bend, bend_change};
use super::unbent::curved;

/// The direction of a beam at a section, along the axes that the section has without twist and prebend.
#[derive(Clone, Debug)]
pub(crate) struct Heading {
    pub(crate) value: Vector3,
    pub(crate) rate: Vector3,
    pub(crate) second: Vector3,
    /// Derivatives by rows of the sections.
    pub(crate) slopes: Vec<(usize, Vector3)>,
}

impl Heading {
    /// A vector that only turns.
    pub(super) fn fixed(g: &mut Graph, value: Vector3) -> Self {
        let zero = Vector3::zero(g);
        Self { value, rate: zero, second: zero, slopes: Vec::new() }
    }
}

/// The directions at the sections of a beam, in terms of the sections' own symbols.
pub(crate) fn headings(g: &mut Graph, context: &Context, id: BeamId, moves: bool) -> Vec<Heading> {
    let sections = context.sections;
    let rows = sections.of(id);
    let turns = sections.by_themselves(g, id).map(|of_beam| of_beam.position);
    let strains = strains(g, context, id, &turns);
    let one = g.constant(1.0);
    let zero = Vector3::zero(g);
    let mut headings = Vec::new();
    for (k, [stretch, across, up]) in strains.into_iter().enumerate() {
        let squares = [g.mul(across, across), g.mul(up, up)];
        let sum = g.add(squares[0], squares[1]);
        let half = g.scale(0.5, sum);
        let longer = g.add(one, stretch);
        let tangent = Vector3([g.sub(longer, half), across, up]);
        let section = &context.mechanism.beams[id.index()].sections[k].2;
        let value = curved(g, context.values, section).apply(g, tangent);
        let section_rows = rows.of_section(k);
        let ids: Vec<SymbolId> = section_rows.iter().map(|&row| sections.position.ids[row]).collect();
        let by_component = value.0.map(|component| gradient(g, component, &ids));
        let slopes = section_rows.iter().enumerate().map(|(i, &row)| {
            let slope = Vector3([0, 1, 2].map(|c| by_component[c][i]));
            (row, slope)
        });
        let slopes = slopes.filter(|(_, slope)| !slope.is_zero(g)).collect();
        let (mut rate, mut second) = (zero, zero);
        if moves {
            let speeds = section_rows.iter().map(|&row| (sections.position.ids[row], sections.velocity.values[row]));
            let growths =
                section_rows.iter().map(|&row| (sections.velocity.ids[row], sections.acceleration.values[row]));
            let along = Direction::new("_rate", speeds.clone().collect());
            rate = vector(&derivatives_along(g, &value.0, &along));
            let along = Direction::new("_rate", speeds.chain(growths).collect());
            second = vector(&derivatives_along(g, &rate.0, &along));
        }
        headings.push(Heading { value, rate, second, slopes });
    }
    headings
}

/// [`headings`] in terms of the unknowns.
pub(crate) fn headings_in_unknowns(g: &mut Graph, context: &Context, id: BeamId) -> Vec<Heading> {
    let mut headings = headings(g, context, id, true);
    let mut all: Vec<&mut Vector3> = Vec::new();
    for Heading { value, rate, second, slopes } in &mut headings {
        all.extend([value, rate, second]);
        all.extend(slopes.iter_mut().map(|(_, slope)| slope));
    }
    let components: Vec<ExprId> = all.iter().flat_map(|vector| vector.0).collect();
    let written = context.in_unknowns(g, &components);
    for (to, written) in all.into_iter().zip(written.chunks(3)) {
        *to = vector(written);
    }
    headings
}

fn vector(components: &[ExprId]) -> Vector3 {
    Vector3([components[0], components[1], components[2]])
}

/// Stretch, and shear along the second and the third axis, at the sections of a beam that turns like `turns`.
pub(crate) fn strains(g: &mut Graph, context: &Context, id: BeamId, turns: &OfBeam<ExprId>) -> Vec<[ExprId; 3]> {
    let beam = &context.mechanism.beams[id.index()];
    if !beam.static_shear {
        return turns.strains.clone();
    }
    let values = context.values;
    let rule = beam.quadrature();
    let stiffness: Vec<[ExprId; 3]> = beam
        .sections
        .iter()
        .map(|(_, _, section)| {
            let [_, about_y, about_z] = section.stiffness.each_ref().map(|stiffness| values.scalar(g, stiffness));
            let twist = values.scalar(g, &section.twist);
            turned(g, [about_y, about_z], twist)
        })
        .collect();
    let slopes = rule.slopes();
    let length = values.scalar(g, &beam.length);
    let square = g.mul(length, length);
    (0..beam.sections.len())
        .map(|k| {
            let section = &beam.sections[k].2;
            let [rotation, slope, curl] = [&turns.rotations, &turns.slopes, &turns.curls].map(|list| Vector3(list[k]));
            let bent = bend(g, rotation, slope);
            let change = bend_change(g, rotation, slope, curl);
            let mut grown = |component: usize| {
                let all = stiffness.iter().map(|x| x[component]);
                if all.clone().all(|x| x == stiffness[k][component]) {
                    return g.zero();
                }
                let terms: Vec<ExprId> = all.zip(&slopes[k]).map(|(x, share)| g.scale(*share, x)).collect();
                g.sum(terms)
            };
            let growth = [0, 1, 2].map(&mut grown);
            let times = |g: &mut Graph, [yy, yz, zz]: [ExprId; 3], v: Vector3| {
                let [_, y, z] = v.0;
                let (a, b) = (g.mul(yy, y), g.mul(yz, z));
                let (c, d) = (g.mul(yz, y), g.mul(zz, z));
                [g.add(a, b), g.add(c, d)]
            };
            let (moments, growing) = (times(g, stiffness[k], change), times(g, growth, bent));
            let about_y = g.add(moments[0], growing[0]);
            let about_z = g.add(moments[1], growing[1]);
            let [_, shear_y, shear_z] =
                section.against_strain.each_ref().map(|against_strain| values.scalar(g, against_strain));
            let one = g.constant(1.0);
            let mut compliance = |stiffness: ExprId| {
                let of_length = g.mul(stiffness, square);
                if g.is(stiffness, 0.0) { stiffness } else { g.div(one, of_length) }
            };
            let compliances = [compliance(shear_y), compliance(shear_z)];
            let twist = values.scalar(g, &section.twist);
            let [yy, yz, zz] = turned(g, compliances, twist);
            let minus = g.neg(about_z);
            let (a, b) = (g.mul(yy, minus), g.mul(yz, about_y));
            let (c, d) = (g.mul(yz, minus), g.mul(zz, about_y));
            [turns.strains[k][0], g.add(a, b), g.add(c, d)]
        })
        .collect()
}

/// A symmetric matrix with two principal values, along the axes that its own have been turned from by an angle.
pub(crate) fn turned(g: &mut Graph, [y, z]: [ExprId; 2], angle: ExprId) -> [ExprId; 3] {
    let (sine, cosine) = (g.unary(Unary::Sin, angle), g.unary(Unary::Cos, angle));
    let (ss, cc) = (g.mul(sine, sine), g.mul(cosine, cosine));
    let sc = g.mul(sine, cosine);
    let (a, b) = (g.mul(cc, y), g.mul(ss, z));
    let (c, d) = (g.mul(ss, y), g.mul(cc, z));
    let difference = g.sub(y, z);
    [g.add(a, b), g.mul(sc, difference), g.add(c, d)]
}
