//! Balancing and Hessenberg form of a real square matrix.

use super::powers::{exponent, power_of_two};

/// Maximum number of balancing sweeps; the remaining imbalance is small.
const SWEEPS: usize = 8;
/// Scales stay within powers of two whose products are finite.
const GREATEST_EXPONENT: i32 = 300;

/// Scales `a` to `D^-1 A D` with rows and columns of similar size (Parlett and Reinsch 1969, with the diagonal included
/// in the sums as recommended by James, Langou and Lowery 2014). The diagonal of `D`, powers of two, is written to
/// `scales`.
pub(super) fn balance(n: usize, a: &mut [f64], scales: &mut [f64]) {
    scales.fill(1.0);
    for _ in 0..SWEEPS {
        let mut settled = true;
        for i in 0..n {
            let (mut column, mut row) = (0.0, 0.0);
            for j in 0..n {
                column += a[j * n + i].abs();
                row += a[i * n + j].abs();
            }
            if column == 0.0 || row == 0.0 {
                continue;
            }
            let shift = (exponent(row) - exponent(column)) / 2;
            let reached = exponent(scales[i]) + shift;
            if shift == 0 || reached.abs() > GREATEST_EXPONENT {
                continue;
            }
            let factor = power_of_two(shift);
            if column * factor + row / factor < 0.95 * (column + row) {
                settled = false;
                scales[i] *= factor;
                for j in 0..n {
                    a[j * n + i] *= factor;
                    a[i * n + j] /= factor;
                }
            }
        }
        if settled {
            break;
        }
    }
}

/// Reduces `a` to Hessenberg form by Householder reflections.
pub(super) fn reduce(n: usize, a: &mut [f64], v: &mut [f64]) {
    for k in 0..n.saturating_sub(2) {
        let mut size = 0.0_f64;
        for i in k + 2..n {
            size = size.max(a[i * n + k].abs());
        }
        if size == 0.0 {
            continue;
        }
        let size = size.max(a[(k + 1) * n + k].abs());
        let mut square = 0.0;
        for i in k + 1..n {
            v[i] = a[i * n + k] / size;
            square += v[i] * v[i];
        }
        let norm = square.sqrt().copysign(v[k + 1]);
        a[(k + 1) * n + k] = -norm * size;
        for i in k + 2..n {
            a[i * n + k] = 0.0;
        }
        // H = I - tau v v^T
        let tau = 1.0 / (square + norm * v[k + 1]);
        v[k + 1] += norm;
        for j in k + 1..n {
            let mut sum = 0.0;
            for i in k + 1..n {
                sum += v[i] * a[i * n + j];
            }
            sum *= tau;
            for i in k + 1..n {
                a[i * n + j] -= sum * v[i];
            }
        }
        for row in a.chunks_exact_mut(n) {
            let mut sum = 0.0;
            for j in k + 1..n {
                sum += row[j] * v[j];
            }
            sum *= tau;
            for j in k + 1..n {
                row[j] -= sum * v[j];
            }
        }
    }
}
