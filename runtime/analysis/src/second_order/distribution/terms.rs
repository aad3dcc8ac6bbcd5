//! The normal form of the model: a sum of independent terms, each in one standard normal variable.

use nalgebra::Complex;

use super::standard::Standard;
use crate::eigenproblem::diagonalise;

/// The term `c z + nu z^2 / 2` of one standard normal `z`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Square {
    pub(super) c: f64,
    pub(super) nu: f64,
}

/// `X = g z_0 + sum_j (c_j z_j + nu_j z_j^2 / 2)`, with standard deviation 1.
pub(in crate::second_order) struct Terms {
    /// One unit of `X` in the unit of the quantity.
    pub(in crate::second_order) unit: f64,
    /// `g >= 0`, which combines all terms without curvature.
    pub(super) normal: f64,
    pub(super) squares: Vec<Square>,
}

impl Terms {
    /// Diagonalises the model: `B = Q diag(nu) Q^T`, `c = Q^T a`; `None` if nothing varies.
    pub(in crate::second_order) fn new(standard: Standard) -> Option<Self> {
        let n = standard.linear.len();
        let (mut c, mut matrix) = (standard.linear, standard.quadratic);
        diagonalise(&mut matrix, n, &mut c);
        let nu: Vec<f64> = (0..n).map(|i| matrix[i * n + i]).collect();
        let variance = |i: usize| c[i] * c[i] + 0.5 * nu[i] * nu[i];
        let sigma = (0..n).map(variance).sum::<f64>().sqrt();
        let unit = standard.scale * sigma;
        if unit == 0.0 || !unit.is_finite() {
            return None;
        }
        let rounding = 4.0 * n as f64 * f64::EPSILON;
        let most = nu.iter().fold(0.0, |most: f64, nu| most.max(nu.abs()));
        // Curvature below 1e-17 of the standard deviation affects no tail that a double can represent.
        let negligible = (rounding * most).max(1e-17 * sigma);
        let mut squares = Vec::new();
        let mut normal = 0.0_f64;
        for (&c, &nu) in c.iter().zip(&nu) {
            if nu.abs() <= negligible {
                normal = normal.hypot(c / sigma);
            } else {
                let (c, nu) = (c / sigma, nu / sigma);
                squares.push(Square { c, nu });
            }
        }
        if !squares.is_empty() && normal <= rounding {
            normal = 0.0;
        }
        Some(Self { unit, normal, squares })
    }

    /// Logarithm `K(s)` of the moment generating function `E e^(s X)`, continued analytically off the real axis, and
    /// the magnitude of its terms, which tells how much of it is rounding.
    pub(super) fn log_generating(&self, s: Complex<f64>) -> (Complex<f64>, f64) {
        let square = s * s;
        let mut sum = square * (0.5 * self.normal * self.normal);
        let mut size = sum.norm();
        for &Square { c, nu } in &self.squares {
            let rest = Complex::new(1.0, 0.0) - s * nu;
            let bend = square * (0.5 * c * c) / rest;
            let spread = rest.ln() * 0.5;
            sum += bend - spread;
            size += bend.norm() + spread.norm();
        }
        (sum, size)
    }
}
