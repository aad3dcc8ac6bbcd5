//! Dependent variables against closed forms of linear correlations under a Gaussian copula.

use std::f64::consts::PI;

use eigentol_statistics::{Distribution, Error, Joint};

fn uniform() -> Distribution {
    Distribution::uniform(-1.0, 1.0).expect("limits in order")
}

fn pair(a: &Distribution, b: &Distribution, r: f64) -> Result<Joint, Error> {
    Joint::correlated(vec![a.clone(), b.clone()], &[1.0, r, r, 1.0])
}

/// The second row of the factor: the normal variable behind the second of two variables, for the two independent
/// ones at (0, 1) and (1, 0).
fn factor(joint: &Joint) -> [f64; 2] {
    let mut slopes = [0.0; 2];
    let last = &joint.variables()[1];
    // At z = 0 each variable is at its median.
    let scale = last.slope_from_normal(0.0);
    joint.gradient_by_normal(&[0.0, 0.0], &[0.0, 1.0 / scale], &mut slopes);
    slopes
}

#[test]
fn uniform_variables() {
    for r in [-0.99, -0.5, 0.1, 0.7, 0.95] {
        let joint = pair(&uniform(), &uniform(), r).unwrap();
        let [rho, rest] = factor(&joint);
        assert!((rho - 2.0 * (PI * r / 6.0).sin()).abs() < 1e-6, "{r}: {rho}");
        assert!((rho.hypot(rest) - 1.0).abs() < 1e-14);
    }
}

/// For three uniform variables: `rho = 2 sin(pi r / 6)`, and the written-out factor of a 3 x 3 matrix.
#[test]
fn the_factor_is_that_of_the_normal_variables() {
    let (a, b, c) = (0.6, -0.3, 0.2);
    let matrix = [1.0, a, b, a, 1.0, c, b, c, 1.0];
    let joint = Joint::correlated(vec![uniform(); 3], &matrix).unwrap();
    let [a, b, c] = [a, b, c].map(|r: f64| 2.0 * (PI * r / 6.0).sin());
    let second = (1.0 - a * a).sqrt();
    let cross = (c - a * b) / second;
    let rest = (1.0 - b * b - cross * cross).sqrt();
    let wanted = [[1.0, 0.0, 0.0], [a, second, 0.0], [b, cross, rest]];
    for (i, row) in wanted.iter().enumerate() {
        for (j, value) in row.iter().enumerate() {
            let found = joint.normal_factor(i, j);
            assert!((found - value).abs() < 1e-6, "{i} {j}: {found} {value}");
        }
    }
    let alone = Joint::independent(vec![uniform(); 2]);
    assert_eq!((alone.normal_factor(1, 1), alone.normal_factor(1, 0)), (1.0, 0.0));
}

#[test]
fn lognormal_variables() {
    let (a, b) = (Distribution::lognormal(2.0, 0.8).unwrap(), Distribution::lognormal(1.0, 0.3).unwrap());
    let [s, t] = [0.4_f64, 0.3].map(|variation| (variation * variation).ln_1p().sqrt());
    for r in [-0.6, 0.2, 0.9] {
        let joint = pair(&a, &b, r).unwrap();
        let rho = (1.0 + r * 0.4 * 0.3_f64).ln() / (s * t);
        assert!((factor(&joint)[0] - rho).abs() < 1e-10);
        assert!((joint.covariance(0, 1) - r * 0.8 * 0.3).abs() < 1e-15);
    }
}

/// A uniform and a normal variable: `r = rho sqrt(3 / pi)`.
#[test]
fn a_uniform_and_a_normal_variable() {
    let normal = Distribution::normal(5.0, 2.0).unwrap();
    let joint = pair(&uniform(), &normal, 0.5).unwrap();
    let rho = 0.5 * (PI / 3.0).sqrt();
    assert!((factor(&joint)[0] - rho).abs() < 1e-10);
    match pair(&uniform(), &normal, 0.99) {
        Err(Error::Setting { reason, .. }) => assert!(reason.contains("0.9772"), "{reason}"),
        other => panic!("{other:?}"),
    }
}

/// Two coins: `r = 2 asin(rho) / pi`.
#[test]
fn coins() {
    let coin = Distribution::discrete(&[(0.0, 1.0), (1.0, 1.0)]).unwrap();
    for r in [0.1, 0.4, 0.6] {
        let joint = pair(&coin, &uniform(), 0.0).unwrap();
        assert_eq!(joint.covariance(0, 1), 0.0);
        let joint = pair(&coin, &coin, r).unwrap();
        let mut found = 0.0;
        // The correlation by integration over both being heads: P = 1/4 + asin(rho) / (2 pi).
        let steps = 400;
        for i in 0..steps {
            for j in 0..steps {
                let z = [i, j].map(|k| eigentol_statistics::normal::quantile((f64::from(k) + 0.5) / f64::from(steps)));
                let mut values = [0.0; 2];
                joint.from_normal(&z, &mut values);
                found += values[0] * values[1];
            }
        }
        let correlation = 4.0 * found / f64::from(steps * steps) - 1.0;
        assert!((correlation - r).abs() < 6e-3, "{r}: {correlation}");
    }
}

#[test]
fn complete_correlation_is_one_variable() {
    for variable in [
        uniform(),
        Distribution::weibull(1.5, 2.0).unwrap(),
        Distribution::discrete(&[(0.0, 1.0), (1.0, 2.0)]).unwrap(),
    ] {
        let joint = pair(&variable, &variable, 1.0).unwrap();
        for (first, other) in [(-2.0, 3.0), (0.3, -1.0), (1.5, 0.0)] {
            let mut values = [0.0; 2];
            joint.from_normal(&[first, other], &mut values);
            assert_eq!(values[0], values[1]);
        }
    }
    let joint = pair(&uniform(), &uniform(), -1.0).unwrap();
    let mut values = [0.0; 2];
    joint.from_normal(&[0.7, 5.0], &mut values);
    assert!((values[0] + values[1]).abs() < 1e-15);
}

#[test]
fn gradients_are_those_of_differences() {
    let variables = vec![
        uniform(),
        Distribution::lognormal(2.0, 0.5).unwrap(),
        Distribution::beta((2.0, 5.0), (0.0, 3.0)).unwrap(),
    ];
    let matrix = [1.0, 0.3, -0.2, 0.3, 1.0, 0.5, -0.2, 0.5, 1.0];
    let joint = Joint::correlated(variables, &matrix).unwrap();
    let f = |x: &[f64]| x[0] * x[1] + x[2] * x[2];
    let at = |z: &[f64]| {
        let mut x = [0.0; 3];
        joint.from_normal(z, &mut x);
        x
    };
    let z = [0.3, -0.8, 1.1];
    let x = at(&z);
    let mut slopes = [0.0; 3];
    joint.gradient_by_normal(&z, &[x[1], x[0], 2.0 * x[2]], &mut slopes);
    for k in 0..3 {
        let [above, below] = [1e-6, -1e-6].map(|step| {
            let mut z = z;
            z[k] += step;
            f(&at(&z))
        });
        assert!((slopes[k] - (above - below) / 2e-6).abs() < 1e-8);
    }
}

#[test]
fn impossible_dependence_is_refused() {
    let normal = || Distribution::normal(0.0, 1.0).unwrap();
    let three = || vec![normal(), normal(), normal()];
    let refused = [
        (three(), vec![1.0; 4]),
        (three(), vec![1.0, 0.9, -0.9, 0.9, 1.0, 0.9, -0.9, 0.9, 1.0]),
        (vec![normal(), normal()], vec![1.0, 0.2, 0.3, 1.0]),
        (vec![normal(), normal()], vec![1.0, 1.1, 1.1, 1.0]),
        (vec![normal(), normal()], vec![2.0, 0.0, 0.0, 1.0]),
        (vec![normal(), normal()], vec![1.0, f64::NAN, f64::NAN, 1.0]),
    ];
    for (variables, matrix) in refused {
        assert!(Joint::correlated(variables, &matrix).is_err(), "{matrix:?}");
    }
    // The sum of two other variables gives a semidefinite, not a definite matrix.
    let half = 0.5_f64.sqrt();
    let sum = [1.0, 0.0, half, 0.0, 1.0, half, half, half, 1.0];
    let joint = Joint::correlated(three(), &sum).unwrap();
    let mut values = [0.0; 3];
    joint.from_normal(&[1.0, 2.0, 9.0], &mut values);
    assert!((values[2] - 3.0 * half).abs() < 1e-15);
}

fn two() -> Joint {
    let normal = || Distribution::normal(0.0, 1.0).expect("a distribution");
    Joint::independent(vec![normal(), normal()])
}

#[test]
#[should_panic(expected = "one number per variable")]
fn room_for_too_few_values_is_refused() {
    two().from_normal(&[0.5, 0.5], &mut [0.0]);
}

#[test]
#[should_panic(expected = "one number per variable")]
fn too_many_normal_numbers_are_refused() {
    two().from_normal(&[0.5, 0.5, 0.5], &mut [0.0, 0.0]);
}

#[test]
#[should_panic(expected = "one number per variable")]
fn too_few_derivatives_are_refused() {
    two().gradient_by_normal(&[0.5, 0.5], &[1.0], &mut [0.0, 0.0]);
}
