//! What rounding leaves of forces that balance where no stiffness resists.
//!
//! Lift and weight of a free machine are equal in the declaration, but add up to a few rounding units of either. Their
//! sum is all that the kernels return, so nothing there tells how large its terms were. Data that differ by rounding
//! alone do: they change such a sum by as much as it is (stochastic arithmetic; Vignes 1993).

use super::operating_point::OperatingPoint;
use crate::algebra::{Vector, greater};

/// How often the data are disturbed.
const SAMPLES: usize = 8;
/// A sum at most this many times its largest change is rounding.
const FACTOR: f64 = 4.0;

/// The residual with zeros where it is rounding of the data; `None` if it is nowhere.
#[cold]
pub(super) fn without_rounding(
    point: &OperatingPoint<'_>,
    q: &[f64],
    residual: &[f64],
) -> Option<Vector> {
    let mut change = Vector::zeros(residual.len());
    for sample in 0..SAMPLES {
        let of = |values: &[f64], first: usize| -> Vector {
            let values = values.iter().enumerate();
            values
                .map(|(k, value)| value * disturbance(first + k, sample))
                .collect()
        };
        let inputs = of(point.inputs, 0);
        let design = of(point.design, inputs.len());
        let disturbed = point.mechanism.residual(q, &inputs, &design);
        for ((change, disturbed), value) in change.iter_mut().zip(&disturbed).zip(residual) {
            *change = greater(*change, (disturbed - value).abs());
        }
    }
    let mut left = Vector::from(residual);
    for (value, change) in left.iter_mut().zip(&change) {
        if value.abs() <= FACTOR * change {
            *value = 0.0;
        }
    }
    (left[..] != *residual).then_some(left)
}

/// One plus or minus up to two rounding units, different for each datum and sample.
fn disturbance(datum: usize, sample: usize) -> f64 {
    let turn = (3 * datum + 2 * sample + datum * sample) % 5;
    1.0 + (turn as f64 - 2.0) * f64::EPSILON
}
