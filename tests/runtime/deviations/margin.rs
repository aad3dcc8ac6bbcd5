//! A forbidden band around a deviating input: the band deviates with it.

use super::{CRITICAL, OMEGA, Single, all_deviate, solved};
use crate::common::{FREQUENCY, close};
use eigentol::Tolerances;
use eigentol::requirement::{FormSettings, Requirement, Requirements};
use eigentol::tolerance::Sampling;

const SIGMA: f64 = 0.1;

/// A tenth away from the speed.
fn away() -> Requirement {
    Requirement::away(FREQUENCY, OMEGA, 0.1)
}

/// Probability that a standard normal variable exceeds `low`, by the midpoint rule.
fn tail(low: f64) -> f64 {
    let step = 1e-4;
    let density = |z: f64| (-0.5 * z * z).exp() / std::f64::consts::TAU.sqrt();
    let parts = (0..100_000).map(|k| density(low + (f64::from(k) + 0.5) * step));
    parts.sum::<f64>() * step
}

/// Design points and samples see the band move. The ratio of frequency to speed, `sqrt(1 - c^2 / v^4)`, increases with the
/// speed: it reaches 0.9 where `v^4 = c^2 / 0.19`. One variable matters, so that first order is exact.
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
