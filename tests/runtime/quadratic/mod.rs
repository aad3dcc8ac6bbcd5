//! Statistics of a quantity known to second order, against quadrature, closed forms, sampling and reference numbers.

mod distributions;
mod margin;
mod moments;
mod probability;

use eigentol::second_order::Quadratic;
use eigentol::{Matrix, Tolerances, Vector};

fn close(value: f64, expected: f64, tolerance: f64) {
    let size = expected.abs().max(f64::MIN_POSITIVE);
    assert!((value - expected).abs() <= tolerance * size, "{value:e}, not {expected:e}");
}

fn within(value: f64, expected: f64, distance: f64) {
    assert!((value - expected).abs() <= distance, "{value:e}, not {expected:e}: {:e} apart", value - expected);
}

/// Independent variables with these standard deviations.
fn independent(sigma: impl Into<Vector>) -> Tolerances {
    Tolerances::new(sigma, 1.0, None).unwrap()
}

/// Four correlated variables, and a model in all of them.
fn coupled() -> (Quadratic, Tolerances) {
    let model = Quadratic {
        value: 7.0,
        slopes: [1.0, -0.5, 0.25, 2.0].into(),
        curvature: [[0.8, 0.3, -0.2, 0.1], [0.3, -0.6, 0.4, 0.5], [-0.2, 0.4, 1.1, -0.3], [0.1, 0.5, -0.3, 0.2]].into(),
    };
    let correlation = [[1.0, 0.5, 0.1, 0.0], [0.5, 1.0, -0.3, 0.2], [0.1, -0.3, 1.0, 0.4], [0.0, 0.2, 0.4, 1.0]];
    let tolerances = Tolerances::new([0.9, 1.2, 0.6, 0.3], 2.0, Some(correlation.into())).unwrap();
    (model, tolerances)
}

/// `f(b0 + x)` of the model.
fn value_at(model: &Quadratic, x: &[f64]) -> f64 {
    let p = x.len();
    let bend = |e: usize| 0.5 * model.curvature[e / p][e % p] * x[e / p] * x[e % p];
    let slope = |i: usize| model.slopes[i] * x[i];
    model.value + (0..p).map(slope).sum::<f64>() + (0..p * p).map(bend).sum::<f64>()
}

/// Standard normal numbers from the test's own generator (SplitMix64 and Box-Muller).
struct Normal(u64);

impl Normal {
    fn uniform(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64 + f64::EPSILON / 4.0
    }

    fn next(&mut self) -> f64 {
        let (radius, angle) = (self.uniform(), self.uniform());
        (-2.0 * radius.ln()).sqrt() * (std::f64::consts::TAU * angle).cos()
    }
}

/// Lower factor of a covariance matrix, for the test's own samples.
fn factor(tolerances: &Tolerances) -> Matrix {
    let sigma = tolerances.sigmas();
    let mut lower = Matrix::zeros(sigma.len(), sigma.len());
    for i in 0..sigma.len() {
        for j in 0..=i {
            let same = f64::from(u8::from(i == j));
            let correlation = tolerances.correlation().map_or(same, |matrix| matrix[i][j]);
            let done: f64 = (0..j).map(|k| lower[i][k] * lower[j][k]).sum();
            let rest = correlation * sigma[i] * sigma[j] - done;
            lower[i][j] = if i == j { rest.sqrt() } else { rest / lower[j][j] };
        }
    }
    lower
}

/// `L z`.
fn spread(factor: &Matrix, z: &[f64]) -> Vector {
    let row = |row: &[f64]| (0..z.len()).map(|k| row[k] * z[k]).sum();
    factor.iter().map(row).collect()
}
