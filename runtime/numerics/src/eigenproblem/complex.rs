//! Eigenvalues of a small complex matrix, in place, with bounded effort and no allocation: QR with one shift at a time.
#![allow(clippy::needless_range_loop, reason = "index loops read as the formulas they are")]

use crate::Complex;

/// Most QR steps per eigenvalue; two or three are usual.
const STEPS: usize = 40;

/// Fills `values` with the eigenvalues of the `n` x `n` matrix (row by row), in no particular order, and destroys the
/// matrix. Returns `false` if the iteration did not converge. Elements must be finite.
pub fn eigenvalues(matrix: &mut [Complex], values: &mut [Complex]) -> bool {
    let n = values.len();
    let size = matrix.iter().fold(0.0_f64, |most, x| most.max(x.re.abs()).max(x.im.abs()));
    if size == 0.0 {
        values.fill(Complex::default());
        return true;
    }
    matrix.iter_mut().for_each(|x| *x /= size);
    let converged = match *matrix {
        [a, b, c, d] => {
            values.copy_from_slice(&two(a, b, c, d));
            true
        }
        _ => {
            hessenberg(matrix, n);
            iterate(matrix, n, values)
        }
    };
    values.iter_mut().for_each(|x| *x *= size);
    converged
}

/// Eigenvalues of `[[a, b], [c, d]]`.
fn two(a: Complex, b: Complex, c: Complex, d: Complex) -> [Complex; 2] {
    let (middle, half) = (0.5 * (a + d), 0.5 * (a - d));
    let root = (half * half + b * c).sqrt();
    [middle - root, middle + root]
}

/// A rotation `[[conj c, conj s], [-s, c]]` that turns `(x, y)` into `(r, 0)`.
fn rotation(x: Complex, y: Complex) -> (Complex, Complex) {
    let size = x.norm().hypot(y.norm());
    if size == 0.0 {
        return (Complex::new(1.0, 0.0), Complex::default());
    }
    (x / size, y / size)
}

/// Applies a rotation to rows `i` and `i + 1` from column `from` on.
fn turn_rows(a: &mut [Complex], n: usize, i: usize, (c, s): (Complex, Complex), from: usize) {
    for k in from..n {
        let (x, y) = (a[i * n + k], a[(i + 1) * n + k]);
        a[i * n + k] = c.conj() * x + s.conj() * y;
        a[(i + 1) * n + k] = c * y - s * x;
    }
}

/// Applies the inverse of a rotation to columns `j` and `j + 1` of the rows before `to`.
fn turn_columns(a: &mut [Complex], n: usize, j: usize, (c, s): (Complex, Complex), to: usize) {
    for k in 0..to {
        let (x, y) = (a[k * n + j], a[k * n + j + 1]);
        a[k * n + j] = c * x + s * y;
        a[k * n + j + 1] = c.conj() * y - s.conj() * x;
    }
}

/// Zeros everything below the subdiagonal by a unitary similarity transformation.
fn hessenberg(a: &mut [Complex], n: usize) {
    for k in 0..n.saturating_sub(2) {
        for i in (k + 1..n - 1).rev() {
            let turn = rotation(a[i * n + k], a[(i + 1) * n + k]);
            turn_rows(a, n, i, turn, 0);
            turn_columns(a, n, i, turn, n);
            a[(i + 1) * n + k] = Complex::default();
        }
    }
}

/// Explicit QR iteration with Wilkinson's shift on a complex Hessenberg matrix (Golub and Van Loan, Matrix
/// Computations, sections 7.5 and 8.3).
fn iterate(a: &mut [Complex], n: usize, values: &mut [Complex]) -> bool {
    let mut end = n;
    let mut steps = 0;
    while end > 0 {
        let last = end - 1;
        let start = active_start(a, n, last);
        if start == last {
            values[last] = a[last * n + last];
            end -= 1;
            steps = 0;
            continue;
        }
        if steps == STEPS {
            return false;
        }
        steps += 1;
        let shift = if steps % 10 == 0 {
            // Breaks a cycle.
            a[last * n + last] + a[last * n + last - 1].norm()
        } else {
            wilkinson(a, n, last)
        };
        step(a, n, (start, end), shift);
    }
    true
}

/// First row of the undivided block that ends with row `last`.
fn active_start(a: &mut [Complex], n: usize, last: usize) -> usize {
    for i in (1..=last).rev() {
        let beside = a[(i - 1) * n + i - 1].l1_norm() + a[i * n + i].l1_norm();
        let scale = if beside > 0.0 { beside } else { 1.0 };
        if a[i * n + i - 1].l1_norm() <= f64::EPSILON * scale {
            a[i * n + i - 1] = Complex::default();
            return i;
        }
    }
    0
}

/// The eigenvalue of the last 2 x 2 block that is closer to the last element.
fn wilkinson(a: &[Complex], n: usize, last: usize) -> Complex {
    let at = |i: usize, j: usize| a[i * n + j];
    let corner = at(last, last);
    let [one, other] = two(at(last - 1, last - 1), at(last - 1, last), at(last, last - 1), corner);
    if (one - corner).norm() <= (other - corner).norm() { one } else { other }
}

/// `A - shift = Q R`, then `R Q + shift`, on the block of rows and columns `start..end`.
fn step(a: &mut [Complex], n: usize, (start, end): (usize, usize), shift: Complex) {
    for i in start..end {
        a[i * n + i] -= shift;
    }
    // The columns lag one rotation behind the rows, which still need their elements.
    let mut before = None;
    for i in start..end - 1 {
        let turn = rotation(a[i * n + i], a[(i + 1) * n + i]);
        turn_rows(a, n, i, turn, i);
        if let Some(before) = before {
            turn_columns(a, n, i - 1, before, i + 1);
        }
        before = Some(turn);
    }
    if let Some(before) = before {
        turn_columns(a, n, end - 2, before, end);
    }
    for i in start..end {
        a[i * n + i] += shift;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(matrix: &[Complex]) -> Vec<Complex> {
        let n = matrix.len().isqrt();
        let (mut work, mut values) = (matrix.to_vec(), vec![Complex::default(); n]);
        assert!(eigenvalues(&mut work, &mut values));
        values
    }

    /// Whether every element of `wanted` is found exactly once, to within `tolerance`.
    fn same(mut complexes: Vec<Complex>, wanted: &[Complex], tolerance: f64) {
        assert_eq!(complexes.len(), wanted.len());
        for want in wanted {
            let apart = |value: &Complex| (value - want).norm();
            let nearest = (0..complexes.len()).min_by(|&a, &b| apart(&complexes[a]).total_cmp(&apart(&complexes[b])));
            let Some(nearest) = nearest else { panic!("none left") };
            let value = complexes.swap_remove(nearest);
            assert!(apart(&value) <= tolerance, "{value} is not {want}");
        }
    }

    /// A random number in the square of side 2 about zero, from this test's own generator.
    fn random(seed: &mut u64) -> Complex {
        let mut next = || {
            *seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (*seed >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
        };
        Complex::new(next(), next())
    }

    #[test]
    fn companion_matrices_have_the_roots_of_unity() {
        for n in 1..12 {
            let mut matrix = vec![Complex::default(); n * n];
            for i in 1..n {
                matrix[i * n + i - 1] = Complex::new(1.0, 0.0);
            }
            matrix[n - 1] = Complex::new(1.0, 0.0);
            let root = |k| Complex::cis(core::f64::consts::TAU * k as f64 / n as f64);
            same(of(&matrix), &(0..n).map(root).collect::<Vec<_>>(), 1e-13);
        }
    }

    /// `T diag(d) T^-1` with unit triangular factors of known inverse.
    #[test]
    fn similar_matrices_have_the_values_they_were_made_from() {
        let mut seed = 5;
        for n in 2..9 {
            let values: Vec<_> = (0..n).map(|_| random(&mut seed)).collect();
            let mut matrix = vec![Complex::default(); n * n];
            for (i, value) in values.iter().enumerate() {
                matrix[i * n + i] = *value;
            }
            for _ in 0..3 * n {
                // E A E^-1 with E = 1 + f e_i e_j^T.
                let (f, pick) = (random(&mut seed), random(&mut seed));
                let i = ((pick.re + 1.0) * 0.5 * n as f64) as usize;
                let j = (i + 1 + ((pick.im + 1.0) * 0.5 * (n - 1) as f64) as usize) % n;
                for k in 0..n {
                    let part = f * matrix[j * n + k];
                    matrix[i * n + k] += part;
                }
                for k in 0..n {
                    let part = f * matrix[k * n + i];
                    matrix[k * n + j] -= part;
                }
            }
            let size = matrix.iter().fold(0.0_f64, |most, x| most.max(x.norm()));
            same(of(&matrix), &values, 1e-12 * size * size);
        }
    }

    #[test]
    fn multiple_and_extreme_values_converge() {
        let zero = Complex::default();
        same(of(&[zero; 25]), &[zero; 5], 0.0);
        let mut block = vec![zero; 9];
        (block[1], block[5]) = (Complex::new(1.0, 0.0), Complex::new(0.0, 1.0));
        same(of(&block), &[zero; 3], 1e-5);
        let one = Complex::new(1.0, 0.0);
        same(of(&[one; 9]), &[zero, zero, 3.0 * one], 1e-14);
        same(of(&[1e-200 * one; 9]), &[zero, zero, 3e-200 * one], 1e-214);
        same(of(&[1e140 * one; 9]), &[zero, zero, 3e140 * one], 1e126);
        let rotation = [zero, -one, one, zero];
        same(of(&rotation), &[Complex::i(), -Complex::i()], 1e-15);
    }
}
