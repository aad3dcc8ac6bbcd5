//! The ellipsoid that represents a body with a given inertia tensor.

use super::scene::Shape;
use crate::eigenproblem::diagonalise;

/// The uniform ellipsoid with a given mass and tensor `inertia` (xx, yy, zz, xy, yz, xz) about a point that is `about`
/// from the centre of mass. Both are given along the axes `frame`; the shape is given along the axes in which `frame`
/// is written.
///
/// With semi-axes `a`: `J_1 = m (a_2^2 + a_3^2) / 5`, so that `a_1^2 = 5 (J_2 + J_3 - J_1) / (2 m)`.
pub(super) fn ellipsoid(frame: [[f64; 3]; 3], mass: f64, inertia: [f64; 6], about: [f64; 3]) -> Shape {
    let [xx, yy, zz, xy, yz, xz] = inertia;
    let square: f64 = about.iter().map(|component| component.powi(2)).sum();
    // About the centre of mass: J - m (|d|^2 1 - d d^T).
    let mut tensor = [xx, xy, xz, xy, yy, yz, xz, yz, zz];
    for (entry, value) in tensor.iter_mut().enumerate() {
        let (i, j) = (entry / 3, entry % 3);
        let diagonal = if i == j { square } else { 0.0 };
        *value -= mass * (diagonal - about[i] * about[j]);
    }
    // Rows of the matrix whose columns are the principal axes; each undergoes the same rotations.
    let mut principal = tensor;
    let rows: [[f64; 3]; 3] = core::array::from_fn(|i| {
        let mut row = [0.0; 3];
        row[i] = 1.0;
        principal = tensor;
        diagonalise(&mut principal, 3, &mut row);
        row
    });
    let moments = [principal[0], principal[4], principal[8]];
    let sum: f64 = moments.iter().sum();
    let semi_axes = moments.map(|moment| {
        let square = 2.5 * (sum - 2.0 * moment) / mass;
        // Zero for a body without mass, and for a flat body, whose square may be negative due to rounding.
        if square > 0.0 && square.is_finite() { square.sqrt() } else { 0.0 }
    });
    let axes = core::array::from_fn(|k| core::array::from_fn(|x| (0..3).map(|i| rows[i][k] * frame[i][x]).sum()));
    Shape::Ellipsoid { axes, semi_axes }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_box_has_the_ellipsoid_of_its_inertia() {
        // m = 12, edges 1, 2, 3, along the axes of a frame rotated by 90 degrees about z; about a point off the centre.
        let about = [0.5, -0.25, 2.0];
        let central = [13.0, 10.0, 5.0];
        let shifted = |i: usize| {
            let square: f64 = about.iter().map(|x: &f64| x * x).sum();
            central[i] + 12.0 * (square - about[i] * about[i])
        };
        let product = |i: usize, j: usize| -12.0 * about[i] * about[j];
        let inertia = [shifted(0), shifted(1), shifted(2), product(0, 1), product(1, 2), product(0, 2)];
        let frame = [[0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, 1.0]];
        let Shape::Ellipsoid { axes, semi_axes } = ellipsoid(frame, 12.0, inertia, about) else {
            panic!("it is an ellipsoid");
        };
        // m a^2 / 5 = m edge^2 / 12
        for (edge, direction) in [1.0, 2.0, 3.0_f64].iter().zip(frame) {
            let expected = (5.0 / 12.0_f64).sqrt() * edge;
            let along = |axis: &[f64; 3]| -> f64 { axis.iter().zip(direction).map(|(a, d)| a * d).sum() };
            let pairs = axes.iter().zip(semi_axes);
            let parallel = pairs.filter(|(axis, _)| along(axis).abs() > 1.0 - 1e-12);
            let values: Vec<f64> = parallel.map(|(_, semi_axis)| semi_axis).collect();
            assert_eq!(values.len(), 1, "{direction:?}");
            assert!((values[0] - expected).abs() < 1e-12, "{direction:?}");
        }
    }

    #[test]
    fn principal_axes_are_those_of_the_tensor() {
        // Moments 2, 3, 4 along axes rotated about z by an angle with sine 0.6 and cosine 0.8.
        let (sine, cosine) = (0.6, 0.8);
        let inertia = [
            2.0 * cosine * cosine + 3.0 * sine * sine,
            2.0 * sine * sine + 3.0 * cosine * cosine,
            4.0,
            -sine * cosine,
            0.0,
            0.0,
        ];
        let frame = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let Shape::Ellipsoid { axes, semi_axes } = ellipsoid(frame, 1.0, inertia, [0.0; 3]) else {
            panic!("it is an ellipsoid");
        };
        let first = axes.iter().zip(semi_axes);
        let first = first.filter(|(axis, _)| (axis[0] * cosine + axis[1] * sine).abs() > 0.999);
        let first: Vec<f64> = first.map(|(_, semi_axis)| semi_axis).collect();
        assert_eq!(first.len(), 1, "{axes:?}");
        assert!((first[0] - (2.5_f64 * 5.0).sqrt()).abs() < 1e-12);
    }

    #[test]
    fn bodies_that_no_ellipsoid_has_are_flat_or_points() {
        let frame = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let semi_axes = |mass: f64, inertia: [f64; 6]| match ellipsoid(frame, mass, inertia, [0.0; 3]) {
            Shape::Ellipsoid { semi_axes, .. } => semi_axes,
            other => panic!("{other:?}"),
        };
        let plate = semi_axes(1.0, [1.0, 1.0, 2.0, 0.0, 0.0, 0.0]);
        assert_eq!(plate[2], 0.0);
        assert!((plate[0] - 5.0_f64.sqrt()).abs() < 1e-15);
        assert_eq!(semi_axes(0.0, [0.0; 6]), [0.0; 3]);
        assert_eq!(semi_axes(2.0, [0.0; 6]), [0.0; 3]);
    }
}
