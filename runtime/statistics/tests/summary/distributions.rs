//! Sample statistics against the distributions they are drawn from.

use eigentol_statistics::summary::{Moments, Statistics};

use crate::common::{normal, uniform};

const COUNT: u64 = 100_000;

fn of(value: impl Fn(u64) -> f64, count: u64) -> Statistics {
    let values: Vec<f64> = (0..count).map(value).collect();
    Statistics::of(&Moments::of(&values), None).expect("values")
}

/// Errors are within those expected of samples of these distributions: five times the standard error of each moment.
#[test]
fn moments_are_those_of_the_distribution() {
    let exponential = |k| -(1.0 - uniform(11, k)).ln();
    let samples: [(&str, Statistics, [f64; 4], [f64; 2]); 3] = [
        ("uniform", of(|k| uniform(10, k), COUNT), [0.5, (1.0_f64 / 12.0).sqrt(), 0.0, -1.2], [1.5, 1.2]),
        ("normal", of(|k| 7.0 + 2.0 * normal(12, k), COUNT), [7.0, 2.0, 0.0, 0.0], [2.5, 5.0]),
        ("exponential", of(exponential, COUNT), [1.0, 1.0, 2.0, 6.0], [25.0, 250.0]),
    ];
    for (name, s, [mean, sigma, skewness, kurtosis], [skewness_scatter, kurtosis_scatter]) in samples {
        let root = (COUNT as f64).sqrt();
        let near = |value: Option<f64>, expected: f64, error: f64| {
            let found = value.expect(name);
            assert!((found - expected).abs() < 5.0 * error, "{name}: {found}, expected {expected}");
        };
        near(Some(s.mean), mean, s.standard_error.expect(name));
        near(s.sigma, sigma, s.sigma_error.expect(name));
        near(s.skewness, skewness, skewness_scatter / root);
        near(s.excess_kurtosis, kurtosis, kurtosis_scatter / root);
    }
}

/// A value as a function of its index.
type Value = fn(u64) -> f64;

/// Standard errors match the scatter of their statistics over many experiments.
#[test]
fn standard_errors_are_the_scatter() {
    const EXPERIMENTS: u64 = 2000;
    let distributions: [(&str, Value); 2] = [("normal", |k| normal(20, k)), ("uniform", |k| uniform(21, k))];
    for (name, value) in distributions {
        let all: Vec<Statistics> = (0..EXPERIMENTS).map(|e| of(|k| value(200 * e + k), 200)).collect();
        let scatter = |pick: &dyn Fn(&Statistics) -> Option<f64>| {
            let values: Vec<f64> = all.iter().filter_map(pick).collect();
            let s = Statistics::of(&Moments::of(&values), None).expect(name);
            (s.mean, s.sigma.expect(name))
        };
        // The scatter of 2000 experiments is known to 1.6 percent.
        let near =
            |scatter: f64, error: f64| assert!((scatter / error - 1.0).abs() < 0.06, "{name}: {scatter} and {error}");
        near(scatter(&|s| Some(s.mean)).1, scatter(&|s| s.standard_error).0);
        near(scatter(&|s| s.sigma).1, scatter(&|s| s.sigma_error).0);
        if name == "normal" {
            near(scatter(&|s| s.skewness).1, scatter(&|s| s.skewness_error).0);
            near(scatter(&|s| s.excess_kurtosis).1, scatter(&|s| s.kurtosis_error).0);
            // Unbiased.
            assert!(scatter(&|s| s.excess_kurtosis).0.abs() < 0.03);
        }
    }
}

/// Closed form: the numbers 1 to n have variance `n (n + 1) / 12`, no skewness and excess kurtosis `G2 = -1.2`.
#[test]
fn consecutive_numbers() {
    for n in [4.0, 10.0, 1000.0_f64] {
        let s = of(|k| k as f64 + 1.0, n as u64);
        assert_eq!(s.mean, (n + 1.0) / 2.0);
        assert!((s.sigma.expect("several") - (n * (n + 1.0) / 12.0).sqrt()).abs() < 1e-12 * n);
        assert!(s.skewness.expect("several").abs() < 1e-13);
        assert!((s.excess_kurtosis.expect("several") + 1.2).abs() < 1e-12);
    }
}
