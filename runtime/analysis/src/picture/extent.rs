//! Extents of bodies and scenes.

use super::scene::{Pose, Scene, Shape, Solid};

pub(super) fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Length of the component of a unit direction perpendicular to a unit vector.
fn across(axis: [f64; 3], direction: [f64; 3]) -> f64 {
    (1.0 - dot(axis, direction).powi(2)).max(0.0).sqrt()
}

impl Solid {
    /// Extent from its centre in the direction of a unit vector.
    fn reach(&self, direction: [f64; 3]) -> f64 {
        let along = |axis: [f64; 3]| dot(axis, direction).abs();
        match &self.shape {
            Shape::Point { .. } => 0.0,
            Shape::Rod { along: axis, length } => along(*axis) * length / 2.0,
            Shape::Disk { axis, radius } => across(*axis, direction) * radius,
            Shape::Cylinder { axis, radius, length } | Shape::Tube { axis, outer: radius, length, .. } => {
                across(*axis, direction) * radius + along(*axis) * length / 2.0
            }
            Shape::Box { edges, size } => edges.iter().zip(size).map(|(edge, size)| along(*edge) * size / 2.0).sum(),
            Shape::Sphere { radius } => *radius,
            Shape::Ellipsoid { axes, semi_axes } => {
                axes.iter().zip(semi_axes).map(|(axis, length)| (along(*axis) * length).powi(2)).sum::<f64>().sqrt()
            }
        }
    }

    /// Points on it, in the frame of the body, at its extremes in each direction.
    pub(super) fn tips(&self) -> impl Iterator<Item = [f64; 3]> + '_ {
        let directions = (0..6).map(|k| {
            let mut direction = [0.0; 3];
            direction[k % 3] = if k < 3 { 1.0 } else { -1.0 };
            direction
        });
        directions.map(|direction| {
            let reach = self.reach(direction);
            core::array::from_fn(|i| self.center[i] + reach * direction[i])
        })
    }
}

/// The smallest box along the axes of the common frame that contains everything.
pub(super) fn bounds(scene: &Scene) -> [[f64; 3]; 2] {
    let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    let mut include = |centre: [f64; 3], reach: [f64; 3]| {
        for i in 0..3 {
            low[i] = low[i].min(centre[i] - reach[i]);
            high[i] = high[i].max(centre[i] + reach[i]);
        }
    };
    for body in &scene.bodies {
        let Pose { rotation, .. } = body.pose;
        for solid in &body.solids {
            // A row of the rotation is an axis of the common frame, expressed in the body frame.
            let reach = rotation.map(|axis| solid.reach(axis));
            include(body.pose.place(solid.center), reach);
        }
    }
    for section in scene.beams.iter().flat_map(|beam| &beam.sections) {
        let [width, height] = section.size;
        let reach = section.pose.rotation.map(|[_, across, up]| (width * across.abs() + height * up.abs()) / 2.0);
        include(section.pose.position, reach);
    }
    let seats = scene.joints.iter().flat_map(|joint| [joint.from, joint.to]);
    let seats = seats.map(|seat| (seat.body, seat.place));
    let points = scene.points.iter().map(|point| (point.body, point.place));
    for (body, point) in seats.chain(points) {
        include(scene.place(body, point), [0.0; 3]);
    }
    for wheel in &scene.wheels {
        if let Some(point) = scene.points.get(wheel.center) {
            include(scene.place(point.body, point.place), [wheel.radius; 3]);
        }
    }
    if low[0] > high[0] {
        return [[0.0; 3]; 2];
    }
    [low, high]
}
