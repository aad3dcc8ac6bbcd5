//! Values of a design, and the mass, centre and central inertia of bodies.

use super::Scalar;
use super::space::{Matrix, Pose, Vector, rotation, unit};
use crate::model::{Placement, Shape, Value, Values};

/// Value of a number or of a multiple of a design variable.
pub(crate) fn value<D: Scalar>(value: Value, design: &[D]) -> D {
    match value {
        Value::Number(number) => D::from(number),
        Value::Design { variable, factor } => design[variable] * factor,
    }
}

pub(crate) fn vector<D: Scalar>(values: &Values, design: &[D]) -> Vector<D> {
    Vector(values.map(|component| value(component, design)))
}

/// Pose of a placement: the offset, then each rotation about the axes left by the one before.
pub(crate) fn placement<D: Scalar>(placement: &Placement, design: &[D]) -> Pose<D> {
    let mut pose = Pose {
        origin: vector(&placement.offset, design),
        ..Pose::identity()
    };
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

/// Axial symmetry about unit `a`: `transverse (I - a a^T) + axial a a^T`.
fn symmetric<D: Scalar>(a: [f64; 3], axial: D, transverse: D) -> Matrix<D> {
    Matrix::identity().scaled(transverse) + Matrix::square(a).scaled(axial - transverse)
}

pub(crate) fn inertia<D: Scalar>(shape: &Shape, design: &[D]) -> Inertia<D> {
    let get = |v: &Value| value(*v, design);
    match shape {
        Shape::Massless => {
            let tensor = Matrix::constant([[0.0; 3]; 3]);
            Inertia {
                mass: D::zero(),
                center: Vector::zero(),
                tensor,
            }
        }
        Shape::Point { mass, center } => {
            let tensor = Matrix::constant([[0.0; 3]; 3]);
            Inertia {
                mass: get(mass),
                center: vector(center, design),
                tensor,
            }
        }
        // m L^2 / 12 across, nothing along.
        Shape::Rod {
            mass,
            length,
            along,
            center,
        } => {
            let (m, l, a) = (get(mass), get(length), unit(*along));
            let half = Vector::constant(a).scaled(l * 0.5);
            let center = center
                .as_ref()
                .map_or(half, |center| vector(center, design));
            Inertia {
                mass: m,
                center,
                tensor: symmetric(a, D::zero(), m * l * l / 12.0),
            }
        }
        // m r^2 / 2 along, m r^2 / 4 across.
        Shape::Disk {
            mass,
            radius,
            axis,
            center,
        } => {
            let (m, r) = (get(mass), get(radius));
            let tensor = symmetric(unit(*axis), m * r * r / 2.0, m * r * r / 4.0);
            Inertia {
                mass: m,
                center: vector(center, design),
                tensor,
            }
        }
        // m r^2 / 2 along, m (3 r^2 + L^2) / 12 across.
        Shape::Cylinder {
            mass,
            radius,
            length,
            axis,
            center,
        } => {
            let (m, r, l) = (get(mass), get(radius), get(length));
            let across = m * (r * r * 3.0 + l * l) / 12.0;
            let tensor = symmetric(unit(*axis), m * r * r / 2.0, across);
            Inertia {
                mass: m,
                center: vector(center, design),
                tensor,
            }
        }
        // m (b^2 + c^2) / 12 about x, and so on.
        Shape::Cuboid { mass, size, center } => {
            let m = get(mass);
            let [a, b, c] = size.map(|edge| value(edge, design) * value(edge, design));
            let (o, k) = (D::zero(), m / 12.0);
            let rows = [
                [k * (b + c), o, o],
                [o, k * (a + c), o],
                [o, o, k * (a + b)],
            ];
            Inertia {
                mass: m,
                center: vector(center, design),
                tensor: Matrix(rows),
            }
        }
        // 2 m r^2 / 5 about any axis.
        Shape::Sphere {
            mass,
            radius,
            center,
        } => {
            let (m, r) = (get(mass), get(radius));
            let tensor = Matrix::identity().scaled(m * r * r * 0.4);
            Inertia {
                mass: m,
                center: vector(center, design),
                tensor,
            }
        }
        Shape::Rigid {
            mass,
            center,
            inertia,
        } => {
            let [xx, yy, zz, xy, yz, xz] = inertia.map(|entry| value(entry, design));
            let tensor = Matrix([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]);
            Inertia {
                mass: get(mass),
                center: vector(center, design),
                tensor,
            }
        }
    }
}
