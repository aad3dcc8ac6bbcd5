//! Units in which the elements of the pencil are of order one: powers of two, so that nothing is rounded.

use super::hessenberg::balance;
use super::powers::{exponent, power_of_two};

/// Largest absolute value; infinite if one is not finite.
pub(crate) fn largest(x: &[f64]) -> f64 {
    x.iter().fold(0.0, |most: f64, value| if value.is_finite() { most.max(value.abs()) } else { f64::INFINITY })
}

/// Balances, in place, `A = stiffness` to `-D^-1 A D / rate`, with no element much larger than one, and makes `damping`
/// the identity. The diagonals of `D` and of its inverse are written to `right` and `left`; returns `rate`.
pub(super) fn scale_first_order(
    n: usize,
    damping: &mut [f64],
    stiffness: &mut [f64],
    right: &mut [f64],
    left: &mut [f64],
) -> f64 {
    balance(n, stiffness, right);
    for (left, right) in left.iter_mut().zip(right) {
        *left = 1.0 / *right;
    }
    let size = largest(stiffness);
    let rate = if size > 0.0 { power_of_two(exponent(size)) } else { 1.0 };
    stiffness.iter_mut().for_each(|value| *value = -(*value / rate));
    damping.fill(0.0);
    for i in 0..n {
        damping[i * (n + 1)] = 1.0;
    }
    rate
}

/// Scales the matrices in place to `D M D`, `D C D / rate`, `D K D / rate^2`, with masses of order one on the diagonal
/// and nothing much larger than one in damping and stiffness. The diagonal of `D` is written to `units`; returns
/// `rate`.
pub(super) fn scale(n: usize, mass: &mut [f64], damping: &mut [f64], stiffness: &mut [f64], units: &mut [f64]) -> f64 {
    for i in 0..n {
        units[i] = power_of_two(-(exponent(mass[i * n + i]).div_euclid(2)));
    }
    for matrix in [&mut *mass, damping, stiffness] {
        for i in 0..n {
            for j in 0..n {
                matrix[i * n + j] *= units[i] * units[j];
            }
        }
    }
    let (c, k) = (largest(damping), largest(stiffness));
    let size = c.max(k.sqrt());
    let rate = if size > 0.0 { power_of_two(exponent(size)) } else { 1.0 };
    damping.iter_mut().for_each(|value| *value /= rate);
    stiffness.iter_mut().for_each(|value| *value = *value / rate / rate);
    rate
}
