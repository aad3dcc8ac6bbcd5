//! A forbidden band around a deviating input: the band deviates with it.

use super::{CRITICAL, OMEGA, Single, all_deviate, solved};
use crate::common::{FREQUENCY, close};
use eigentol::requirement::{FormSettings, Requirement, Requirements, SecondOrderFailure, second_order_failure};
use eigentol::tolerance::Sampling;
use eigentol::{Error, Tolerances};

const SIGMA: f64 = 0.1;

/// A tenth away from the speed.
fn away() -> Requirement {
    Requirement::away(FREQUENCY, OMEGA, 0.1)
}

/// The probability that the bar fails a requirement at a speed set to `speed` with mean `deviation` and standard deviation
/// `sigma`.
fn failure(speed: f64, deviation: f64, sigma: f64, wanted: Requirement) -> Result<SecondOrderFailure, Error> {
    let deviating = all_deviate(&Single);
    let mut b = deviating.design(&[3.0, 1.0]);
    b[2] = deviation;
    let (at, modes) = solved(&deviating, &[speed], &b, &[1.0]);
    let tolerances = Tolerances::new([0.0, 0.0, 3.0 * sigma], 3.0, None).unwrap();
    second_order_failure(&deviating, &at, &modes, &tolerances, wanted)
}

/// Probability that a standard normal variable exceeds `low`, by the midpoint rule.
fn tail(low: f64) -> f64 {
    let step = 1e-4;
    let density = |z: f64| (-0.5 * z * z).exp() / std::f64::consts::TAU.sqrt();
    let parts = (0..100_000).map(|k| density(low + (f64::from(k) + 0.5) * step));
    parts.sum::<f64>() * step
}

/// The ratio of frequency to speed, `sqrt(1 - c^2 / v^4)`, increases with the speed: it reaches 0.9 where
/// `v^4 = c^2 / 0.19`.
#[test]
fn the_band_is_around_the_speed_that_it_is() {
    let speed = 5.6_f64;
    let margin = failure(speed, 0.0, SIGMA, away()).unwrap().margin;
    let square = CRITICAL * CRITICAL;
    let ratio = (1.0 - square / speed.powi(4)).sqrt();
    let slope = 2.0 * square / (speed.powi(5) * ratio);
    let bend = -(10.0 * square / speed.powi(6) + slope * slope) / ratio;
    close(margin.sigma, SIGMA * speed * slope, 1e-11);
    close(margin.value, speed * ratio, 1e-12);
    let distance = (0.9 - ratio) / (SIGMA * slope);
    close(margin.distance, distance, 1e-10);
    close(margin.first_order, tail(distance), 1e-7);
    // The parabola lies in the band between two deviations.
    let root = (slope * slope + 2.0 * bend * (0.9 - ratio)).sqrt();
    let [near, far] = [root, -root].map(|root| (root - slope) / (bend * SIGMA));
    close(margin.corrected.value, tail(near) - tail(far), 1e-7);
    let exact = tail(((square / 0.19).powf(0.25) - speed) / SIGMA);
    let errors = [margin.first_order, margin.corrected.value].map(|value| (value - exact).abs());
    assert!(errors[0] > 0.5 * exact && errors[1] < 0.1 * exact, "{errors:?} of {exact}");
}

/// Design points and samples see the band move too. One variable matters, so that first order is exact.
#[test]
fn design_points_and_samples_follow_the_band() {
    let speed = 5.6_f64;
    let beta = ((CRITICAL * CRITICAL / 0.19).powf(0.25) - speed) / SIGMA;
    let deviating = all_deviate(&Single);
    let (at, modes) = solved(&deviating, &[speed], &deviating.design(&[3.0, 1.0]), &[1.0]);
    let tolerances = Tolerances::new([0.0, 0.0, 3.0 * SIGMA], 3.0, None).unwrap();
    let wanted = vec![away()];
    let all = Requirements::new(&deviating, &at, &modes, &tolerances, wanted).unwrap();
    let found = all.reliability(&FormSettings::default()).unwrap();
    assert!(found.verified(), "{found}");
    let point = &found.limits[0].design_points.as_ref().unwrap()[0];
    close(point.beta(), beta, 1e-6);
    close(point.by_nominal[2].beta, -1.0 / SIGMA, 1e-6);
    let judged = found.judgement.judged().unwrap().probability.value;
    close(judged, tail(beta), 1e-6);
    let samples = 4000;
    let chances = all.chances(&Sampling::default().samples(samples)).unwrap();
    let error = (tail(beta) * (1.0 - tail(beta)) / samples as f64).sqrt();
    assert!((chances.all.failure() - tail(beta)).abs() < 4.0 * error, "{chances}");
}

/// Derivatives by the set speed and by the mean deviation, against differences.
#[test]
fn its_derivatives_are_what_differences_show() {
    let second_order_failure = failure(5.6, 0.0, SIGMA, away()).unwrap();
    let step = 1e-4;
    let probability = |speed: f64| {
        let second_order_failure = failure(speed, 0.0, SIGMA, away());
        second_order_failure.unwrap().margin.first_order
    };
    let expected = (probability(5.6 + step) - probability(5.6 - step)) / (2.0 * step);
    assert!(expected.abs() > 0.1);
    close(second_order_failure.by_input.as_ref().unwrap()[0], expected, 1e-6);
    let by_deviation = second_order_failure.margin.derivatives.unwrap().by_design[2];
    close(by_deviation, expected, 1e-6);
}

/// A mean deviation of the set speed is equivalent to that speed.
#[test]
fn a_mean_deviation_moves_the_speed() {
    let beside = Requirement::Outside { response: FREQUENCY, low: 5.0, high: 6.0 };
    for wanted in [away(), beside] {
        let [moved, other] = [(5.5, 0.12), (5.62, 0.0)].map(|(speed, deviation)| {
            let second_order_failure = failure(speed, deviation, SIGMA, wanted).unwrap();
            let derivatives = second_order_failure.margin.derivatives.unwrap();
            let probabilities = [second_order_failure.margin.first_order, second_order_failure.margin.corrected.value];
            [probabilities, [derivatives.by_design[2], second_order_failure.by_input.unwrap()[0]]].concat()
        });
        for (moved, other) in moved.iter().zip(&other) {
            close(*moved, *other, 1e-9);
        }
        assert!(moved[0] > 1e-3 && moved[3].abs() > 0.01);
    }
}

/// Without a tolerance on the input nothing changes, and a band about zero has no relative width.
#[test]
fn exact_inputs_and_none() {
    let margin = failure(5.6, 0.0, 0.0, away()).unwrap().margin;
    assert_eq!((margin.sigma, margin.first_order), (0.0, 0.0));
    let at_rest = failure(0.0, 0.0, SIGMA, away());
    assert!(matches!(at_rest, Err(Error::NotFinite { .. })), "{at_rest:?}");
}
