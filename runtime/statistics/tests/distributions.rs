//! Distributions against forty-digit numbers (mpmath) and closed forms.

use eigentol_statistics::{Distribution, Error, normal};

fn near(value: f64, expected: f64, relative: f64) {
    assert!((value - expected).abs() <= relative * expected.abs(), "{value:.17e}, not {expected:.17e}");
}

/// One of each kind, and some at the limits of the allowed range.
fn all() -> Vec<Distribution> {
    [
        Distribution::normal(2.0, 0.3),
        Distribution::lognormal(2.0, 0.5),
        Distribution::weibull_by_moments(2.0, 0.1),
        Distribution::weibull(0.7, 3.0),
        Distribution::truncated_normal(0.0, 1.0, (-1.0, 2.0)),
        Distribution::truncated_normal(1.0, 2.0, (f64::NEG_INFINITY, 3.0)),
        Distribution::truncated_normal(0.0, 1.0, (5.0, 6.0)),
        Distribution::uniform(-1.0, 3.0),
        Distribution::triangular(0.0, 0.25, 1.0),
        Distribution::triangular(0.0, 0.0, 1.0),
        Distribution::triangular(-1.0, 1.0, 1.0),
        Distribution::beta((2.0, 3.0), (0.0, 1.0)),
        Distribution::beta((0.5, 0.5), (-2.0, 2.0)),
        Distribution::beta((200.0, 300.0), (10.0, 11.0)),
    ]
    .into_iter()
    .map(Result::unwrap)
    .collect()
}

#[test]
fn weibull_by_mean_and_sigma() {
    for (mean, sigma, low, high, skewness) in [
        (2.0, 0.1, 1.568_582_132_547_686_4, 2.244_971_651_598_057_5, -0.918_041_222_359_674),
        (1.0, 1e-5, 0.999_952_986_354_910_8, 1.000_022_729_885_085_3, -1.139_500_578_399_971),
        (3.0, 6.0, 8.904_860_523_011_432e-6, 128.218_935_815_472_9, 5.578_149_144_060_556),
    ] {
        let variable = Distribution::weibull_by_moments(mean, sigma).unwrap();
        near(variable.mean(), mean, 1e-14);
        near(variable.sigma(), sigma, 1e-11);
        let close = if sigma < 1.0 { 1e-12 } else { 2e-10 };
        near(variable.from_normal(-3.0), low, close);
        near(variable.from_normal(4.0), high, close);
        near(variable.skewness(), skewness, 1e-6);
    }
}

#[test]
fn beta_quantiles_in_both_tails() {
    for (alpha, beta, z, x) in [
        (2.0, 3.0, -8.0, 1.018_246_913_305_039e-8),
        (2.0, 3.0, -3.0, 0.015_152_399_346_550_433),
        (0.5, 0.5, -3.0, 4.496_152_480_878_862e-6),
        (200.0, 300.0, -4.0, 0.314_995_651_556_799_1),
        (5.0, 0.3, -2.0, 0.655_233_360_224_929),
    ] {
        let variable = Distribution::beta((alpha, beta), (0.0, 1.0)).unwrap();
        near(variable.from_normal(z), x, 2e-12);
        // The mirror image: its upper tail is the lower tail of this one.
        let mirrored = Distribution::beta((beta, alpha), (-1.0, 0.0)).unwrap();
        near(mirrored.from_normal(-z), -x, 2e-12);
    }
    for (alpha, beta, z, rest) in [
        (2.0, 3.0, 0.5, 0.497_351_318_962_049_8),
        (2.0, 3.0, 5.0, 0.004_157_991_517_414_918),
        (0.5, 0.5, 2.0, 0.001_276_505_569_820_396),
        (200.0, 300.0, 4.0, 0.511_025_940_928_164_9),
        (5.0, 0.3, 3.0, 4.069_384_626_501_381e-11),
    ] {
        let from_its_end = Distribution::beta((alpha, beta), (-1.0, 0.0)).unwrap();
        near(-from_its_end.from_normal(z), rest, 2e-12);
    }
}

#[test]
fn moments_of_truncated_normal_variables() {
    for (low, high, mean, sigma) in [
        (-3.0, 3.0, 0.0, 0.986_578_392_558_108_6),
        (-1.0, 2.0, 0.229_637_179_091_329, 0.720_945_586_859_045_8),
        (5.0, 6.0, 5.183_147_090_477_174, 0.171_617_105_116_253_07),
        (-30.0, -20.0, -20.049_753_068_527_85, 0.049_631_256_432_334_69),
        (1.0, 1.001, 1.000_499_916_625_004_2, 2.886_751_225_594_643e-4),
        (0.0, f64::INFINITY, 0.797_884_560_802_865_4, 0.602_810_274_989_087),
    ] {
        let variable = Distribution::truncated_normal(0.0, 1.0, (low, high)).unwrap();
        assert!((variable.mean() - mean).abs() <= 1e-14 * (1.0 + mean.abs()));
        near(variable.sigma(), sigma, 1e-11);
    }
}

#[test]
fn third_and_fourth_moments() {
    let cases = [
        (Distribution::beta((2.0, 3.0), (0.0, 1.0)), 0.285_714_285_714_285_7, -0.642_857_142_857_142_9),
        (Distribution::truncated_normal(0.0, 1.0, (-1.0, 2.0)), 0.322_545_912_833_091_5, -0.719_827_542_077_103_4),
        (Distribution::triangular(0.0, 0.25, 1.0), 0.422_403_983_411_6, -0.6),
        (Distribution::lognormal(2.0, 0.5), 0.765_625, 1.060_073_852_539_062_5),
        (Distribution::discrete(&[(0.0, 3.0), (1.0, 1.0)]), 2.0 / 3.0_f64.sqrt(), -2.0 / 3.0),
        (Distribution::uniform(3.0, 5.0), 0.0, -1.2),
    ];
    for (variable, skewness, kurtosis) in cases {
        let variable = variable.unwrap();
        assert!((variable.skewness() - skewness).abs() < 1e-9, "{variable:?}");
        assert!((variable.excess_kurtosis() - kurtosis).abs() < 1e-9);
    }
}

/// Mean and standard deviation match integrals over the quantiles, and slopes match differences.
#[test]
fn quantiles_agree_with_moments_and_slopes() {
    for variable in all() {
        let number = 20_000;
        let values = (0..number).map(|k| variable.quantile((f64::from(k) + 0.5) / f64::from(number)));
        let values: Vec<f64> = values.collect();
        let mean = values.iter().sum::<f64>() / f64::from(number);
        let squares: f64 = values.iter().map(|value| (value - variable.mean()).powi(2)).sum();
        let sigma = (squares / f64::from(number)).sqrt();
        assert!((mean - variable.mean()).abs() < 2e-4 * variable.sigma(), "{variable:?}");
        assert!((sigma / variable.sigma() - 1.0).abs() < 1.5e-2, "{variable:?}: {sigma}");
        for k in -50..=50 {
            let z = 0.1 * f64::from(k) + 0.013;
            let step = 1e-5;
            let [below, above] = [z - step, z + step].map(|z| variable.from_normal(z));
            let slope = (above - below) / (2.0 * step);
            let found = variable.slope_from_normal(z);
            let rounding = 1e-10 * above.abs().max(below.abs()) + 1e-6 * slope.abs();
            assert!((slope - found).abs() <= rounding, "{variable:?} at {z}: {slope} {found}");
            assert!(above >= below);
        }
    }
}

#[test]
fn supports_and_ends() {
    for variable in all() {
        let (low, high) = variable.support();
        assert_eq!((variable.quantile(0.0), variable.quantile(1.0)), (low, high));
        for z in [-60.0, -12.0, 0.0, 12.0, 60.0] {
            let value = variable.from_normal(z);
            assert!((low..=high).contains(&value), "{variable:?} at {z}: {value}");
            assert!(variable.slope_from_normal(z) >= 0.0, "{variable:?} at {z}");
        }
    }
}

#[test]
fn discrete_values_and_data() {
    let dice = Distribution::discrete(&[(3.0, 1.0), (1.0, 2.0), (2.0, 1.0), (9.0, 0.0)]).unwrap();
    near(dice.mean(), 1.75, 1e-15);
    near(dice.sigma(), (11.0_f64 / 16.0).sqrt(), 1e-15);
    let values = [0.1, 0.49, 0.51, 0.74, 0.76, 0.99].map(|p| dice.quantile(p));
    assert_eq!(values, [1.0, 1.0, 2.0, 2.0, 3.0, 3.0]);
    assert_eq!(dice.support(), (1.0, 3.0));
    assert!(!dice.is_continuous());
    let data = Distribution::empirical(&[1e8 + 3.0, 1e8 + 1.0, 1e8 + 2.0]).unwrap();
    near(data.mean(), 1e8 + 2.0, 1e-16);
    near(data.sigma(), (2.0_f64 / 3.0).sqrt(), 1e-14);
    // The first or last thousandth of the probability is the first or the last value.
    let many: Vec<f64> = (0..1000).map(f64::from).collect();
    let many = Distribution::empirical(&many).unwrap();
    let at = |p: f64| many.from_normal(normal::quantile(p));
    assert_eq!((at(9.99e-4), at(1.01e-3), at(1.0 - 9.99e-4)), (0.0, 1.0, 999.0));
}

#[test]
fn constants_do_not_vary() {
    for constant in [
        Distribution::constant(3.0),
        Distribution::uniform(3.0, 3.0),
        Distribution::triangular(3.0, 3.0, 3.0),
        Distribution::lognormal(3.0, 0.0),
        Distribution::weibull_by_moments(3.0, 0.0),
        Distribution::beta((2.0, 2.0), (3.0, 3.0)),
        Distribution::empirical(&[3.0]),
    ] {
        let constant = constant.unwrap();
        assert_eq!((constant.mean(), constant.sigma()), (3.0, 0.0));
        assert_eq!(constant.from_normal(2.0), 3.0);
        assert_eq!(constant.slope_from_normal(2.0), 0.0);
        assert_eq!((constant.skewness(), constant.excess_kurtosis()), (0.0, 0.0));
        assert!(constant.is_normal() && constant.is_continuous());
        assert_eq!(constant.support(), (3.0, 3.0));
    }
}

#[test]
fn what_makes_no_sense_is_refused() {
    let nan = f64::NAN;
    let cases = [
        (Distribution::normal(0.0, -1.0), "standard deviation"),
        (Distribution::normal(nan, 1.0), "distribution"),
        (Distribution::normal(0.0, f64::INFINITY), "standard deviation"),
        (Distribution::lognormal(-1.0, 1.0), "mean of a lognormal variable"),
        (Distribution::weibull(0.0, 1.0), "shape of a Weibull variable"),
        (Distribution::weibull(2.0, 0.0), "scale of a Weibull variable"),
        (Distribution::weibull_by_moments(1.0, 1e-12), "standard deviation of a Weibull variable"),
        (Distribution::uniform(2.0, 1.0), "limits"),
        (Distribution::uniform(0.0, nan), "distribution"),
        (Distribution::triangular(0.0, 2.0, 1.0), "peak of a triangular distribution"),
        (Distribution::beta((0.0, 1.0), (0.0, 1.0)), "shape of a beta distribution"),
        (Distribution::truncated_normal(0.0, 1.0, (50.0, 60.0)), "limits of a truncated normal variable"),
        (Distribution::truncated_normal(0.0, 0.0, (-1.0, 1.0)), "standard deviation of a truncated normal variable"),
        (Distribution::discrete(&[]), "discrete distribution"),
        (Distribution::discrete(&[(1.0, -1.0)]), "discrete distribution"),
        (Distribution::discrete(&[(1.0, 0.0)]), "discrete distribution"),
        (Distribution::empirical(&[1.0, nan]), "discrete distribution"),
    ];
    for (found, expected) in cases {
        match found {
            Err(Error::Setting { setting, .. }) => assert_eq!(setting, expected),
            other => panic!("{other:?} where {expected} is wrong"),
        }
    }
}
