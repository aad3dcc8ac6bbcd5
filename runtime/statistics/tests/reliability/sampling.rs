//! Sampling against exact probabilities and derivatives.

use eigentol_statistics::reliability::sampling::{
    Failure, Proposal, SampleSums, Sampler, SamplingSettings, clopper_pearson, wilson,
};
use eigentol_statistics::reliability::{LimitFunction, LimitState, LimitValue};

use crate::common::{below, close, density, design_point, limit, linear};

fn settings(coefficient_of_variation: f64) -> SamplingSettings {
    SamplingSettings { coefficient_of_variation, ..SamplingSettings::default() }
}

/// `g = beta - 0.6 z0 - 0.8 z1`: `dP/dmu_i = phi(beta) n_i`, `dP/dsigma_i = phi(beta) beta n_i^2`.
#[test]
fn probabilities_and_derivatives_of_a_linear_limit() {
    for beta in [-1.0, 1.0, 4.0, 8.0] {
        let limits = [linear(beta, vec![-0.6, -0.8])];
        let proposal = Proposal::around(&[design_point(&limits[0])]).unwrap();
        let settings = settings(0.004);
        let found = Sampler::new(&limits, Failure::Any, &proposal, &settings).unwrap().run();
        let exact = below(-beta);
        assert!(found.reached);
        assert!(found.coefficient_of_variation.unwrap() <= 0.004);
        let off = |estimate: f64, error: f64, expected: f64| {
            assert!((estimate - expected).abs() < 4.0 * error, "{estimate} {expected} {error}");
        };
        off(found.probability.value, found.probability.standard_error, exact);
        for (i, n) in [0.6, 0.8].into_iter().enumerate() {
            let (mean, sigma) = (found.by_mean[i], found.by_sigma[i]);
            let by_mean = density(beta) * n;
            off(mean.value, mean.standard_error, by_mean);
            assert!(mean.standard_error < 0.1 * by_mean);
            let by_sigma = density(beta) * beta * n * n;
            off(sigma.value, sigma.standard_error, by_sigma);
            assert!(sigma.standard_error < 0.2 * by_sigma.abs());
        }
    }
}

/// The standard error matches the scatter over seeds, from 40 repetitions.
#[test]
fn standard_errors_are_right() {
    let limits = [linear(3.0, vec![-1.0])];
    let proposal = Proposal::around(&[design_point(&limits[0])]).unwrap();
    let runs: Vec<_> = (0..40)
        .map(|stream| {
            let settings = SamplingSettings { stream, samples: 500, ..settings(0.0) };
            Sampler::new(&limits, Failure::Any, &proposal, &settings).unwrap().run()
        })
        .collect();
    let squares =
        runs.iter().map(|run| ((run.probability.value - below(-3.0)) / run.probability.standard_error).powi(2));
    let chi_square: f64 = squares.sum();
    // 40 degrees of freedom: both tails beyond these limits have probability 1e-3.
    assert!((17.9..73.5).contains(&chi_square), "{chi_square}");
}

#[test]
fn plain_monte_carlo_counts() {
    let limits = [linear(1.0, vec![-1.0, 0.0])];
    let proposal = Proposal::standard(2);
    let settings = SamplingSettings { samples: 20_000, ..settings(0.0) };
    let found = Sampler::new(&limits, Failure::Any, &proposal, &settings).unwrap().run();
    assert_eq!(found.samples, 20_000);
    assert!(!found.reached);
    close(found.probability.value, found.failures as f64 / 20_000.0, 1e-12);
    // For a binary share: `p (1 - p) / (n - 1)`.
    let share = found.failures as f64 / 20_000.0;
    let exact = (share * (1.0 - share) / 19_999.0).sqrt();
    close(found.probability.standard_error / exact, 1.0, 1e-9);
    close(found.coefficient_of_variation.unwrap(), exact / share, 1e-9);
    for interval in [wilson, clopper_pearson] {
        let interval = interval(found.failures, found.samples, 0.999).unwrap();
        assert!(interval.lower < below(-1.0) && below(-1.0) < interval.upper);
    }
}

#[test]
fn nothing_failed() {
    let limits = [linear(30.0, vec![-1.0])];
    let proposal = Proposal::standard(1);
    let settings = SamplingSettings { samples: 2000, ..settings(0.1) };
    let found = Sampler::new(&limits, Failure::Any, &proposal, &settings).unwrap().run();
    assert_eq!((found.failures, found.probability.value), (0, 0.0));
    assert_eq!(found.coefficient_of_variation, None);
    assert_eq!(found.ln_probability, None);
    assert!(!found.reached);
    assert!(clopper_pearson(0, found.samples, 0.95).unwrap().upper < 2e-3);
}

/// The coefficient of variation from a single failure is meaningless.
#[test]
fn a_few_failures_are_not_enough() {
    let limits = [linear(1.0, vec![-1.0])];
    let proposal = Proposal::standard(1);
    let settings = SamplingSettings { batch: 1, ..settings(100.0) };
    let found = Sampler::new(&limits, Failure::Any, &proposal, &settings).unwrap().run();
    assert!(found.reached);
    assert_eq!(found.failures, 10);
}

/// Probabilities whose squares, or which themselves, are below the smallest representable number.
#[test]
fn extreme_tails() {
    for beta in [30.0, 45.0] {
        let limits = [linear(beta, vec![-1.0, 0.0])];
        let at = design_point(&limits[0]);
        let proposal = Proposal::around(core::slice::from_ref(&at)).unwrap();
        let settings = settings(0.02);
        let found = Sampler::new(&limits, Failure::Any, &proposal, &settings).unwrap().run();
        assert!(found.reached);
        assert!((found.ln_probability.unwrap() - at.ln_probability()).abs() < 0.08);
    }
}

/// Any range of samples can be computed separately; batches joined in order give the same bits as the whole.
#[test]
fn ranges_join() {
    let limits = [linear(2.0, vec![-0.6, 0.8])];
    let proposal = Proposal::around(&[design_point(&limits[0])]).unwrap();
    let settings = SamplingSettings { samples: 4500, ..settings(0.0) };
    let sampler = Sampler::new(&limits, Failure::Any, &proposal, &settings).unwrap();
    let mut parts: Vec<SampleSums> =
        (0..5).rev().map(|k| sampler.sums(1000 * k..(1000 * k + 1000).min(4500))).collect();
    parts.reverse();
    let mut joined = parts.remove(0);
    parts.iter().for_each(|part| joined.join(part));
    assert_eq!(sampler.estimate(&joined), sampler.run());
    let single: u64 = (0..100).map(|k| sampler.sums(k..k + 1).failures()).sum();
    assert_eq!(single, sampler.sums(0..100).failures());
    let other = SamplingSettings { stream: 1, ..settings.clone() };
    let other = Sampler::new(&limits, Failure::Any, &proposal, &other).unwrap();
    assert_ne!(other.sums(0..100), sampler.sums(0..100));
}

/// Independent requirements: `1 - (1 - p) (1 - q)` for any, `p q` for all.
#[test]
fn several_requirements() {
    let limits = [linear(1.0, vec![-1.0, 0.0]), linear(1.5, vec![0.0, -1.0])];
    let (p, q) = (below(-1.0), below(-1.5));
    let proposal = Proposal::mixture(vec![vec![1.0, 0.0], vec![0.0, 1.5], vec![1.0, 1.5]], vec![1.0; 3]).unwrap();
    let settings = settings(0.01);
    for (failure, exact) in [(Failure::Any, p + q - p * q), (Failure::All, p * q)] {
        let found = Sampler::new(&limits, failure, &proposal, &settings).unwrap().run();
        assert!((found.probability.value - exact).abs() < 4.0 * found.probability.standard_error);
    }
}

/// No value beyond 1; a sample without a value still counts as a failure if another requirement fails.
#[test]
fn samples_without_a_value_are_counted_apart() {
    let partial = |threshold: f64| {
        LimitFunction::new(1, move |z: &[f64]| {
            if z[0] > 1.0 {
                return Err("does not exist");
            }
            let value = threshold - z[0];
            Ok(LimitValue { value, gradient: vec![-1.0] })
        })
    };
    let proposal = Proposal::standard(1);
    let settings = SamplingSettings { samples: 20_000, ..settings(0.0) };
    let limits = [partial(0.5)];
    let found = Sampler::new(&limits, Failure::Any, &proposal, &settings).unwrap().run();
    let off = |value: f64, exact: f64| assert!((value - exact).abs() < 0.012, "{value} {exact}");
    off(found.probability.value, below(1.0) - below(0.5));
    off(found.probability_without_value.value, below(-1.0));
    // When sampling from elsewhere, each sample has its weight, with a value or without.
    let shifted = Proposal::mixture(vec![vec![1.0], vec![-0.5]], vec![2.0, 1.0]).unwrap();
    let found = Sampler::new(&limits, Failure::Any, &shifted, &settings).unwrap().run();
    for (estimate, exact) in
        [(found.probability, below(1.0) - below(0.5)), (found.probability_without_value, below(-1.0))]
    {
        let off = (estimate.value - exact).abs();
        assert!(off < 4.0 * estimate.standard_error, "{estimate:?} {exact}");
        assert!(estimate.standard_error < 0.02 * exact);
    }
    let whole =
        LimitFunction::new(1, |z: &[f64]| Ok::<_, &str>(LimitValue { value: 2.0 - z[0], gradient: vec![-1.0] }));
    let first = partial(0.5);
    let mixed: [&dyn LimitState<Error = &str>; 2] = [&first, &whole];
    let found = Sampler::new(&mixed, Failure::Any, &proposal, &settings).unwrap().run();
    off(found.probability.value, below(1.0) - below(0.5) + below(-2.0));
    off(found.probability_without_value.value, below(2.0) - below(1.0));
    let found = Sampler::new(&mixed, Failure::All, &proposal, &settings).unwrap().run();
    assert_eq!(found.failures, 0);
    off(found.probability_without_value.value, below(-2.0));
}

#[test]
fn nonsense_is_refused() {
    assert!(Proposal::around(&[]).is_err());
    assert!(Proposal::mixture(vec![vec![0.0], vec![0.0, 1.0]], vec![1.0, 1.0]).is_err());
    assert!(Proposal::mixture(vec![vec![0.0]], vec![0.0]).is_err());
    assert!(Proposal::mixture(vec![vec![f64::NAN]], vec![1.0]).is_err());
    let limits = [limit(1, |z| (z[0], vec![1.0]))];
    let two = Proposal::standard(2);
    let plain = settings(0.1);
    assert!(Sampler::new(&limits, Failure::Any, &two, &plain).is_err());
    assert!(Sampler::new(&limits[..0], Failure::Any, &two, &plain).is_err());
    let one = Proposal::standard(1);
    let wrong = settings(f64::NAN);
    assert!(Sampler::new(&limits, Failure::Any, &one, &wrong).is_err());
}
