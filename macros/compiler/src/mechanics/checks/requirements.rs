//! Requirements on bodies and constraints at run time, for any design values: positive masses, lengths and sections, and
//! physically possible inertias.
//!
//! # Requirements travel with the kernels
//!
//! A negative mass gives finite but meaningless matrices. The compiler therefore emits `violation`, which names the
//! first physical requirement that design values break; solvers and Monte Carlo call it first. Inertias are judged per
//! group of bodies welded by fixed joints (`model/welded.rs`), not body by body. Similarly `pose_margin` tells how far
//! a joint of three turns is from the pose in which its coordinates fail.

use crate::algebra::{ExprId, Graph, Vector3};
use crate::mechanics::functions::Requirement;
use crate::mechanics::setup::{MassDistribution, Values};
use crate::model::inertia::is_inertia_of_a_body;
use crate::model::mechanism::{Body, ConstraintLaw, CurveArgument, Mechanism};
use crate::model::shape::{Reduced, Spread};
use crate::model::welded::{Member, groups};

/// Fraction of the trace below which a principal second moment counts as zero: a flat body has one that is exactly
/// zero, and rounding must not make it negative.
const FLATNESS: f64 = 1e-9;

/// The requirements that depend on inputs or design variables; constants are checked with the declaration.
pub(crate) fn requirements(g: &mut Graph, mechanism: &Mechanism, values: &Values) -> Vec<Requirement> {
    let mut list = Vec::new();
    for body in &mechanism.bodies {
        let name = &body.name;
        for part in &body.parts {
            let Reduced { mass, positive, .. } = part.shape.reduced();
            for (quantity, value) in std::iter::once(("mass", mass.clone())).chain(positive) {
                list.push(Requirement {
                    quantity: format!("{quantity} of {name}"),
                    requirement: "positive",
                    value: values.scalar(g, &value),
                });
            }
        }
        if body.parts.iter().any(|part| part.hole) {
            let pieces = MassDistribution::of_body(g, values, body);
            let (mass, second) = central_moments(g, pieces);
            list.push(Requirement { quantity: format!("mass of {name}"), requirement: "positive", value: mass });
            if !is_in_doubt(g, values, body) {
                list.extend(inertia_of_a_body(g, &name.to_string(), second));
            }
        }
    }
    for group in groups(mechanism.bodies.len(), &mechanism.joints) {
        list.extend(inertia_together(g, mechanism, values, &group));
    }
    for constraint in &mechanism.constraints {
        let (quantity, value) = match &constraint.law {
            ConstraintLaw::Distance { length, .. } => ("length", length),
            ConstraintLaw::Rolling { radius, .. } => ("radius", radius),
            ConstraintLaw::Coincident { .. } | ConstraintLaw::Aligned { .. } | ConstraintLaw::Equation { .. } => {
                continue;
            }
        };
        list.push(Requirement {
            quantity: format!("{quantity} of {}", constraint.name),
            requirement: "positive",
            value: values.scalar(g, value),
        });
    }
    let of_beams = mechanism.beams.iter().flat_map(|beam| &beam.positive);
    let of_shafts = mechanism.shafts.iter().flat_map(|shaft| &shaft.positive);
    for (quantity, value) in of_beams.chain(of_shafts) {
        let value = values.scalar(g, value);
        // The parts of a beam that loads split share what was asked of the whole.
        if list.iter().all(|known| known.value != value) {
            list.push(Requirement { quantity: quantity.clone(), requirement: "positive", value });
        }
    }
    list.extend(inside_curves(g, mechanism, values));
    list.retain(|requirement| g.constant_value(requirement.value).is_none());
    list
}

/// Requires arguments of curves to lie between the first and the last point.
fn inside_curves(g: &mut Graph, mechanism: &Mechanism, values: &Values) -> Vec<Requirement> {
    let mut list: Vec<Requirement> = Vec::new();
    for CurveArgument { curve, argument } in &mechanism.curve_arguments {
        let argument = values.scalar(g, argument);
        let [first, last] = curve.range().map(|end| curve.with_unit(end));
        let [low, high] = curve.range_with_ends().map(|end| g.constant(end));
        let name = curve.spline.name();
        let unit = match curve.unit.symbol.as_str() {
            "" => String::new(),
            symbol => format!(" ({symbol})"),
        };
        let ends = [
            (format!("{name} begins at {first}: its argument minus that{unit}"), g.sub(argument, low)),
            (format!("{name} ends at {last}: that minus its argument{unit}"), g.sub(high, argument)),
        ];
        for (quantity, value) in ends {
            // The message shows this value next to the end of the curve, in the declared unit.
            let value = g.scale(1.0 / curve.unit.scale, value);
            // Curves that share a range and an argument need one check.
            if list.iter().all(|known| known.value != value) {
                list.push(Requirement { quantity, requirement: "positive", value });
            }
        }
    }
    list
}

/// Whether an inertia is declared with entries that are not constant or that no real body can have, or about another
/// point than the centre of mass.
fn is_in_doubt(g: &mut Graph, values: &Values, body: &Body) -> bool {
    body.parts.iter().any(|part| {
        let Spread::Tensor { inertia, about } = part.shape.reduced().spread else {
            return false;
        };
        let entries: [ExprId; 6] = std::array::from_fn(|k| values.scalar(g, &inertia[k]));
        let known = entries.map(|entry| g.constant_value(entry));
        let [Some(xx), Some(yy), Some(zz), Some(xy), Some(yz), Some(xz)] = known else {
            return true;
        };
        let tensor = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]];
        about.is_some() || !is_inertia_of_a_body(&tensor)
    })
}

/// The requirements on bodies welded together. There are none if each certainly has the inertia of a real body, because
/// then so does their sum.
fn inertia_together(g: &mut Graph, mechanism: &Mechanism, values: &Values, group: &[Member]) -> Vec<Requirement> {
    let body = |member: &Member| &mechanism.bodies[member.body.index()];
    let mut bodies = group.iter().map(body);
    let Some(first) = bodies.find(|body| is_in_doubt(g, values, body)) else {
        return Vec::new();
    };
    let mut pieces = Vec::new();
    for member in group {
        for mut piece in MassDistribution::of_body(g, values, body(member)) {
            for placement in &member.placements {
                piece = piece.placed(g, values, placement);
            }
            pieces.push(piece);
        }
    }
    let name = match group.len() {
        1 => first.name.to_string(),
        _ => format!("{} with all that is welded to it", first.name),
    };
    let (_, second) = central_moments(g, pieces);
    inertia_of_a_body(g, &name, second)
}

/// Mass, and second moments about the centre of mass: rows of `S - F F^T / m`, with each diagonal entry raised by a
/// small fraction of the trace of `S`.
fn central_moments(g: &mut Graph, pieces: Vec<MassDistribution>) -> (ExprId, [Vector3; 3]) {
    let zero = g.zero();
    let (mut mass, mut first) = (zero, Vector3::zero(g));
    let mut second = [first; 3];
    for piece in pieces {
        mass = g.add(mass, piece.mass);
        for (k, row) in second.iter_mut().enumerate() {
            row.0[k] = g.add(row.0[k], piece.isotropic);
        }
        for arm in &piece.arms {
            let share = arm.direction.scale(g, arm.first);
            first = first.add(g, share);
            for (other, &weight) in piece.arms.iter().zip(&arm.second) {
                for (row, &component) in second.iter_mut().zip(&arm.direction.0) {
                    let factor = g.mul(weight, component);
                    let share = other.direction.scale(g, factor);
                    *row = row.add(g, share);
                }
            }
        }
    }
    let trace = g.sum([second[0].0[0], second[1].0[1], second[2].0[2]]);
    let raise = g.scale(FLATNESS, trace);
    for (k, row) in second.iter_mut().enumerate() {
        let factor = g.div(first.0[k], mass);
        let shift = first.scale(g, factor);
        *row = row.sub(g, shift);
        row.0[k] = g.add(row.0[k], raise);
    }
    (mass, second)
}

/// The second moment `S = tr(J)/2 1 - J` of an inertia `J` is positive definite exactly when all its principal minors
/// are positive. Each diagonal entry is half of the amount by which two moments of inertia exceed the third.
fn inertia_of_a_body(g: &mut Graph, body: &str, [x, y, z]: [Vector3; 3]) -> Vec<Requirement> {
    let ([a, xy, xz], [_, b, yz], [_, _, c]) = (x.0, y.0, z.0);
    let require = |quantity: &str, unit: &str, value| Requirement {
        quantity: format!("{quantity} of {body} in {unit}"),
        requirement: "positive (about the centre of mass a principal moment of inertia is at most the sum of the other two)",
        value,
    };
    let mut list = vec![
        require("(Jyy + Jzz - Jxx)/2", "kg*m^2", a),
        require("(Jxx + Jzz - Jyy)/2", "kg*m^2", b),
        require("(Jxx + Jyy - Jzz)/2", "kg*m^2", c),
    ];
    if [xy, yz, xz].iter().any(|&product| !g.is(product, 0.0)) {
        for (name, p, q, r) in [("xy", a, b, xy), ("yz", b, c, yz), ("xz", a, c, xz)] {
            let (product, square) = (g.mul(p, q), g.mul(r, r));
            let quantity = format!("the {name} minor of tr(J)/2 - J");
            list.push(require(&quantity, "kg^2*m^4", g.sub(product, square)));
        }
        let determinant = x.cross(g, y).dot(g, z);
        list.push(require("the determinant of tr(J)/2 - J", "kg^3*m^6", determinant));
    }
    list
}
