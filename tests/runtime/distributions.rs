//! Tolerances with any distribution: first order and Monte Carlo against the exact distribution of the rotating bar,
//! whose frequency is a function of its length.

use eigentol::tolerance::{Distribution, MonteCarlo, Outcome};
use eigentol::{DesignVariable, Error, Law, Study, mechanism};

use crate::common::{GRAVITY, close};

mechanism! {
    mechanism Pendulum {
        input omega: rad/s;
        design m = 3.0 kg;
        design l = 1.0 m;
        gravity 9.81 m/s^2 along -z;
        body shaft: massless;
        body bar: rod(mass: m, length: l, along: -z);
        joint spin: revolute(z) from ground to shaft, driven at omega;
        joint theta: revolute(y) from shaft to bar;
    }
}

const MASS: DesignVariable<Pendulum> = Pendulum::m;
const LENGTH: DesignVariable<Pendulum> = Pendulum::l;
const SPEED: f64 = 5.0;
const SAMPLES: usize = 20_000;

fn study() -> Study<Pendulum> {
    Study::new(Pendulum).input(Pendulum::omega, SPEED).start(Pendulum::theta, 1.0).samples(SAMPLES)
}

fn frequency(length: f64) -> f64 {
    let natural = 1.5 * GRAVITY / length;
    (SPEED.powi(2) - (natural / SPEED).powi(2)).sqrt()
}

/// Mean and standard deviation of the frequency, over quantiles of the length.
fn exact(length: &Distribution) -> (f64, f64) {
    let number = 20_000;
    let at = |k: u32| frequency(length.quantile((f64::from(k) + 0.5) / f64::from(number)));
    let mean = (0..number).map(at).sum::<f64>() / f64::from(number);
    let squares = (0..number).map(|k| (at(k) - mean).powi(2)).sum::<f64>();
    (mean, (squares / f64::from(number)).sqrt())
}

fn lengths() -> Vec<Distribution> {
    [
        Distribution::normal(1.01, 0.01),
        Distribution::truncated_normal(1.0, 0.02, (0.98, 1.05)),
        Distribution::uniform(0.95, 1.05),
        Distribution::triangular(0.98, 1.0, 1.06),
        Distribution::lognormal(1.0, 0.03),
        Distribution::weibull_by_moments(1.0, 0.02),
        Distribution::beta((2.0, 5.0), (0.97, 1.08)),
        Distribution::discrete(&[(0.95, 1.0), (1.0, 2.0), (1.02, 1.0)]),
        Distribution::empirical(&[0.97, 0.99, 1.0, 1.0, 1.01, 1.04]),
    ]
    .into_iter()
    .map(Result::unwrap)
    .collect()
}

#[test]
fn monte_carlo_has_the_exact_moments() {
    for (seed, length) in lengths().into_iter().enumerate() {
        let (mean, sigma) = exact(&length);
        let study = study().distribution(LENGTH, length.clone()).seed(seed as u64);
        for study in [study.clone(), study.vectors(None)] {
            let run = study.monte_carlo().unwrap();
            let mode = run.modes[0].as_ref().unwrap();
            let error = sigma / (SAMPLES as f64).sqrt();
            assert_eq!(run.counts.stable, SAMPLES);
            assert!((mode.mean - mean).abs() < 4.0 * error, "{length:?}");
            // An upper bound on the standard error of a standard deviation for excess kurtosis below 6.
            assert!((mode.sigma.unwrap() - sigma).abs() < 4.0 * 1.42 * error, "{length:?}");
        }
    }
}

/// The same designs are drawn, whichever way they are solved.
#[test]
fn side_by_side_draws_the_same_values() {
    for length in lengths() {
        let mass = Distribution::uniform(2.9, 3.2).unwrap();
        let correlation = [[1.0, 0.4], [0.4, 1.0]];
        let study = study()
            .distribution(LENGTH, length)
            .distribution(MASS, mass)
            .correlation(correlation)
            .samples(100)
            .keep_samples(true);
        let together = study.monte_carlo().unwrap();
        let alone = study.vectors(None).monte_carlo().unwrap();
        assert!(together.side_by_side && !alone.side_by_side);
        for (one, other) in together.all.unwrap().iter().zip(alone.all.unwrap()) {
            assert_eq!(one.design, other.design);
            let [one, other] = [one, &other].map(|sample| sample.frequencies[0].unwrap());
            close(one, other, 1e-12);
        }
    }
}

fn correlation_of(run: &MonteCarlo) -> f64 {
    let all = run.all.as_ref().unwrap();
    let number = all.len() as f64;
    let mean = [0, 1].map(|k| all.iter().map(|sample| sample.design[k]).sum::<f64>() / number);
    let moment = |i: usize, j: usize| {
        let each = all.iter().map(|s| (s.design[i] - mean[i]) * (s.design[j] - mean[j]));
        each.sum::<f64>() / number
    };
    moment(0, 1) / (moment(0, 0) * moment(1, 1)).sqrt()
}

#[test]
fn values_have_the_correlation_that_was_asked_for() {
    for wanted in [-0.5, 0.7] {
        let study = study()
            .distribution(LENGTH, Distribution::uniform(0.99, 1.01).unwrap())
            .distribution(MASS, Distribution::lognormal(3.0, 1.0).unwrap())
            .correlation([[1.0, wanted], [wanted, 1.0]])
            .keep_samples(true);
        let value = correlation_of(&study.monte_carlo().unwrap());
        assert!((value - wanted).abs() < 0.03, "{value}, not {wanted}");
    }
}

#[test]
fn first_order_counts_the_mean_and_the_law() {
    let study = study().limits(LENGTH, -0.01, 0.03);
    let slope = study.sensitivities().unwrap().modes[0].frequency().unwrap().by_design[1];
    for (law, sigma) in [
        (Law::Normal, 0.02 / 3.0),
        (Law::Uniform, 0.02 / 3.0_f64.sqrt()),
        (Law::Triangular, 0.02 / 6.0_f64.sqrt()),
        (Law::Lognormal, 0.02 / 3.0),
        (Law::Weibull, 0.02 / 3.0),
        (Law::TruncatedNormal, 0.02 / 3.0 * 0.986_578_392_558_108_6),
        (Law::Beta { alpha: 2.0, beta: 2.0 }, 0.02 / 5.0_f64.sqrt()),
    ] {
        let study = study.clone().law(LENGTH, law);
        let first = study.first_order().unwrap();
        let found = first.modes[0].frequency().unwrap();
        close(found.sigma, slope.abs() * sigma, 1e-11);
        close(found.mean, frequency(1.0) + 0.01 * slope, 1e-12);
        assert!((study.tolerances().unwrap().shifts()[1] - 0.01).abs() < 1e-12);
    }
}

/// With shapes 2 and 5 the mean lies two sevenths of the way, with 5 and 2 five sevenths.
#[test]
fn a_beta_law_leans_as_its_shapes_say() {
    for (alpha, beta, shift) in [(2.0, 5.0, 0.01), (5.0, 2.0, 0.04)] {
        let study = study().limits(LENGTH, -0.01, 0.06);
        let study = study.law(LENGTH, Law::Beta { alpha, beta });
        let found = study.tolerances().unwrap();
        assert!((found.shifts()[1] - shift).abs() < 1e-12);
        close(found.sigmas()[1], 0.07 * (10.0_f64 / 392.0).sqrt(), 1e-12);
    }
}

#[test]
fn a_law_follows_limits_and_limits_keep_the_law() {
    let wide = |study: Study<Pendulum>| study.tolerances().unwrap().sigmas()[1];
    let one = study().law(LENGTH, Law::Uniform).tolerance(LENGTH, 0.03);
    let other = study().tolerance(LENGTH, 0.03).law(LENGTH, Law::Uniform);
    assert_eq!(wide(one.clone()), wide(other));
    // Hard limits do not depend on how many standard deviations they correspond to.
    assert_eq!(wide(one.clone()), wide(one.sigma_level(2.0)));
    let soft = study().tolerance(LENGTH, 0.03);
    close(wide(soft.clone().sigma_level(2.0)), 1.5 * wide(soft), 1e-14);
}

/// Discrete values between the limits scale with them.
#[test]
fn one_of_some_values_between_limits() {
    let places = vec![(0.0, 1.0), (0.25, 6.0), (1.0, 1.0)];
    let law = Law::OneOf(places.into());
    let study = study().limits(LENGTH, -0.01, 0.03).law(LENGTH, law.clone());
    let found = study.tolerances().unwrap();
    // Values of 0.99 (1/8), 1 (6/8) and 1.03 (1/8).
    close(found.shifts()[1], 0.02 / 8.0, 1e-12);
    let variance = (1e-4 + 9e-4) / 8.0 - (0.02_f64 / 8.0).powi(2);
    close(found.sigmas()[1], variance.sqrt(), 1e-12);
    let twice = study.clone().limits(LENGTH, -0.02, 0.06).tolerances().unwrap();
    close(twice.sigmas()[1], 2.0 * variance.sqrt(), 1e-12);
    let outside = vec![(0.0, 1.0), (1.5, 1.0)];
    let refused = study.law(LENGTH, Law::OneOf(outside.into())).tolerances();
    assert!(refused.unwrap_err().to_string().contains("1.5 is not between 0"));
}

#[test]
fn what_makes_no_sense_is_refused() {
    let refused = |study: Study<Pendulum>| match study.tolerances() {
        Err(Error::Setting { setting, .. }) => setting,
        other => panic!("{other:?}"),
    };
    assert_eq!(refused(study().limits(LENGTH, 0.02, 0.01)), "tolerance");
    assert_eq!(refused(study().limits(LENGTH, f64::NAN, 0.01)), "tolerance");
    assert_eq!(refused(study().limits(LENGTH, -0.01, f64::INFINITY)), "tolerance");
    let shape = Law::Beta { alpha: -1.0, beta: 2.0 };
    assert_eq!(refused(study().tolerance(LENGTH, 0.01).law(LENGTH, shape)), "shape of a beta distribution");
    let negative = study().limits(LENGTH, -3.0, -2.0).law(LENGTH, Law::Lognormal);
    assert_eq!(refused(negative), "mean of a lognormal variable");
    let uniform = Distribution::uniform(0.9, 1.1).unwrap();
    let correlated =
        study().distribution(LENGTH, uniform).tolerance(MASS, 0.1).correlation([[1.0, 0.999], [0.999, 1.0]]);
    assert_eq!(refused(correlated), "correlation matrix");
}

#[test]
fn impossible_bodies_are_counted() {
    let study = study().distribution(LENGTH, Distribution::uniform(-0.5, 1.5).unwrap()).keep_samples(true);
    for study in [study.clone(), study.vectors(None)] {
        let run = study.monte_carlo().unwrap();
        let share = run.counts.unphysical as f64 / SAMPLES as f64;
        assert!((share - 0.25).abs() < 0.01, "{share}");
        for sample in run.all.unwrap() {
            assert_eq!(sample.outcome == Outcome::Unphysical, sample.design[1] <= 0.0);
        }
        assert_eq!(run.counts.total(), SAMPLES);
    }
}

/// A fluctuating speed with a varying length: first order is exact in the derivatives of the closed form for both.
#[test]
fn a_speed_that_wanders() {
    let exact = Study::new(Pendulum).input(Pendulum::omega, SPEED).start(Pendulum::theta, 1.0).tolerance(LENGTH, 0.03);
    let study = exact.clone().tolerance(Pendulum::omega, 0.3);
    assert_eq!(study.tolerances().unwrap().sigmas(), [0.0, 0.01, 0.3 / 3.0]);
    let slopes = study.sensitivities().unwrap();
    let by_speed = slopes.modes[0].frequency().unwrap().by_input[0];
    let spread = |study: &Study<Pendulum>| {
        let first = study.first_order().unwrap();
        first.modes[0].frequency().unwrap()
    };
    let (with, without) = (spread(&study), spread(&exact));
    close(with.sigma, without.sigma.hypot(0.1 * by_speed), 1e-14);
    close(with.variance_shares[2], (0.1 * by_speed / with.sigma).powi(2), 1e-12);

    let run = study.clone().samples(SAMPLES).monte_carlo().unwrap();
    let mode = run.modes[0].as_ref().unwrap();
    assert!((mode.sigma.unwrap() / with.sigma - 1.0).abs() < 0.03);
    assert!(run.side_by_side && run.counts.stable == SAMPLES);

    close(
        study.second_order().unwrap().modes[0].as_ref().unwrap().frequency.moments.first_order_sigma,
        with.sigma,
        1e-13,
    );
    assert!(study.summary().is_ok() && study.clusters().unwrap().is_empty());
    let swept = study.first_order_sweep(Pendulum::omega, &[4.5, SPEED]).unwrap();
    let last = swept[1].as_ref().unwrap().modes[0].frequency().unwrap();
    close(last.sigma, with.sigma, 1e-12);
    // The mechanism becomes critical at the same speed, so the set value is lower by the deviation.
    let critical = study.critical_tolerance(Pendulum::omega, 0.0, 6.0).unwrap();
    let plain = exact.critical_tolerance(Pendulum::omega, 0.0, 6.0).unwrap();
    close(critical.sigma().unwrap(), plain.sigma().unwrap().hypot(0.1), 1e-12);
    assert!(study.campbell(Pendulum::omega, &[4.0, 5.0], &[1.0]).is_ok());
}

mod declared {
    use super::*;

    mechanism! {
        mechanism Declared {
            input omega: rad/s +/- 2% uniform;
            design m = 3.0 kg;
            design l = 1000 mm +20 -10 mm triangular;
            gravity 9.81 m/s^2 along -z;
            body shaft: massless;
            body bar: rod(mass: m, length: l, along: -z);
            joint spin: revolute(z) from ground to shaft, driven at omega;
            joint theta: revolute(y) from shaft to bar;
        }
    }

    mechanism! {
        mechanism Classes {
            input omega: rad/s;
            design l = 1 m one of [0.98, 1.0, 1.03] m weighted [1, 6, 1];
            gravity 9.81 m/s^2 along -z;
            body shaft: massless;
            body bar: rod(mass: 3 kg, length: l, along: -z);
            joint spin: revolute(z) from ground to shaft, driven at omega;
            joint theta: revolute(y) from shaft to bar;
        }
    }

    /// Three lengths, three frequencies: mean and variance are sums.
    #[test]
    fn classes_of_the_language() {
        let study = Study::new(Classes)
            .input(Classes::omega, SPEED)
            .start(Classes::theta, 1.0)
            .samples(4000)
            .keep_samples(true);
        let run = study.monte_carlo().unwrap();
        let classes = [0.98, 1.0, 1.03].map(frequency);
        let weights = [0.125, 0.75, 0.125];
        let of = |value: &dyn Fn(f64) -> f64| -> f64 {
            classes.iter().zip(weights).map(|(class, weight)| weight * value(*class)).sum()
        };
        let mean = of(&|x| x);
        let variance = of(&|x| (x - mean).powi(2));
        let mode = run.modes[0].as_ref().unwrap();
        assert!((mode.mean - mean).abs() < 4.0 * (variance / 4000.0).sqrt(), "{mode:?}");
        close(mode.sigma.unwrap(), variance.sqrt(), 0.05);
        close(mode.min, classes[0].min(classes[2]), 1e-12);
        close(mode.max, classes[0].max(classes[2]), 1e-12);
        for (length, weight) in [0.98, 1.0, 1.03].into_iter().zip(weights) {
            let all = run.all.as_ref().unwrap();
            let count = all.iter().filter(|x| (x.design[0] - length).abs() < 1e-15).count();
            let expected = 4000.0 * weight;
            assert!((count as f64 - expected).abs() < 4.0 * (expected * (1.0 - weight)).sqrt());
        }
    }

    /// A study uses the declared tolerances: the tolerance of the speed follows it.
    #[test]
    fn tolerances_of_the_language() {
        let study = Study::new(Declared).input(Declared::omega, SPEED).start(Declared::theta, 1.0);
        let tolerances = study.tolerances().unwrap();
        let uniform = |half_width: f64| half_width / 3.0_f64.sqrt();
        close(tolerances.sigmas()[2], uniform(0.02 * SPEED), 1e-14);
        close(tolerances.sigmas()[1], 0.015 / 6.0_f64.sqrt(), 1e-12);
        close(tolerances.shifts()[1], 5e-3, 1e-12);
        let faster = study.clone().input(Declared::omega, 2.0 * SPEED);
        close(faster.tolerances().unwrap().sigmas()[2], uniform(0.04 * SPEED), 1e-14);
        let run = study.samples(500).monte_carlo().unwrap();
        assert_eq!(run.counts.stable, 500);
    }
}
