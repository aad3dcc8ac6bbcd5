//! Poses as 4 x 4 matrices built from quaternions.

use num_dual::Dual;

use super::beams;
use crate::matrices::Scalar;
use crate::model::{Coordinate, Flexure, Frame, Model, Motion, Placement, Step, Value, Values};

pub(super) type Four<D> = [[D; 4]; 4];

pub(super) fn get<D: Scalar>(value: Value, design: &[D]) -> D {
    match value {
        Value::Number(number) => D::from(number),
        Value::Design { variable, factor } => design[variable] * factor,
    }
}

pub(super) fn lift<D: Scalar>(values: &[D]) -> Vec<Dual<D>> {
    values.iter().map(|&value| Dual::from_re(value)).collect()
}

/// The poses of all bodies and points.
pub(super) struct Poses<'a, D> {
    pub(super) model: &'a Model,
    /// Values of all coordinates.
    pub(super) coordinates: Vec<D>,
    pub(super) design: Vec<D>,
    /// Poses of all bodies in the ground.
    pub(super) bodies: Vec<Four<D>>,
}

impl<'a, D: Scalar> Poses<'a, D> {
    pub(super) fn new(model: &'a Model, coordinates: Vec<D>, design: Vec<D>) -> Self {
        let mut bodies = vec![translation([D::zero(); 3]); model.bodies.len()];
        let names = model.coordinates();
        for branch in model.tree() {
            let joint = &model.joints[branch.joint];
            let mut across = placed(&joint.from_placement, &design);
            if let Some(Flexure { beam, place }) = joint.flexure {
                let beam = &model.beams[beam];
                let q = beams::of_beam(model, beam, &coordinates);
                across = multiply(&across, &beams::section(beam, q, place, &design));
            }
            for (step, declared) in joint.motions().iter().enumerate() {
                let x = coordinates[index(&names, Coordinate { joint: branch.joint, step })];
                across = multiply(&across, &displacement(declared, x, &design));
            }
            // The pose of the `to` body in the `from` body
            let to = placed(&joint.to_placement, &design);
            let mut across = multiply(&across, &inverse(&to));
            if branch.reversed {
                across = inverse(&across);
            }
            bodies[branch.body] = match branch.parent {
                Frame::Ground => across,
                Frame::Body(parent) => multiply(&bodies[parent], &across),
            };
        }
        Self { model, coordinates, design, bodies }
    }

    /// The frame of a point in the ground.
    pub(super) fn point(&self, point: usize) -> Four<D> {
        let point = &self.model.points[point];
        let placed = placed(&point.placement, &self.design);
        match point.frame {
            Frame::Ground => placed,
            Frame::Body(body) => multiply(&self.bodies[body], &placed),
        }
    }

    pub(super) fn position(&self, point: usize) -> [D; 3] {
        let frame = self.point(point);
        [frame[0][3], frame[1][3], frame[2][3]]
    }

    pub(super) fn distance(&self, from: usize, to: usize) -> D {
        let (start, end) = (self.position(from), self.position(to));
        let square = |i: usize| (end[i] - start[i]) * (end[i] - start[i]);
        (square(0) + square(1) + square(2)).sqrt()
    }

    /// The frame of one point relative to another.
    pub(super) fn relative(&self, from: usize, to: usize) -> Four<D> {
        multiply(&inverse(&self.point(from)), &self.point(to))
    }

    pub(super) fn coordinate(&self, coordinate: Coordinate) -> D {
        self.coordinates[index(&self.model.coordinates(), coordinate)]
    }
}

pub(super) fn index(all: &[Coordinate], coordinate: Coordinate) -> usize {
    let place = all.iter().position(|&other| other == coordinate);
    place.expect("a coordinate of the model")
}

fn displacement<D: Scalar>(step: &Step, x: D, design: &[D]) -> Four<D> {
    let length = norm(step.axis);
    let along = |x: D| translation(step.axis.map(|component| x * (component / length)));
    match step.motion {
        Motion::Turn => quaternion_rotation(step.axis, x),
        Motion::Slide => along(x),
        Motion::Screw { lead } => multiply(&along(get(lead, design) * x), &quaternion_rotation(step.axis, x)),
    }
}

pub(super) fn placed<D: Scalar>(placement: &Placement, design: &[D]) -> Four<D> {
    let offset: Values = placement.offset;
    let start = translation(offset.map(|component| get(component, design)));
    placement
        .rotations
        .iter()
        .fold(start, |pose, (axis, angle)| multiply(&pose, &quaternion_rotation(*axis, get(*angle, design))))
}

pub(super) fn norm(axis: [f64; 3]) -> f64 {
    axis[0].hypot(axis[1]).hypot(axis[2])
}

pub(super) fn translation<D: Scalar>(offset: [D; 3]) -> Four<D> {
    let (o, i) = (D::zero(), D::one());
    let [x, y, z] = offset;
    [[i, o, o, x], [o, i, o, y], [o, o, i, z], [o, o, o, i]]
}

/// Rotation by the unit quaternion `(w, v) = (cos(angle/2), sin(angle/2) axis)`.
pub(super) fn quaternion_rotation<D: Scalar>(axis: [f64; 3], angle: D) -> Four<D> {
    let half = angle * 0.5;
    let sine = half.sin() / norm(axis);
    quaternion(half.cos(), axis.map(|component| sine * component))
}

/// Rotation by a unit quaternion.
pub(super) fn quaternion<D: Scalar>(w: D, [x, y, z]: [D; 3]) -> Four<D> {
    let (o, i) = (D::zero(), D::one());
    [
        [i - (y * y + z * z) * 2.0, (x * y - w * z) * 2.0, (x * z + w * y) * 2.0, o],
        [(x * y + w * z) * 2.0, i - (x * x + z * z) * 2.0, (y * z - w * x) * 2.0, o],
        [(x * z - w * y) * 2.0, (y * z + w * x) * 2.0, i - (x * x + y * y) * 2.0, o],
        [o, o, o, i],
    ]
}

pub(super) fn multiply<D: Scalar>(a: &Four<D>, b: &Four<D>) -> Four<D> {
    std::array::from_fn(|i| std::array::from_fn(|j| (0..4).map(|k| a[i][k] * b[k][j]).sum()))
}

pub(super) fn inverse<D: Scalar>(pose: &Four<D>) -> Four<D> {
    let mut inverse = translation([D::zero(); 3]);
    for i in 0..3 {
        for j in 0..3 {
            inverse[i][j] = pose[j][i];
            inverse[i][3] -= pose[j][i] * pose[j][3];
        }
    }
    inverse
}

pub(super) fn transpose<D: Scalar>(a: &Four<D>) -> Four<D> {
    std::array::from_fn(|i| std::array::from_fn(|j| a[j][i]))
}
