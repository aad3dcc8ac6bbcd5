//! Tridiagonal form of a real skew-symmetric matrix by reflections (Ward and Gray, "Eigensystem computation for
//! skew-symmetric matrices", 1978).

use crate::eigenproblem::dense::{add, dot};
use crate::scalar::Real;

/// The reflections `I - factor v v^T` that made a matrix tridiagonal.
pub(super) struct Reflections {
    n: usize,
    /// Row `i` begins with the `v` of length `i` that zeroed row `i` to the left of the subdiagonal.
    vectors: Vec<f64>,
    /// Zero where there was nothing to do.
    factors: Vec<f64>,
}

/// `matrix = Q T Q^T` for a skew-symmetric matrix of size `n`, given row by row by its lower triangle. Returns `Q` and
/// the elements `T[i][i - 1]`, the first of which is zero.
pub(super) fn tridiagonal(n: usize, mut matrix: Vec<f64>) -> (Reflections, Vec<f64>) {
    let (mut factors, mut beside) = (vec![0.0; n], vec![0.0; n]);
    let mut product = vec![0.0; n];
    f64::run(
        #[inline(always)]
        || {
            for i in (1..n).rev() {
                let (above, v) = matrix.split_at_mut(i * n);
                let v = &mut v[..i];
                (beside[i], factors[i]) = reflector(v);
                if factors[i] != 0.0 {
                    let product = &mut product[..i];
                    times(n, above, v, product);
                    product.iter_mut().for_each(|x| *x *= factors[i]);
                    // H W H = W + v p^T - p v^T, because v^T W v = 0.
                    for (r, row) in above.chunks_exact_mut(n).enumerate() {
                        let (of_v, of_p) = (v[r], product[r]);
                        for ((x, v), p) in row[..r].iter_mut().zip(&v[..r]).zip(&product[..r]) {
                            *x += of_v * p - of_p * v;
                        }
                    }
                }
            }
        },
    );
    let vectors = matrix;
    let reflections = Reflections { n, vectors, factors };
    (reflections, beside)
}

/// Makes a row the `v` of the reflection that leaves only its last element, and returns that and the factor.
#[inline(always)]
fn reflector(v: &mut [f64]) -> (f64, f64) {
    let last = v.len() - 1;
    let others = v[..last].iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    if others == 0.0 {
        return (v[last], 0.0);
    }
    let size = others.max(v[last].abs());
    v.iter_mut().for_each(|x| *x /= size);
    let square = dot(v, v);
    let norm = square.sqrt().copysign(v[last]);
    let factor = 1.0 / (square + norm * v[last]);
    v[last] += norm;
    (-norm * size, factor)
}

/// `matrix v` for the first `v.len()` rows and columns.
#[inline(always)]
fn times(n: usize, matrix: &[f64], v: &[f64], into: &mut [f64]) {
    into.fill(0.0);
    for (r, row) in matrix.chunks_exact(n).take(v.len()).enumerate() {
        let row = &row[..r];
        add(-v[r], row, &mut into[..r]);
        into[r] += dot(row, &v[..r]);
    }
}

impl Reflections {
    /// `Q X` in place, for `X` with rows of length `columns`.
    pub(super) fn apply(&self, columns: usize, x: &mut [f64]) {
        let n = self.n;
        let mut sums = vec![0.0; columns];
        f64::run(
            #[inline(always)]
            || {
                for i in 1..n {
                    let factor = self.factors[i];
                    if factor == 0.0 {
                        continue;
                    }
                    let v = &self.vectors[i * n..i * n + i];
                    sums.fill(0.0);
                    for (x, v) in x.chunks_exact(columns).zip(v) {
                        add(*v, x, &mut sums);
                    }
                    for (x, v) in x.chunks_exact_mut(columns).zip(v) {
                        add(-factor * v, &sums, x);
                    }
                }
            },
        );
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_similar_to_the_matrix() {
        const N: usize = 7;
        let skew: [f64; N * N] = core::array::from_fn(|k| {
            let (i, j) = (k / N, k % N);
            let value = ((i * j) as f64 + 0.3 * (i + j) as f64).sin();
            match i.cmp(&j) {
                core::cmp::Ordering::Greater => value,
                core::cmp::Ordering::Less => -value,
                core::cmp::Ordering::Equal => 0.0,
            }
        });
        let (q, beside) = tridiagonal(N, skew.to_vec());
        let mut rotation = [0.0; N * N];
        (0..N).for_each(|i| rotation[i * N + i] = 1.0);
        q.apply(N, &mut rotation);
        let tridiagonal = |i: usize, j: usize| match (i, j) {
            _ if i == j + 1 => beside[i],
            _ if j == i + 1 => -beside[j],
            _ => 0.0,
        };
        for i in 0..N {
            for j in 0..N {
                let terms = (0..N * N).map(|k| {
                    let (a, b) = (k / N, k % N);
                    rotation[i * N + a] * tridiagonal(a, b) * rotation[j * N + b]
                });
                assert!((terms.sum::<f64>() - skew[i * N + j]).abs() < 1e-14);
                let product: f64 = (0..N).map(|k| rotation[i * N + k] * rotation[j * N + k]).sum();
                let one = if i == j { 1.0 } else { 0.0 };
                assert!((product - one).abs() < 1e-14);
            }
        }
    }
}
