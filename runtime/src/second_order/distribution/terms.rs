//! The normal form of the model: a sum of independent terms, each of one standard normal variable.

use nalgebra::Complex;

use super::standard::Standard;
use super::{Estimate, contour, davies, normal, single};
use crate::eigenproblem::diagonalise;

/// `c z + nu z^2 / 2` of one standard normal `z`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Square {
    pub(super) c: f64,
    pub(super) nu: f64,
}

/// Error beyond which a second method is asked.
const ACCEPTED: f64 = 1e-11;

/// `X = g z_0 + sum_j (c_j z_j + nu_j z_j^2 / 2)` with standard deviation 1.
pub(in crate::second_order) struct Terms {
    /// What one unit of `X` is in the unit of the quantity.
    pub(in crate::second_order) unit: f64,
    /// `g >= 0`, all terms without curvature in one.
    pub(super) normal: f64,
    pub(super) squares: Vec<Square>,
}

impl Terms {
    /// Diagonalises the model: `B = Q diag(nu) Q^T`, `c = Q^T a`; `None` when nothing varies.
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
        // Curvature below 1e-17 of the standard deviation changes no tail that a double can hold.
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
        Some(Self {
            unit,
            normal,
            squares,
        })
    }

    /// `P(from < X < to)`, by a closed form where there is one.
    pub(in crate::second_order) fn between(&self, from: f64, to: f64) -> Estimate {
        if from >= to {
            return Estimate {
                value: 0.0,
                error: 0.0,
            };
        }
        match self.squares[..] {
            [] => self.straight(from, to),
            [square] if self.normal == 0.0 => single::between(square, from, to),
            _ => self.inverted(from, to),
        }
    }

    /// Without any square: the normal distribution.
    fn straight(&self, from: f64, to: f64) -> Estimate {
        let (from, to) = (from / self.normal, to / self.normal);
        Estimate {
            value: normal::between(from, to).clamp(0.0, 1.0),
            error: normal::end_error(from, 0.0) + normal::end_error(to, 0.0),
        }
    }

    /// The trapezoidal rule where it is short, with its proven bound; otherwise the turned ray; the better of the two
    /// where neither is good.
    fn inverted(&self, from: f64, to: f64) -> Estimate {
        let rule = davies::Rule::new(self);
        if rule.is_short() {
            return rule.between(self, from, to);
        }
        let ray = contour::between(self, from, to);
        match ray {
            Some(estimate) if estimate.error < ACCEPTED => estimate,
            _ => {
                let long = rule.between(self, from, to);
                ray.filter(|ray| ray.error < long.error).unwrap_or(long)
            }
        }
    }

    /// Logarithm `K(s)` of the moment generating function `E e^(s X)`, continued off the real axis, and the size of its
    /// summands, which says how much of it is rounding.
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

#[cfg(test)]
mod tests {
    use super::*;

    /// Standard deviation 1, five or more variables of every sign: both inversions apply, and share no formula but the
    /// terms.
    #[test]
    fn both_inversions_agree() {
        for (normal, count, c, nu) in [
            (0.0, 5, 0.8, 0.7),
            (0.3, 4, 0.5, -1.2),
            (0.05, 6, 0.1, 1.0),
            (1.0, 3, 0.4, 0.05),
            (0.0, 9, 0.0, 1.0),
        ] {
            let squares = (0..count).map(|j| Square {
                c: c * (1.0 + f64::from(j)).sin(),
                nu: nu * (2.0 + 1.7 * f64::from(j)).cos(),
            });
            let mut terms = Terms {
                unit: 1.0,
                normal,
                squares: squares.collect(),
            };
            let parts = terms.squares.iter();
            let variance: f64 = parts.map(|t| t.c * t.c + 0.5 * t.nu * t.nu).sum();
            let sigma = (variance + normal * normal).sqrt();
            terms.normal /= sigma;
            for square in &mut terms.squares {
                square.c /= sigma;
                square.nu /= sigma;
            }
            let rule = davies::Rule::new(&terms);
            let mut compared = 0;
            for k in -12..=12 {
                let y = 0.5 * f64::from(k);
                let axis = rule.between(&terms, y, f64::INFINITY);
                let Some(ray) = contour::between(&terms, y, f64::INFINITY) else {
                    panic!("a ray at {y}")
                };
                let apart = (axis.value - ray.value).abs();
                assert!(apart <= axis.error + ray.error, "{y}: {axis:?} {ray:?}");
                compared += usize::from(axis.error + ray.error < 1e-9);
            }
            assert_eq!(compared, 25);
        }
    }
}
