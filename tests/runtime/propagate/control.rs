//! The Taylor model as a control variate: accurate within its stated error, which is much smaller than that of plain
//! samples.

use eigentol::propagation::{Controlled, ControlledSpread, Method, Propagation, controlled, sampled};
use eigentol::tolerance::{Points, Sampling};

use super::*;
use crate::common::close;

fn of(tolerances: &Tolerances, samples: usize, seed: u64) -> (Controlled, Propagation) {
    let sampling = Sampling::default().samples(samples).seed(seed);
    ask(&bar(), vec![FREQUENCY], |responses| {
        (
            controlled(&Bar, responses, tolerances, &sampling).unwrap(),
            sampled(responses, tolerances, &sampling).unwrap().propagation().unwrap(),
        )
    })
}

/// Over many seeds, the errors in units of the stated error have unit scatter, and the stated gain matches the actual
/// errors.
#[test]
fn the_stated_error_is_that_of_many_runs() {
    for (k, length) in lengths().into_iter().enumerate() {
        let exact = Exact::new(&length);
        let tolerances = varied(length);
        let runs: Vec<ControlledSpread> =
            (0..60).map(|seed| of(&tolerances, 300, 100 * k as u64 + seed).0.spreads[0].unwrap()).collect();
        let check = |item: &dyn Fn(&ControlledSpread) -> (f64, f64), truth: f64| {
            let squares = runs.iter().map(|run| {
                let (value, error) = item(run);
                ((value - truth) / error).powi(2)
            });
            let mean = squares.sum::<f64>() / runs.len() as f64;
            // From 60 runs; heavy tails of the remainder make the error of the error large.
            assert!((0.4..2.5).contains(&mean), "{mean}");
        };
        check(&|run| (run.mean.value, run.mean.error.unwrap()), exact.mean);
        check(&|run| (run.sigma.value, run.sigma.error.unwrap()), exact.sigma);
    }
}

#[test]
fn it_is_worth_many_plain_samples() {
    let tolerances = varied(lengths()[0].clone());
    let (found, plain) = of(&tolerances, 1000, 1);
    let (spread, plain) = (found.spreads[0].unwrap(), spread(&plain, 0));
    assert_eq!(spread.model, Method::SecondOrder);
    let ratio = (plain.mean.error.unwrap() / spread.mean.error.unwrap()).powi(2);
    // The variance of plain samples has one degree of freedom fewer.
    close(spread.worth, ratio, 2e-3);
    assert!(spread.worth > 500.0 && spread.worth_of_sigma > 50.0, "{spread:?}");
}

/// A linear response is known exactly, without samples.
#[test]
fn a_linear_response_is_exact() {
    let tolerances = Tolerances::new([0.0, 0.0, 0.1, 0.2, 0.3], 1.0, None).unwrap();
    let sampling = Sampling::default().samples(50);
    let all = ask_sum(outputs(), |responses| controlled(&Sum, responses, &tolerances, &sampling).unwrap());
    let spread = all.spreads[0].unwrap();
    assert_eq!(spread.model, Method::SecondOrder);
    close(spread.mean.value, -4.0, 1e-12);
    close(spread.sigma.value, (0.01_f64 + 0.16 + 0.81).sqrt(), 1e-12);
    assert!(spread.worth > 1e10 && spread.mean.error.unwrap() < 1e-7);
}

/// `a^4` with `a = 1 + x`: its mean is `1 + 6 s^2 + 3 s^4`, of which the model contains all but the last term.
#[test]
fn a_mean_that_the_model_misses() {
    let s: f64 = 0.3;
    let tolerances = Tolerances::new([0.0, 0.0, s, 0.0, 0.0], 1.0, None).unwrap();
    let sampling = Sampling::default().samples(100_000);
    let fourth = vec![Response::Output(Sum::fourth.any())];
    let all = ask_sum(fourth, |responses| controlled(&Sum, responses, &tolerances, &sampling).unwrap());
    let spread = all.spreads[0].unwrap();
    assert_eq!(spread.model, Method::SecondOrder);
    let within = |estimated: eigentol::propagation::Estimated, exact: f64| {
        let error = estimated.error.expect("an error");
        assert!((estimated.value - exact).abs() < 4.0 * error, "{estimated:?} {exact}");
        assert!(error < 0.01 * exact, "{estimated:?}");
    };
    let mean = 1.0 + 6.0 * s.powi(2) + 3.0 * s.powi(4);
    let square = 1.0 + 28.0 * s.powi(2) + 210.0 * s.powi(4) + 420.0 * s.powi(6) + 105.0 * s.powi(8);
    within(spread.mean, mean);
    within(spread.sigma, (square - mean * mean).sqrt());
    assert!(spread.mean.error.unwrap() < 0.5 * 3.0 * s.powi(4), "the model's mean would do");
}

#[test]
fn what_samples_do_not_have_is_not_controlled() {
    let (found, _) = of(&varied(Distribution::normal(1.0, 0.4).unwrap()), 500, 3);
    assert_eq!(found.spreads, [None]);
    assert!(found.counts.unphysical > 0 && found.counts.total() == 500);
    ask(&bar(), vec![FREQUENCY], |responses| {
        let tolerances = varied(lengths()[0].clone());
        let with = |points| Sampling::default().points(points).samples(100);
        let found = controlled(&Bar, responses, &tolerances, &with(Points::Sobol));
        assert!(is_setting(found, "points"));
        let few = with(Points::Random).samples(2);
        assert!(is_setting(controlled(&Bar, responses, &tolerances, &few), "samples"));
    });
}
