//! The second-order model in independent standard normal variables, scaled so that its largest coefficient is about 1.

use crate::Error;
use crate::algebra::dot;
use crate::scalar::Real as _;
use crate::second_order::quadratic::{ModelMoments, Quadratic, beyond_range};
use crate::tolerance::Tolerances;

/// `f - f0 = scale (a^T z + z^T B z / 2)`, `z ~ N(0, I)`; the largest element of `a` and `B` is about 1.
pub(super) struct Standard {
    /// SI value of one unit of the coefficients below; zero if nothing varies.
    pub(super) scale: f64,
    /// `a`, from `L^T S`.
    pub(super) linear: Vec<f64>,
    /// `B`, from `L^T H L`, row by row.
    pub(super) quadratic: Vec<f64>,
}

impl Standard {
    pub(super) fn new(model: &Quadratic, tolerances: &Tolerances) -> Result<Self, Error> {
        model.check(tolerances)?;
        let sigmas = tolerances.sigmas();
        let n = sigmas.len();
        let symmetric = |i: usize, j: usize| 0.5 * model.curvature[i][j] + 0.5 * model.curvature[j][i];
        let mut standard = Self {
            scale: 1.0,
            linear: (0..n).map(|i| model.slopes[i] * sigmas[i]).collect(),
            quadratic: (0..n * n)
                .map(|e| (e / n, e % n))
                .map(|(i, j)| product([symmetric(i, j), sigmas[i], sigmas[j]]))
                .collect(),
        };
        standard.rescale()?;
        if tolerances.correlation().is_some() {
            let factor = tolerances.factor();
            let root = |row: usize, column: usize| {
                if sigmas[row] > 0.0 { factor[row][column] / sigmas[row] } else { 0.0 }
            };
            let root: Vec<f64> = (0..n * n).map(|e| root(e / n, e % n)).collect();
            standard.correlate(&root);
            standard.rescale()?;
        }
        Ok(standard)
    }

    /// Moves the largest coefficient into the scale.
    fn rescale(&mut self) -> Result<(), Error> {
        let size = self.linear.iter().chain(&self.quadratic).fold(0.0, |most: f64, value| most.max(value.abs()));
        if size == 0.0 {
            self.scale = 0.0;
            return Ok(());
        }
        self.scale *= size;
        if !self.scale.is_finite() {
            return Err(beyond_range());
        }
        self.linear.iter_mut().chain(&mut self.quadratic).for_each(|value| *value /= size);
        Ok(())
    }

    /// Replaces `a` by `C^T a` and `B` by `C^T B C`, where the correlation matrix is `C C^T`.
    fn correlate(&mut self, root: &[f64]) {
        let n = self.linear.len();
        let half = transposed_product(root, &self.quadratic, n);
        // C^T B can be transposed because B is symmetric: C^T (C^T B)^T = C^T B C.
        self.quadratic = transposed_product(root, &transposed(&half, n), n);
        self.linear = (0..n).map(|i| (0..n).map(|k| root[k * n + i] * self.linear[k]).sum()).collect();
    }

    /// Moments of `value + scale (a^T z + z^T B z / 2)` from traces; infinite where they exceed the range of a double.
    pub(super) fn moments(&self, value: f64) -> ModelMoments {
        let n = self.linear.len();
        let (a, b) = (&self.linear, &self.quadratic);
        let bent = times(b, a);
        let squared = f64::run(
            #[inline(always)]
            || square(b, n),
        );
        let trace: f64 = (0..n).map(|i| b[i * n + i]).sum();
        let (slope, curvature) = (dot(a, a), 0.5 * dot(b, b));
        let variance = slope + curvature;
        let third = 3.0 * dot(a, &bent) + dot(&squared, b);
        let fourth = 12.0 * dot(&bent, &bent) + 3.0 * dot(&squared, &squared);
        let relative = |cumulant: f64, power: f64| {
            if variance > 0.0 { cumulant / variance.powf(power) } else { 0.0 }
        };
        let mean_shift = self.scale * 0.5 * trace;
        ModelMoments {
            mean: value + mean_shift,
            mean_shift,
            first_order_sigma: self.scale * slope.sqrt(),
            curvature_sigma: self.scale * curvature.sqrt(),
            sigma: self.scale * variance.sqrt(),
            skewness: relative(third, 1.5),
            excess_kurtosis: relative(fourth, 2.0),
        }
    }
}

/// Product of three numbers that overflows or underflows only if the result does.
fn product(mut factors: [f64; 3]) -> f64 {
    factors.sort_by(|a, b| a.abs().total_cmp(&b.abs()));
    factors[0] * factors[2] * factors[1]
}

fn times(matrix: &[f64], x: &[f64]) -> Vec<f64> {
    (0..x.len()).map(|i| &matrix[i * x.len()..(i + 1) * x.len()]).map(|row| dot(row, x)).collect()
}

fn transposed(matrix: &[f64], n: usize) -> Vec<f64> {
    (0..n * n).map(|e| matrix[(e % n) * n + e / n]).collect()
}

/// `B^2` of a symmetric matrix.
#[inline(always)]
fn square(b: &[f64], n: usize) -> Vec<f64> {
    let mut result = vec![0.0; n * n];
    for k in 0..n {
        let row = &b[k * n..(k + 1) * n];
        for i in 0..n {
            let factor = row[i];
            if factor != 0.0 {
                for (sum, value) in result[i * n + i..(i + 1) * n].iter_mut().zip(&row[i..]) {
                    *sum += factor * value;
                }
            }
        }
    }
    for i in 0..n {
        for j in 0..i {
            result[i * n + j] = result[j * n + i];
        }
    }
    result
}

/// `A^T B`.
fn transposed_product(a: &[f64], b: &[f64], n: usize) -> Vec<f64> {
    let mut result = vec![0.0; n * n];
    for k in 0..n {
        for i in 0..n {
            let factor = a[k * n + i];
            for j in 0..n {
                result[i * n + j] += factor * b[k * n + j];
            }
        }
    }
    result
}
