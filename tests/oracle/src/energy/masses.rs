//! Mass distributions as pseudo-inertias.

use std::f64::consts::PI;

use super::poses::{Four, get, multiply, norm, placed, transpose};
use crate::matrices::Scalar;
use crate::model::{Amount, Part, Shape, Value, Values};

/// `P = sum +- X P_i X^T` over the parts, each with its placement `X`.
pub(super) fn pseudo_inertia<D: Scalar>(parts: &[Part], design: &[D]) -> Four<D> {
    let mut total = [[D::zero(); 4]; 4];
    for part in parts {
        let pose = placed(&part.placement, design);
        let inner = of_shape(&part.shape, design);
        let turned = multiply(&multiply(&pose, &inner), &transpose(&pose));
        let sign = if part.hole { -1.0 } else { 1.0 };
        for i in 0..4 {
            for j in 0..4 {
                total[i][j] += turned[i][j] * sign;
            }
        }
    }
    total
}

/// `integral [r; 1] [r; 1]^T dm`: second moments, first moments, mass.
fn of_shape<D: Scalar>(shape: &Shape, design: &[D]) -> Four<D> {
    let number = |v: &Value| get(*v, design);
    let vector = |v: &Values| v.map(|component| get(component, design));
    let along = |a: [f64; 3], i: usize, j: usize| a[i] * a[j] / (norm(a) * norm(a));
    let across = |a: [f64; 3], i: usize, j: usize| f64::from(i == j) - along(a, i, j);
    let zero = [D::zero(); 3];
    let amount = |amount: Amount, volume: D| match amount {
        Amount::Mass(mass) => number(&mass),
        Amount::Density(density) => number(&density) * volume,
    };
    // Mass, centre, and second moments about the centre.
    let (mass, center, second): (D, [D; 3], [[D; 3]; 3]) = match shape {
        Shape::Point { mass, center } => (number(mass), vector(center), [zero; 3]),
        Shape::Rod { mass, length, along: a, center } => {
            let l = number(length);
            let m = amount(*mass, l);
            let half = a.map(|component| l * (0.5 * component / norm(*a)));
            let center = center.as_ref().map_or(half, vector);
            (m, center, table(|i, j| m * l * l * (along(*a, i, j) / 12.0)))
        }
        Shape::Disk { mass, radius, axis, center } => {
            let r = number(radius);
            let m = amount(*mass, r * r * PI);
            (m, vector(center), table(|i, j| m * r * r * (across(*axis, i, j) / 4.0)))
        }
        Shape::Cylinder { mass, radius, length, axis, center } => {
            let (r, l) = (number(radius), number(length));
            let m = amount(*mass, r * r * l * PI);
            let moments = |i, j| m * r * r * (across(*axis, i, j) / 4.0) + m * l * l * (along(*axis, i, j) / 12.0);
            (m, vector(center), table(moments))
        }
        // The outer cylinder minus the bore.
        Shape::Tube { mass, inner, outer, length, axis, center } => {
            let (a, b, l) = (number(inner), number(outer), number(length));
            let m = amount(*mass, (b * b - a * a) * l * PI);
            let density = m / ((b * b - a * a) * l * PI);
            let cylinder = |r: D, i, j| {
                let m = density * r * r * l * PI;
                m * r * r * (across(*axis, i, j) / 4.0) + m * l * l * (along(*axis, i, j) / 12.0)
            };
            let moments = |i, j| cylinder(b, i, j) - cylinder(a, i, j);
            (m, vector(center), table(moments))
        }
        Shape::Cuboid { mass, size, center } => {
            let size = vector(size);
            let m = amount(*mass, size[0] * size[1] * size[2]);
            (m, vector(center), table(|i, j| m * size[i] * size[j] * (f64::from(i == j) / 12.0)))
        }
        Shape::Sphere { mass, radius, center } => {
            let r = number(radius);
            let m = amount(*mass, r * r * r * (4.0 * PI / 3.0));
            (m, vector(center), table(|i, j| m * r * r * (f64::from(i == j) / 5.0)))
        }
        Shape::Rigid { mass, center, inertia, about } => {
            let [xx, yy, zz, xy, yz, xz] = inertia.map(|entry| get(entry, design));
            let tensor = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]];
            let half_trace = (xx + yy + zz) * 0.5;
            let (m, c) = (number(mass), vector(center));
            let a = about.as_ref().map_or(c, vector);
            let moments = |i: usize, j: usize| {
                let about = half_trace * f64::from(i == j) - tensor[i][j];
                about - m * (c[i] - a[i]) * (c[j] - a[j])
            };
            (m, c, table(moments))
        }
    };
    let mut p = [[D::zero(); 4]; 4];
    for i in 0..3 {
        for j in 0..3 {
            p[i][j] = second[i][j] + mass * center[i] * center[j];
        }
        p[i][3] = mass * center[i];
        p[3][i] = p[i][3];
    }
    p[3][3] = mass;
    p
}

fn table<D>(entry: impl Fn(usize, usize) -> D) -> [[D; 3]; 3] {
    std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j)))
}
