//! First and second order for any distribution, and the automatic choice of method.

use eigentol::Law;
use eigentol::propagation::{Estimated, Method, Propagation, first_order, propagate, second_order};
use eigentol::sweep::Range;
use eigentol::tolerance::{Points, Sampling};

use super::*;
use crate::common::close;

/// First and second derivatives of the frequency by the length: `f^2 = u^2 - n^2`, `n = 1.5 g / (u l)`.
fn slopes(length: f64) -> (f64, f64) {
    let (n, f) = (1.5 * GRAVITY / (SPEED * length), frequency(length));
    let slope = n * n / (length * f);
    (slope, -3.0 * n * n / (length * length * f) - slope * slope / f)
}

fn both(tolerances: &Tolerances) -> [Propagation; 2] {
    ask(&bar(), vec![FREQUENCY], |responses| {
        [first_order(&Bar, responses, tolerances).unwrap(), second_order(&Bar, responses, tolerances).unwrap()]
    })
}

/// Moments of `f + s x + h x^2 / 2` over a distribution of `x`, by the midpoint rule.
fn model(length: &Distribution, second: bool) -> [f64; 3] {
    let (slope, curvature) = slopes(1.0);
    let number = 200_000;
    let at = |k: u32| {
        let x = length.quantile((f64::from(k) + 0.5) / f64::from(number)) - 1.0;
        let bend = if second { 0.5 * curvature * x * x } else { 0.0 };
        frequency(1.0) + slope * x + bend
    };
    let mean = (0..number).map(at).sum::<f64>() / f64::from(number);
    let power = |n: i32| {
        let all = (0..number).map(|k| (at(k) - mean).powi(n));
        all.sum::<f64>() / f64::from(number)
    };
    let sigma = power(2).sqrt();
    [mean, sigma, power(3) / sigma.powi(3)]
}

/// The moments of the model are exact for any distribution: those of the Taylor polynomial of the closed form.
#[test]
fn moments_of_the_polynomial() {
    for length in [
        Distribution::normal(1.01, 0.02).unwrap(),
        Distribution::uniform(0.94, 1.08).unwrap(),
        Distribution::triangular(0.98, 1.0, 1.06).unwrap(),
        Distribution::lognormal(1.0, 0.03).unwrap(),
        Distribution::discrete(&[(0.95, 1.0), (1.0, 2.0), (1.02, 1.0)]).unwrap(),
    ] {
        let found = both(&varied(length.clone()));
        for (second, all) in [false, true].into_iter().zip(&found) {
            let own = spread(all, 0);
            let [mean, sigma, skewness] = model(&length, second);
            close(own.mean.value, mean, 1e-6);
            close(own.sigma.unwrap().value, sigma, 2e-4);
            let found = own.skewness.unwrap();
            assert!((found.value - skewness).abs() < 5e-3 + 0.01 * skewness.abs(), "{found:?} {skewness}");
        }
    }
}

/// A skewed distribution: the variance contains the third moment of the variable, not only the fourth.
#[test]
fn variance_knows_the_third_moment() {
    let length = Distribution::triangular(0.9, 0.9, 1.2).unwrap();
    let [_, second] = both(&varied(length.clone()));
    let [mean, sigma, _] = model(&length, true);
    let own = spread(&second, 0);
    assert!((own.sigma.unwrap().value / sigma - 1.0).abs() < 1e-6);
    assert!((own.mean.value / mean - 1.0).abs() < 1e-7);
}

/// The stated error covers the exact distribution, and is smaller for second order.
#[test]
fn errors_hold() {
    for length in lengths() {
        let exact = Exact::new(&length);
        let [first, second] = both(&varied(length));
        let inside = |estimated: Estimated, truth: f64| {
            assert!((estimated.value - truth).abs() < 1.5 * estimated.error.unwrap() + 1e-5, "{estimated:?} {truth}");
        };
        for own in [&first, &second].map(|all| spread(all, 0)) {
            inside(own.mean, exact.mean);
            inside(own.sigma.unwrap(), exact.sigma);
        }
        let error = |all: &Propagation| spread(all, 0).mean.error.unwrap();
        assert!(error(&second) < 0.5 * error(&first));
    }
}

#[test]
fn quantiles_of_the_models() {
    let length = Distribution::uniform(0.97, 1.03).unwrap();
    let [first, second] = both(&varied(length.clone()));
    let (slope, curvature) = slopes(1.0);
    for (all, bend) in [(&first, 0.0), (&second, 0.5 * curvature)] {
        for quantile in &spread(all, 0).quantiles {
            let x = length.quantile(quantile.probability) - 1.0;
            let truth = frequency(1.0) + slope * x + bend * x * x;
            assert!((quantile.value - truth).abs() < 2e-3 * slope * 0.03 + 1e-9, "{quantile:?} {truth}");
        }
    }
    // Normal to first order, hence exact.
    let [first, _] = both(&varied(Distribution::normal(1.0, 0.01).unwrap()));
    close(spread(&first, 0).quantiles[6].value, frequency(1.0) + 3.0 * 0.01 * slope, 1e-12);
}

/// Linear outputs are exact to first order, including their covariance; a product is exact to second order.
#[test]
fn a_linear_response() {
    let laws = [Law::Uniform, Law::Triangular, Law::Normal];
    let mut study = Study::new(Sum);
    for (law, variable) in laws.into_iter().zip([Sum::a, Sum::b, Sum::c]) {
        study = study.tolerance(variable, 0.3).law(variable, law);
    }
    let tolerances = study.tolerances().unwrap();
    let [a, b, c]: [f64; 3] = [0.09 / 3.0, 0.09 / 6.0, 0.01];
    ask_sum(outputs(), |responses| {
        let all = first_order(&Sum, responses, &tolerances).unwrap();
        close(spread(&all, 0).sigma.unwrap().value, (a + 4.0 * b + 9.0 * c).sqrt(), 1e-12);
        assert!(spread(&all, 0).skewness.unwrap().value.abs() < 1e-12);
        close(all.covariance[0][1].unwrap(), 2.0 * a + 2.0 * b, 1e-12);
        close(all.with_design[0][4].unwrap(), -3.0 * c, 1e-12);
        let second = second_order(&Sum, responses, &tolerances).unwrap();
        for all in [&all, &second] {
            assert!(spread(all, 0).mean.error < Some(1e-12));
            close(spread(all, 0).sigma.unwrap().value, (a + 4.0 * b + 9.0 * c).sqrt(), 1e-12);
        }
        // a0 = 1, b0 = 2: first order omits `sigma_a sigma_b`, and reports this.
        let [linear, exact] = [&all, &second].map(|all| spread(all, 1).sigma.unwrap());
        let truth = (4.0 * a + b + a * b).sqrt();
        close(exact.value, truth, 1e-12);
        assert!(linear.error.unwrap() >= truth - linear.value && linear.value < truth);
    });
}

/// An angle and a critical speed of the bar: the moments are those of the Taylor polynomials of their closed forms.
#[test]
fn outputs_and_critical_values() {
    let c = 1.5 * GRAVITY / SPEED.powi(2);
    let (sine, angle) = ((1.0 - c * c).sqrt(), c.acos());
    let speed = (1.5 * GRAVITY).sqrt();
    let polynomials =
        [[angle, c / sine, -c / sine * (2.0 + c * c / (sine * sine))], [speed, -0.5 * speed, 0.75 * speed]];
    let length = Distribution::uniform(0.92, 1.1).unwrap();
    let range = Range::new(Bar::omega.any(), 0.5, 8.0).steps(20);
    let wanted = vec![Response::Output(Bar::angle.any()), Response::Critical(range)];
    let all = ask(&bar(), wanted, |responses| second_order(&Bar, responses, &varied(length.clone())).unwrap());
    let number = 200_000;
    for (k, [value, slope, bend]) in polynomials.into_iter().enumerate() {
        let at = |k: u32| {
            let x = length.quantile((f64::from(k) + 0.5) / f64::from(number)) - 1.0;
            value + slope * x + 0.5 * bend * x * x
        };
        let mean = (0..number).map(at).sum::<f64>() / f64::from(number);
        let square = (0..number).map(|k| (at(k) - mean).powi(2)).sum::<f64>();
        let own = spread(&all, k);
        close(own.nominal.unwrap(), value, 1e-12);
        close(own.mean.value, mean, 1e-8);
        close(own.sigma.unwrap().value, (square / f64::from(number)).sqrt(), 1e-6);
    }
}

mechanism! {
    mechanism Twins {
        design m = 1.0 kg;
        design k = 4.0 N/m;
        body left: sphere(mass: m, radius: 0.1 m);
        body right: sphere(mass: m, radius: 0.1 m);
        joint x: prismatic(x) from ground to left;
        joint y: prismatic(y) from ground to right;
        force hold_x: spring(on: x, stiffness: k);
        force hold_y: spring(on: y, stiffness: k);
    }
}

/// Equal modes have no second derivatives of their own.
#[test]
fn first_order_where_there_is_no_second() {
    let study = Study::new(Twins).tolerance(Twins::m, 0.01);
    let (at, modes) = (&study.equilibrium().unwrap(), &study.modes().unwrap());
    let tolerances = study.tolerances().unwrap();
    let responses = Responses::new(&Twins, at, modes, vec![FREQUENCY]).unwrap();
    let sampling = Sampling::default();
    let all = propagate(&Twins, &responses, &tolerances, 1, &sampling).unwrap();
    assert_eq!(all.method, Method::FirstOrder);
    assert!(all.reason.ends_with("no second derivatives"), "{}", all.reason);
    assert_eq!(spread(&all, 0).mean.error, None);
}

/// Dependent non-normal variables have no closed form: the model is sampled, and its error is given.
#[test]
fn dependent_variables() {
    let length = Distribution::uniform(0.97, 1.03).unwrap();
    let mass = Distribution::uniform(2.9, 3.1).unwrap();
    let correlation = eigentol::Matrix::from([[1.0, 0.6], [0.6, 1.0]]);
    let tolerances = Tolerances::distributed(&[3.0, 1.0], vec![mass, length.clone()], 3.0, Some(correlation)).unwrap();
    let [_, second] = both(&tolerances);
    let [mean, sigma, skewness] = model(&length, true);
    let own = spread(&second, 0);
    close(own.mean.value, mean, 1e-8);
    close(own.sigma.unwrap().value, sigma, 1e-3);
    assert!((own.skewness.unwrap().value - skewness).abs() < 1e-2);
    // Only the mass varies with the length.
    let with_mass = second.with_design[0][0].unwrap();
    let by_length = second.with_design[0][1].unwrap();
    close(with_mass / by_length, 0.6 * (0.1 / 0.03), 1e-2);
}

/// The choice by cost, and its reason.
#[test]
fn the_method_follows_the_cost() {
    let range = Range::new(Bar::omega.any(), 0.5, 8.0).steps(20);
    let critical = vec![Response::Critical(range)];
    let tolerances = varied(Distribution::normal(1.0, 0.02).unwrap());
    let of = |wanted: &[Response], tolerances: &Tolerances, solutions| {
        ask(&bar(), wanted.to_vec(), |responses| {
            let sampling = Sampling::default().samples(4096);
            let all = propagate(&Bar, responses, tolerances, solutions, &sampling).unwrap();
            assert!(!all.reason.is_empty());
            all
        })
    };
    let all = of(&[FREQUENCY], &tolerances, 4096);
    assert_eq!((all.method, all.evaluations), (Method::Sampled(Points::Sobol), 4096));
    assert_eq!(of(&[FREQUENCY], &tolerances, 4095).method, Method::SecondOrder);
    let found = of(&critical, &tolerances, 21 * 4095);
    assert_eq!(found.method, Method::SecondOrder);
    // sqrt(1.5 g / l): the mean from its series to second order.
    let (speed, s) = ((1.5 * GRAVITY).sqrt(), 0.02_f64.powi(2));
    close(spread(&found, 0).mean.value, speed * (1.0 + 0.375 * s), 1e-8);
    assert_eq!(of(&critical, &tolerances, 21 * 4).method, Method::SecondOrder);
    let still = varied(Distribution::constant(1.0).unwrap());
    assert_eq!(of(&[FREQUENCY], &still, 1_000_000).method, Method::FirstOrder);
    let wide = varied(Distribution::normal(1.0, 0.6).unwrap());
    let found = of(&[FREQUENCY], &wide, 200);
    assert_eq!((found.method, found.evaluations), (Method::Sampled(Points::Sobol), 128));
    assert!(found.counts.unphysical > 0);
    let steps = varied(Distribution::discrete(&[(0.9, 1.0), (1.1, 1.0)]).unwrap());
    assert_eq!(of(&[FREQUENCY], &steps, 100).method, Method::SecondOrder);
}
