//! Eigenvalues of a symmetric matrix, with one vector rotated along: by rotations if it is small, which needs no
//! allocation and always converges, otherwise from its tridiagonal form, which is many times faster.
#![allow(clippy::needless_range_loop, reason = "index loops read as the formulas they are")]

use super::tridiagonal::decompose;

/// Size from which the tridiagonal form is faster.
const LARGE: usize = 8;
/// Number of sweeps after which the remainder is left as it is; convergence is quadratic and takes fewer than ten.
const SWEEPS: usize = 40;

/// Diagonalises the symmetric `n` x `n` matrix (row by row).
///
/// On return its diagonal holds the eigenvalues, in no particular order, accurate to a few rounding errors of the
/// largest. `vector` becomes `Q^T vector`, where the columns of `Q` are the eigenvectors; it may be empty. Elements
/// must be finite and their sum must not overflow.
pub fn diagonalise(matrix: &mut [f64], n: usize, vector: &mut [f64]) {
    if n < LARGE || !tridiagonal(matrix, n, vector) {
        jacobi(matrix, n, vector);
    }
}

/// From the tridiagonal form; `false` if that does not converge, and nothing is changed.
fn tridiagonal(matrix: &mut [f64], n: usize, vector: &mut [f64]) -> bool {
    let mut room = vec![0.0; 3 * n];
    let (values, rest) = room.split_at_mut(n);
    let (beside, product) = rest.split_at_mut(n);
    let (whole, turned) = (&mut matrix.to_vec(), &mut vector.to_vec());
    let converged = decompose(whole, turned, [&mut *values, beside, product]);
    if converged {
        matrix.iter_mut().step_by(n + 1).zip(values).for_each(|(to, value)| *to = *value);
        vector.copy_from_slice(turned);
    }
    converged
}

/// By cyclic rotations (Golub and Van Loan, Matrix Computations, section 8.5).
fn jacobi(matrix: &mut [f64], n: usize, vector: &mut [f64]) {
    let size = matrix.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
    let negligible = size * f64::EPSILON / 64.0;
    for _ in 0..SWEEPS {
        let mut rotated = false;
        for p in 0..n {
            for q in p + 1..n {
                if matrix[p * n + q].abs() > negligible {
                    rotate(matrix, n, vector, p, q);
                    rotated = true;
                }
            }
        }
        if !rotated {
            return;
        }
    }
}

/// One rotation that zeros element (`p`, `q`), by the smaller of the two angles.
fn rotate(matrix: &mut [f64], n: usize, vector: &mut [f64], p: usize, q: usize) {
    let off = matrix[p * n + q];
    let half = (matrix[q * n + q] - matrix[p * n + p]) / (2.0 * off);
    let tangent = half.signum() / (half.abs() + half.hypot(1.0));
    let cosine = 1.0 / tangent.hypot(1.0);
    let sine = tangent * cosine;
    for k in 0..n {
        if k == p || k == q {
            continue;
        }
        let (a, b) = (matrix[k * n + p], matrix[k * n + q]);
        let (a, b) = (cosine * a - sine * b, sine * a + cosine * b);
        matrix[k * n + p] = a;
        matrix[p * n + k] = a;
        matrix[k * n + q] = b;
        matrix[q * n + k] = b;
    }
    matrix[p * n + p] -= tangent * off;
    matrix[q * n + q] += tangent * off;
    matrix[p * n + q] = 0.0;
    matrix[q * n + p] = 0.0;
    if !vector.is_empty() {
        let (a, b) = (vector[p], vector[q]);
        vector[p] = cosine * a - sine * b;
        vector[q] = sine * a + cosine * b;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn eigenvalues(matrix: &[f64], n: usize) -> Vec<f64> {
        let mut work = matrix.to_vec();
        diagonalise(&mut work, n, &mut []);
        let mut values: Vec<f64> = (0..n).map(|i| work[i * n + i]).collect();
        values.sort_by(f64::total_cmp);
        values
    }

    #[test]
    fn second_difference_matrix_has_its_closed_form() {
        for n in [2, 7, 8, 30] {
            let mut matrix = vec![0.0; n * n];
            for i in 0..n {
                matrix[i * n + i] = 2.0;
                if i + 1 < n {
                    matrix[i * n + i + 1] = -1.0;
                    matrix[(i + 1) * n + i] = -1.0;
                }
            }
            for (k, value) in eigenvalues(&matrix, n).iter().enumerate() {
                let angle = core::f64::consts::PI * (k + 1) as f64 / (2 * (n + 1)) as f64;
                let exact = 4.0 * angle.sin().powi(2);
                assert!((value - exact).abs() < 2e-14, "{n} {k}");
            }
        }
    }

    /// Both ways, on the same matrix: `sum_k nu_k c_k^2 = v^T A v` for any `v`, whatever the order.
    #[test]
    fn both_ways_carry_the_same_vector() {
        const N: usize = 12;
        let matrix: Vec<f64> = (0..N * N)
            .map(|k| ((k / N + 1) as f64 * (k % N + 1) as f64).sin() + if k / N == k % N { 3.0 } else { 0.0 })
            .collect();
        let vector: Vec<f64> = (0..N).map(|i| 1.0 / (1.0 + i as f64)).collect();
        let [one, other] = [jacobi, |a: &mut [f64], n, v: &mut [f64]| {
            assert!(tridiagonal(a, n, v));
        }]
        .map(|way| {
            let (mut work, mut turned) = (matrix.clone(), vector.clone());
            way(&mut work, N, &mut turned);
            let mut pairs: Vec<_> = (0..N).map(|i| (work[i * (N + 1)], turned[i].powi(2))).collect();
            pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
            pairs
        });
        for (a, b) in one.iter().zip(&other) {
            assert!((a.0 - b.0).abs() < 1e-13 && (a.1 - b.1).abs() < 1e-13);
        }
    }

    #[test]
    fn vector_is_carried_along() {
        // v^T A^k v does not change under the rotation.
        let matrix = [2.0, -1.0, 0.5, -1.0, 3.0, 0.25, 0.5, 0.25, -4.0];
        let vector = [1.0, -2.0, 0.5];
        let (mut work, mut turned) = (matrix, vector);
        diagonalise(&mut work, 3, &mut turned);
        let once: f64 = (0..9).map(|e| vector[e / 3] * matrix[e] * vector[e % 3]).sum();
        let again: f64 = (0..3).map(|i| turned[i].powi(2) * work[4 * i]).sum();
        assert!((once - again).abs() < 1e-13);
        let twice: f64 = (0..3).map(|i| (0..3).map(|j| matrix[3 * i + j] * vector[j]).sum::<f64>().powi(2)).sum();
        let again: f64 = (0..3).map(|i| (turned[i] * work[4 * i]).powi(2)).sum();
        assert!((twice - again).abs() < 1e-12);
    }

    #[test]
    fn hard_scales_converge() {
        assert_eq!(eigenvalues(&[0.0; 4], 2), [0.0, 0.0]);
        assert_eq!(eigenvalues(&[], 0), [0.0; 0]);
        assert_eq!(eigenvalues(&[7.0], 1), [7.0]);
        let huge = eigenvalues(&[1e200, 1e200, 1e200, 1e200], 2);
        assert!(huge[0].abs() < 1e185 && (huge[1] / 2e200 - 1.0).abs() < 1e-14);
        let graded = eigenvalues(&[1.0, 1e-200, 1e-200, -1e-300], 2);
        assert!((graded[1] - 1.0).abs() < 1e-15 && graded[0].abs() < 1e-16);
        let subnormal = eigenvalues(&[0.0, 5e-324, 5e-324, 0.0], 2);
        assert!(subnormal.iter().all(|value| value.is_finite()));
    }
}
