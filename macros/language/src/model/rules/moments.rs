//! Mass, centre and second moments of shapes in numbers.

use super::tensor::{Matrix, Vector, identity, matrix, product, product_with_vector, second_moment, transposed};
use crate::model::evaluate::Values;
use crate::model::expression::{self, Expr};
use crate::model::mechanism::{Part, Placement, Shape};
use crate::model::shape::{MeanSquare, Spread};

/// Mass, first and second moment (the integrals of 1, `r` and `r r^T`) about the origin of the body frame.
#[derive(Clone, Debug, Default)]
pub(super) struct Moments {
    pub(super) mass: f64,
    first: Vector,
    pub(super) second: Matrix,
}

impl Moments {
    /// The moments of a shape; a hole counts positive.
    pub(super) fn of(part: &Part, at: &Values) -> Self {
        let (mass, center, central) = central_moments(&part.shape, at);
        let moments = Self {
            mass,
            first: center.map(|component| mass * component),
            second: matrix(|i, j| central[i][j] + mass * center[i] * center[j]),
        };
        moments.placed(&part.placement, at)
    }

    /// The moments seen from the frame in which their own frame is placed: `r = o + R r'`.
    pub(super) fn placed(&self, placement: &Placement, at: &Values) -> Self {
        let (turn, o) = (rotation(placement, at), at.vector(&placement.offset));
        let f = product_with_vector(&turn, self.first);
        let second = product(&product(&turn, &self.second), &transposed(&turn));
        let mass = self.mass;
        Self {
            mass,
            first: [0, 1, 2].map(|i| f[i] + mass * o[i]),
            second: matrix(|i, j| second[i][j] + o[i] * f[j] + f[i] * o[j] + mass * o[i] * o[j]),
        }
    }

    pub(super) fn is_real(&self) -> bool {
        self.mass > 0.0
            && self.mass.is_finite()
            && self.first.iter().chain(self.second.iter().flatten()).copied().all(f64::is_finite)
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
        let Self { mass, first, second } = self;
        matrix(|i, j| second[i][j] - first[i] * first[j] / mass)
    }
}

/// Mass, centre of mass, and second moment about it, in the frame of the shape.
fn central_moments(shape: &Shape, at: &Values) -> (f64, Vector, Matrix) {
    let shape = shape.reduced();
    let (mass, center) = (at.of(shape.mass), at.vector(shape.center));
    let square = |expr: &Expr| at.of(expr).powi(2);
    let mean_square =
        |terms: &MeanSquare| -> f64 { terms.iter().map(|(factor, length)| factor * square(length)).sum() };
    // `across` m^2 in each direction perpendicular to the axis, `along` along it
    let round = |axis: &expression::Vector, across: f64, along: f64| {
        let a = at.vector(axis);
        matrix(|i, j| across * identity(i, j) + (along - across) * a[i] * a[j])
    };
    let per_mass = match &shape.spread {
        Spread::Point => Matrix::default(),
        Spread::Line { length, along } => round(along, 0.0, square(length) / 12.0),
        Spread::Round { axis, across, along } => round(axis, mean_square(across), mean_square(along)),
        Spread::Box { size } => {
            let edges = at.vector(size);
            matrix(|i, j| identity(i, j) * edges[i] * edges[j] / 12.0)
        }
        Spread::Ball(along) => {
            let along = mean_square(along);
            matrix(|i, j| along * identity(i, j))
        }
        Spread::Tensor { inertia, about } => {
            let [xx, yy, zz, xy, yz, xz] = [0, 1, 2, 3, 4, 5].map(|k| at.of(&inertia[k]));
            let second = second_moment(&[[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]);
            let reference = about.map_or(center, |about| at.vector(about));
            let arm = [0, 1, 2].map(|i| center[i] - reference[i]);
            let central = matrix(|i, j| second[i][j] - mass * arm[i] * arm[j]);
            return (mass, center, central);
        }
    };
    (mass, center, matrix(|i, j| mass * per_mass[i][j]))
}

/// The axes of a placement as columns, in the outer frame.
fn rotation(placement: &Placement, at: &Values) -> Matrix {
    let mut turned = matrix(identity);
    for (axis, angle) in &placement.rotations {
        let n = at.vector(axis);
        let (sin, cos) = at.of(angle).sin_cos();
        let [x, y, z] = n;
        let cross = [[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]];
        // Rodrigues.
        let one = matrix(|i, j| cos * identity(i, j) + sin * cross[i][j] + (1.0 - cos) * n[i] * n[j]);
        turned = product(&turned, &one);
    }
    turned
}
