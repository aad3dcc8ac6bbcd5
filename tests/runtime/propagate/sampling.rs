//! Samples: statistics with reliable error estimates, merged from any split to the same bits.
#![allow(clippy::single_range_in_vec_init, reason = "lists of ranges")]

use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use eigentol::propagation::{Samples, sampled};
use eigentol::tolerance::{Points, Sampling};

use super::*;
use crate::common::close;

const ALL: [Points; 3] = [Points::Random, Points::LatinHypercube, Points::Sobol];

/// Every number is within a few of its own errors of the truth, and the error itself is below what the points promise.
#[test]
fn statistics_of_the_exact_distribution() {
    for (seed, length) in lengths().into_iter().enumerate() {
        let exact = Exact::new(&length);
        let tolerances = varied(length);
        for points in ALL {
            let sampling = Sampling::default().points(points).samples(8192).seed(seed as u64);
            let all = ask(&bar(), vec![FREQUENCY], |responses| {
                let samples = sampled(responses, &tolerances, &sampling).unwrap();
                samples.propagation().unwrap()
            });
            assert_eq!((all.evaluations, all.counts.stable), (8192, 8192));
            let found = spread(&all, 0);
            close(found.nominal.unwrap(), frequency(1.0), 1e-12);
            let within = |value: f64, error: Option<f64>, exact: f64, most: f64| {
                let error = error.unwrap();
                // Eight randomisations determine a standard error within a factor of two.
                assert!((value - exact).abs() <= 6.0 * error + 1e-7, "{points:?} {value} {exact} {error}");
                assert!(error <= most, "{points:?} {error} {most}");
            };
            let sigma = found.sigma.unwrap();
            let skewness = found.skewness.unwrap();
            let plain = exact.sigma / 8192_f64.sqrt();
            let gain = if points == Points::Random { 1.01 } else { 0.2 };
            within(found.mean.value, found.mean.error, exact.mean, gain * plain);
            within(sigma.value, sigma.error, exact.sigma, gain * plain);
            within(skewness.value, skewness.error, exact.skewness, 0.03);
            for quantile in &found.quantiles {
                let truth = exact.quantile(quantile.probability);
                let density = 0.5 * exact.sigma;
                // A bucket of the sketch is up to 0.004 standard deviations wide per standard deviation.
                let bucket = 0.02 * exact.sigma;
                let error = quantile.error.unwrap_or(density) + bucket;
                within(quantile.value, Some(error), truth, density + bucket);
            }
            assert_eq!(found.share, 1.0);
        }
    }
}

/// Over many seeds errors scatter about zero as stated: balanced points cause no bias, as their means take no degree of
/// freedom from their variances.
#[test]
fn stated_errors_are_those_of_many_runs() {
    for length in lengths() {
        let exact = Exact::new(&length);
        let tolerances = varied(length);
        for points in ALL {
            let (mut squares, mut sums) = ([0.0; 7], [0.0; 7]);
            let seeds = 40;
            for seed in 0..seeds {
                let sampling = Sampling::default().points(points).samples(1024).seed(seed).threads(1);
                let all = ask(&bar(), vec![FREQUENCY], |responses| {
                    let samples = sampled(responses, &tolerances, &sampling).unwrap();
                    samples.propagation().unwrap()
                });
                let found = spread(&all, 0);
                let moments = [found.mean, found.sigma.unwrap()];
                let moments = moments.map(|moment| (moment.value, moment.error));
                let moments = moments.into_iter().zip([exact.mean, exact.sigma]);
                // Those beyond two standard deviations have hardly a sample.
                let quantiles = found.quantiles[1..6].iter();
                let quantiles =
                    quantiles.map(|quantile| ((quantile.value, quantile.error), exact.quantile(quantile.probability)));
                for (k, ((value, error), truth)) in moments.chain(quantiles).enumerate() {
                    let z = (value - truth) / error.unwrap();
                    squares[k] += z * z / seeds as f64;
                    sums[k] += z / seeds as f64;
                }
            }
            // Student's t with seven degrees of freedom has a variance of 1.4.
            for (square, sum) in squares.into_iter().zip(sums) {
                assert!((0.2..3.0).contains(&square), "{points:?} {squares:?}");
                // A quantile of few samples is biased towards the centre, by up to half a sample.
                assert!(f64::abs(sum) < 1.0, "{points:?} {sums:?}");
            }
        }
    }
}

#[test]
fn splits_merge_to_the_same_bits() {
    let tolerances = varied(lengths()[1].clone());
    for points in ALL {
        let sampling = Sampling::default().points(points).samples(3000).threads(1);
        let total = sampling.total().unwrap();
        let run = |range, threads| {
            ask(&bar(), vec![FREQUENCY], |responses| {
                let own = sampling.clone().range(range).threads(threads);
                sampled(responses, &tolerances, &own).unwrap()
            })
        };
        let whole = run(None, 1);
        assert_eq!(whole, run(None, 3));
        assert_eq!(whole.ranges(), [0..total]);
        let cuts = [0, 1, 700, 1100, total];
        let mut parts: Vec<Samples> = (cuts.windows(2)).map(|ends| run(Some(ends[0]..ends[1]), 2)).collect();
        assert_eq!(parts[2].ranges(), [700..1100]);
        let mut merged = parts.remove(2);
        for part in parts {
            merged.merge(part).unwrap();
        }
        assert_eq!(merged, whole);
        assert!(merged.clone().merge(run(Some(5..6), 1)).is_err());
        assert_eq!(merged, whole);
    }
}

/// The value from a stopped run covers the samples done so far, and the rest can be added.
#[test]
fn a_run_that_is_stopped_can_be_resumed() {
    let tolerances = varied(lengths()[0].clone());
    let (stop, done) = (AtomicBool::new(false), AtomicUsize::new(0));
    let progress = |number| {
        if done.fetch_add(number, Ordering::Relaxed) + number >= 1000 {
            stop.store(true, Ordering::Relaxed);
        }
    };
    let whole = Sampling::default().points(Points::Sobol).samples(4096).threads(1);
    let stopped = whole.clone().progress(Some(&progress)).stop(Some(&stop));
    ask(&bar(), vec![FREQUENCY], |responses| {
        let all = sampled(responses, &tolerances, &whole).unwrap();
        let mut part = sampled(responses, &tolerances, &stopped).unwrap();
        assert_eq!(part.ranges(), [0..1024]);
        assert_eq!(part.counts().total(), 1024);
        let so_far = part.propagation().unwrap();
        // Six of eight randomisations are missing, so no error can be estimated.
        assert_eq!(spread(&so_far, 0).mean.error, None);
        let rest = whole.clone().range(Some(1024..4096));
        part.merge(sampled(responses, &tolerances, &rest).unwrap()).unwrap();
        assert_eq!(part, all);
        stop.store(true, Ordering::Relaxed);
        let none = sampled(responses, &tolerances, &stopped).unwrap();
        assert!(none.ranges().is_empty());
        assert_eq!(none.propagation().unwrap().spreads, [None]);
    });
}

#[test]
fn progress_counts_every_sample() {
    let tolerances = varied(lengths()[0].clone());
    let seen = Mutex::new(0);
    let progress = |number| *seen.lock().unwrap() += number;
    let sampling = Sampling::default().samples(777).progress(Some(&progress));
    ask(&bar(), vec![FREQUENCY], |responses| sampled(responses, &tolerances, &sampling).unwrap());
    assert_eq!(*seen.lock().unwrap(), 777);
}

/// Mean and variance of a sum, covariance with a product, and with the variables.
#[test]
fn covariance_of_responses() {
    let sigmas = [0.0, 0.0, 0.1, 0.2, 0.05];
    let tolerances = Tolerances::new(sigmas, 1.0, None).unwrap();
    let sampling = Sampling::default().points(Points::Sobol).samples(1 << 14);
    let all =
        ask_sum(outputs(), |responses| sampled(responses, &tolerances, &sampling).unwrap().propagation().unwrap());
    // sum = a + 2 b - 3 c, product = a b with a = 1 +- 0.1, b = 2 +- 0.2.
    let sum = 0.1_f64.powi(2) + 0.4_f64.powi(2) + 0.15_f64.powi(2);
    let product = (2.0 * 0.1_f64).powi(2) + 0.2_f64.powi(2) + (0.1_f64 * 0.2).powi(2);
    let both = 2.0 * 0.01 + 2.0 * 0.04;
    // Plain samples have a standard error of about 1.4 % of these covariances.
    const WITHIN: f64 = 4e-3;
    close(all.covariance[0][0].unwrap(), sum, WITHIN);
    close(all.covariance[1][1].unwrap(), product, WITHIN);
    close(all.covariance[0][1].unwrap(), both, WITHIN);
    assert_eq!(all.covariance[0][1], all.covariance[1][0]);
    close(all.correlation(0, 1).unwrap(), both / (sum * product).sqrt(), WITHIN);
    close(all.with_design[0][4].unwrap(), -3.0 * 0.05 * 0.05, WITHIN);
    close(all.with_design[1][2].unwrap(), 2.0 * 0.01, WITHIN);
    assert_eq!(all.with_design[1][0], Some(0.0));
}

/// Two variables with correlation 1 act as one variable with both effects.
#[test]
fn correlation_1_is_a_shared_variable() {
    let ones = [[1.0, 1.0], [1.0, 1.0]];
    let matrix = eigentol::Matrix::from_fn(5, 5, |i, j| match (i, j) {
        (2 | 3, 2 | 3) => ones[i - 2][j - 2],
        _ => f64::from(u8::from(i == j)),
    });
    let both = Tolerances::new([0.0, 0.0, 0.1, 0.1, 0.0], 1.0, Some(matrix)).unwrap();
    let sampling = Sampling::default().points(Points::Sobol).samples(4096);
    let all = ask_sum(outputs(), |responses| sampled(responses, &both, &sampling).unwrap().propagation().unwrap());
    // Three times the standard normal number underlying both.
    let alone = Tolerances::new([0.0, 0.0, 0.3, 0.0, 0.0], 1.0, None).unwrap();
    let one = ask_sum(outputs(), |responses| sampled(responses, &alone, &sampling).unwrap().propagation().unwrap());
    let sigma = |all: &Propagation| spread(all, 0).sigma.unwrap().value;
    close(sigma(&all), sigma(&one), 1e-12);
    close(sigma(&all), 0.3, 1e-3);
}

/// Speeds near the critical one: samples hang straight down or have no distinct equilibrium; none is lost.
#[test]
fn samples_without_values_are_counted() {
    let tolerances = varied(Distribution::uniform(-0.5, 1.5).unwrap());
    let sampling = Sampling::default().points(Points::LatinHypercube).samples(1600);
    let all = ask(&bar(), vec![FREQUENCY, Response::Output(Bar::length.any())], |responses| {
        sampled(responses, &tolerances, &sampling).unwrap().propagation().unwrap()
    });
    assert_eq!((all.counts.unphysical, all.counts.stable), (400, 1200));
    assert_eq!(spread(&all, 1).share, 0.75);
    close(spread(&all, 1).mean.value, 1.5, 1e-2);
    assert!(all.spreads[0].is_some() && all.with_design[1][0] == Some(0.0));
}

#[test]
fn a_sampling_that_makes_no_sense_is_refused() {
    let tolerances = varied(lengths()[0].clone());
    ask(&bar(), vec![FREQUENCY], |responses| {
        let found = |sampling: Sampling<'_>| sampled(responses, &tolerances, &sampling);
        let sobol = || Sampling::default().points(Points::Sobol);
        assert!(is_setting(found(sobol().samples(15)), "samples"));
        assert!(is_setting(found(sobol().randomisations(1)), "randomisations"));
        assert!(is_setting(found(Sampling::default().samples(0)), "samples"));
        assert!(is_setting(found(sobol().range(Some(4000..4097))), "range"));
        let other = Tolerances::new([0.1], 3.0, None).unwrap();
        assert!(matches!(sampled(responses, &other, &sobol()), Err(Error::WrongLength { .. })));
        let mut one = found(sobol().range(Some(0..10))).unwrap();
        let other = found(sobol().seed(1).range(Some(10..20))).unwrap();
        let refused = one.merge(other).unwrap_err();
        assert_eq!(refused.to_string(), "these samples belong to another run: seed is 0 here and 1 there");
    });
}

/// Nothing varies: every sample equals the nominal one.
#[test]
fn without_tolerances_nothing_is_spread() {
    let tolerances = varied(Distribution::constant(1.0).unwrap());
    let sampling = Sampling::default().points(Points::Sobol).samples(64);
    let all = ask(&bar(), vec![FREQUENCY], |responses| {
        sampled(responses, &tolerances, &sampling).unwrap().propagation().unwrap()
    });
    let found = spread(&all, 0);
    assert_eq!(found.sigma.unwrap().value, 0.0);
    assert_eq!((found.skewness, all.correlation(0, 0)), (None, None));
    close(found.mean.value, frequency(1.0), 1e-12);
}

/// Of a quantile beyond all samples nothing is known.
#[test]
fn quantiles_beyond_all_samples_have_no_error() {
    let tolerances = varied(lengths()[0].clone());
    for points in ALL {
        let sampling = Sampling::default().points(points).samples(256);
        let all = ask(&bar(), vec![FREQUENCY], |responses| {
            let samples = sampled(responses, &tolerances, &sampling).unwrap();
            samples.propagation().unwrap()
        });
        let quantiles = &spread(&all, 0).quantiles;
        let known = quantiles.iter().map(|quantile| quantile.error.is_some());
        // 0.35 samples beyond three standard deviations, 5.8 beyond two.
        let expected = [false, true, true, true, true, true, false];
        assert_eq!(known.collect::<Vec<_>>(), expected, "{points:?}");
    }
}
