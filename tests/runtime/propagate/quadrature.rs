//! Quadrature: exact for polynomials, nearly exact for smooth responses, refused where a node has no value.

use eigentol::Matrix;
use eigentol::propagation::{Method, quadrature};

use super::*;
use crate::common::close;

#[test]
fn statistics_of_the_exact_distribution() {
    for length in lengths() {
        let exact = Exact::new(&length);
        let all = ask(&bar(), vec![FREQUENCY], |responses| quadrature(responses, &varied(length), 12, 2).unwrap());
        let found = spread(&all, 0);
        assert_eq!((all.method, all.evaluations), (Method::Tensor { nodes: 13 }, 25));
        let (sigma, skewness) = (found.sigma.unwrap(), found.skewness.unwrap());
        for (one, truth) in [(found.mean, exact.mean), (sigma, exact.sigma)] {
            let error = (one.value - truth).abs();
            // The tails omitted by the midpoint rule are below 1e-5 of a standard deviation.
            assert!(error <= one.error.unwrap() + 2e-5 * exact.sigma, "{one:?} {truth}");
            assert!(one.error.unwrap() < 0.01 * exact.sigma);
        }
        assert!((skewness.value - exact.skewness).abs() < skewness.error.unwrap() + 1e-3);
    }
}

/// A linear response and a product of two variables: means, variances and covariances are exact on a sparse grid in
/// five variables.
#[test]
fn polynomials_are_exact() {
    let sigmas = [0.0, 0.0, 0.1, 0.2, 0.05];
    let shared = Matrix::from_fn(5, 5, |i, j| match (i, j) {
        (2, 3) | (3, 2) => 0.5,
        _ => f64::from(u8::from(i == j)),
    });
    for (sigmas, method) in
        [(sigmas, Method::Tensor { nodes: 3 }), ([0.01, 0.01, 0.1, 0.2, 0.05], Method::Sparse { level: 2 })]
    {
        let tolerances = Tolerances::new(sigmas, 1.0, Some(shared.clone())).unwrap();
        let all = ask_sum(outputs(), |responses| quadrature(responses, &tolerances, 2, 1).unwrap());
        assert_eq!(all.method, method);
        // a + 2 b - 3 c, a b: Cov(a, b) = 0.01.
        let sum = 0.01 + 0.16 + 0.0225 + 4.0 * 0.01;
        let product: f64 = 4.0 * 0.01 + 0.04 + 4.0 * 0.01 + 0.01 * 0.04 + 0.01 * 0.01;
        let both = 2.0 * 0.01 + 2.0 * 0.04 + 0.01 * (1.0 + 4.0);
        close(spread(&all, 0).mean.value, -4.0, 1e-13);
        close(spread(&all, 1).mean.value, 2.01, 1e-13);
        close(all.covariance[0][0].unwrap(), sum, 1e-12);
        close(spread(&all, 1).sigma.unwrap().value, product.sqrt(), 1e-12);
        close(all.covariance[0][1].unwrap(), both, 1e-12);
        close(all.with_design[0][4].unwrap(), -3.0 * 0.0025, 1e-12);
        assert!(spread(&all, 0).skewness.unwrap().value.abs() < 1e-9);
    }
}

/// The order of variables and of responses makes no difference.
#[test]
fn permutations() {
    let of = |sigmas: [f64; 5], wanted| {
        let tolerances = Tolerances::new(sigmas, 1.0, None).unwrap();
        ask_sum(wanted, |responses| quadrature(responses, &tolerances, 3, 1).unwrap())
    };
    let mut reversed = outputs();
    reversed.reverse();
    let (one, other) = (of([0.0, 0.0, 0.1, 0.1, 0.2], outputs()), of([0.0, 0.0, 0.1, 0.1, 0.2], reversed));
    assert_eq!(one.spreads[0], other.spreads[1]);
    assert_eq!(one.covariance[0][1], other.covariance[1][0]);
    // a b is unchanged when a = 1 +- 0.1 and b = 2 +- 0.2 exchange their relative tolerances.
    let (one, other) = (of([0.0, 0.0, 0.1, 0.4, 0.0], outputs()), of([0.0, 0.0, 0.2, 0.2, 0.0], outputs()));
    close(spread(&one, 1).sigma.unwrap().value, spread(&other, 1).sigma.unwrap().value, 1e-12);
}

#[test]
fn what_has_no_value_is_refused() {
    ask(&bar(), vec![FREQUENCY], |responses| {
        let reach = varied(Distribution::normal(1.0, 0.4).unwrap());
        let found = quadrature(responses, &reach, 6, 1);
        assert!(matches!(found, Err(Error::NoResponse { response: 0, missing, needed: 13, .. }) if missing > 0));
        let steps = varied(Distribution::discrete(&[(0.9, 1.0), (1.1, 1.0)]).unwrap());
        assert!(is_setting(quadrature(responses, &steps, 3, 1), "quadrature"));
        let fine = varied(lengths()[0].clone());
        assert!(is_setting(quadrature(responses, &fine, 0, 1), "level"));
    });
}
