//! What every body must satisfy at run time, whatever the design values: positive masses and lengths, and inertias that
//! a body can have.

use crate::algebra::Graph;
use crate::base::ids::ExprId;
use crate::model::expression::Expr;
use crate::model::mechanism::{Mechanism, Shape};

use super::functions::Requirement;
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
        let mut positive = |g: &mut Graph, quantity: &str, value: &Expr| {
            let value = values.scalar(g, value);
            list.push(Requirement {
                quantity: format!("{quantity} of {name}"),
                requirement: "positive",
                value,
            });
        };
        match &body.shape {
            Shape::Massless => {}
            Shape::Point { mass, .. } => positive(g, "mass", mass),
            Shape::Rod { mass, length, .. } => {
                positive(g, "mass", mass);
                positive(g, "length", length);
            }
            Shape::Disk { mass, radius, .. } | Shape::Sphere { mass, radius, .. } => {
                positive(g, "mass", mass);
                positive(g, "radius", radius);
            }
            Shape::Cylinder {
                mass,
                radius,
                length,
                ..
            } => {
                positive(g, "mass", mass);
                positive(g, "radius", radius);
                positive(g, "length", length);
            }
            Shape::Cuboid { mass, size, .. } => {
                positive(g, "mass", mass);
                for (edge, axis) in size.iter().zip(["x", "y", "z"]) {
                    positive(g, &format!("size along {axis}"), edge);
                }
            }
            Shape::Rigid { mass, inertia, .. } => {
                positive(g, "mass", mass);
                let inertia = std::array::from_fn(|i| values.scalar(g, &inertia[i]));
                for value in second_moment_minors(g, inertia) {
                    list.push(Requirement {
                        quantity: format!("inertia of {name}"),
                        requirement: "one that a body can have (triangle inequality)",
                        value,
                    });
                }
            }
        }
    }
    list.retain(|requirement| g.constant_value(requirement.value).is_none());
    list
}

/// Principal minors of the second-moment tensor `tr(J)/2 1 - J`, each raised a little: all positive exactly when the
/// inertia `J` (xx, yy, zz, xy, yz, xz) is one that a mass distribution can have.
fn second_moment_minors(g: &mut Graph, inertia: [ExprId; 6]) -> Vec<ExprId> {
    let [xx, yy, zz, xy, yz, xz] = inertia;
    let trace = g.sum([xx, yy, zz]);
    let half = g.scale(0.5 + FLATNESS, trace);
    let [a, b, c] = [xx, yy, zz].map(|j| g.sub(half, j));
    let mut minors = vec![a, b, c];
    let two = |g: &mut Graph, p, q, r| {
        let (product, square) = (g.mul(p, q), g.mul(r, r));
        g.sub(product, square)
    };
    let (ab, bc, ac) = (two(g, a, b, xy), two(g, b, c, yz), two(g, a, c, xz));
    if [xy, yz, xz].iter().any(|&j| !g.is(j, 0.0)) {
        // det = a (bc - yz^2) - xy (xy c - yz xz) + xz (xy yz - b xz), with off-diagonal entries -xy, -yz, -xz.
        let first = g.mul(a, bc);
        let (xyc, yzxz) = (g.mul(xy, c), g.mul(yz, xz));
        let inner = g.add(xyc, yzxz);
        let second = g.mul(xy, inner);
        let (xyyz, bxz) = (g.mul(xy, yz), g.mul(b, xz));
        let inner = g.add(xyyz, bxz);
        let third = g.mul(xz, inner);
        let partial = g.sub(first, second);
        minors.extend([ab, bc, ac, g.sub(partial, third)]);
    }
    minors
}
