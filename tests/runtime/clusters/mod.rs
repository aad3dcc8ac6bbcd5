//! Modes mixed by tolerances: closed forms, and Monte Carlo on the whole problem.

mod directional;
mod general;
mod small;
mod summary;
mod undamped;

use eigentol::clusters::SortedSpread;
use eigentol::kernels::BatchKernels;
use eigentol::tolerance::Statistics;
use eigentol::{Complex, Error, MonteCarlo, Study, Tolerances};

use crate::common::close;

fn within(value: f64, expected: f64, distance: f64) {
    assert!((value - expected).abs() <= distance, "{value:e}, not {expected:e}: {:e} apart", value - expected);
}

/// Independent variables with these standard deviations.
fn independent<const P: usize>(sigma: [f64; P]) -> Tolerances {
    Tolerances::new(sigma, 1.0, None).unwrap()
}

/// Mean, standard deviation and their standard errors (the second for tails no heavier than normal).
#[derive(Clone, Copy, Debug)]
struct Moments {
    mean: f64,
    sigma: f64,
    count: f64,
}

impl Moments {
    fn of(values: &[f64]) -> Self {
        let count = values.len() as f64;
        let mean = values.iter().sum::<f64>() / count;
        let squares: f64 = values.iter().map(|value| (value - mean).powi(2)).sum();
        Self { mean, sigma: (squares / (count - 1.0)).sqrt(), count }
    }

    /// Both agree within five standard errors, plus `model` times the standard deviation for model error.
    #[track_caller]
    fn agrees(&self, statistics: Option<Statistics>, model: f64) {
        let found = statistics.unwrap();
        let shares = 1.0 / self.count + 1.0 / found.count as f64;
        let error = self.sigma * (5.0 * shares.sqrt() + model);
        within(found.mean, self.mean, error);
        within(found.sigma.unwrap(), self.sigma, error);
    }
}

/// Every sample of a Monte Carlo run on the whole problem, sorted by a quantity of its eigenvalues.
fn sorted(run: &MonteCarlo, quantity: impl Fn(Complex) -> f64) -> Vec<Vec<f64>> {
    let one = |sample: &eigentol::tolerance::Sample| {
        let values = sample.eigenvalues.iter().map(|s| quantity(s.unwrap()));
        let mut values: Vec<f64> = values.collect();
        values.sort_by(f64::total_cmp);
        values
    };
    run.all.as_ref().unwrap().iter().map(one).collect()
}

/// Samples that share no random numbers with the cluster's own.
fn run<M: BatchKernels + Clone>(study: &Study<M>) -> MonteCarlo {
    let study = study.clone().seed(91).samples(4096).keep_samples(true);
    study.monte_carlo().unwrap()
}

/// Every sorted member and the splitting agree with the sampled values.
#[track_caller]
fn agree(sorted_spread: &SortedSpread, samples: &[Vec<f64>], model: f64) {
    let count = sorted_spread.members.len();
    for (k, member) in sorted_spread.members.iter().enumerate() {
        let values: Vec<f64> = samples.iter().map(|sample| sample[k]).collect();
        Moments::of(&values).agrees(member.value.clone(), model);
    }
    let splitting: Vec<f64> = samples.iter().map(|one| one[count - 1] - one[0]).collect();
    Moments::of(&splitting).agrees(sorted_spread.splitting.clone(), model);
}

#[track_caller]
fn refused<T: core::fmt::Debug>(found: Result<T, Error>) {
    assert!(matches!(found, Err(Error::Setting { .. })), "{found:?}");
}
