//! Checks indices against closed forms and against their definitions.

use std::f64::consts::PI;

use proptest::prelude::*;

use super::*;
use crate::sequence::Sequence;

const ESTIMATORS: [Estimator; 3] = [Estimator::Saltelli, Estimator::Jansen, Estimator::Martinez];

pub(super) fn evaluate(design: &SaltelliDesign, f: impl Fn(&[f64]) -> f64) -> Vec<Option<f64>> {
    let mut walk = design.from(0);
    let mut values = Vec::new();
    while let Some(point) = walk.next_point() {
        values.push(Some(f(point)));
    }
    values
}

fn quasi_random(inputs: usize, rows: u64) -> SaltelliDesign {
    SaltelliDesign::new(Sequence::sobol(2 * inputs, 4, 0).unwrap(), rows).unwrap()
}

pub(super) fn few() -> Bootstrap {
    Bootstrap { resamples: 20, ..Bootstrap::default() }
}

fn assert_indices(f: impl Fn(&[f64]) -> f64, first: &[f64], total: &[f64], tolerance: f64) {
    let values = evaluate(&quasi_random(first.len(), 1 << 12), f);
    for estimator in ESTIMATORS {
        let indices = sobol_indices(first.len(), &values, estimator, few()).unwrap();
        for (estimates, exact) in [(&indices.first, first), (&indices.total, total)] {
            for (estimate, exact) in estimates.iter().zip(exact) {
                let error = (estimate.value - exact).abs();
                assert!(error < tolerance, "{estimator:?} {estimate:?} {exact}");
                assert!(estimate.lower <= estimate.value && estimate.value <= estimate.upper);
            }
        }
    }
}

/// The function of Ishigami and Homma (1990) with a = 7, b = 0.1; the indices are as in Saltelli et al., Sensitivity
/// Analysis (2000).
fn ishigami(u: &[f64]) -> f64 {
    let [x, y, z] = [0, 1, 2].map(|i| PI * (2.0 * u[i] - 1.0));
    x.sin() + 7.0 * y.sin().powi(2) + 0.1 * z.powi(4) * x.sin()
}

#[test]
fn ishigamis_function() {
    let [a, b] = [7.0_f64, 0.1];
    let first = 0.5 * (1.0 + b * PI.powi(4) / 5.0).powi(2);
    let second = a * a / 8.0;
    let both = 8.0 * b * b * PI.powi(8) / 225.0;
    let variance = first + second + both;
    assert!((first / variance - 0.3139).abs() < 1e-4 && (second / variance - 0.4424).abs() < 1e-4);
    let share = |part: f64| part / variance;
    assert_indices(
        ishigami,
        &[share(first), share(second), 0.0],
        &[share(first + both), share(second), share(both)],
        0.012,
    );
    let values = evaluate(&quasi_random(3, 1 << 12), ishigami);
    let indices = sobol_indices(3, &values, Estimator::Jansen, few()).unwrap();
    assert!((indices.variance / variance - 1.0).abs() < 0.01);
    assert!((indices.mean - a / 2.0).abs() < 0.01);
}

/// The g-function of Sobol' (Saltelli and Sobol' 1995), eight inputs.
#[test]
fn sobols_g_function() {
    let a = [0.0, 1.0, 4.5, 9.0, 99.0, 99.0, 99.0, 99.0];
    let part = a.map(|a: f64| 1.0 / (3.0 * (1.0 + a).powi(2)));
    let product: f64 = part.iter().map(|v| 1.0 + v).product();
    let variance = product - 1.0;
    let g = move |u: &[f64]| {
        let factors = u.iter().zip(a).map(|(u, a)| ((4.0 * u - 2.0).abs() + a) / (1.0 + a));
        factors.product::<f64>()
    };
    assert_indices(g, &part.map(|v| v / variance), &part.map(|v| v * product / (1.0 + v) / variance), 0.012);
}

#[test]
fn linear_models() {
    let c = [1.0, -2.0, 0.5, 0.0];
    let squares: f64 = c.iter().map(|c| c * c).sum();
    let shares = c.map(|c| c * c / squares);
    let f = |u: &[f64]| 1e6 + u.iter().zip(c).map(|(u, c)| c * u).sum::<f64>();
    assert_indices(f, &shares, &shares, 2e-3);
}

/// The published formulas, sum by sum, for arbitrary values.
#[test]
fn estimators_are_the_published_ones() {
    let values = evaluate(&quasi_random(3, 57), |u| (9.0 * u[0]).sin() + u[1] * u[2] + 5.0);
    let rows: Vec<Vec<f64>> = values.chunks(5).map(|row| row.iter().flatten().copied().collect()).collect();
    let n = rows.len() as f64;
    let mean = |f: &dyn Fn(&[f64]) -> f64| rows.iter().map(|row| f(row)).sum::<f64>() / n;
    let m = 0.5 * mean(&|r| r[0] + r[1]);
    let variance = 0.5 * mean(&|r| (r[0] - m).powi(2) + (r[1] - m).powi(2));
    let correlation = |p: usize, q: usize| {
        let (mp, mq) = (mean(&|r| r[p]), mean(&|r| r[q]));
        let squares = mean(&|r| (r[p] - mp).powi(2)) * mean(&|r| (r[q] - mq).powi(2));
        mean(&|r| (r[p] - mp) * (r[q] - mq)) / squares.sqrt()
    };
    for input in 0..3 {
        let i = 2 + input;
        let total = mean(&|r| (r[0] - r[i]).powi(2)) / (2.0 * variance);
        let expected = [
            [mean(&|r| (r[1] - m) * (r[i] - r[0])) / variance, total],
            [1.0 - mean(&|r| (r[1] - r[i]).powi(2)) / (2.0 * variance), total],
            [correlation(1, i), 1.0 - correlation(0, i)],
        ];
        for (estimator, [first, total]) in ESTIMATORS.into_iter().zip(expected) {
            let sobol_indices = sobol_indices(3, &values, estimator, few()).unwrap();
            assert!((sobol_indices.first[input].value - first).abs() < 1e-12, "{estimator:?}");
            assert!((sobol_indices.total[input].value - total).abs() < 1e-12, "{estimator:?}");
        }
    }
}

#[test]
fn permuted_inputs_permute_the_indices() {
    let values = evaluate(&quasi_random(3, 256), ishigami);
    let order = [2, 0, 1];
    let permuted: Vec<Option<f64>> =
        values.chunks(5).flat_map(|row| [row[0], row[1], row[4], row[2], row[3]]).collect();
    for estimator in ESTIMATORS {
        let plain = sobol_indices(3, &values, estimator, few()).unwrap();
        let other = sobol_indices(3, &permuted, estimator, few()).unwrap();
        for (new, old) in order.into_iter().enumerate() {
            let near = |a: Estimate, b: Estimate| {
                let pairs = [(a.value, b.value), (a.lower, b.lower), (a.upper, b.upper)];
                pairs.iter().all(|(a, b)| (a - b).abs() < 1e-12)
            };
            assert!(near(other.first[new], plain.first[old]));
            assert!(near(other.total[new], plain.total[old]));
        }
    }
}

#[test]
fn rows_with_a_missing_value_are_dropped_and_counted() {
    let values = evaluate(&quasi_random(3, 100), ishigami);
    let mut holes = values.clone();
    for k in [0, 5 * 7 + 1, 5 * 40 + 4, 5 * 40 + 3, 5 * 99 + 2] {
        holes[k] = None;
    }
    let rest: Vec<Option<f64>> = (values.chunks(5).enumerate())
        .filter(|(row, _)| ![0, 7, 40, 99].contains(row))
        .flat_map(|(_, row)| row.to_vec())
        .collect();
    let found = sobol_indices(3, &holes, Estimator::Jansen, few()).unwrap();
    let expected = sobol_indices(3, &rest, Estimator::Jansen, few()).unwrap();
    assert_eq!((found.rows, found.dropped), (96, 4));
    assert_eq!(SobolIndices { dropped: 0, ..found }, expected);
}

proptest! {
    /// The indices do not depend on unit or zero of the result.
    #[test]
    fn indices_have_no_unit(scale in 1e-9..1e9_f64, shift in -1e3..1e3_f64) {
        let values = evaluate(&quasi_random(3, 32), ishigami);
        let other: Vec<Option<f64>> = values.iter().map(|v| v.map(|v| scale * (shift - v))).collect();
        for estimator in ESTIMATORS {
            let plain = sobol_indices(3, &values, estimator, few()).unwrap();
            let moved = sobol_indices(3, &other, estimator, few()).unwrap();
            for (a, b) in plain.first.iter().chain(&plain.total).zip(moved.first.iter().chain(&moved.total)) {
                prop_assert!((a.value - b.value).abs() < 1e-9 && (a.upper - b.upper).abs() < 1e-9);
            }
        }
    }
}
