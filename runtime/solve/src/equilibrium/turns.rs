//! States that differ by full turns of angles: they are one place if the mechanism is the same there.

use super::operating_point::OperatingPoint;
use crate::Description;
use crate::algebra::{Vector, largest_element};
use crate::constraints::Structure;

/// Difference of coordinates, and share of the largest stiffness, that counts as none.
const CLOSE: f64 = 1e-6;
/// The counterpart of [`CLOSE`] at a singular configuration, where rounding limits the accuracy of states.
const CLOSE_SINGULAR: f64 = 1e-4;
/// Share of its terms by which a residual may differ after full turns, which are rounded.
const ROUNDED: f64 = 1e-10;

/// Turns the angles of `q` towards `other` by full turns.
pub fn turned_towards(q: &[f64], other: &[f64], description: &Description) -> Vector {
    Vector::from_fn(q.len(), |i| {
        let angle = description.coordinates[i].unit.symbol == *"rad";
        let turns = ((q[i] - other[i]) / core::f64::consts::TAU).round();
        if angle && turns != 0.0 { q[i] - turns * core::f64::consts::TAU } else { q[i] }
    })
}

/// Whether coordinates and speeds are equal up to rounding. Reactions follow from them, but less accurately.
pub fn coincide(a: &[f64], b: &[f64], singular: bool, description: &Description) -> bool {
    let close = if singular { CLOSE_SINGULAR } else { CLOSE };
    let motions = Structure::of(description).motions();
    (0..motions).all(|i| (a[i] - b[i]).abs() <= close * (description.large(i) + a[i].abs()))
}

/// Whether the mechanism is the same in two states that differ by full turns, so that no spring or screw counts the
/// turns.
pub fn turns_do_not_count(point: &OperatingPoint<'_>, q: &[f64], turned: &[f64]) -> bool {
    let (Some(a), Some(b)) = (point.evaluate_plain(q), point.evaluate_plain(turned)) else {
        return false;
    };
    let same = |i: usize| {
        let scale = (0..q.len()).fold(0.0, |sum, j| sum + a.1[i][j].abs() * (1.0 + q[j].abs()));
        (a.0[i] - b.0[i]).abs() <= ROUNDED * scale
    };
    let scale = CLOSE * largest_element(&a.1);
    let mut stiffness = a.1.as_flattened().iter().zip(b.1.as_flattened());
    (0..q.len()).all(same) && stiffness.all(|(a, b)| (a - b).abs() <= scale)
}
