//! Monte Carlo with a fluctuating speed against quadrature.

use super::{CRITICAL, Double, OMEGA, Single, all_deviate, frequency, solved};
use crate::common::pendulum::Pendulum;
use eigentol::kernels::{BatchKernels, DeviatingInputs};
use eigentol::scalar::Instructions;
use eigentol::tolerance::{Sampling, monte_carlo};
use eigentol::{MonteCarlo, Tolerances};

/// Mean and standard deviation of `value` for a normal variable, by the midpoint rule.
fn moments(mean: f64, sigma: f64, value: impl Fn(f64) -> f64) -> (f64, f64) {
    const STEPS: usize = 400_000;
    let sum = |f: &dyn Fn(f64) -> f64| -> f64 {
        let width = 17.0 / STEPS as f64;
        let each = (0..STEPS).map(|k| {
            let z = -8.5 + (k as f64 + 0.5) * width;
            (-0.5 * z * z).exp() * f(value(mean + sigma * z))
        });
        each.sum::<f64>() * width / std::f64::consts::TAU.sqrt()
    };
    let first = sum(&|x| x);
    (first, sum(&|x| (x - first) * (x - first)).sqrt())
}

#[test]
fn quadrature_knows_its_closed_forms() {
    let (mean, sigma) = moments(5.0, 0.3, |u| u * u);
    assert!((mean - 25.09).abs() < 1e-11);
    assert!((sigma - (4.0 * 25.0 * 0.09 + 2.0 * 0.0081_f64).sqrt()).abs() < 1e-11);
}

fn sampled(
    machine: &dyn BatchKernels,
    speed: f64,
    sigma: f64,
    vectors: Option<Instructions>,
    samples: usize,
) -> MonteCarlo {
    let deviating = DeviatingInputs::new(machine, &[OMEGA]).unwrap();
    let b = deviating.design(&[3.0, 1.0]);
    let (at, modes) = solved(&deviating, &[speed], &b, &[1.0]);
    let tolerances = Tolerances::new([0.0, 0.0, 3.0 * sigma], 3.0, None).unwrap();
    let sampling = Sampling::default().samples(samples).seed(20).vectors(vectors).keep_samples(true);
    monte_carlo(&deviating, &at, &modes, &tolerances, &sampling).unwrap()
}

#[test]
fn monte_carlo_matches_quadrature() {
    samples_match_quadrature(6_000);
}

#[test]
#[ignore = "ten seconds"]
fn monte_carlo_of_many_samples_matches_quadrature() {
    samples_match_quadrature(60_000);
}

/// Far above the critical speed, 3.836 rad/s, and near it, where samples hang or have left the vertical.
fn samples_match_quadrature(samples: usize) {
    let best = Some(Instructions::best());
    for (speed, sigma) in [(6.0, 0.2), (5.0, 0.1), (4.0, 0.1), (3.836, 0.02)] {
        let (mean, deviation) = moments(speed, sigma, frequency);
        for (machine, vectors) in [(&Pendulum as &dyn BatchKernels, None), (&Single, best)] {
            let run = sampled(machine, speed, sigma, vectors, samples);
            assert_eq!(run.counts.stable, run.samples);
            assert_eq!(run.side_by_side, vectors.is_some() && speed >= 5.0);
            let mode = run.modes[0].as_ref().unwrap();
            let error = (mode.mean - mean).abs() / mode.standard_error.unwrap();
            assert!(error < 4.0, "{speed}: mean {} is not {mean}", mode.mean);
            // Its standard error from the sample itself, through the fourth moment.
            let frequency = run.all.as_ref().unwrap().iter().map(|one| one.frequencies[0].unwrap());
            let count = samples as f64;
            let fourth = frequency.map(|x| (x - mode.mean).powi(4)).sum::<f64>() / count;
            let spread = mode.sigma.unwrap();
            let error = ((fourth - spread.powi(4)) / count).sqrt() / (2.0 * spread);
            assert!(
                (spread - deviation).abs() < 4.0 * error,
                "{speed}: sigma {spread} is not {deviation} within {error}"
            );
        }
    }
}

/// Every sample has the frequency at its own speed.
#[test]
fn every_sample_is_the_closed_form() {
    let best = Some(Instructions::best());
    for (speed, vectors, side_by_side) in [(4.0, None, false), (5.0, None, false), (5.0, best, true)] {
        let run = sampled(&Single, speed, 0.1, vectors, 2000);
        assert_eq!(run.side_by_side, side_by_side);
        let mut hanging = 0;
        for sample in run.all.unwrap() {
            assert_eq!(sample.design[..2], [3.0, 1.0]);
            let speed = speed + sample.design[2];
            hanging += usize::from(speed * speed < CRITICAL);
            let (frequency, expected) = (sample.frequencies[0].unwrap(), frequency(speed));
            // A frequency near zero is the square root of a difference.
            let error = (frequency * frequency - expected * expected).abs();
            assert!(error <= 1e-9 * speed * speed, "{speed}: {frequency} {expected}");
        }
        assert_eq!(hanging > 20, speed == 4.0);
    }
}

/// Samples in vectors against samples one by one, with speed, load and lengths varying together.
#[test]
fn side_by_side_is_one_by_one() {
    let deviating = all_deviate(&Double);
    let b = deviating.design(&[3.0, 3.0, 1.0, 1.0]);
    let (at, modes) = solved(&deviating, &[6.0, 2.0], &b, &[1.0, 1.1]);
    let tolerances = Tolerances::new([0.05, 0.0, 0.03, 0.02, 0.3, 0.5], 3.0, None).unwrap();
    let run = |vectors, threads| {
        let sampling = Sampling::default().samples(1003).seed(3).threads(threads).vectors(vectors).keep_samples(true);
        monte_carlo(&deviating, &at, &modes, &tolerances, &sampling).unwrap()
    };
    let alone = run(None, 1);
    let together = run(Some(Instructions::SCALAR), 1);
    assert!(together.side_by_side && !alone.side_by_side);
    for set in Instructions::available() {
        assert!(run(Some(set), 2) == together, "{set:?}");
    }
    assert_eq!(together.counts, alone.counts);
    assert_eq!(together.counts.stable, 1003);
    let samples = together.all.unwrap().into_iter().zip(alone.all.unwrap());
    for (found, expected) in samples {
        for (value, expected) in found.design.iter().zip(&expected.design) {
            assert!((value - expected).abs() <= 1e-14);
        }
        for (frequency, expected) in found.frequencies.iter().zip(&expected.frequencies) {
            let (found, expected) = (frequency.unwrap(), expected.unwrap());
            assert!((found - expected).abs() <= 1e-10 * expected);
        }
    }
}
