//! Moments against exact sums of integers.

use eigentol_statistics::Error;
use eigentol_statistics::summary::{Chunk, Comoments, Covariance, Moments, Partial, Plan, Statistics, chunks};
use proptest::prelude::*;

use crate::common::{normal, uniform};

fn partial(columns: &[&[f64]], plan: &Plan) -> Result<Partial, Error> {
    let mut partial = Partial::new(plan.clone());
    for piece in chunks(0..columns[0].len() as u64) {
        let mut chunk = Chunk::new(plan, piece.clone())?;
        for (k, values) in columns.iter().enumerate() {
            chunk.set_all(k, &values[piece.start as usize..piece.end as usize])?;
        }
        partial.add(&chunk)?;
    }
    Ok(partial)
}

/// Count, mean and central sums of numbers `origin + unit * k` with integer `k`, from exact integer sums of powers of
/// `k`. All products must stay below `2^127`.
struct Exact {
    n: f64,
    mean: f64,
    central: [f64; 3],
}

impl Exact {
    fn of(integers: &[i64], origin: f64, unit: f64) -> Self {
        let n = integers.len() as i128;
        let power = |p: u32| integers.iter().map(|k| i128::from(*k).pow(p)).sum::<i128>();
        let [s1, s2, s3, s4] = [1, 2, 3, 4].map(power);
        // n, n^2 and n^3 times the central sums.
        let second = n * s2 - s1 * s1;
        let third = n * n * s3 - 3 * n * s1 * s2 + 2 * s1 * s1 * s1;
        let fourth = n * n * n * s4 - 4 * n * n * s1 * s3 + 6 * n * s1 * s1 * s2 - 3 * s1.pow(4);
        let size = n as f64;
        let central = [
            second as f64 / size * unit.powi(2),
            third as f64 / size.powi(2) * unit.powi(3),
            fourth as f64 / size.powi(3) * unit.powi(4),
        ];
        Self { n: size, mean: origin + unit * (s1 as f64 / size), central }
    }

    /// Checks that the statistics match to within this relative error, as a share of the scale of each.
    fn assert(&self, s: &Statistics, tolerance: f64) {
        let Self { n, mean, central: [m2, m3, m4] } = *self;
        let near = |name: &str, value: Option<f64>, expected: f64, scale: f64| {
            let found = value.expect(name);
            assert!((found - expected).abs() <= tolerance * scale, "{name}: {found:e}, expected {expected:e}");
        };
        let sigma = (m2 / (n - 1.0)).sqrt();
        near("mean", Some(s.mean), mean, f64::max(mean.abs(), sigma));
        near("sigma", s.sigma, sigma, sigma);
        near("standard error", s.standard_error, sigma / n.sqrt(), sigma);
        let (g1, g2) = (n.sqrt() * m3 / m2.powf(1.5), n * m4 / (m2 * m2) - 3.0);
        near("skewness", s.skewness, g1 * (n * (n - 1.0)).sqrt() / (n - 2.0), 1.0 + g1.abs());
        let g2 = (n - 1.0) / ((n - 2.0) * (n - 3.0)) * ((n + 1.0) * g2 + 6.0);
        near("kurtosis", s.excess_kurtosis, g2, 10.0 + g2.abs());
        let variance = (m4 / n - (n - 3.0) / (n - 1.0) * sigma.powi(4)) / n;
        near("error of sigma", s.sigma_error, variance.sqrt() / (2.0 * sigma), sigma);
    }
}

#[test]
fn large_means_with_small_spreads() -> Result<(), Error> {
    // Multiples of 2^-26, exact when added to 1e8, with a standard deviation of 1e-4; skewed, so that the third moment
    // matters.
    let unit = 0.5_f64.powi(26);
    let skewed = |k| normal(1, k) + 0.3 * normal(2, k).powi(2);
    let integers: Vec<i64> = (0..10_000).map(|k| (1e-4 * skewed(k) / unit).round() as i64).collect();
    for origin in [1e8, -1e8, 0.0, 1e8 + 1.0] {
        let values: Vec<f64> = integers.iter().map(|k| origin + unit * *k as f64).collect();
        let statistics = partial(&[&values], &Plan::new(1))?.statistics(0)?.expect("values");
        Exact::of(&integers, origin, unit).assert(&statistics, 1e-14);
        assert_eq!(statistics.min, origin + unit * *integers.iter().min().expect("values") as f64);
        assert_eq!(statistics.max, origin + unit * *integers.iter().max().expect("values") as f64);
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn of_any_integers(integers in prop::collection::vec(-1000_i64..1000, 4..900), origin in -9_i32..9) {
        prop_assume!(integers.iter().any(|k| *k != integers[0]));
        let origin = f64::from(origin) * 1e6;
        let values: Vec<f64> = integers.iter().map(|k| origin + *k as f64).collect();
        let statistics = partial(&[&values], &Plan::new(1))?.statistics(0)?.expect("values");
        Exact::of(&integers, origin, 1.0).assert(&statistics, 1e-12);
    }

    /// The parts differ as much as possible, unlike random samples.
    #[test]
    fn merging_unlike_parts(
        left in prop::collection::vec(-1000_i64..-500, 1..40),
        right in prop::collection::vec(300_i64..1000, 1..400),
        cut in 0_usize..400,
    ) {
        prop_assume!(left.len() + right.len() > 3);
        let floats = |integers: &[i64]| -> Vec<f64> { integers.iter().map(|k| *k as f64).collect() };
        let mut moments = Moments::of(&floats(&left));
        let cut = cut.min(right.len());
        moments.merge(&Moments::of(&floats(&right[..cut])));
        moments.merge(&Moments::of(&floats(&right[cut..])));
        let all = [left, right].concat();
        let statistics = Statistics::of(&moments, None).expect("values");
        Exact::of(&all, 0.0, 1.0).assert(&statistics, 1e-12);
    }

    #[test]
    fn covariances(pairs in prop::collection::vec((-1000_i64..1000, -90_i64..90), 2..700), cut in 0_usize..700) {
        let n = pairs.len() as i128;
        let sum = |f: fn(i128, i128) -> i128| pairs.iter().map(|(x, y)| f((*x).into(), (*y).into())).sum::<i128>();
        let (x, y) = (sum(|x, _| x), sum(|_, y| y));
        let scaled = [sum(|x, _| x * x) * n - x * x, sum(|_, y| y * y) * n - y * y, sum(|x, y| x * y) * n - x * y];
        prop_assume!(scaled[0] > 0 && scaled[1] > 0);
        let [xx, yy, xy] = scaled.map(|value| value as f64 / n as f64 / (n - 1) as f64);
        let (first, second): (Vec<f64>, Vec<f64>) = pairs.iter().map(|(x, y)| (1e7 + *x as f64, *y as f64 - 1e5)).unzip();
        let cut = cut.min(pairs.len());
        let mut comoments = Comoments::of(&first[..cut], &second[..cut]);
        comoments.merge(&Comoments::of(&first[cut..], &second[cut..]));
        let plan = Plan::new(2).covariances(&[0], &[1])?;
        let partial = partial(&[&first, &second], &plan)?;
        for found in [Covariance::of(&comoments), partial.covariance(0, 1)?] {
            let found = found.expect("values");
            let scale = (xx * yy).sqrt();
            prop_assert!((found.covariance.expect("pairs") - xy).abs() <= 1e-12 * scale);
            prop_assert!((found.correlation.expect("both vary") - xy / scale).abs() <= 1e-12);
            let [sigma_x, sigma_y] = found.sigmas.expect("pairs");
            prop_assert!((sigma_x - xx.sqrt()).abs() <= 1e-12 * sigma_x);
            prop_assert!((sigma_y - yy.sqrt()).abs() <= 1e-12 * sigma_y);
            prop_assert!((found.means[0] - (1e7 + x as f64 / n as f64)).abs() <= 1e-15 * 1e7);
            prop_assert!((found.means[1] - (y as f64 / n as f64 - 1e5)).abs() <= 1e-15 * 1e5);
        }
        let swapped = partial.covariance(1, 0)?.expect("values");
        prop_assert_eq!(swapped.means[0], partial.covariance(0, 1)?.expect("values").means[1]);
    }
}

#[test]
fn covariance_of_samples_that_have_both() -> Result<(), Error> {
    let plan = Plan::new(2).covariances(&[0], &[1])?;
    let mut partial = Partial::new(plan.clone());
    let (mut first, mut second) = (Vec::new(), Vec::new());
    for piece in chunks(0..1000) {
        let mut chunk = Chunk::new(&plan, piece.clone())?;
        for sample in piece {
            let (x, y) = (uniform(3, sample), uniform(4, sample));
            let (with_x, with_y) = (sample % 3 != 0, sample % 7 != 2);
            chunk.set(sample, 0, with_x.then_some(x))?;
            chunk.set(sample, 1, with_y.then_some(x + y))?;
            if with_x && with_y {
                first.push(x);
                second.push(x + y);
            }
        }
        partial.add(&chunk)?;
    }
    let found = partial.covariance(0, 1)?.expect("values");
    let expected = Covariance::of(&Comoments::of(&first, &second)).expect("values");
    assert_eq!(found.count, first.len() as u64);
    let both = [(found.covariance, expected.covariance), (found.correlation, expected.correlation)];
    for (found, expected) in both {
        let (found, expected) = (found.expect("pairs"), expected.expect("pairs"));
        assert!((found - expected).abs() < 1e-14 && expected > 0.05);
    }
    Ok(())
}

#[test]
fn few_values() {
    let of = |values: &[f64]| Statistics::of(&Moments::of(values), None);
    assert!(of(&[]).is_none() && Covariance::of(&Comoments::of(&[], &[])).is_none());
    let one = of(&[3.0]).expect("a value");
    assert_eq!((one.count, one.mean, one.min, one.max), (1, 3.0, 3.0, 3.0));
    assert_eq!((one.sigma, one.standard_error, one.sigma_error), (None, None, None));
    assert_eq!((one.skewness, one.excess_kurtosis), (None, None));
    let two = of(&[1.0, 2.0]).expect("values");
    assert_eq!((two.sigma, two.standard_error), (Some(0.5_f64.sqrt()), Some(0.5)));
    assert_eq!((two.skewness, two.excess_kurtosis), (None, None));
    let three = of(&[1.0, 2.0, 4.0]).expect("values");
    // From R's package e1071: skewness(c(1, 2, 4), type = 2).
    assert!((three.skewness.expect("three") - 0.935_219_529_582_825).abs() < 1e-14);
    assert_eq!(three.excess_kurtosis, None);
    let single = Covariance::of(&Comoments::of(&[1.0], &[2.0, 5.0])).expect("a pair");
    assert_eq!((single.count, single.means), (1, [1.0, 2.0]));
    assert_eq!((single.covariance, single.correlation, single.sigmas), (None, None, None));
}

#[test]
fn values_that_are_all_the_same_have_no_spread() -> Result<(), Error> {
    for value in [0.1, -1e8 / 3.0, 1e300, 1e-300] {
        let values = vec![value; 1000];
        let plan = Plan::new(2).covariances(&[0], &[1])?;
        let line: Vec<f64> = (0..1000).map(f64::from).collect();
        let partial = partial(&[&values, &line], &plan)?;
        let s = partial.statistics(0)?.expect("values");
        assert_eq!((s.mean, s.sigma, s.standard_error), (value, Some(0.0), Some(0.0)));
        assert_eq!((s.sigma_error, s.skewness, s.excess_kurtosis), (None, None, None));
        let c = partial.covariance(0, 1)?.expect("values");
        assert_eq!((c.covariance, c.correlation), (Some(0.0), None));
    }
    Ok(())
}

#[test]
fn what_is_too_large_to_compute_is_not_there() -> Result<(), Error> {
    let values: Vec<f64> = (0..600).map(|k| if k % 3 == 0 { -1e300 } else { 1e300 }).collect();
    let s = partial(&[&values], &Plan::new(1))?.statistics(0)?.expect("values");
    assert!((s.mean / 1e300 - 1.0 / 3.0).abs() < 1e-15 && s.min == -1e300);
    assert_eq!((s.sigma, s.standard_error, s.sigma_error), (None, None, None));
    assert_eq!((s.skewness, s.excess_kurtosis), (None, None));
    Ok(())
}
