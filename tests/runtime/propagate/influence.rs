//! Sources of the scatter: exact for linear responses and products.

use eigentol::propagation::{Method, influence};
use eigentol::tolerance::{Points, Sampling};

use super::*;
use crate::common::close;

const SIGMAS: [f64; 5] = [0.0, 0.0, 0.1, 0.2, 0.05];

/// For `a + 2 b - 3 c` every share is the variable's share of the variance; for `a b` the product adds only to the
/// total indices.
#[test]
fn indices_of_simple_responses() {
    let tolerances = Tolerances::new(SIGMAS, 3.0, None).unwrap();
    let sigma = tolerances.sigmas().to_vec();
    let all = ask_sum(outputs(), |responses| {
        influence(responses, &tolerances, &Sampling::default().samples(20_480)).unwrap()
    });
    assert_eq!(all.counts.stable, 5 * 4096);
    let parts = [sigma[2], 2.0 * sigma[3], -3.0 * sigma[4]];
    let variance: f64 = parts.iter().map(|part| part * part).sum();
    let response = &all.responses[0];
    for (variable, part) in response.variables.iter().zip(parts) {
        let share = part * part / variance;
        for index in [variable.first.unwrap(), variable.total.unwrap()] {
            assert!((index.value - share).abs() < 0.01, "{index:?} {share}");
            assert!(index.lower <= share && share <= index.upper, "{index:?} {share}");
        }
        close(variable.correlation.unwrap(), part / variance.sqrt(), 5e-3);
        close(variable.regression.unwrap(), part / variance.sqrt(), 5e-3);
        assert!((variable.rank_correlation.unwrap() - variable.correlation.unwrap()).abs() < 0.05);
    }
    close(response.determination.unwrap(), 1.0, 1e-12);
    // a b about (1, 2), at the half-widths: the corners of each variable separately.
    let product = &all.responses[1].variables;
    assert_eq!(product.iter().map(|response| response.variable).collect::<Vec<_>>(), [2, 3, 4]);
    close(product[0].at_low.unwrap(), 0.9 * 2.0, 1e-12);
    close(product[0].at_high.unwrap(), 1.1 * 2.0, 1e-12);
    close(product[1].at_high.unwrap(), 2.2, 1e-12);
    assert_eq!(product[2].at_low, all.responses[1].nominal);
    assert!(product[2].total.unwrap().value.abs() < 1e-12);
}

/// A product about zero has zero first-order indices, and only total ones.
#[test]
fn interaction() {
    let about_zero = |half: f64| Distribution::uniform(-half, half).unwrap();
    let fixed = |value| Distribution::constant(value).unwrap();
    let values = vec![fixed(2.0), fixed(8.0), about_zero(1.0), about_zero(0.5), fixed(3.0)];
    let tolerances = Tolerances::distributed(&[2.0, 8.0, 1.0, 2.0, 3.0], values, 3.0, None).unwrap();
    let all = ask_sum(outputs(), |responses| {
        influence(responses, &tolerances, &Sampling::default().samples(16_384)).unwrap()
    });
    for variable in &all.responses[1].variables {
        assert!(variable.first.unwrap().value.abs() < 0.02);
        close(variable.total.unwrap().value, 1.0, 0.02);
        assert!(variable.correlation.unwrap().abs() < 0.02);
    }
}

/// Dependent variables have no shares; nor does a response that does not vary.
#[test]
fn what_has_no_indices() {
    let correlation = eigentol::Matrix::from_fn(5, 5, |i, j| match (i, j) {
        (2, 3) | (3, 2) => 0.5,
        _ => f64::from(u8::from(i == j)),
    });
    let tolerances = Tolerances::new(SIGMAS, 3.0, Some(correlation)).unwrap();
    let sampling = Sampling::default().samples(4096);
    ask_sum(outputs(), |responses| {
        let all = influence(responses, &tolerances, &sampling).unwrap();
        let sum = &all.responses[0];
        assert!(all.to_string().contains("No Sobol' indices: the variables depend"), "{all}");
        assert!(sum.variables.iter().all(|own| own.first.is_none() && own.total.is_none()));
        // In units of the standard deviation: a + 2 b - 3 c with sigma^2 = 1 + 16 + 2.25 + 4 in tenths squared.
        let sigma = 23.25_f64.sqrt();
        close(sum.variables[1].regression.unwrap(), 4.0 / sigma, 1e-2);
        close(sum.variables[0].correlation.unwrap(), (1.0 + 2.0) / sigma, 2e-2);
        let few = influence(responses, &tolerances, &sampling.clone().samples(15));
        assert!(is_setting(few, "samples"));
        let still = Tolerances::new([0.0; 5], 3.0, None).unwrap();
        let none = influence(responses, &still, &sampling).unwrap();
        assert!(none.responses[0].variables.is_empty() && none.counts.total() == 0);
    });
}

/// Reports name responses and variables below the operating point.
#[test]
fn reports() {
    let study = bar().tolerance(Bar::l, 0.03).samples(512);
    let wanted = [FREQUENCY, Response::Output(Bar::length.any())];
    let texts = [
        study.propagate(&wanted).unwrap().to_string(),
        study.worst_case(&wanted).unwrap().to_string(),
        study.influence(&wanted).unwrap().to_string(),
    ];
    for text in texts {
        assert!(text.starts_with("Bar at omega = 5 rad/s"), "{text}");
        assert!(text.contains("frequency 1 [rad/s]") && text.contains("length [m]"), "{text}");
        assert!(!text.contains("NaN"));
    }
}

/// A fluctuating speed is a variable like any other.
#[test]
fn inputs_with_tolerances() {
    let study = bar().tolerance(Bar::omega, 0.3).samples(4096);
    let all = study.propagate(&[FREQUENCY]).unwrap();
    let at = |speed: f64| (speed.powi(2) - (1.5 * GRAVITY / speed).powi(2)).sqrt();
    let slope = (at(5.0 + 1e-4) - at(5.0 - 1e-4)) / 2e-4;
    close(spread(&all, 0).sigma.unwrap().value, 0.1 * slope, 5e-3);
    let worst = study.worst_case(&[FREQUENCY]).unwrap();
    close(worst.responses[0].greatest.as_ref().unwrap().value, at(5.3), 1e-11);
    let shares = study.influence(&[FREQUENCY]).unwrap();
    assert_eq!(shares.responses[0].variables.len(), 1);
}

/// Asking for many samples allows as many solutions.
#[test]
fn many_samples() {
    let study = bar().tolerance(Bar::l, 0.03).samples(131_072);
    let all = study.propagate(&[Response::Output(Bar::length.any())]).unwrap();
    assert_eq!((all.method, all.evaluations), (Method::Sampled(Points::Sobol), 131_072));
    assert_eq!(spread(&all, 0).quantiles.len(), 7);
}
