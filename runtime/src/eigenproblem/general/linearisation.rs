//! The balanced companion form of a scaled pencil, whose eigenvalues are the starting values for all other steps.

use num_complex::Complex64;

use super::hessenberg;
use super::pencil::{Degree, Pencil, modulus};

use crate::eigenproblem::symmetric::{Trouble, factor_into};

/// `x' = A x` for `x = D^-1 (y, s y)`, `phi = L^-T y`, `M = L L^T`, with
/// `A = D^-1 [[0, I], [-L^-1 K L^-T, -L^-1 C L^-T]] D`; for a first-order pencil `A = -K`, which is already balanced.
pub(super) struct Linearisation<'a> {
    n: usize,
    degree: Degree,
    lower: &'a [f64],
    /// `L^-1 C L^-T` and `L^-1 K L^-T`.
    damping: &'a [f64],
    stiffness: &'a [f64],
    /// Diagonal of `D`.
    scales: &'a [f64],
    /// Frobenius norm of `A`.
    pub(super) size: f64,
}

impl<'a> Linearisation<'a> {
    /// Builds `A` in `companion`, using `3 n^2 + 2 n` numbers of `store`.
    pub(super) fn new(
        pencil: &Pencil,
        companion: &mut [f64],
        store: &'a mut [f64],
    ) -> Result<Self, Trouble> {
        let n = pencil.n;
        let (lower, store) = store.split_at_mut(n * n);
        let (damping, store) = store.split_at_mut(n * n);
        let (stiffness, store) = store.split_at_mut(n * n);
        let scales = &mut store[..2 * n];
        if pencil.degree == Degree::One {
            for (a, k) in companion.iter_mut().zip(pencil.stiffness) {
                *a = -k;
            }
            stiffness.copy_from_slice(pencil.stiffness);
            return Ok(Self {
                n,
                degree: pencil.degree,
                lower,
                damping,
                size: frobenius(companion),
                stiffness,
                scales,
            });
        }
        factor_into(n, pencil.mass, lower)?;
        damping.copy_from_slice(pencil.damping);
        stiffness.copy_from_slice(pencil.stiffness);
        reduce(n, lower, damping);
        reduce(n, lower, stiffness);
        companion.fill(0.0);
        for i in 0..n {
            companion[i * 2 * n + n + i] = 1.0;
            for j in 0..n {
                companion[(n + i) * 2 * n + j] = -stiffness[i * n + j];
                companion[(n + i) * 2 * n + n + j] = -damping[i * n + j];
            }
        }
        hessenberg::balance(2 * n, companion, scales);
        let size = frobenius(companion);
        Ok(Self {
            n,
            degree: pencil.degree,
            lower,
            damping,
            stiffness,
            scales,
            size,
        })
    }

    /// The sum of all eigenvalues: `-tr(M^-1 C)`, or `-tr K` for a first-order pencil.
    pub(super) fn sum(&self) -> f64 {
        let matrix = match self.degree {
            Degree::One => self.stiffness,
            Degree::Two => self.damping,
        };
        -(0..self.n).map(|i| matrix[i * (self.n + 1)]).sum::<f64>()
    }

    /// Condition number of `s` as an eigenvalue of `A`, from the vectors of the pencil and
    /// `slope = psi^T (2 s M + C) phi`. `work` needs `n` numbers.
    pub(super) fn condition(
        &self,
        s: Complex64,
        right: &[Complex64],
        left: &[Complex64],
        slope: Complex64,
        work: &mut [Complex64],
    ) -> f64 {
        let n = self.n;
        if self.degree == Degree::One {
            let square = |x: &[Complex64]| x.iter().map(Complex64::norm_sqr).sum::<f64>();
            return at_least_one((square(right) * square(left)).sqrt() / modulus(slope));
        }
        let s_square = s.norm_sqr();
        let (mut x, mut w) = (0.0, 0.0);
        let transformed = |phi: &[Complex64], j: usize| {
            let mut sum = Complex64::ZERO;
            for i in j..n {
                sum += phi[i] * self.lower[i * n + j];
            }
            sum
        };
        for j in 0..n {
            let (up, down) = (self.scales[j], self.scales[n + j]);
            let y = transformed(right, j).norm_sqr();
            x += y / (up * up) + s_square * y / (down * down);
            let w2 = transformed(left, j);
            work[j] = w2;
            w += w2.norm_sqr() * (down * down);
        }
        // The upper half of the left vector is (s + C^T) w2 = -K^T w2 / s; use the form with less cancellation.
        let small = s_square < 1e-2;
        let matrix = if small { self.damping } else { self.stiffness };
        for j in 0..n {
            let mut sum = Complex64::ZERO;
            for i in 0..n {
                sum += work[i] * matrix[i * n + j];
            }
            let square = if small {
                (sum + s * work[j]).norm_sqr()
            } else {
                sum.norm_sqr() / s_square
            };
            w += square * (self.scales[j] * self.scales[j]);
        }
        at_least_one((x * w).sqrt() / modulus(slope))
    }
}

fn at_least_one(condition: f64) -> f64 {
    if condition.is_nan() {
        f64::INFINITY
    } else {
        condition.max(1.0)
    }
}

fn frobenius(matrix: &[f64]) -> f64 {
    matrix.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// `L^-1 matrix L^-T` in place.
fn reduce(n: usize, lower: &[f64], matrix: &mut [f64]) {
    for i in 0..n {
        for k in 0..i {
            let factor = lower[i * n + k];
            for j in 0..n {
                matrix[i * n + j] -= factor * matrix[k * n + j];
            }
        }
        for j in 0..n {
            matrix[i * n + j] /= lower[i * n + i];
        }
    }
    for row in matrix.chunks_exact_mut(n) {
        for i in 0..n {
            for k in 0..i {
                row[i] -= lower[i * n + k] * row[k];
            }
            row[i] /= lower[i * n + i];
        }
    }
}
