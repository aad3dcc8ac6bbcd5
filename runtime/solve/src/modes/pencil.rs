//! The quadratic pencil `s^2 Mhat + s Chat + Khat` and complex vectors.

use crate::Complex;
use crate::algebra::{Matrix, Vector, times_complex};
use crate::kernels::Linear;

/// `(s^2 M + s C + K) x` for the given matrices.
pub fn pencil_times(linear: &Linear, s: Complex, x: &[Complex]) -> Vector<Complex> {
    Vector::from_fn(linear.mass.row_count(), |i| {
        let rows = linear.mass[i].iter().zip(&linear.damping[i]);
        let rows = rows.zip(&linear.stiffness[i]).zip(x);
        let zero = Complex::default();
        let [m, c, k] = rows.fold([zero; 3], |[m, c, k], (((mass, damping), stiffness), x)| {
            [m + x * mass, c + x * damping, k + x * stiffness]
        });
        s * (s * m + c) + k
    })
}

/// `(2 s M + C) x`: the derivative of the pencil with respect to `s`, times `x`.
pub fn pencil_slope_times(linear: &Linear, s: Complex, x: &[Complex]) -> Vector<Complex> {
    let m = times_complex(&linear.mass, x);
    let c = times_complex(&linear.damping, x);
    Vector::from_fn(x.len(), |i| 2.0 * s * m[i] + c[i])
}

/// The three matrices transposed.
pub fn transposed(linear: &Linear) -> Linear {
    Linear {
        mass: linear.mass.transpose(),
        damping: linear.damping.transpose(),
        stiffness: linear.stiffness.transpose(),
    }
}

/// `(s^2 M + s C + K)^T x`.
pub(crate) fn pencil_transposed_times(linear: &Linear, s: Complex, x: &[Complex]) -> Vector<Complex> {
    let product = |matrix: &Matrix| -> Vector<Complex> {
        let mut sum = Vector::zeros(matrix.column_count());
        for (row, x) in matrix.iter().zip(x) {
            for (sum, value) in sum.iter_mut().zip(row) {
                *sum += x * value;
            }
        }
        sum
    };
    let (m, c, k) = (product(&linear.mass), product(&linear.damping), product(&linear.stiffness));
    Vector::from_fn(x.len(), |i| s * (s * m[i] + c[i]) + k[i])
}
