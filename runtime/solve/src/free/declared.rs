//! The values that a declaration gives to unknowns in steady motion, with their derivatives.

use super::Held;
use crate::algebra::{Matrix, Vector};
use crate::kernels::{Kernels, Second};
use crate::scalar::Dual;

/// The unknowns with declared values, in the order of the declaration.
pub fn declared(mechanism: &dyn Kernels, u: &[f64], b: &[f64]) -> Vec<Held> {
    let places = &mechanism.description().held;
    if places.is_empty() {
        return Vec::new();
    }
    let still = (Vector::zeros(u.len()), Vector::zeros(b.len()));
    let declared_values = derivatives(mechanism, (u, b), (&still.0, &still.1));
    let held = places.iter().enumerate().map(|(k, &unknown)| {
        let (by_input, by_design) = declared_values.first[k].split_at(u.len());
        Held {
            unknown,
            value: declared_values.values[k],
            by_input: by_input.into(),
            by_design: by_design.into(),
            declared: Some(k),
        }
    });
    held.collect()
}

/// Declared values, one after the other.
pub(super) struct Derivatives {
    pub(super) values: Vector,
    /// By input, then by design variable.
    pub(super) first: Matrix,
    /// Derivative of `first` along a direction.
    pub(super) along: Matrix,
}

/// Declared values with their first derivatives, and the derivatives of these along a direction.
pub(super) fn derivatives(
    mechanism: &dyn Kernels,
    (u, b): (&[f64], &[f64]),
    (du, db): (&[f64], &[f64]),
) -> Derivatives {
    let description = mechanism.description();
    let count = description.held.len();
    let size = u.len() + b.len();
    let mut derivatives = Derivatives {
        values: Vector::zeros(count),
        first: Matrix::zeros(count, size),
        along: Matrix::zeros(count, size),
    };
    let moving = u.iter().chain(b).zip(du.iter().chain(db));
    let mut numbers: Vec<Second> = moving.map(|(&value, &slope)| Dual::fixed(Dual { value, slope })).collect();
    let mut values = vec![Second::fixed(Dual::fixed(0.0)); count + description.rings.len()];
    let mut evaluate = |numbers: &[Second]| {
        let (u, b) = numbers.split_at(u.len());
        mechanism.held_values_into(u, b, &mut values);
        values[..count].to_vec()
    };
    for (slot, value) in derivatives.values.iter_mut().zip(evaluate(&numbers)) {
        *slot = value.value.value;
    }
    for j in 0..size {
        numbers[j].slope.value = 1.0;
        for (k, value) in evaluate(&numbers).iter().enumerate() {
            derivatives.first[k][j] = value.slope.value;
            derivatives.along[k][j] = value.slope.slope;
        }
        numbers[j].slope.value = 0.0;
    }
    derivatives
}
