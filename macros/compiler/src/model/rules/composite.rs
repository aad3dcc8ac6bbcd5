//! Sums of shapes in numbers: what holes leave of a body.

use super::physical::positive_semidefinite;
use crate::model::evaluate::Values;
use crate::model::mechanism::{Part, Placement, Shape};

type Vector = [f64; 3];
type Matrix = [Vector; 3];

/// What is wrong with the holes of a body, as the end of a sentence. Values that are not known, and masses that are
/// reported themselves, are no matter of the holes.
pub(super) fn holes(parts: &[Part], at: &Values) -> Option<String> {
    let moments: Vec<(f64, Moments)> = parts
        .iter()
        .map(|part| (if part.hole { -1.0 } else { 1.0 }, Moments::of(part, at)))
        .collect();
    if moments.iter().any(|(_, part)| !part.is_real()) {
        return None;
    }
    let [mut solid, mut holes] = [Moments::default(), Moments::default()];
    for (sign, part) in &moments {
        let sum = if *sign < 0.0 { &mut holes } else { &mut solid };
        sum.add(part, 1.0);
    }
    let mut whole = solid.clone();
    whole.add(&holes, -1.0);
    // What rounding leaves of nothing is nothing.
    if whole.mass <= 1e-12 * solid.mass {
        return Some("are as heavy as the rest of it, or heavier: nothing is left".to_string());
    }
    let central = whole.second_about_center();
    let scale = (0..3).map(|axis| solid.second[axis][axis]).sum();
    let [[xx, xy, xz], [_, yy, yz], [_, _, zz]] = central;
    (!positive_semidefinite([xx, yy, zz, xy, yz, xz], scale)).then(|| {
        "leave an inertia that no body has: a hole must lie inside the shapes it is cut from"
            .to_string()
    })
}

/// Mass, first and second moment (the integrals of 1, `r` and `r r^T`) about the origin of the body frame.
#[derive(Clone, Debug, Default)]
struct Moments {
    mass: f64,
    first: Vector,
    second: Matrix,
}

impl Moments {
    fn of(part: &Part, at: &Values) -> Self {
        let (mass, center, central) = central_moments(&part.shape, at);
        let turn = rotation(&part.placement, at);
        let offset = at.vector(&part.placement.offset);
        let turned = product_with_vector(&turn, center);
        let place = [0, 1, 2].map(|i: usize| offset[i] + turned[i]);
        let central = product(&product(&turn, &central), &transposed(&turn));
        Self {
            mass,
            first: place.map(|component| mass * component),
            second: matrix(|i, j| central[i][j] + mass * place[i] * place[j]),
        }
    }

    fn is_real(&self) -> bool {
        let entries = self.first.iter().chain(self.second.iter().flatten());
        self.mass > 0.0 && self.mass.is_finite() && entries.copied().all(f64::is_finite)
    }

    fn add(&mut self, other: &Self, factor: f64) {
        self.mass += factor * other.mass;
        for i in 0..3 {
            self.first[i] += factor * other.first[i];
            for j in 0..3 {
                self.second[i][j] += factor * other.second[i][j];
            }
        }
    }

    fn second_about_center(&self) -> Matrix {
        let Self {
            mass,
            first,
            second,
        } = self;
        matrix(|i, j| second[i][j] - first[i] * first[j] / mass)
    }
}

/// Mass, centre of mass, and second moment about it, in the frame of the shape.
fn central_moments(shape: &Shape, at: &Values) -> (f64, Vector, Matrix) {
    // A solid of revolution: `across` m^2 in each direction across the axis, `along` along it.
    let round = |axis: &super::super::expression::Vector, across: f64, along: f64| {
        let a = at.vector(axis);
        matrix(|i, j| across * identity(i, j) + (along - across) * a[i] * a[j])
    };
    let square = |expr| at.of(expr).powi(2);
    let (mass, center, per_mass) = match shape {
        Shape::Point { mass, center } => (mass, center, Matrix::default()),
        Shape::Rod {
            mass,
            length,
            along,
            center,
        } => (mass, center, round(along, 0.0, square(length) / 12.0)),
        Shape::Disk {
            mass,
            radius,
            axis,
            center,
        } => (mass, center, round(axis, square(radius) / 4.0, 0.0)),
        Shape::Cylinder {
            mass,
            radius,
            length,
            axis,
            center,
        } => {
            let (across, along) = (square(radius) / 4.0, square(length) / 12.0);
            (mass, center, round(axis, across, along))
        }
        Shape::Tube {
            mass,
            inner,
            outer,
            length,
            axis,
            center,
        } => {
            let across = (square(inner) + square(outer)) / 4.0;
            (mass, center, round(axis, across, square(length) / 12.0))
        }
        Shape::Cuboid { mass, size, center } => {
            let edges = at.vector(size);
            let entries = matrix(|i, j| identity(i, j) * edges[i] * edges[j] / 12.0);
            (mass, center, entries)
        }
        Shape::Sphere {
            mass,
            radius,
            center,
        } => {
            let along = square(radius) / 5.0;
            (mass, center, matrix(|i, j| along * identity(i, j)))
        }
        Shape::Rigid {
            mass,
            center,
            inertia,
            about,
        } => {
            let [xx, yy, zz, xy, yz, xz] = [0, 1, 2, 3, 4, 5].map(|k: usize| at.of(&inertia[k]));
            let inertia = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]];
            let half = (xx + yy + zz) / 2.0;
            let (mass, c) = (at.of(mass), at.vector(center));
            let reference = about.as_ref().map_or(c, |about| at.vector(about));
            let arm = [0, 1, 2].map(|i: usize| c[i] - reference[i]);
            let central =
                matrix(|i, j| half * identity(i, j) - inertia[i][j] - mass * arm[i] * arm[j]);
            return (mass, c, central);
        }
    };
    let mass = at.of(mass);
    let central = matrix(|i, j| mass * per_mass[i][j]);
    (mass, at.vector(center), central)
}

/// The axes of a placement, column by column, in the frame that it is in.
fn rotation(placement: &Placement, at: &Values) -> Matrix {
    let mut turned = matrix(identity);
    for (axis, angle) in &placement.rotations {
        let n = at.vector(axis);
        let (sin, cos) = at.of(angle).sin_cos();
        let [x, y, z] = n;
        let cross = [[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]];
        // Rodrigues.
        let one =
            matrix(|i, j| cos * identity(i, j) + sin * cross[i][j] + (1.0 - cos) * n[i] * n[j]);
        turned = product(&turned, &one);
    }
    turned
}

fn identity(i: usize, j: usize) -> f64 {
    if i == j { 1.0 } else { 0.0 }
}

fn matrix(entry: impl Fn(usize, usize) -> f64) -> Matrix {
    [0, 1, 2].map(|i| [0, 1, 2].map(|j| entry(i, j)))
}

fn product(a: &Matrix, b: &Matrix) -> Matrix {
    matrix(|i, j| (0..3).map(|k| a[i][k] * b[k][j]).sum())
}

fn product_with_vector(a: &Matrix, v: Vector) -> Vector {
    [0, 1, 2].map(|i: usize| (0..3).map(|k| a[i][k] * v[k]).sum())
}

fn transposed(a: &Matrix) -> Matrix {
    matrix(|i, j| a[j][i])
}
