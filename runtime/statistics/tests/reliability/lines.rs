//! Lines against exact probabilities: planes, shells, systems, missing values.

use eigentol_statistics::reliability::LimitState;
use eigentol_statistics::reliability::lines::{Direction, LineProbability, LineSampler, LineSettings};

use crate::common::{below, close, limit, linear, mean};

fn settings(coefficient_of_variation: f64) -> LineSettings {
    LineSettings { coefficient_of_variation, evaluations: 1_000_000, ..LineSettings::default() }
}

fn toward(along: &[f64], distance: f64) -> Direction {
    Direction { along: along.to_vec(), distance }
}

fn run<L: LimitState>(limit: &L, directions: &[Direction], coefficient_of_variation: f64) -> LineProbability {
    let dimension = limit.dimension();
    let variables: Vec<usize> = (0..dimension).collect();
    let settings = settings(coefficient_of_variation);
    LineSampler::new(dimension, &variables, directions, &settings).expect("valid settings").run(limit)
}

/// Within four standard errors, which are at most `relative` of the exact value.
fn covers(line_probability: &LineProbability, exact: f64, relative: f64) {
    let probability = line_probability.probability;
    assert!(line_probability.settled && line_probability.reached, "{line_probability:?}");
    assert!(
        (probability.value - exact).abs() <= 4.0 * probability.standard_error + 2e-3 * exact,
        "{line_probability:?}, exact {exact:e}"
    );
    assert!(probability.standard_error <= relative * exact, "{line_probability:?}");
}

/// Along its normal a plane has no scatter at all; along any other direction the estimate is still unbiased.
#[test]
fn planes() {
    for beta in [-1.0, 0.0, 0.6, 3.0, 7.0] {
        let plane = linear(beta, vec![-0.6, -0.8]);
        let found = run(&plane, &[toward(&[6.0, 8.0], beta)], 1e-6);
        close(found.probability.value, below(-beta), 2e-3);
        // A wrong distance does no harm, nor does a wrong sign.
        let found = run(&plane, &[toward(&[-0.6, -0.8], 2.0)], 0.01);
        covers(&found, below(-beta), 0.011);
    }
    let plane = linear(2.0, vec![-0.6, -0.8]);
    covers(&run(&plane, &[toward(&[1.0, 1.0], 2.0)], 0.02), below(-2.0), 0.021);
    covers(&run(&plane, &[toward(&[0.6, -0.8], 2.0)], 0.05), below(-2.0), 0.051);
    covers(&run(&plane, &[], 0.05), below(-2.0), 0.051);
}

/// Outside, inside and between spheres in four dimensions: `P(|z| > r) = exp(-r^2 / 2) (1 + r^2 / 2)`.
#[test]
fn spheres_and_thin_shells() {
    let outside = |r: f64| (-0.5 * r * r).exp() * (1.0 + 0.5 * r * r);
    let square = |z: &[f64]| z.iter().map(|z| z * z).sum::<f64>();
    let directions = |r: f64| [toward(&[1.0, 0.0, 0.0, 0.0], r), toward(&[0.0, 1.0, -1.0, 0.5], r)];
    let gradient = || vec![0.0; 4];
    for r in [1.0_f64, 3.0, 5.0] {
        let far = limit(4, |z| (r * r - square(z), gradient()));
        covers(&run(&far, &directions(r), 0.05), outside(r), 0.06);
    }
    let near = limit(4, |z| (square(z) - 1.0, gradient()));
    covers(&run(&near, &directions(0.0), 0.05), 1.0 - outside(1.0), 0.051);
    for thickness in [1e-2, 1e-4] {
        let half = 0.5 * thickness;
        let shell = limit(4, |z| ((square(z).sqrt() - 2.0).abs() - half, gradient()));
        let exact = outside(2.0 - half) - outside(2.0 + half);
        covers(&run(&shell, &directions(2.0), 0.05), exact, 0.06);
    }
}

/// Planes at right angles, each of which alone would be half of the failures, or a third: those in which no failure was
/// expected are found too.
#[test]
fn a_series_system() {
    for (dimension, beta) in [(2, 3.0), (2, 1.0), (3, 4.0), (6, 3.5)] {
        let system = limit(dimension, |z| {
            let nearest = z[0].max(z[1]).max(if dimension > 2 { z[2] } else { -9.0 });
            (beta - nearest, vec![0.0; dimension])
        });
        let exact = 1.0 - below(beta).powi(dimension.min(3) as i32);
        let axis = |k: usize| {
            let mut along = vec![0.0; dimension];
            along[k] = 1.0;
            toward(&along, beta)
        };
        for directions in [vec![axis(0)], vec![axis(1), axis(0)], vec![]] {
            covers(&run(&system, &directions, 0.05), exact, 0.06);
        }
    }
}

/// Two planes of which the farther one was not expected: opposite, oblique, and nearly the same.
#[test]
fn directions_share_the_space() {
    let angle = |degrees: f64| {
        let (sine, cosine) = degrees.to_radians().sin_cos();
        vec![cosine, sine]
    };
    let gauss = |f: &dyn Fn(f64) -> f64| mean(f);
    for degrees in [180.0, 120.0, 60.0, 10.0] {
        let (first, second) = (angle(0.0), angle(degrees));
        let (near, far) = (2.0, 2.5);
        let system = limit(2, |z| {
            let along = |values: &[f64]| values[0] * z[0] + values[1] * z[1];
            let nearest = (near - along(&first)).min(far - along(&second));
            (nearest, vec![0.0; 2])
        });
        // Given z_0, the second plane cuts off what lies above, or below, a value of z_1.
        let both = |z: f64| {
            let rest = far - second[0] * z;
            match second[1] > 1e-9 {
                true => below(-rest / second[1]),
                false => f64::from(u8::from(rest < 0.0)),
            }
        };
        let exact = below(-near) + gauss(&|z| if z > near { 0.0 } else { both(z) });
        for directions in [
            vec![toward(&first, near)],
            vec![toward(&second, far)],
            vec![toward(&first, near), toward(&second, far)],
            vec![toward(&first, near), toward(&first, near), toward(&[-1.0, 0.0], 3.0)],
        ] {
            let found = run(&system, &directions, 0.02);
            let probability = found.probability;
            assert!(found.reached, "{degrees} {found:?}");
            assert!(
                (probability.value - exact).abs() <= 4.0 * probability.standard_error + 1e-3 * exact,
                "{degrees} {found:?}, exact {exact:e}"
            );
        }
    }
}

/// Directions that miss a failure as probable as the one they know, or that tell of one where there is none, do as well as
/// the right ones: of 30 streams none is off by a tenth.
#[test]
fn failures_that_nobody_expected() {
    let beta = 4.0;
    let plane = |degrees: f64| {
        let (sine, cosine) = f64::to_radians(degrees).sin_cos();
        vec![cosine, 0.6 * sine, 0.8 * sine]
    };
    for degrees in [180.0, 120.0, 75.0] {
        let [first, second] = [plane(0.0), plane(degrees)];
        let along = |values: &[f64], z: &[f64]| values.iter().zip(z).map(|(a, z)| a * z).sum::<f64>();
        let system = limit(3, |z| {
            let nearest = along(&first, z).max(along(&second, z));
            (beta - nearest, vec![0.0; 3])
        });
        // What both planes cut off is less than a thousandth.
        let exact = 2.0 * below(-beta);
        for directions in [
            vec![toward(&first, beta)],
            vec![toward(&first, beta), toward(&[0.0, 1.0, -1.0], 2.0)],
            vec![toward(&[1.0, 0.3, 0.0], 3.0)],
            vec![],
        ] {
            for stream in 0..30 {
                let settings = LineSettings { stream, evaluations: 20_000, ..LineSettings::default() };
                let sampler = LineSampler::new(3, &[0, 1, 2], &directions, &settings).unwrap();
                let found = sampler.run(&system);
                let relative = found.probability.value / exact;
                assert!(found.settled, "{degrees} {directions:?} {found:?}");
                assert!((relative - 1.0).abs() < 0.1, "{degrees} {directions:?} {found:?}");
            }
        }
    }
}

/// A single variable of several takes one line, whatever the others are.
#[test]
fn one_variable_of_three() {
    let band = limit(3, |z| ((z[1] - 1.0).abs() - 0.25, vec![0.0; 3]));
    let sampler = LineSampler::new(3, &[1], &[toward(&[5.0, 1.0, 0.0], 0.75)], &settings(0.01)).unwrap();
    let found = sampler.run(&band);
    assert_eq!((found.lines, found.settled), (1, true));
    let exact = below(-0.75) - below(-1.25);
    assert!(found.probability.standard_error < 2e-6 * exact);
    close(found.probability.value, exact, 1e-6);
}

/// What has no value counts for neither side.
#[test]
fn missing_values_are_counted_apart() {
    let partial = limit(2, |z| {
        let value = if z[1] > 1.0 { f64::NAN } else { 1.5 - z[0] };
        (value, vec![0.0; 2])
    });
    let found = run(&partial, &[toward(&[1.0, 0.0], 1.5)], 0.02);
    covers(&found, below(-1.5) * below(1.0), 0.021);
    let missing = found.without_value;
    assert!((missing.value - below(-1.0)).abs() < 4.0 * missing.standard_error);
}

/// Too few lines, or failures that few of them meet, settle nothing.
#[test]
fn few_failures_settle_nothing() {
    let ball = limit(6, |z| {
        let square = z.iter().skip(1).fold((z[0] - 4.0).powi(2), |sum, z| sum + z * z);
        (square - 0.25, vec![0.0; 6])
    });
    let rarely = LineSettings { evaluations: 3_000, ..LineSettings::default() };
    let variables = [0, 1, 2, 3, 4, 5];
    let found = LineSampler::new(6, &variables, &[], &rarely).unwrap().run(&ball);
    assert!(!found.settled && !found.reached, "{found:?}");
    let hardly = LineSettings { evaluations: 100, ..LineSettings::default() };
    let plane = linear(2.0, vec![-1.0, 0.0]);
    let found = LineSampler::new(2, &[0, 1], &[toward(&[1.0, 0.0], 2.0)], &hardly).unwrap().run(&plane);
    assert!(!found.settled, "{found:?}");
}

/// The standard error matches the scatter over 60 streams.
#[test]
fn standard_errors_are_right() {
    let curved = limit(2, |z| (2.5 - z[0] - 0.3 * z[1] * z[1], vec![0.0; 2]));
    let runs: Vec<LineProbability> = (0..60)
        .map(|stream| {
            let settings = LineSettings { stream, coefficient_of_variation: 0.1, ..LineSettings::default() };
            LineSampler::new(2, &[0, 1], &[toward(&[1.0, 0.0], 2.5)], &settings).unwrap().run(&curved)
        })
        .collect();
    let n = runs.len() as f64;
    let mean = runs.iter().map(|run| run.probability.value).sum::<f64>() / n;
    let squares = runs.iter().map(|run| (run.probability.value - mean).powi(2));
    let scatter = (squares.sum::<f64>() / (n - 1.0)).sqrt();
    let stated = runs.iter().map(|run| run.probability.standard_error).sum::<f64>() / n;
    assert!((0.6..1.6).contains(&(stated / scatter)), "{stated} {scatter}");
}

#[test]
fn settings_that_make_no_sense_are_refused() {
    let reach = LineSettings { reach: 0.0, ..LineSettings::default() };
    assert!(LineSampler::new(2, &[0], &[], &reach).is_err());
    assert!(LineSampler::new(2, &[], &[], &LineSettings::default()).is_err());
    assert!(LineSampler::new(2, &[2], &[], &LineSettings::default()).is_err());
}
