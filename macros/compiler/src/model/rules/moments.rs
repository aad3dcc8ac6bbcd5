//! Mass, centre and second moments of shapes in numbers.

use super::tensor::{
    Matrix, Vector, identity, matrix, product, product_with_vector, second_moment, transposed,
};
use crate::model::evaluate::Values;
use crate::model::expression;
use crate::model::mechanism::{Part, Placement, Shape};

/// Mass, first and second moment (the integrals of 1, `r` and `r r^T`) about the origin of the body frame.
#[derive(Clone, Debug, Default)]
pub(super) struct Moments {
    pub(super) mass: f64,
    first: Vector,
    pub(super) second: Matrix,
}

impl Moments {
    /// Those of a shape; a hole counts positive.
    pub(super) fn of(part: &Part, at: &Values) -> Self {
        let (mass, center, central) = central_moments(&part.shape, at);
        let moments = Self {
            mass,
            first: center.map(|component| mass * component),
            second: matrix(|i, j| central[i][j] + mass * center[i] * center[j]),
        };
        moments.placed(&part.placement, at)
    }

    /// The same seen from the frame in which theirs is placed: `r = o + R r'`.
    pub(super) fn placed(&self, placement: &Placement, at: &Values) -> Self {
        let (turn, o) = (rotation(placement, at), at.vector(&placement.offset));
        let f = product_with_vector(&turn, self.first);
        let second = product(&product(&turn, &self.second), &transposed(&turn));
        let mass = self.mass;
        Self {
            mass,
            first: [0, 1, 2].map(|i: usize| f[i] + mass * o[i]),
            second: matrix(|i, j| second[i][j] + o[i] * f[j] + f[i] * o[j] + mass * o[i] * o[j]),
        }
    }

    pub(super) fn is_real(&self) -> bool {
        let entries = self.first.iter().chain(self.second.iter().flatten());
        self.mass > 0.0 && self.mass.is_finite() && entries.copied().all(f64::is_finite)
    }

    pub(super) fn add(&mut self, other: &Self, factor: f64) {
        self.mass += factor * other.mass;
        for i in 0..3 {
            self.first[i] += factor * other.first[i];
            for j in 0..3 {
                self.second[i][j] += factor * other.second[i][j];
            }
        }
    }

    pub(super) fn second_about_center(&self) -> Matrix {
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
    let round = |axis: &expression::Vector, across: f64, along: f64| {
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
            let second = second_moment(&[[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]);
            let (mass, c) = (at.of(mass), at.vector(center));
            let reference = about.as_ref().map_or(c, |about| at.vector(about));
            let arm = [0, 1, 2].map(|i: usize| c[i] - reference[i]);
            let central = matrix(|i, j| second[i][j] - mass * arm[i] * arm[j]);
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
