//! Values at a design point, and the mass, centre and central inertia of bodies.

use std::f64::consts::PI;

use super::Scalar;
use super::space::{Matrix, Pose, Vector, rotation, unit};
use crate::model::{Amount, Part, Placement, Shape, Value, Values};

/// Evaluates a number or a multiple of a design variable.
pub(crate) fn value<D: Scalar>(value: Value, design: &[D]) -> D {
    match value {
        Value::Number(number) => D::from(number),
        Value::Design { variable, factor } => design[variable] * factor,
    }
}

pub(crate) fn vector<D: Scalar>(values: &Values, design: &[D]) -> Vector<D> {
    Vector(values.map(|component| value(component, design)))
}

/// Pose of a placement: the offset, then each rotation about the axes resulting from the previous one.
pub(crate) fn placement<D: Scalar>(placement: &Placement, design: &[D]) -> Pose<D> {
    let mut pose = Pose { origin: vector(&placement.offset, design), ..Pose::identity() };
    for (axis, angle) in &placement.rotations {
        pose.rotation = pose.rotation * rotation(*axis, value(*angle, design));
    }
    pose
}

/// Mass properties in the body frame.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Inertia<D> {
    pub(crate) mass: D,
    pub(crate) center: Vector<D>,
    /// About the centre of mass.
    pub(crate) tensor: Matrix<D>,
}

/// Inertia with axial symmetry about the unit vector `a`: `transverse (I - a a^T) + axial a a^T`.
fn symmetric<D: Scalar>(a: [f64; 3], axial: D, transverse: D) -> Matrix<D> {
    Matrix::identity().scaled(transverse) + Matrix::square(a).scaled(axial - transverse)
}

/// Mass, centre and central inertia of a sum of parts: `m = sum m_i`, `m c = sum m_i c_i`, and by Steiner's theorem
/// `J = sum (R_i J_i R_i^T + m_i (d_i . d_i I - d_i d_i^T))` with `d_i = c_i - c`; a hole counts negatively.
pub(crate) fn inertia<D: Scalar>(parts: &[Part], design: &[D]) -> Inertia<D> {
    let pieces: Vec<(D, Vector<D>, Matrix<D>)> = parts
        .iter()
        .map(|part| {
            let sign = D::from(if part.hole { -1.0 } else { 1.0 });
            let (pose, piece) = (placement(&part.placement, design), shape(&part.shape, design));
            let tensor = pose.rotation * piece.tensor * pose.rotation.transpose();
            (piece.mass * sign, pose.point(piece.center), tensor.scaled(sign))
        })
        .collect();
    let mut total = Inertia { mass: D::zero(), center: Vector::zero(), tensor: Matrix::constant([[0.0; 3]; 3]) };
    if pieces.is_empty() {
        return total;
    }
    for &(mass, center, _) in &pieces {
        total.mass += mass;
        total.center = total.center + center.scaled(mass);
    }
    total.center = total.center.scaled(total.mass.recip());
    for &(mass, center, tensor) in &pieces {
        total.tensor = total.tensor + tensor + steiner(mass, center - total.center);
    }
    total
}

/// `m (d . d I - d d^T)`: the inertia that a mass adds about a point at distance `d` from its centre.
fn steiner<D: Scalar>(mass: D, d: Vector<D>) -> Matrix<D> {
    let square = Matrix(d.0.map(|x| d.0.map(|y| D::zero() - x * y)));
    (Matrix::identity().scaled(d.dot(d)) + square).scaled(mass)
}

/// Mass of an amount over a given volume (or length, or area).
fn mass_of<D: Scalar>(amount: Amount, volume: D, design: &[D]) -> D {
    match amount {
        Amount::Mass(mass) => value(mass, design),
        Amount::Density(density) => value(density, design) * volume,
    }
}

/// Mass properties of a shape in the frame of its part.
fn shape<D: Scalar>(shape: &Shape, design: &[D]) -> Inertia<D> {
    let get = |v: &Value| value(*v, design);
    match shape {
        Shape::Point { mass, center } => {
            Inertia { mass: get(mass), center: vector(center, design), tensor: Matrix::constant([[0.0; 3]; 3]) }
        }
        // m L^2 / 12 across, zero along.
        Shape::Rod { mass, length, along, center } => {
            let (l, a) = (get(length), unit(*along));
            let m = mass_of(*mass, l, design);
            let half = Vector::constant(a).scaled(l * 0.5);
            let center = center.as_ref();
            Inertia {
                mass: m,
                center: center.map_or(half, |center| vector(center, design)),
                tensor: symmetric(a, D::zero(), m * l * l / 12.0),
            }
        }
        // m r^2 / 2 along, m r^2 / 4 across.
        Shape::Disk { mass, radius, axis, center } => {
            let r = get(radius);
            let m = mass_of(*mass, r * r * PI, design);
            Inertia {
                mass: m,
                center: vector(center, design),
                tensor: symmetric(unit(*axis), m * r * r / 2.0, m * r * r / 4.0),
            }
        }
        // m r^2 / 2 along, m (3 r^2 + L^2) / 12 across.
        Shape::Cylinder { mass, radius, length, axis, center } => {
            let (r, l) = (get(radius), get(length));
            let m = mass_of(*mass, r * r * l * PI, design);
            let across = m * (r * r * 3.0 + l * l) / 12.0;
            Inertia { mass: m, center: vector(center, design), tensor: symmetric(unit(*axis), m * r * r / 2.0, across) }
        }
        // m (a^2 + b^2) / 2 along, m (3 (a^2 + b^2) + L^2) / 12 across.
        Shape::Tube { mass, inner, outer, length, axis, center } => {
            let (a, b, l) = (get(inner), get(outer), get(length));
            let m = mass_of(*mass, (b * b - a * a) * l * PI, design);
            let squares = a * a + b * b;
            let across = m * (squares * 3.0 + l * l) / 12.0;
            Inertia {
                mass: m,
                center: vector(center, design),
                tensor: symmetric(unit(*axis), m * squares / 2.0, across),
            }
        }
        // m (b^2 + c^2) / 12 about x, and so on.
        Shape::Cuboid { mass, size, center } => {
            let [a, b, c] = size.map(|edge| value(edge, design));
            let m = mass_of(*mass, a * b * c, design);
            let (o, k) = (D::zero(), m / 12.0);
            let rows = [[k * (b * b + c * c), o, o], [o, k * (a * a + c * c), o], [o, o, k * (a * a + b * b)]];
            Inertia { mass: m, center: vector(center, design), tensor: Matrix(rows) }
        }
        // 2 m r^2 / 5 about any axis.
        Shape::Sphere { mass, radius, center } => {
            let r = get(radius);
            let m = mass_of(*mass, r * r * r * (4.0 * PI / 3.0), design);
            Inertia { mass: m, center: vector(center, design), tensor: Matrix::identity().scaled(m * r * r * 0.4) }
        }
        // J_center = J_about - m (d . d I - d d^T) with d = center - about.
        Shape::Rigid { mass, center, inertia, about } => {
            let [xx, yy, zz, xy, yz, xz] = inertia.map(|entry| value(entry, design));
            let tensor = Matrix([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]);
            let (mass, center) = (get(mass), vector(center, design));
            let about = about.as_ref().map_or(center, |about| vector(about, design));
            let away = steiner(mass, center - about);
            Inertia { mass, center, tensor: tensor + away.scaled(D::from(-1.0)) }
        }
    }
}
