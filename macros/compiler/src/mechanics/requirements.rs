//! What bodies and constraints must satisfy at run time, whatever the design values: positive masses and lengths, and inertias
//! that a body can have.

use crate::algebra::{Graph, Vector3};
use crate::base::ids::ExprId;
use crate::model::expression::Expr;
use crate::model::mechanism::{Body, ConstraintLaw, Mechanism, Shape};

use super::functions::Requirement;
use super::inertia::MassDistribution;
use super::values::Values;

/// Share of the trace below which a principal second moment counts as zero: a flat body has one that is exactly zero,
/// and rounding must not make it negative.
const FLATNESS: f64 = 1e-9;

/// The requirements that depend on inputs or design variables; constants were checked when the declaration was.
pub(super) fn requirements(
    g: &mut Graph,
    mechanism: &Mechanism,
    values: &Values,
) -> Vec<Requirement> {
    let mut list = Vec::new();
    for body in &mechanism.bodies {
        let name = &body.name;
        for part in &body.parts {
            for (quantity, value) in positive_quantities(&part.shape) {
                list.push(Requirement {
                    quantity: format!("{quantity} of {name}"),
                    requirement: "positive",
                    value: values.scalar(g, value),
                });
            }
            if let Shape::Tube { inner, outer, .. } = &part.shape {
                let (inner, outer) = (values.scalar(g, inner), values.scalar(g, outer));
                list.push(Requirement {
                    quantity: format!("wall thickness of {name}"),
                    requirement: "positive",
                    value: g.sub(outer, inner),
                });
            }
        }
        let holes = body.parts.iter().any(|part| part.hole);
        let given = body
            .parts
            .iter()
            .any(|part| matches!(part.shape, Shape::Rigid { .. }));
        if holes || given {
            let (mass, second) = central_moments(g, values, body);
            if holes {
                list.push(Requirement {
                    quantity: format!("mass of {name}"),
                    requirement: "positive",
                    value: mass,
                });
            }
            for value in principal_minors(g, second) {
                list.push(Requirement {
                    quantity: format!("inertia of {name}"),
                    requirement: "one that a body can have (triangle inequality)",
                    value,
                });
            }
        }
    }
    for constraint in &mechanism.constraints {
        let (quantity, value) = match &constraint.law {
            ConstraintLaw::Distance { length, .. } => ("length", length),
            ConstraintLaw::Rolling { radius, .. } => ("radius", radius),
            _ => continue,
        };
        list.push(Requirement {
            quantity: format!("{quantity} of {}", constraint.name),
            requirement: "positive",
            value: values.scalar(g, value),
        });
    }
    list.retain(|requirement| g.constant_value(requirement.value).is_none());
    list
}

/// The dimensions of a shape that have to be positive.
fn positive_quantities(shape: &Shape) -> Vec<(&'static str, &Expr)> {
    match shape {
        Shape::Point { mass, .. } | Shape::Rigid { mass, .. } => vec![("mass", mass)],
        Shape::Rod { mass, length, .. } => vec![("mass", mass), ("length", length)],
        Shape::Disk { mass, radius, .. } | Shape::Sphere { mass, radius, .. } => {
            vec![("mass", mass), ("radius", radius)]
        }
        Shape::Cylinder {
            mass,
            radius,
            length,
            ..
        } => {
            vec![("mass", mass), ("radius", radius), ("length", length)]
        }
        Shape::Tube {
            mass,
            inner,
            length,
            ..
        } => {
            vec![("mass", mass), ("inner radius", inner), ("length", length)]
        }
        Shape::Cuboid {
            mass,
            size: [x, y, z],
            ..
        } => vec![
            ("mass", mass),
            ("size along x", x),
            ("size along y", y),
            ("size along z", z),
        ],
    }
}

/// Mass of a body, and its second moments about its centre of mass: rows of `S - F F^T / m`, each diagonal entry raised
/// by a little of the trace of `S`.
fn central_moments(g: &mut Graph, values: &Values, body: &Body) -> (ExprId, [Vector3; 3]) {
    let zero = g.zero();
    let (mut mass, mut first) = (zero, Vector3::zero(g));
    let mut second = [first; 3];
    for piece in MassDistribution::of_body(g, values, body) {
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

/// Principal minors of a symmetric matrix: all positive exactly when it is positive definite.
fn principal_minors(g: &mut Graph, [x, y, z]: [Vector3; 3]) -> Vec<ExprId> {
    let ([a, xy, xz], [_, b, yz], [_, _, c]) = (x.0, y.0, z.0);
    let mut minors = vec![a, b, c];
    if [xy, yz, xz].iter().any(|&product| !g.is(product, 0.0)) {
        for (p, q, r) in [(a, b, xy), (b, c, yz), (a, c, xz)] {
            let (product, square) = (g.mul(p, q), g.mul(r, r));
            minors.push(g.sub(product, square));
        }
        let normal = x.cross(g, y);
        minors.push(normal.dot(g, z));
    }
    minors
}
