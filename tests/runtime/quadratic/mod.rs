//! Statistics of a quantity known to second order, against quadrature and closed forms.

mod distributions;
mod moments;

use eigentol::second_order::Quadratic;
use eigentol::{Matrix, Tolerances, Vector};

fn close(value: f64, expected: f64, tolerance: f64) {
    let size = expected.abs().max(f64::MIN_POSITIVE);
    assert!((value - expected).abs() <= tolerance * size, "{value:e}, not {expected:e}");
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
