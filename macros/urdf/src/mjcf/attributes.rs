//! Attributes as numbers, and frames in the ways in which a file may write them.

use super::element::Element;
use crate::error::{ImportError, Reason};
use crate::geometry::{Pose, Vector, cross, norm};

type Result<T> = std::result::Result<T, ImportError>;

/// How angles are written.
#[derive(Clone, Debug)]
pub(super) struct Angles {
    /// Radians of a unit.
    pub(super) scale: f64,
    /// Order of axes; upper case about fixed axes.
    pub(super) order: String,
}

/// The numbers of an attribute; empty where it is absent.
pub(super) fn numbers(of: &Element, attribute: &'static str) -> Result<Vec<f64>> {
    let Some(text) = of.get(attribute) else { return Ok(Vec::new()) };
    let each = text.split_whitespace().map(|word| word.parse::<f64>().ok().filter(|number| number.is_finite()));
    each.collect::<Option<Vec<f64>>>().ok_or_else(|| {
        let (attribute, found) = (attribute.to_owned(), text.to_owned());
        of.mistake(Reason::Value { attribute, found, expected: "numbers" })
    })
}

pub(super) fn number(of: &Element, attribute: &'static str, otherwise: f64) -> Result<f64> {
    Ok(numbers(of, attribute)?.first().copied().unwrap_or(otherwise))
}

/// As many numbers as there must be; `None` where the attribute is absent.
pub(super) fn exactly<const N: usize>(of: &Element, attribute: &'static str) -> Result<Option<[f64; N]>> {
    let found = numbers(of, attribute)?;
    if found.is_empty() {
        return Ok(None);
    }
    found.try_into().map(Some).map_err(|found: Vec<f64>| {
        of.wrong(format!("`{attribute}` has {} numbers", found.len()), format!("write {N} numbers"))
    })
}

pub(super) fn vector(of: &Element, attribute: &'static str, otherwise: Vector) -> Result<Vector> {
    Ok(exactly(of, attribute)?.unwrap_or(otherwise))
}

pub(super) fn required<'a>(of: &'a Element, attribute: &'static str) -> Result<&'a str> {
    let missing = || of.mistake(Reason::MissingAttribute { element: of.tag.clone(), attribute });
    of.get(attribute).ok_or_else(missing)
}

/// The frame of an element: `pos`, and one of the ways to turn it.
pub(super) fn pose(of: &Element, angles: &Angles) -> Result<Pose> {
    Ok(Pose { offset: vector(of, "pos", [0.0; 3])?, rotations: rotations(of, angles)? })
}

fn rotations(of: &Element, angles: &Angles) -> Result<Vec<(Vector, f64)>> {
    if let Some(quaternion) = exactly(of, "quat")? {
        return Ok(of_quaternion(quaternion));
    }
    if let Some([x, y, z, angle]) = exactly(of, "axisangle")? {
        return Ok(turn([x, y, z], angles.scale * angle));
    }
    if let Some(three) = exactly::<3>(of, "euler")? {
        let axis = |letter: char| match letter.to_ascii_lowercase() {
            'x' => [1.0, 0.0, 0.0],
            'y' => [0.0, 1.0, 0.0],
            _ => [0.0, 0.0, 1.0],
        };
        let fixed = angles.order.chars().next().is_some_and(|letter| letter.is_ascii_uppercase());
        let turns =
            angles.order.chars().zip(three).flat_map(|(letter, angle)| turn(axis(letter), angles.scale * angle));
        let mut turns: Vec<_> = turns.collect();
        // About fixed axes, the last turn is the first one about turned axes.
        if fixed {
            turns.reverse();
        }
        return Ok(turns);
    }
    if let Some([a, b, c, d, e, f]) = exactly(of, "xyaxes")? {
        let x = unit([a, b, c]);
        let along: f64 = (0..3).map(|k| x[k] * [d, e, f][k]).sum();
        let y = unit([0, 1, 2].map(|k| [d, e, f][k] - along * x[k]));
        return Ok(of_axes([x, y, cross(x, y)]));
    }
    match exactly::<3>(of, "zaxis")? {
        Some(axis) => Ok(from_z(axis)),
        None => Ok(Vec::new()),
    }
}

/// The shortest turn that brings z along a direction.
pub(super) fn from_z(direction: Vector) -> Vec<(Vector, f64)> {
    let [x, y, z] = unit(direction);
    let across = x.hypot(y);
    if across < 1e-300 {
        return if z < 0.0 { turn([1.0, 0.0, 0.0], std::f64::consts::PI) } else { Vec::new() };
    }
    turn([-y / across, x / across, 0.0], across.atan2(z))
}

fn turn(axis: Vector, angle: f64) -> Vec<(Vector, f64)> {
    if angle == 0.0 || norm(axis) == 0.0 { Vec::new() } else { vec![(axis, angle)] }
}

pub(super) fn unit(v: Vector) -> Vector {
    v.map(|x| x / norm(v))
}

pub(super) fn of_quaternion([w, x, y, z]: [f64; 4]) -> Vec<(Vector, f64)> {
    turn([x, y, z], 2.0 * norm([x, y, z]).atan2(w))
}

/// From the axes of a frame, as columns.
fn of_axes(columns: [Vector; 3]) -> Vec<(Vector, f64)> {
    let m = |i: usize, j: usize| columns[j][i];
    // The largest component of the quaternion is computed first (Shepperd).
    let trace = m(0, 0) + m(1, 1) + m(2, 2);
    let squares = [trace, m(0, 0), m(1, 1), m(2, 2)];
    let largest = (0..4).max_by(|&a, &b| squares[a].total_cmp(&squares[b])).unwrap_or(0);
    let [a, b, c] = [m(2, 1) - m(1, 2), m(0, 2) - m(2, 0), m(1, 0) - m(0, 1)];
    let quaternion = match largest {
        0 => [1.0 + trace, a, b, c],
        1 => [a, 1.0 + 2.0 * m(0, 0) - trace, m(0, 1) + m(1, 0), m(0, 2) + m(2, 0)],
        2 => [b, m(0, 1) + m(1, 0), 1.0 + 2.0 * m(1, 1) - trace, m(1, 2) + m(2, 1)],
        _ => [c, m(0, 2) + m(2, 0), m(1, 2) + m(2, 1), 1.0 + 2.0 * m(2, 2) - trace],
    };
    of_quaternion(quaternion)
}
