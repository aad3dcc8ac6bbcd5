//! The quadratic pencil `s^2 Mhat + s Chat + Khat` and complex vectors.

use crate::array::{Square, times_complex, transpose};
use crate::{Complex, Linear};

/// `(s^2 M + s C + K) x` for three given matrices.
pub(crate) fn pencil_times<const N: usize>(
    linear: &Linear<f64, N>,
    s: Complex,
    x: &[Complex; N],
) -> [Complex; N] {
    let m = times_complex(&linear.mass, x);
    let c = times_complex(&linear.damping, x);
    let k = times_complex(&linear.stiffness, x);
    core::array::from_fn(|i| s * (s * m[i] + c[i]) + k[i])
}

/// `(2 s M + C) x`: the derivative of the pencil by `s`.
pub(crate) fn pencil_slope_times<const N: usize>(
    linear: &Linear<f64, N>,
    s: Complex,
    x: &[Complex; N],
) -> [Complex; N] {
    let m = times_complex(&linear.mass, x);
    let c = times_complex(&linear.damping, x);
    core::array::from_fn(|i| 2.0 * s * m[i] + c[i])
}

/// The three matrices transposed.
pub(crate) fn transposed<const N: usize>(linear: &Linear<f64, N>) -> Linear<f64, N> {
    Linear {
        mass: transpose(&linear.mass),
        damping: transpose(&linear.damping),
        stiffness: transpose(&linear.stiffness),
    }
}

/// `(s^2 M + s C + K)^T x`.
pub(crate) fn pencil_transposed_times<const N: usize>(
    linear: &Linear<f64, N>,
    s: Complex,
    x: &[Complex; N],
) -> [Complex; N] {
    let product = |matrix: &Square<N>| -> [Complex; N] {
        let mut sum = [Complex::default(); N];
        for (row, x) in matrix.iter().zip(x) {
            for (sum, value) in sum.iter_mut().zip(row) {
                *sum += x * value;
            }
        }
        sum
    };
    let (m, c, k) = (
        product(&linear.mass),
        product(&linear.damping),
        product(&linear.stiffness),
    );
    core::array::from_fn(|i| s * (s * m[i] + c[i]) + k[i])
}
