//! Linear algebra on plain arrays: small systems stay on the stack, whatever their size, without a matrix library.
#![allow(
    clippy::needless_range_loop,
    reason = "index loops read as the formulas they are"
)]

use crate::Complex;

/// A square matrix, `matrix[row][column]`.
pub(crate) type Square<const N: usize> = [[f64; N]; N];

/// `matrix x` for a complex vector.
pub(crate) fn times_complex<const N: usize>(matrix: &Square<N>, x: &[Complex; N]) -> [Complex; N] {
    core::array::from_fn(|i| {
        matrix[i]
            .iter()
            .zip(x)
            .fold(Complex::default(), |sum, (a, b)| sum + b * a)
    })
}

/// `x^T y`, without conjugation.
pub(crate) fn dot_complex<const N: usize>(x: &[Complex; N], y: &[Complex; N]) -> Complex {
    x.iter()
        .zip(y)
        .fold(Complex::default(), |sum, (a, b)| sum + a * b)
}

pub(crate) fn dot<const N: usize>(a: &[f64; N], b: &[f64; N]) -> f64 {
    // The neutral element of addition: the first sum costs nothing.
    let mut sum = -0.0;
    for i in 0..N {
        sum += a[i] * b[i];
    }
    sum
}

pub(crate) fn times<const R: usize, const C: usize>(
    matrix: &[[f64; C]; R],
    x: &[f64; C],
) -> [f64; R] {
    core::array::from_fn(|i| dot(&matrix[i], x))
}

/// `a + factor * b`.
pub(crate) fn add_scaled<const N: usize>(a: &[f64; N], factor: f64, b: &[f64; N]) -> [f64; N] {
    core::array::from_fn(|i| a[i] + factor * b[i])
}

/// Quadratic form `x^T matrix y`.
pub(crate) fn form<const N: usize>(x: &[f64; N], matrix: &Square<N>, y: &[f64; N]) -> f64 {
    dot(x, &times(matrix, y))
}

pub(crate) fn transpose<const R: usize, const C: usize>(matrix: &[[f64; C]; R]) -> [[f64; R]; C] {
    core::array::from_fn(|j| core::array::from_fn(|i| matrix[i][j]))
}

pub(crate) fn largest<const N: usize>(x: &[f64; N]) -> f64 {
    x.iter().fold(0.0, |most, value| greater(most, value.abs()))
}

/// The greater of two numbers, the first one where the second is NaN; one instruction, unlike [`f64::max`].
#[inline]
pub(crate) fn greater(most: f64, value: f64) -> f64 {
    if value > most { value } else { most }
}

pub(crate) fn largest_element<const N: usize>(matrix: &Square<N>) -> f64 {
    matrix
        .iter()
        .fold(0.0, |most, row| greater(most, largest(row)))
}

/// Whether no value is NaN or infinite; of a few values, without a branch for each.
#[inline]
pub(crate) fn all_finite<const N: usize>(x: &[f64; N]) -> bool {
    x.iter().fold(0.0, |sum, value| sum + unless_finite(*value)) == 0.0
}

/// NaN unless a value is finite: then zero.
#[inline]
pub(crate) fn unless_finite(value: f64) -> f64 {
    0.0 * value
}

/// As [`all_finite`].
#[inline]
pub(crate) fn all_finite_square<const N: usize>(matrix: &Square<N>) -> bool {
    let values = matrix.iter().flatten();
    values.fold(0.0, |sum, value| sum + unless_finite(*value)) == 0.0
}

/// Greatest difference of mirrored elements, relative to the greatest element.
pub(crate) fn asymmetry<const N: usize>(matrix: &Square<N>) -> f64 {
    let size = largest_element(matrix);
    let mut most = 0.0_f64;
    for i in 0..N {
        for j in 0..i {
            most = most.max((matrix[i][j] - matrix[j][i]).abs());
        }
    }
    if size > 0.0 { most / size } else { 0.0 }
}

/// Factors of a symmetric positive definite matrix, `matrix = L D L^T`: Cholesky's without roots.
pub(crate) struct Cholesky<const N: usize> {
    /// `L` below the diagonal, which is one.
    lower: Square<N>,
    /// The diagonal of `D`.
    pivots: [f64; N],
}

impl<const N: usize> Cholesky<N> {
    /// Factors `matrix`; `Err` names the first row whose pivot is not above rounding.
    #[inline]
    pub(crate) fn new(matrix: &Square<N>) -> Result<Self, usize> {
        let threshold = 8.0 * N as f64 * f64::EPSILON;
        let mut lower = [[0.0; N]; N];
        let mut pivots = [0.0; N];
        for i in 0..N {
            let mut pivot = matrix[i][i];
            let mut scaled = [0.0; N];
            for j in 0..i {
                let mut sum = matrix[i][j];
                for k in 0..j {
                    sum -= scaled[k] * lower[j][k];
                }
                scaled[j] = sum;
                lower[i][j] = sum / pivots[j];
                pivot -= sum * lower[i][j];
            }
            if pivot > threshold * matrix[i][i].abs() && pivot < f64::INFINITY {
                pivots[i] = pivot;
            } else {
                return Err(i);
            }
        }
        Ok(Self { lower, pivots })
    }

    /// The diagonal of `D`.
    #[inline]
    pub(crate) fn pivots(&self) -> &[f64; N] {
        &self.pivots
    }

    /// Turns vectors `x_i` whose products are `matrix` into orthonormal ones: `sum_j x_j L^-T D^-1/2`.
    pub(crate) fn orthonormalise(&self, vectors: &mut [[f64; N]]) {
        for i in 0..vectors.len() {
            for k in 0..i {
                vectors[i] = add_scaled(&vectors[i], -self.lower[i][k], &vectors[k]);
            }
        }
        for (vector, pivot) in vectors.iter_mut().zip(self.pivots) {
            let size = pivot.sqrt();
            *vector = vector.map(|value| value / size);
        }
    }

    #[inline]
    pub(crate) fn solve(&self, right: &[f64; N]) -> [f64; N] {
        let mut x = *right;
        for i in 0..N {
            for k in 0..i {
                x[i] -= self.lower[i][k] * x[k];
            }
        }
        for i in (0..N).rev() {
            x[i] /= self.pivots[i];
            for k in i + 1..N {
                x[i] -= self.lower[k][i] * x[k];
            }
        }
        x
    }
}

/// What a linear system is solved in: real or complex numbers.
pub(crate) trait Field:
    Copy
    + PartialEq
    + core::ops::Add<Output = Self>
    + core::ops::Sub<Output = Self>
    + core::ops::Mul<Output = Self>
    + core::ops::Div<Output = Self>
{
    /// A magnitude within a factor of two of the absolute value.
    fn size(self) -> f64;
}

impl Field for f64 {
    fn size(self) -> f64 {
        self.abs()
    }
}

impl Field for Complex {
    fn size(self) -> f64 {
        self.l1_norm()
    }
}

/// Triangular factors of a general matrix with row exchanges.
pub(crate) struct Lu<T, const N: usize> {
    factors: [[T; N]; N],
    order: [usize; N],
    odd: bool,
}

impl<T: Field, const N: usize> Lu<T, N> {
    /// Factors `matrix`; `None` when a pivot does not rise above the rounding of its own row.
    pub(crate) fn new(matrix: &[[T; N]; N]) -> Option<Self> {
        let threshold = 8.0 * N as f64 * f64::EPSILON;
        let mut factors = *matrix;
        let mut order: [usize; N] = core::array::from_fn(|i| i);
        let mut size: [f64; N] = core::array::from_fn(|i| {
            matrix[i]
                .iter()
                .fold(0.0, |most: f64, value| most.max(value.size()))
        });
        let mut odd = false;
        for k in 0..N {
            let mut best = k;
            let mut most = -1.0;
            for i in k..N {
                let relative = factors[i][k].size() / size[i];
                if relative > most {
                    best = i;
                    most = relative;
                }
            }
            if most.is_nan() || most <= threshold {
                return None;
            }
            if best != k {
                factors.swap(k, best);
                order.swap(k, best);
                size.swap(k, best);
                odd = !odd;
            }
            for i in k + 1..N {
                let factor = factors[i][k] / factors[k][k];
                factors[i][k] = factor;
                for j in k + 1..N {
                    factors[i][j] = factors[i][j] - factor * factors[k][j];
                }
            }
        }
        Some(Self {
            factors,
            order,
            odd,
        })
    }

    pub(crate) fn solve(&self, right: &[T; N]) -> [T; N] {
        let mut x: [T; N] = core::array::from_fn(|i| right[self.order[i]]);
        for i in 0..N {
            for k in 0..i {
                x[i] = x[i] - self.factors[i][k] * x[k];
            }
        }
        for i in (0..N).rev() {
            for k in i + 1..N {
                x[i] = x[i] - self.factors[i][k] * x[k];
            }
            x[i] = x[i] / self.factors[i][i];
        }
        x
    }
}

impl<const N: usize> Lu<f64, N> {
    /// Whether the determinant is negative.
    pub(crate) fn negative_determinant(&self) -> bool {
        (0..N).fold(self.odd, |negative, i| {
            negative != (self.factors[i][i] < 0.0)
        })
    }

    /// Solves for the real and the imaginary part.
    pub(crate) fn solve_complex(&self, right: &[Complex; N]) -> [Complex; N] {
        let re = self.solve(&right.map(|value| value.re));
        let im = self.solve(&right.map(|value| value.im));
        core::array::from_fn(|i| Complex::new(re[i], im[i]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_factorisations_solve() {
        let matrix = [[4.0, 1.0, 0.5], [1.0, 3.0, -1.0], [0.5, -1.0, 5.0]];
        let x = [1.0, -2.0, 3.0];
        let right = times(&matrix, &x);
        let Ok(cholesky) = Cholesky::new(&matrix) else {
            panic!("positive definite")
        };
        let Some(lu) = Lu::new(&matrix) else {
            panic!("regular")
        };
        for solution in [cholesky.solve(&right), lu.solve(&right)] {
            assert!(largest(&add_scaled(&solution, -1.0, &x)) < 1e-14);
        }
        assert!(!lu.negative_determinant());
    }

    #[test]
    fn singular_matrices_are_refused() {
        let singular = [[1.0, 2.0], [2.0, 4.0]];
        assert_eq!(Cholesky::new(&singular).err(), Some(1));
        assert!(Lu::new(&singular).is_none());
        assert!(Lu::new(&[[0.0; 2]; 2]).is_none());
        assert!(Lu::new(&[[f64::NAN; 2]; 2]).is_none());
    }

    #[test]
    fn sign_of_determinant_follows_exchanges() {
        let Some(swap) = Lu::new(&[[0.0, 1.0], [1.0, 0.0]]) else {
            panic!("regular")
        };
        assert!(swap.negative_determinant());
    }
}
