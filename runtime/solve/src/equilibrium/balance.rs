//! What rounding leaves of forces that balance where no stiffness resists.
//!
//! Lift and weight of a free machine are equal in the declaration, but add up to a few rounding units of either. Their
//! sum is all that the kernels return, so nothing there tells how large its terms were. Data that differ by rounding
//! alone do: they change such a sum by as much as it is (stochastic arithmetic; Vignes 1993). The same holds for the
//! stiffness that such forces leave along a direction in which nothing holds the machine. In any units that are found
//! from the matrix itself it would pass for a stiffness like others.

use crate::Description;
use crate::algebra::{Matrix, Vector, greater, largest};
use crate::kernels::Kernels;

/// How often the data are disturbed.
const SAMPLES: usize = 8;
/// Largest disturbance in rounding units: so many that sums of the same few terms are rounded in several ways.
const AMPLITUDE: u64 = 16;
/// Rounding of a sum of forces, relative to what it is elsewhere.
const FORCES: f64 = 32.0 * f64::EPSILON;
/// A sum at most this many times its largest change is rounding.
const FACTOR: f64 = 4.0;
/// Share of the largest stiffness, for motions of similar size, below which all stiffness against a motion may be
/// rounding.
const FAINT: f64 = 1e-10;

/// What the equations are evaluated with.
pub(crate) struct Data<'a> {
    pub(super) mechanism: &'a dyn Kernels,
    pub(super) description: &'a Description,
    /// The number of coordinates and speeds.
    pub(super) motions: usize,
    pub(super) inputs: &'a [f64],
    pub(super) design: &'a [f64],
}

/// The residual with zeros where it is rounding of the data; `None` if it is nowhere. Forces that lead held unknowns to
/// their values may have been added to it; only what the mechanism returns is disturbed.
pub(super) fn residual_without_rounding(data: &Data<'_>, q: &[f64], residual: &[f64]) -> Option<Vector> {
    without_rounding(data, q, residual, |q, inputs, design| data.mechanism.residual(q, inputs, design))
}

/// Values `of` coordinates, inputs and design with zeros where they are rounding of the data; `None` if they are nowhere.
#[cold]
pub(crate) fn without_rounding(
    data: &Data<'_>,
    q: &[f64],
    values: &[f64],
    of: impl Fn(&[f64], &[f64], &[f64]) -> Vector,
) -> Option<Vector> {
    let change = change(data, q, &of);
    // What the numbers of a declaration leave is the same whatever the data: beside forces that balance here, but
    // nowhere else, it is small.
    let mut sizes = Vector::zeros(values.len());
    for sample in 0..SAMPLES {
        let moved = q.iter().enumerate().map(|(i, value)| {
            let share = (disturbance(i, sample) - 1.0) / (AMPLITUDE as f64 * f64::EPSILON);
            value + share * data.description.large(i)
        });
        let moved: Vector = moved.collect();
        for (size, value) in sizes.iter_mut().zip(&of(&moved, data.inputs, data.design)) {
            *size = greater(*size, value.abs());
        }
    }
    let mut left = Vector::from(values);
    for ((value, change), size) in left.iter_mut().zip(&change).zip(&sizes) {
        if value.abs() <= FACTOR * greater(*change, FORCES * size) {
            *value = 0.0;
        }
    }
    (left[..] != *values).then_some(left)
}

/// Sets to zero what is rounding of the data in a stiffness against motions that hardly anything resists, and in equations
/// that hardly any motion appears in.
pub(super) fn remove_rounding(data: &Data<'_>, q: &[f64], stiffness: &mut Matrix) {
    let n = data.motions;
    let (mut rows, mut columns) = (Vector::zeros(n), Vector::zeros(n));
    for i in 0..n {
        for j in 0..n {
            let large = data.description.large(i) * data.description.large(j);
            let size = stiffness[i][j].abs() * large;
            rows[i] = greater(rows[i], size);
            columns[j] = greater(columns[j], size);
        }
    }
    let limit = FAINT * largest(&rows);
    let faint = |size: &f64| *size < limit;
    if (rows.iter().chain(&columns)).any(|size| faint(size) && *size > 0.0) {
        let faint = [rows, columns].map(|sizes| sizes.iter().map(faint).collect::<Vec<bool>>());
        remove(data, q, &faint, stiffness);
    }
}

#[cold]
fn remove(data: &Data<'_>, q: &[f64], [rows, columns]: &[Vec<bool>; 2], stiffness: &mut Matrix) {
    let n = q.len();
    let change = change(data, q, |q, inputs, design| {
        let (_, stiffness) = data.mechanism.residual_and_stiffness(q, inputs, design);
        stiffness.as_flattened().into()
    });
    let of = |i: usize, j: usize| {
        if data.description.symmetric_stiffness {
            greater(change[i * n + j], change[j * n + i])
        } else {
            change[i * n + j]
        }
    };
    for i in 0..rows.len() {
        for j in 0..columns.len() {
            let is_rounding = stiffness[i][j].abs() <= FACTOR * of(i, j);
            if (rows[i] || columns[j]) && is_rounding {
                stiffness[i][j] = 0.0;
            }
        }
    }
}

/// The largest changes of some numbers by rounding of inputs, design variables and coordinates.
fn change(data: &Data<'_>, q: &[f64], of: impl Fn(&[f64], &[f64], &[f64]) -> Vector) -> Vector {
    let given = of(q, data.inputs, data.design);
    let mut change = Vector::zeros(given.len());
    for sample in 0..SAMPLES {
        let disturbed = |values: &[f64], first: usize| -> Vector {
            values.iter().enumerate().map(|(k, value)| value * disturbance(first + k, sample)).collect()
        };
        let inputs = disturbed(data.inputs, 0);
        let design = disturbed(data.design, inputs.len());
        let first = inputs.len() + design.len();
        // Coordinates balance each other: that of a tilt has the rounding of a motion of the size of the machine.
        let moved = q.iter().enumerate().map(|(i, value)| {
            let rounding = disturbance(first + i, sample) - 1.0;
            value + rounding * (value.abs() + data.description.large(i))
        });
        let disturbed = of(&moved.collect::<Vector>(), &inputs, &design);
        for ((change, disturbed), value) in change.iter_mut().zip(&disturbed).zip(&given) {
            *change = greater(*change, (disturbed - value).abs());
        }
    }
    change
}

/// One plus or minus up to [`AMPLITUDE`] rounding units, different for each datum and sample: their number, mixed by the
/// golden ratio.
fn disturbance(datum: usize, sample: usize) -> f64 {
    let number = (SAMPLES * datum + sample + 1) as u64;
    let mixed = number.wrapping_mul(0x9E37_79B9_7F4A_7C15) >> 32;
    1.0 + ((mixed % (2 * AMPLITUDE + 1)) as f64 - AMPLITUDE as f64) * f64::EPSILON
}

#[cfg(test)]
mod tests {
    use eigentol_macros::mechanism;

    use super::*;
    use crate::equilibrium::{OperatingPoint, relative_residual};
    use crate::free::{FreeDirections, Held};

    mechanism! {
        /// A bar on a shaft that may turn at any speed.
        mechanism Conical {
            design l = 0.8 m;
            gravity 9.81 m/s^2 along -z;
            body shaft: rigid(mass: 1 kg, inertia: [0.1, 0.1, 0.1] kg*m^2);
            body bar: rod(mass: 1 kg, length: l, along: -z);
            joint spin: revolute(z) from ground to shaft, coasting;
            joint tilt: revolute(y) from shaft to bar;
        }
    }

    /// A member of a family that is off its held value is no solution, although nothing in the mechanism resists.
    #[test]
    fn distances_from_held_values_are_no_rounding() {
        let (length, tilt) = (0.8, 0.9_f64);
        let speed = (1.5 * 9.81 / (length * tilt.cos())).sqrt();
        let design = [length];
        let point = OperatingPoint::unchecked(&Conical, &[], &design);
        let q = [tilt, speed];
        let (_, stiffness) = point.evaluate_plain(&q).expect("finite");
        for (distance, solved) in [(0.0, true), (1e-6, false), (-1e-3, false)] {
            let held = vec![Held::at(1, speed - distance)];
            let directions = FreeDirections::of_member(&stiffness, 0, held);
            assert_eq!(directions.count(), 1);
            let point = point.clone().held_like(&directions).placed(&directions);
            let (residual, stiffness) = point.evaluate(&q).expect("finite");
            let relative = relative_residual(&point, &q, &residual, &stiffness);
            assert_eq!(relative < 1e-10, solved, "{distance}: {relative}");
        }
    }

    #[test]
    fn every_datum_is_disturbed_in_its_own_way() {
        let ways = (0..200).map(|datum| (0..SAMPLES).map(|k| disturbance(datum, k).to_bits()).collect());
        let ways: Vec<Vec<u64>> = ways.collect();
        for (k, way) in ways.iter().enumerate() {
            assert!(way.iter().any(|bits| *bits != way[0]), "{k}");
            assert!(k == 0 || *way != ways[k - 1], "{k}");
        }
    }
}
