//! Verdicts: each warning appears where its cause is present and nowhere else, with one sentence each.

use eigentol::summary::{Doubt, Summary};
use eigentol::tolerance::Outcome;
use eigentol::{Coordinate, DesignVariable, Family, Input, Quantity, Study};

use super::close;
use crate::common::GRAVITY;
use crate::common::derived::Derived;
use crate::common::models::{Pair, Plate};
use crate::common::pendulum::Pendulum;

const OMEGA: Input<Pendulum> = Input::new(0);
const LENGTH: DesignVariable<Pendulum> = DesignVariable::new(1);

fn of_pendulum(speed: f64, tolerance: f64) -> Study<Pendulum> {
    Study::new(Pendulum).input(OMEGA, speed).start(Coordinate::new(0), 1.0).tolerance(LENGTH, tolerance)
}

fn pendulum(speed: f64, tolerance: f64) -> Summary {
    of_pendulum(speed, tolerance).summary().unwrap()
}

/// Without samples.
fn by_distance(speed: f64, tolerance: f64) -> Summary {
    let study = of_pendulum(speed, tolerance);
    study.summary_within(0.0).unwrap()
}

fn plate(speed: f64, damping: f64, sigma: f64) -> Summary {
    let study = Study::new(Derived(Plate))
        .family(Family::General)
        .sigma_level(1.0)
        .input(Input::new(0), speed)
        .design(DesignVariable::new(3), damping)
        .tolerance(DesignVariable::new(0), 0.0)
        .tolerance(DesignVariable::new(1), 0.1)
        .tolerance(DesignVariable::new(2), 0.1)
        .tolerance(DesignVariable::new(3), sigma);
    study.summary().unwrap()
}

fn says(text: &str, parts: &[&str]) {
    for part in parts {
        assert!(text.contains(part), "{part}: {text}");
    }
}

#[test]
fn far_from_everything_a_mode_is_trusted() {
    for summary in [pendulum(2.0, 0.03), pendulum(6.0, 0.03)] {
        assert!(summary.trusted(), "{summary}");
        says(&summary.to_string(), &["yes", "Mode 1: nothing contradicts"]);
    }
    let whirling = plate(3.0, 0.0, 0.0);
    assert!(whirling.trusted(), "{whirling}");
    says(&whirling.to_string(), &["Modes 1 and 2: nothing contradicts"]);
}

#[test]
fn near_the_critical_speed_nothing_is_trusted() {
    let summary = pendulum(3.87, 0.03);
    let [Doubt::NearCritical { distance }, ..] = summary.trust[0].doubts[..] else { panic!("{summary:?}") };
    assert_eq!(distance, summary.first.distance_to_critical);
    assert!(distance > 0.0 && distance < 2.0);
    says(&summary.to_string(), &["critical state is", "Monte Carlo", " no\n"]);
}

/// At 1.000004 times the critical speed no term of the series is meaningful. Compared with the exact distribution, by
/// quadrature over both branches: `lambda = w - u^2` below `u^2 = w = 3 g / (2 L)` and `u^2 - w^2 / u^2` beyond.
#[test]
fn at_the_critical_speed_sampling_is_what_to_use() {
    let speed = 3.836;
    let frequency = |length: f64| {
        let (w, square) = (1.5 * GRAVITY / length, speed * speed);
        f64::sqrt(if w > square { w - square } else { square - w * w / square })
    };
    let moment = |power: i32| {
        let steps = (-80_000..=80_000).map(|k| f64::from(k) * 1e-4);
        let density = |z: f64| (-0.5 * z * z).exp() * 1e-4 / std::f64::consts::TAU.sqrt();
        steps.map(|z| density(z) * frequency(1.0 + 0.01 * z).powi(power)).sum::<f64>()
    };
    let exact = (moment(2) - moment(1).powi(2)).sqrt();
    close(exact, 0.1745, 1e-3);
    let study = Study::new(Pendulum).input(OMEGA, speed).start(Coordinate::new(0), 1.0).tolerance(LENGTH, 0.03);
    let sampled = study.clone().samples(15_000).monte_carlo().unwrap();
    let sigma = sampled.modes[0].as_ref().unwrap().sigma.unwrap();
    close(sigma, exact, 0.02);
    let summary = study.summary().unwrap();
    let second = &summary.second.modes[0].as_ref().unwrap().frequency;
    assert!(second.moments.sigma > 3000.0);
    let [Doubt::NearCritical { .. }, Doubt::Inaccurate { quantity: Quantity::Frequency, error }] =
        summary.trust[0].doubts[..]
    else {
        panic!("{:?}", summary.trust)
    };
    assert!(error.value > 10.0);
    let check = summary.trust[0].check(Quantity::Frequency).unwrap();
    assert!((check.sigma.value - exact).abs() < 5.0 * check.sigma.standard_error);
    let text = summary.to_string();
    says(&text, &["use Monte Carlo", " no\n"]);
    assert!(!text.contains("use second"), "{text}");
    let row = text.lines().find(|line| line.trim_start().starts_with("1 ")).unwrap();
    assert_eq!(row.matches(" -").count(), 1, "no second order: {row}");
}

#[test]
fn wide_tolerances_bend() {
    let summary = by_distance(7.0, 0.6);
    let found = summary.trust[0].doubts.iter().find_map(|doubt| match doubt {
        Doubt::Nonlinear { sigma_error, .. } => Some(*sigma_error),
        _ => None,
    });
    let second = summary.second.modes[0].as_ref().unwrap();
    close(found.unwrap(), second.frequency.nonlinearity.sigma_error(), 1e-15);
    says(&summary.to_string(), &["% below that of second order", "use Monte Carlo", " no\n"]);
    // Samples show how large the first-order error is.
    let measured = pendulum(7.0, 0.6);
    assert!(matches!(measured.trust[0].doubts[..], [.., Doubt::Inaccurate { .. }]));
    says(&measured.to_string(), &["% below that of the samples", " no\n"]);
}

#[test]
fn mixed_modes_have_no_sigma_of_their_own() {
    let study = Study::new(Derived(Pair)).design(DesignVariable::new(1), 102.0);
    let summary = study.summary().unwrap();
    for trust in &summary.trust {
        let [Doubt::Clustered { modes, distance, defective: false }] = &trust.doubts[..] else { panic!("{trust:?}") };
        assert_eq!(modes, &[0, 1]);
        close(*distance, 1.0, 1e-12);
    }
    assert_eq!(summary.cluster_of(1).unwrap().modes, [0, 1]);
    let text = summary.to_string();
    says(
        &text,
        &[
            "Modes 1 and 2: tolerances mix modes 1 and 2, 1.00 standard deviations apart",
            "lowest frequency",
            "highest frequency",
            "splitting",
            "of the mean eigenvalue",
            "cluster",
        ],
    );
    // Their rows show no sigma.
    let row = text.lines().find(|line| line.trim_start().starts_with("1 ")).unwrap();
    assert_eq!(row.matches(" -").count(), 5, "{row}");
    // Only first order raises a warning there.
    says(&summary.first.to_string(), &["Each mode is taken alone", "summary"]);
    // Equal frequencies, for which second order does not exist either.
    let equal = Study::new(Derived(Pair)).summary().unwrap();
    assert!(matches!(&equal.trust[0].doubts[..], [Doubt::Clustered { .. }]));
}

#[test]
fn a_vibration_about_to_grow_says_so() {
    let summary = plate(0.5, 0.02, 0.01);
    // The damping ratio of the stable samples is normal, truncated at two standard deviations.
    let hazard = (-2.0_f64).exp() / std::f64::consts::TAU.sqrt() / 0.977_249_868;
    let cut = (1.0 - 2.0 * hazard - hazard * hazard).sqrt();
    for trust in &summary.trust {
        let [Doubt::NearInstability { distance }, Doubt::Inaccurate { quantity: Quantity::DampingRatio, error }] =
            trust.doubts[..]
        else {
            panic!("{trust:?}")
        };
        close(distance, 2.0, 1e-3);
        assert!((error.value - (1.0 / cut - 1.0)).abs() < 4.0 * error.standard_error);
    }
    let unstable = summary.sampled().unwrap().chance(Outcome::Flutter).unwrap();
    let (share, samples) = (0.022_75_f64, unstable.samples as f64);
    let error = 4.0 * (share * (1.0 - share) / samples).sqrt();
    assert!((unstable.value() - share).abs() < error, "{unstable:?}");
    says(&summary.to_string(), &["begins to grow 2.0"]);
    let growing = plate(0.5, -0.02, 0.01);
    says(&growing.to_string(), &["the vibration grows"]);
    // Without damping nothing changes the growth, except rounding.
    let conservative = plate(0.5, 0.0, 0.0);
    assert!(conservative.trusted(), "{conservative}");
    let first = &conservative.first.modes[0];
    assert_eq!(first.distance_to_instability, f64::INFINITY);
}

#[test]
fn an_oscillation_about_to_cease_says_so() {
    // In x at rest: (Im s)^2 = k/m - (c/2m)^2 with m = 0.5, k = 40; c = 8.9 is just below critical damping.
    let summary = plate(0.0, 8.9, 0.05);
    let near = summary.trust.iter().find_map(|trust| match trust.doubts[..] {
        [Doubt::NearCriticalDamping { distance }, ..] => Some((trust.mode, distance)),
        _ => None,
    });
    let (mode, distance) = near.unwrap();
    // Variances of (Im s)^2 due to k and c.
    let sigma = (0.1_f64 / 0.5).hypot(2.0 * 8.9 * 0.05);
    close(distance, (80.0 - 8.9_f64.powi(2)) / sigma, 1e-9);
    assert!(summary.first.modes[mode].distance_to_critical > 4.5);
    says(&summary.to_string(), &["the oscillation ceases"]);
    // Beyond it two decaying modes form a cluster.
    let beyond = plate(0.0, 9.0, 0.05);
    let doubts = &beyond.trust.iter().find(|x| !x.trusted()).unwrap().doubts;
    assert!(matches!(doubts[..], [Doubt::NoFrequency, Doubt::Clustered { .. }]));
    says(&beyond.to_string(), &["no oscillation", "a member has no frequency"]);
}

/// On both sides of each threshold, from closed forms. Thresholds on quantities that samples can judge apply only
/// without samples.
#[test]
fn thresholds_are_where_they_are_said_to_be() {
    let w = 1.5 * GRAVITY;
    // Hanging, lambda = w / l - u^2: (w - u^2) / (w sigma) standard deviations.
    let near = |distance: f64, speed: f64| 3.0 * (w - speed * speed) / (w * distance);
    for (distance, doubted) in [(4.45, true), (4.55, false)] {
        let summary = by_distance(3.0, near(distance, 3.0));
        close(summary.first.distance_to_critical, distance, 1e-9);
        let critical = |doubt: &Doubt| matches!(doubt, Doubt::NearCritical { .. });
        assert_eq!(summary.trust[0].doubts.iter().any(critical), doubted);
        assert_eq!(summary.first.trusted(), !doubted);
        // k1 alone moves lambda = k1 against lambda = k2.
        let pair = Study::new(Derived(Pair))
            .sigma_level(1.0)
            .design(DesignVariable::new(1), 100.0 + distance)
            .tolerance(DesignVariable::new(0), 1.0)
            .tolerance(DesignVariable::new(2), 0.0);
        assert_eq!(pair.clusters().unwrap().len(), usize::from(doubted));
        assert_eq!(pair.first_order().unwrap().trusted(), !doubted);
        // Growth -c / (2 m) of a damped mode by c alone: c / sigma(c).
        let plate = (0..3).fold(Study::new(Derived(Plate)), |study, k| study.tolerance(DesignVariable::new(k), 0.0));
        let plate = plate.design(DesignVariable::new(3), 0.02).sigma_level(1.0);
        let plate = plate.tolerance(DesignVariable::new(3), 0.02 / distance).summary().unwrap();
        let growing = |doubt: &Doubt| matches!(doubt, Doubt::NearInstability { .. });
        assert_eq!(plate.trust[0].doubts.iter().any(growing), doubted);
    }
    // Beyond, omega = sqrt(u^2 - w^2 / (u l)^2), which is curved: with r = omega'' sigma / (sqrt(2) omega') first order
    // differs from second by 1 - 1 / sqrt(1 + r^2).
    let speed = 5.0_f64;
    let rest = (w / speed).powi(2);
    let omega = (speed * speed - rest).sqrt();
    let slope = rest / omega;
    let bend = -(3.0 * rest + slope * slope) / omega;
    for (error, doubted) in [(0.0495, false), (0.0505, true)] {
        let ratio = ((1.0_f64 / (1.0 - error)).powi(2) - 1.0).sqrt();
        let sigma = ratio * 2.0_f64.sqrt() * slope / bend.abs();
        let summary = by_distance(speed, 3.0 * sigma);
        assert!(summary.first.distance_to_critical > 4.6);
        let second = &summary.second.modes[0].as_ref().unwrap().frequency;
        close(second.nonlinearity.sigma_error(), error, 1e-9);
        assert_eq!(summary.trusted(), !doubted, "{error}");
    }
}
