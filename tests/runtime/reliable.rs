//! Requirements: linear limits, and the rotating bar, whose frequency is a function of its length, against exact
//! probabilities.

use eigentol::requirement::Requirement;
use eigentol::response::Response;
use eigentol::tolerance::Distribution;
use eigentol::{Error, Law, Quantity, Study, mechanism};
use eigentol_statistics::normal;

use crate::common::{GRAVITY, close};

mechanism! {
    mechanism Pendulum {
        input omega: rad/s;
        design m = 3.0 kg;
        design l = 1.0 m;
        gravity 9.81 m/s^2 along -z;
        body shaft: massless;
        body bar: rod(mass: m, length: l, along: -z);
        joint spin: revolute(z) from ground to shaft, driven at omega;
        joint theta: revolute(y) from shaft to bar;
    }
}

mechanism! {
    mechanism Stack {
        design a = 50 mm;
        design b = 20 mm;
        design c = 30 mm;
        design d = 10 mm;
        gravity 9.81 m/s^2 along -z;
        body bar: rod(mass: 1 kg, length: 1 m, along: -z);
        joint theta: revolute(y) from ground to bar;
        output gap = a - 2 * b + c;
        output other = a + b;
        output third = d;
    }
}

const SPEED: f64 = 5.0;
const FREQUENCY: Response = Response::Mode { mode: 0, quantity: Quantity::Frequency };

fn pendulum() -> Study<Pendulum> {
    Study::new(Pendulum).input(Pendulum::omega, SPEED).start(Pendulum::theta, 1.0)
}

/// The length at which the bar has the given frequency.
fn length(frequency: f64, speed: f64) -> f64 {
    1.5 * GRAVITY / (speed * (speed * speed - frequency * frequency).sqrt())
}

fn gap() -> Response {
    Response::Output(Stack::gap.any())
}

/// Sigmas 0.1, 0.05 and 0.2 mm; the slopes of the gap are 1, -2 and 1.
fn stack() -> Study<Stack> {
    Study::new(Stack).tolerance(Stack::a, 0.3e-3).tolerance(Stack::b, 0.15e-3).tolerance(Stack::c, 0.6e-3)
}

#[test]
fn a_linear_limit_is_exact() {
    let correlation = [[1.0, 0.5, 0.0, 0.0], [0.5, 1.0, -0.3, 0.0], [0.0, -0.3, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]];
    let parts = [0.1e-3, -0.1e-3, 0.2e-3, 0.0];
    for study in [stack(), stack().correlation(correlation)] {
        let with = |i: usize, j: usize| match study.tolerances().unwrap().correlation() {
            Some(matrix) => matrix[i][j],
            None => f64::from(u8::from(i == j)),
        };
        let covariances: Vec<f64> = (0..4).map(|i| (0..4).map(|j| with(i, j) * parts[j]).sum()).collect();
        let variance: f64 = parts.iter().zip(&covariances).map(|(a, b)| a * b).sum();
        let sigma = variance.sqrt();
        let found = study.reliability(&[Requirement::at_most(gap(), 41e-3)]).unwrap();
        assert!(found.verified());
        let limit = &found.limits[0];
        assert_eq!(limit.limit, Requirement::at_most(gap(), 41e-3));
        let points = limit.design_points.as_ref().unwrap();
        assert_eq!(points.len(), 1);
        let at = &points[0];
        let beta = 1e-3 / sigma;
        close(at.beta(), beta, 1e-11);
        close(limit.probability().unwrap(), normal::cdf(-beta), 1e-10);
        let slopes = [1.0, -2.0, 1.0, 0.0];
        let sigmas = [0.1e-3, 0.05e-3, 0.2e-3, 0.0];
        let nominal = [50e-3, 20e-3, 30e-3, 10e-3];
        for k in 0..4 {
            let moved = sigmas[k] * covariances[k] / sigma * beta;
            assert!((at.design[k] - nominal[k] - moved).abs() < 1e-13);
            let share = parts[k] * covariances[k] / variance;
            assert!((at.importance[k] - share).abs() < 1e-11);
            // beta = (limit - mean) / sigma.
            assert!((at.by_nominal[k].beta * sigma + slopes[k]).abs() < 1e-10);
            let by_sigma = slopes[k] * covariances[k] / sigma;
            let by_half_width = -beta / sigma * by_sigma / 3.0;
            assert!((at.by_half_width[k].beta - by_half_width).abs() < 1e-8 * beta / sigma);
            close(at.by_half_width[k].probability, -normal::density(beta) * at.by_half_width[k].beta, 1e-9);
        }
        let samples = study.samples(20_000).chances(&[Requirement::at_most(gap(), 40.5e-3)]);
        let interval = samples.unwrap().all.clopper_pearson(0.9999).unwrap();
        let exact = normal::cdf(-0.5 * beta);
        assert!(interval.lower < exact && exact < interval.upper);
    }
}

/// Two limits of one band, and a band on another output: the exact probability is that of two normal variables.
#[test]
fn a_series_system() {
    let other = Response::Output(Stack::other.any());
    let wanted =
        [Requirement::Within { response: gap(), low: 39.5e-3, high: 40.5e-3 }, Requirement::at_most(other, 70.2e-3)];
    let found = stack().reliability(&wanted).unwrap();
    assert_eq!(found.limits.len(), 3);
    let sigma = 0.06_f64.sqrt() * 1e-3;
    for limit in &found.limits[..2] {
        close(limit.beta().unwrap(), 0.5e-3 / sigma, 1e-10);
    }
    close(found.beta_of(0).unwrap(), -normal::quantile(2.0 * normal::cdf(-0.5e-3 / sigma)), 1e-9);
    let beta = 0.2e-3 / (0.0125_f64.sqrt() * 1e-3);
    close(found.beta_of(1).unwrap(), beta, 1e-10);
    // gap and other have covariance 0.1^2 - 2 0.05^2 (in mm^2); integrated over the gap.
    let correlation = 0.005 / (0.06 * 0.0125_f64).sqrt();
    let rest = (1.0 - correlation * correlation).sqrt();
    let steps = 20_000;
    let edge = 0.5e-3 / sigma;
    let met: f64 = (0..steps)
        .map(|k| {
            let width = 2.0 * edge / f64::from(steps);
            let x = -edge + (f64::from(k) + 0.5) * width;
            normal::density(x) * normal::cdf((beta - correlation * x) / rest) * width
        })
        .sum();
    let judged = found.judgement.judged().unwrap().probability;
    assert!((judged.value + met - 1.0).abs() < 4.0 * judged.standard_error, "{found} {met}");
    let chances = stack().samples(20_000).chances(&wanted).unwrap();
    let interval = chances.all.wilson(0.9999).unwrap();
    assert!(interval.lower < 1.0 - met && 1.0 - met < interval.upper);
    assert_eq!(chances.all.samples(), 20_000);
    assert_eq!(chances.counts.stable, 20_000);
    let failed: usize = chances.each.iter().map(|x| x.failed).sum();
    assert!(failed > chances.all.failed, "some fail both");
}

fn distributed(values: Distribution) -> Study<Pendulum> {
    pendulum().distribution(Pendulum::l, values)
}

/// Probability that the length is below a value.
fn below(values: &Distribution, at: f64) -> f64 {
    let (mut low, mut high) = (-9.0, 9.0);
    for _ in 0..200 {
        let middle: f64 = 0.5 * (low + high);
        match values.quantile(normal::cdf(middle)) < at {
            true => low = middle,
            false => high = middle,
        }
    }
    normal::cdf(low)
}

/// In one variable the limit is a point, and first order is exact for any distribution.
#[test]
fn the_pendulum_in_a_band() {
    for values in [
        Distribution::normal(1.0, 0.01).unwrap(),
        Distribution::uniform(0.97, 1.03).unwrap(),
        Distribution::lognormal(1.0, 0.02).unwrap(),
    ] {
        let (low, high) = (3.98, 4.09);
        let band = Requirement::Within { response: FREQUENCY, low, high };
        let exact_low = below(&values, length(low, SPEED));
        let exact_high = 1.0 - below(&values, length(high, SPEED));
        // A varying mass has no effect.
        for mass in [0.0, 0.9] {
            let study = distributed(values.clone()).tolerance(Pendulum::m, mass);
            let found = study.reliability(&[band]).unwrap();
            for (limit, exact) in found.limits.iter().zip([exact_low, exact_high]) {
                close(limit.probability().unwrap(), exact, 1e-8);
                let at = &limit.design_points.as_ref().unwrap()[0];
                assert!(at.verified);
                close(at.probability(), exact, 1e-6);
                assert!((at.importance[1] - 1.0).abs() < 1e-9 && at.importance[0].abs() < 1e-9);
                assert!(at.by_nominal[0].beta.abs() < 1e-9);
                assert!(at.by_half_width[0].beta.abs() < 1e-9);
            }
            close(found.judgement.judged().unwrap().probability.value, exact_low + exact_high, 1e-6);
            let run = study.samples(20_000).seed(3).chances(&[band]).unwrap();
            let interval = run.all.clopper_pearson(0.9999).unwrap();
            let exact = exact_low + exact_high;
            assert!(interval.lower < exact && exact < interval.upper);
        }
    }
}

#[test]
fn a_forbidden_band() {
    let study = pendulum().tolerance(Pendulum::l, 0.03);
    let values = Distribution::normal(1.0, 0.01).unwrap();
    let frequency = study.modes().unwrap().frequencies()[0].unwrap();
    for (low, high) in [(4.1, 5.0), (2.0, 3.97)] {
        let forbidden = Requirement::Outside { response: FREQUENCY, low, high };
        let at = [low, high].map(|end| length(end.min(4.999), SPEED));
        let exact = below(&values, at[1]) - below(&values, at[0]);
        let found = study.reliability(&[forbidden]).unwrap();
        close(found.limits[0].probability().unwrap(), exact, 1e-8);
        assert!((low > frequency) || (high < frequency));
        let run = study.clone().samples(20_000).chances(&[forbidden]).unwrap();
        let interval = run.all.clopper_pearson(0.9999).unwrap();
        assert!(interval.lower < exact && exact < interval.upper);
    }
    // The middle of all designs fails.
    let inside = Requirement::Outside { response: FREQUENCY, low: 4.0, high: 6.0 };
    let found = study.reliability(&[inside]).unwrap();
    close(found.limits[0].probability().unwrap(), 1.0 - below(&values, length(4.0, SPEED)), 1e-8);
}

/// A fluctuating speed and a length, both normal: the exact probability is an integral over the speed.
#[test]
fn small_probabilities_of_a_curved_limit() {
    let study = pendulum().tolerance(Pendulum::l, 0.03).tolerance(Pendulum::omega, 0.15).tolerance(Pendulum::m, 0.5);
    let low = 3.6;
    let lengths = Distribution::normal(1.0, 0.01).unwrap();
    let steps = 4000;
    let exact: f64 = (0..steps)
        .map(|k| {
            let width = 16.0 / f64::from(steps);
            let z = -8.0 + (f64::from(k) + 0.5) * width;
            let at = length(low, SPEED + 0.05 * z);
            normal::density(z) * normal::cdf((at - lengths.mean()) / lengths.sigma()) * width
        })
        .sum();
    assert!((1e-7..1e-5).contains(&exact), "{exact}");
    let wanted = [Requirement::at_least(FREQUENCY, low)];
    let found = study.reliability(&wanted).unwrap();
    let at = &found.limits[0].design_points.as_ref().unwrap()[0];
    assert!(at.verified && at.importance[0].abs() < 1e-12);
    let judged = found.limits[0].judgement.judged().unwrap();
    let probability = judged.probability;
    assert!(judged.settled && judged.designs < 30_000);
    assert!((probability.value - exact).abs() < 4.0 * probability.standard_error, "{found} {exact}");
    assert!(probability.standard_error < 0.021 * exact);
}

/// Against first-order reliability recomputed at changed values.
#[test]
fn derivatives_are_those_of_differences() {
    let at = |nominal: [f64; 2], wide: [f64; 2], law: &Law, edge: f64| {
        let study = pendulum()
            .design(Pendulum::l, nominal[1])
            .limits(Pendulum::l, -0.01 * wide[1] + 0.01, 0.01 * wide[1] + 0.01)
            .law(Pendulum::l, law.clone())
            .tolerance(Pendulum::omega, 0.15 * wide[0])
            .correlation([[1.0, 0.0, 0.0], [0.0, 1.0, 0.4], [0.0, 0.4, 1.0]]);
        let found = study.reliability(&[Requirement::at_least(FREQUENCY, edge)]).unwrap();
        let half_widths = study.tolerances().unwrap().half_widths().to_vec();
        let all = found.limits[0].design_points.clone().unwrap();
        (all[0].clone(), half_widths)
    };
    for law in &[Law::Normal, Law::Uniform, Law::Triangular] {
        for edge in [3.95, 4.0, 4.2] {
            let (point, half_widths) = at([0.0, 1.0], [1.0, 1.0], law, edge);
            let h = 1e-5;
            let difference = |ahead: f64, back: f64, step: f64| (ahead - back) / (2.0 * step);
            let by_length = difference(
                at([0.0, 1.0 + h], [1.0, 1.0], law, edge).0.beta(),
                at([0.0, 1.0 - h], [1.0, 1.0], law, edge).0.beta(),
                h,
            );
            close(point.by_nominal[1].beta, by_length, 1e-6);
            let by_width = difference(
                at([0.0, 1.0], [1.0, 1.0 + h], law, edge).0.beta(),
                at([0.0, 1.0], [1.0, 1.0 - h], law, edge).0.beta(),
                h * half_widths[1],
            );
            close(point.by_half_width[1].beta, by_width, 1e-5);
            let by_speed_width = difference(
                at([0.0, 1.0], [1.0 + h, 1.0], law, edge).0.probability(),
                at([0.0, 1.0], [1.0 - h, 1.0], law, edge).0.probability(),
                h * half_widths[2],
            );
            close(point.by_half_width[2].probability, by_speed_width, 1e-5);
        }
    }
}

#[test]
fn what_makes_no_sense_is_refused() {
    let study = pendulum().tolerance(Pendulum::l, 0.03);
    let setting =
        |study: &Study<Pendulum>, wanted: &[Requirement]| match (study.reliability(wanted), study.chances(wanted)) {
            (Err(Error::Setting { setting, .. }), other) => (setting, other.is_ok()),
            other => panic!("{other:?}"),
        };
    let band = |low, high| Requirement::Within { response: FREQUENCY, low, high };
    let good = band(4.0, 4.1);
    assert_eq!(setting(&study, &[]), ("requirements", false));
    for wrong in [band(4.1, 4.0), band(f64::NAN, 4.0), band(f64::NEG_INFINITY, f64::INFINITY)] {
        assert_eq!(setting(&study, &[good, wrong]), ("requirement", false));
    }
    assert_eq!(setting(&study, &[Requirement::Stable]), ("requirements", true));
    assert_eq!(setting(&pendulum(), &[good]), ("tolerances", true));
    let measured = Distribution::empirical(&[0.98, 1.0, 1.01]).unwrap();
    assert_eq!(setting(&distributed(measured), &[good]), ("distribution", true));
    assert!(study.clone().samples(0).chances(&[good]).is_err());
    let mode = Response::Mode { mode: 3, quantity: Quantity::Frequency };
    assert!(matches!(
        study.reliability(&[Requirement::at_least(mode, 1.0)]),
        Err(Error::NoSuchMode { mode: 3, count: 1 })
    ));
}

/// No design within reach fails: the limit reports this.
#[test]
fn a_limit_out_of_reach() {
    let study = distributed(Distribution::uniform(0.99, 1.01).unwrap());
    let wanted = [Requirement::at_least(FREQUENCY, 3.0)];
    let found = study.reliability(&wanted).unwrap();
    assert!(matches!(found.limits[0].design_points, Err(Error::NoReliability(_))));
    assert!(!found.verified() && found.beta_of(0).is_none());
    let run = study.samples(500).chances(&wanted).unwrap();
    assert_eq!((run.all.met, run.all.failed, run.all.untold), (500, 0, 0));
}

#[test]
fn samples_without_a_value_are_counted() {
    let wanted = [Requirement::at_least(FREQUENCY, 3.0)];
    let study = distributed(Distribution::uniform(-2.0, -1.0).unwrap());
    let run = study.clone().samples(300).chances(&wanted).unwrap();
    assert_eq!((run.all.met, run.all.failed, run.all.untold), (0, 0, 300));
    assert_eq!(run.counts.unphysical, 300);
    let with_stable = [wanted[0], Requirement::Stable];
    let run = study.clone().samples(300).chances(&with_stable).unwrap();
    assert_eq!((run.all.failed, run.each[0].untold), (300, 300));
    let found = study.reliability(&with_stable).unwrap();
    assert!(matches!(found.limits[0].design_points, Err(Error::NoReliability(_))));
    assert_eq!(found.left_out, [1]);
}

#[test]
fn reports_name_what_they_are_about() {
    let wanted = [Requirement::Within { response: gap(), low: 39.5e-3, high: 40.5e-3 }, Requirement::Stable];
    let study = stack().samples(100);
    let text = study.chances(&wanted).unwrap().to_string();
    assert!(text.starts_with("Stack: requirements, 100 samples\n"), "{text}");
    let text = study.reliability(&wanted).unwrap().to_string();
    assert!(text.contains("gap at least 0.0395 m"), "{text}");
    assert!(text.contains("a [mm]"), "{text}");
    assert!(text.contains("Requirement 2 has no design point"), "{text}");
}
