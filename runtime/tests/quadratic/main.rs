//! Statistics of a quantity known to second order: against quadrature, closed forms, sampling and reference numbers.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

#[path = "../common/mod.rs"]
mod common;

mod margin;
mod moments;
mod probability;

use eigentol::Tolerances;
use eigentol::tolerance::Quadratic;

fn close(value: f64, expected: f64, tolerance: f64) {
    let size = expected.abs().max(f64::MIN_POSITIVE);
    assert!(
        (value - expected).abs() <= tolerance * size,
        "{value:e}, not {expected:e}"
    );
}

fn within(value: f64, expected: f64, distance: f64) {
    assert!(
        (value - expected).abs() <= distance,
        "{value:e}, not {expected:e}: {:e} apart",
        value - expected
    );
}

/// Independent variables with these standard deviations.
fn independent<const P: usize>(sigma: [f64; P]) -> Tolerances<P> {
    Tolerances::new(sigma, 1.0, None).unwrap()
}

/// Four correlated variables and a model of all of them.
fn coupled() -> (Quadratic<4>, Tolerances<4>) {
    let model = Quadratic {
        value: 7.0,
        slopes: [1.0, -0.5, 0.25, 2.0],
        curvature: [
            [0.8, 0.3, -0.2, 0.1],
            [0.3, -0.6, 0.4, 0.5],
            [-0.2, 0.4, 1.1, -0.3],
            [0.1, 0.5, -0.3, 0.2],
        ],
    };
    let correlation = [
        [1.0, 0.5, 0.1, 0.0],
        [0.5, 1.0, -0.3, 0.2],
        [0.1, -0.3, 1.0, 0.4],
        [0.0, 0.2, 0.4, 1.0],
    ];
    let tolerances = Tolerances::new([0.9, 1.2, 0.6, 0.3], 2.0, Some(correlation)).unwrap();
    (model, tolerances)
}

/// `f(b0 + x)` of the model.
fn value_at<const P: usize>(model: &Quadratic<P>, x: [f64; P]) -> f64 {
    let bend = |e: usize| 0.5 * model.curvature[e / P][e % P] * x[e / P] * x[e % P];
    let slope = |i: usize| model.slopes[i] * x[i];
    model.value + (0..P).map(slope).sum::<f64>() + (0..P * P).map(bend).sum::<f64>()
}

/// Standard normal numbers of a generator of this test's own (SplitMix64 and Box-Muller).
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

/// Lower factor of a covariance matrix, for the test's own draws.
fn factor<const P: usize>(tolerances: &Tolerances<P>) -> [[f64; P]; P] {
    let sigma = tolerances.standard_deviations();
    let mut lower = [[0.0; P]; P];
    for i in 0..P {
        for j in 0..=i {
            let same = f64::from(u8::from(i == j));
            let correlation = tolerances.correlation().map_or(same, |matrix| matrix[i][j]);
            let done: f64 = (0..j).map(|k| lower[i][k] * lower[j][k]).sum();
            let rest = correlation * sigma[i] * sigma[j] - done;
            lower[i][j] = if i == j {
                rest.sqrt()
            } else {
                rest / lower[j][j]
            };
        }
    }
    lower
}

/// `L z`.
fn spread<const P: usize>(factor: &[[f64; P]; P], z: [f64; P]) -> [f64; P] {
    core::array::from_fn(|i| (0..P).map(|k| factor[i][k] * z[k]).sum())
}
