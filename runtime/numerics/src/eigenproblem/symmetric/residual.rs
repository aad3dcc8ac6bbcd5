//! The residual `K phi - lambda M phi` of a pair, and the resulting error of its eigenvalue.
#![allow(clippy::needless_range_loop, reason = "index loops read as the formulas they are")]

use crate::algebra::{Vector, greater};
use crate::eigenproblem::dense;
use crate::rounding::of_elements;

/// Stiffness and mass, row by row.
pub(crate) struct Matrices<'a> {
    pub(crate) n: usize,
    pub(crate) k: &'a [f64],
    pub(crate) m: &'a [f64],
}

impl Matrices<'_> {
    /// Largest component of `K phi - lambda M phi`, relative to the sums of absolute terms in the rows.
    #[inline(always)]
    pub(crate) fn relative_residual(&self, lambda: f64, phi: &[f64]) -> f64 {
        self.rest(self.n, lambda, phi).relative()
    }

    /// Distance from `lambda` within which there is an eigenvalue: the length of `K phi - lambda M phi` in the metric
    /// `M^-1`, for `phi^T M phi = 1` (Parlett, "The Symmetric Eigenvalue Problem", 1998, theorem 15.9.1).
    #[cold]
    pub(super) fn distance(&self, lambda: f64, phi: &[f64]) -> f64 {
        let n = self.n;
        let mut lower = vec![0.0; n * n];
        if dense::cholesky(n, self.m, &mut lower).is_err() {
            return f64::INFINITY;
        }
        let mut rest = self.residual(lambda, phi).to_vec();
        dense::solve_lower(n, &lower, 1, &mut rest);
        rest.iter().map(|x| x * x).sum::<f64>().sqrt()
    }

    fn residual(&self, lambda: f64, phi: &[f64]) -> Vector {
        let n = self.n;
        let row = |matrix: &[f64], i: usize| dense::dot(&matrix[i * n..(i + 1) * n], phi);
        Vector::from_fn(n, |i| row(self.k, i) - lambda * row(self.m, i))
    }

    /// Error of an eigenvalue caused by components of other modes in its shape `r`.
    #[cold]
    pub(super) fn error_of_shape(&self, lambda: &[f64], shapes: &[f64], r: usize) -> f64 {
        let n = self.n;
        let phi = &shapes[r * n..(r + 1) * n];
        let rest = self.residual(lambda[r], phi);
        let part = |values: &[f64]| values.iter().zip(&rest).map(|(a, b)| a * b).sum();
        second_order(lambda, r, shapes.chunks_exact(n).map(part))
    }

    /// The relative residual of a pair, for matrices of size `n`, and the error of its eigenvalue.
    #[inline(always)]
    pub(super) fn measured(&self, n: usize, lambda: f64, phi: &[f64]) -> (f64, f64) {
        let rest = self.rest(n, lambda, phi);
        (rest.relative(), rest.error(n))
    }

    /// The residual `K phi - lambda M phi`.
    #[inline(always)]
    fn rest(&self, n: usize, lambda: f64, phi: &[f64]) -> Rest {
        let mut rest = Rest::default();
        for i in 0..n {
            let (mut sum, mut terms) = (0.0, 0.0);
            let (k, m) = (&self.k[i * n..(i + 1) * n], &self.m[i * n..(i + 1) * n]);
            for ((k, m), phi) in k.iter().zip(m).zip(phi) {
                let (k, m) = (k * phi, lambda * m * phi);
                sum += k - m;
                terms += k.abs() + m.abs();
            }
            if sum.is_nan() {
                rest.most = f64::NAN;
                return rest;
            }
            rest.add(phi[i], sum, terms);
        }
        rest
    }
}

/// Error of an eigenvalue `r` caused by components of other modes in its shape: of second order, twice the sum of
/// `(phi_s^T (K - lambda M) phi_r)^2 / |lambda_s - lambda_r|`, given by its `parts`.
pub(super) fn second_order(lambda: &[f64], r: usize, parts: impl Iterator<Item = f64>) -> f64 {
    let mut sum = 0.0;
    for (s, part) in parts.enumerate().filter(|(s, _)| *s != r) {
        let part: f64 = part.abs();
        if part > 0.0 {
            // For equal eigenvalues the error is of first order.
            sum += part * (part / greater(part, (lambda[s] - lambda[r]).abs()));
        }
    }
    2.0 * sum
}

/// `K phi - lambda M phi`, summarised.
#[derive(Default)]
pub(super) struct Rest {
    /// Largest component.
    most: f64,
    /// Largest sum of absolute terms in a row.
    size: f64,
    /// `phi^T (K - lambda M) phi` and its absolute terms.
    along: f64,
    terms: f64,
}

impl Rest {
    /// Adds a component: of the shape, of the residual, and the absolute terms in that.
    #[inline(always)]
    pub(super) fn add(&mut self, phi: f64, value: f64, terms: f64) {
        self.most = greater(self.most, value.abs());
        self.size = greater(self.size, terms);
        self.along += phi * value;
        self.terms += phi.abs() * terms;
    }

    #[inline(always)]
    pub(super) fn relative(&self) -> f64 {
        if self.most == 0.0 { 0.0 } else { self.most / self.size }
    }

    /// Error of `lambda`: rounding of the elements plus twice its distance from the Rayleigh quotient of `phi`.
    #[inline(always)]
    pub(super) fn error(&self, n: usize) -> f64 {
        of_elements(n) * self.terms + 2.0 * self.along.abs()
    }
}
