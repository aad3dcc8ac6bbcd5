//! Tolerances: first order against closed forms, Monte Carlo against quadrature, reproducibility, correct counts.

use std::sync::atomic::{AtomicUsize, Ordering};

use crate::common::chain::{Bars, DOUBLE};
use crate::common::derived::Derived;
use crate::common::models::{Pair, Plate, Spring, Supercritical};
use crate::common::pendulum::Pendulum;
use crate::common::{FREQUENCY, close};
use eigentol::requirement::Requirement;
use eigentol::tolerance::{Spread, Tolerances, output_tolerances};
use eigentol::{Complex, Coordinate, DesignVariable, Error, Family, Input, MonteCarlo, Policy, Quantity, Study};

type Double = Study<Derived<Bars<2>>>;

const OMEGA: Input<Pendulum> = Input::new(0);
const THETA: Coordinate<Pendulum> = Coordinate::new(0);
const LENGTH: DesignVariable<Pendulum> = DesignVariable::new(1);

fn pendulum(omega: f64, tolerance: f64) -> Study<Pendulum> {
    Study::new(Pendulum).input(OMEGA, omega).start(THETA, 1.0).tolerance(LENGTH, tolerance)
}

fn sampled(omega: f64, tolerance: f64, samples: usize) -> MonteCarlo {
    pendulum(omega, tolerance).samples(samples).seed(20).monte_carlo().unwrap()
}

/// `lambda = 3 g / (2 l)` of a hanging bar, with the opposite sign for one that stands on its hinge: its growth is the
/// root.
#[test]
fn undamped_modes_have_the_spreads_of_a_root() {
    let rate = (1.5 * 9.81_f64).sqrt();
    // Limits of unequal size move the mean by 0.01 m; they are three standard deviations apart from it.
    let study = |start: f64| {
        let study = Study::new(Pendulum).start(THETA, start);
        study.policy(Policy::Nearest).limits(LENGTH, -0.01, 0.03)
    };
    let same = |spread: Spread| {
        close(spread.mean, rate - 0.5 * rate * 0.01, 1e-12);
        close(spread.by_design[1], -0.5 * rate, 1e-12);
        close(spread.sigma, 0.5 * rate * 0.02 / 3.0, 1e-12);
        close(spread.band, 0.5 * rate * 0.02, 1e-12);
        assert_eq!(spread.variance_shares, [0.0, 1.0]);
    };
    let still = |spread: Spread| {
        assert_eq!((spread.mean, spread.sigma, spread.band), (0.0, 0.0, 0.0));
        assert_eq!((spread.by_design, spread.variance_shares), ([0.0; 2].into(), [0.0; 2].into()));
    };
    // Derivatives of the eigenvalue itself: along the imaginary axis, along the real one.
    for (start, unit) in [(0.1, Complex::new(0.0, 1.0)), (3.1, Complex::new(1.0, 0.0))] {
        let mode = &study(start).sensitivities().unwrap().modes[0];
        let slope = mode.s().unwrap().by_design[1];
        assert!((slope + 0.5 * rate * unit).norm() < 1e-12, "{slope}");
        let by_length = |quantity| mode.of(quantity).map(|slopes| slopes.by_design[1]);
        let [omega, natural, damping, growth, decrement] = Quantity::ALL.map(by_length);
        if unit.im > 0.0 {
            close(omega.unwrap(), slope.im, 1e-15);
            close(natural.unwrap(), slope.im, 1e-15);
            assert_eq!((damping, growth, decrement), (Some(0.0), Some(0.0), Some(0.0)));
        } else {
            assert_eq!([omega, natural, damping, growth, decrement], [None, None, None, Some(slope.re), None]);
        }
    }
    let hanging = &study(0.1).first_order().unwrap().modes[0];
    same(hanging.frequency().unwrap());
    same(hanging.natural_frequency().unwrap());
    still(hanging.damping_ratio().unwrap());
    still(hanging.growth().unwrap());
    let standing = &study(3.1).first_order().unwrap().modes[0];
    same(standing.growth().unwrap());
    let others = [standing.frequency(), standing.natural_frequency(), standing.damping_ratio()];
    assert_eq!(others, [None, None, None]);
}

#[test]
fn first_order_matches_closed_form_and_warns_near_the_critical_speed() {
    let far = pendulum(3.0, 0.03).first_order().unwrap();
    close(far.modes[0].frequency().unwrap().sigma, 0.030_776_707_242_026_677, 1e-11);
    close(far.modes[0].frequency().unwrap().band, 3.0 * 0.030_776_707_242_026_677, 1e-11);
    close(far.modes[0].variance_shares()[1], 1.0, 1e-12);
    assert!(far.trusted());
    let near = pendulum(3.836, 0.03).first_order().unwrap();
    assert!(near.modes[0].frequency().unwrap().sigma > 7.0);
    assert!(!near.trusted());
    assert!(near.to_string().contains("Not to be trusted"));
    close(
        pendulum(3.0, 0.03).sigma_level(2.0).first_order().unwrap().modes[0].frequency().unwrap().sigma,
        0.046_165_060_863_040_02,
        1e-11,
    );
}

#[test]
fn plate_sigma_matches_reference() {
    // Independent m, kx, ky and an exact speed: 0.06046 also contains Omega's share (-0.5 * 0.04/3), which is
    // subtracted here.
    let study = Study::new(Derived(Plate)).input(Input::new(0), 4.0).family(Family::Undamped);
    let spread = study.first_order().unwrap();
    let expected = (0.060_461_190_490_723_515_f64.powi(2) - (0.5 * 0.04_f64 / 3.0).powi(2)).sqrt();
    close(spread.modes[0].frequency().unwrap().sigma, expected, 1e-12);
    close(spread.modes[0].variance_shares().iter().sum(), 1.0, 1e-12);
}

#[test]
fn near_modes_are_not_trusted() {
    let study = Study::new(Derived(Plate))
        .family(Family::Undamped)
        .input(Input::new(0), 1.0)
        .design(DesignVariable::new(2), 40.5);
    let spread = study.first_order().unwrap();
    assert!(!spread.trusted() && !spread.modes[0].alone());
    assert!(spread.modes[0].distance_to_neighbour < 2.0);
    assert!(spread.to_string().contains("mix"));
}

#[test]
fn correlation_changes_the_spread() {
    let base = Double::new(DOUBLE).input(Input::new(0), 3.0).start(Coordinate::new(0), 1.0);
    let independent = base.first_order().unwrap();
    let mut matrix = [[0.0; 4]; 4];
    (0..4).for_each(|j| matrix[j][j] = 1.0);
    matrix[0][1] = 1.0;
    matrix[1][0] = 1.0;
    let together = base.clone().correlation(matrix).first_order().unwrap();
    let rates = base.sensitivities().unwrap();
    let slopes = rates.modes[0].frequency().unwrap().by_design;
    close(together.modes[0].frequency().unwrap().sigma, (slopes[0] + slopes[1]).abs() * 0.01, 1e-12);
    close(independent.modes[0].frequency().unwrap().sigma, slopes[0].hypot(slopes[1]) * 0.01, 1e-12);
    // Monte Carlo sees the same coupling.
    let run = base.clone().correlation(matrix).samples(4000).keep_samples(true).monte_carlo().unwrap();
    assert!(run.all.unwrap().iter().all(|s| (s.design[0] - s.design[1]).abs() < 1e-12));
    matrix[0][1] = 1.5;
    matrix[1][0] = 1.5;
    assert!(matches!(base.correlation(matrix).first_order(), Err(Error::Setting { .. })));
}

/// Requires mean and standard deviation to agree within four standard errors.
fn agrees(run: &MonteCarlo, mean: f64, sigma: f64) {
    let mode = run.modes[0].as_ref().unwrap();
    assert_eq!(run.counts.stable, run.samples);
    let error = (mode.mean - mean).abs() / mode.standard_error.unwrap();
    assert!(error < 4.0, "mean {} is {error} standard errors from {mean}", mode.mean);
    // Standard error of a standard deviation, for moderate kurtosis.
    let deviation = mode.sigma.unwrap();
    let error = (deviation - sigma).abs() * (2.0 * run.samples as f64).sqrt() / sigma;
    assert!(error < 4.0, "sigma {deviation} is {error} standard errors from {sigma}");
}

#[test]
fn monte_carlo_matches_quadrature() {
    // L is normal about 1 m, with three standard deviations in the tolerance; from quadrature in 30-digit arithmetic.
    for (omega, tolerance, mean, sigma) in [
        (2.0, 0.03, 3.273_525_091_654, 0.022_481_458_667_38),
        (4.2, 0.06, 2.310_563_045_236, 0.107_359_679_428),
        (6.0, 0.12, 5.473_038_312_985, 0.044_620_098_805_95),
    ] {
        agrees(&sampled(omega, tolerance, 200_000), mean, sigma);
    }
}

#[test]
fn results_do_not_depend_on_the_number_of_threads() {
    let study = Double::new(DOUBLE)
        .input(Input::new(0), 3.0)
        .start(Coordinate::new(0), 1.0)
        .samples(2000)
        .seed(5)
        .keep_samples(true);
    let run = |threads: usize| study.clone().threads(threads).monte_carlo().unwrap();
    let one = run(1);
    for threads in [0, 2, 3, 7] {
        assert_eq!(one, run(threads));
    }
    let other = study.clone().seed(6).monte_carlo().unwrap();
    assert_ne!(one.modes, other.modes);
    // A shorter run is the beginning of a longer one.
    let short = study.clone().samples(300).monte_carlo().unwrap();
    assert_eq!(short.all.unwrap()[..], one.all.unwrap()[..300]);
}

#[test]
fn no_sample_is_dropped() {
    // A length that is often negative, deliberately.
    let run = pendulum(3.0, 3.0).samples(3000).monte_carlo().unwrap();
    assert_eq!(run.counts.total(), 3000);
    assert!(run.counts.unphysical > 300, "{}", run.counts);
    let count = run.modes[0].as_ref().unwrap().count as usize;
    assert_eq!(count, run.counts.stable);
    // A stiffness about zero: half of the samples diverge. The force fixes the equilibrium.
    let study = Study::new(Derived(Plate)).input(Input::new(0), 8.5).tolerance(DesignVariable::new(1), 12.0);
    let plate = study.samples(2000).monte_carlo().unwrap();
    assert_eq!(plate.counts.total(), 2000);
    assert!(plate.counts.divergent > 100, "{}", plate.counts);
    assert!(plate.counts.stable > 100, "{}", plate.counts);
    // A potential without a lower bound: beyond some force there is no equilibrium at all.
    let study = Study::new(Derived(Spring)).input(Input::new(0), 1.9).design(DesignVariable::new(1), -1.0);
    let fold = study
        .start(Coordinate::new(0), 0.3)
        .tolerance(DesignVariable::new(2), 0.3)
        .samples(2000)
        .monte_carlo()
        .unwrap();
    assert_eq!(fold.counts.total(), 2000);
    assert!(fold.counts.stable > 100, "{}", fold.counts);
}

#[test]
fn samples_on_the_other_branch_are_counted() {
    let run = sampled(3.82, 0.06, 2000);
    assert!(run.left_nominal_branch > 100);
    assert_eq!(sampled(2.0, 0.03, 2000).left_nominal_branch, 0);
}

#[test]
fn progress_adds_up() {
    let done = AtomicUsize::new(0);
    let count = |number: usize| {
        done.fetch_add(number, Ordering::Relaxed);
    };
    let study = pendulum(3.0, 0.03).samples(1000);
    let sampling = study.sampling().progress(Some(&count));
    study.sample_modes(&sampling).unwrap();
    assert_eq!(done.load(Ordering::Relaxed), 1000);
}

#[test]
fn settings_are_checked() {
    assert!(matches!(Tolerances::new([-1.0], 3.0, None), Err(Error::Setting { .. })));
    assert!(matches!(Tolerances::new([f64::NAN], 3.0, None), Err(Error::Setting { .. })));
    assert!(matches!(Tolerances::new([1.0], 0.0, None), Err(Error::Setting { .. })));
    let foreign = pendulum(3.0, 0.03).design(DesignVariable::new(9), 1.0).equilibrium();
    assert!(matches!(foreign, Err(Error::UnknownHandle { index: 9, count: 2, .. })));
    let empty = pendulum(3.0, 0.03).samples(0).monte_carlo().unwrap();
    assert_eq!((empty.counts.total(), empty.modes[0].clone()), (0, None));
}

#[test]
fn outputs_have_tolerances() {
    let study = pendulum(5.0, 0.03);
    let spread = study.output_tolerances().unwrap();
    let outputs = study.outputs().unwrap();
    let slope = outputs.by_design[0].as_ref().unwrap()[1];
    close(spread.spreads[0].as_ref().unwrap().sigma, 0.01 * slope.abs(), 1e-12);
    let direct = output_tolerances(&outputs, &study.tolerances().unwrap()).unwrap();
    assert_eq!(spread, direct);
}

#[test]
fn every_result_prints() {
    let study = pendulum(5.0, 0.03).samples(300).steps(30);
    let text = [
        study.equilibrium().unwrap().to_string(),
        study.modes().unwrap().to_string(),
        study.equilibrium_shift().unwrap().to_string(),
        study.sensitivities().unwrap().to_string(),
        study.outputs().unwrap().to_string(),
        study.first_order().unwrap().to_string(),
        study.monte_carlo().unwrap().to_string(),
        study.critical_state(OMEGA, 1.0, 5.0).unwrap().to_string(),
        study.crossings(OMEGA, 1.0, 5.0, 1.0).unwrap()[0].to_string(),
        study.sweep(OMEGA, &[1.0, f64::NAN, 5.0]).unwrap().to_string(),
        study.campbell(OMEGA, &[1.0, 3.0], &[1.0]).unwrap().to_string(),
        study.second_order().unwrap().to_string(),
        study.reliability(&[Requirement::away(FREQUENCY, OMEGA.any(), 0.1)]).unwrap().to_string(),
        study
            .reliability(&[Requirement::Outside { response: FREQUENCY, low: 900.0, high: 1000.0 }])
            .unwrap()
            .to_string(),
        study.branches(OMEGA, 1.0, 5.0).unwrap().to_string(),
    ]
    .join("\n");
    println!("{text}");
    for word in [
        "theta [rad]",
        "stable",
        "omega [rad/s]",
        "tip_radius",
        "share of l",
        "samples",
        "critical at omega = 3.83601",
        "Campbell",
        "second order",
        "frequency 1 away from omega by 10.0 %",
        "Designs solved anew",
    ] {
        assert!(text.contains(word), "{word} is missing from\n{text}");
    }
    assert!(text.contains("give a finite value"));
}

/// `x* = -e / (omega^2 - 1)` approximately; an energy descent would run to the stable equilibria far outside.
#[test]
fn samples_stay_where_gyroscopic_forces_hold_them() {
    let study = Study::new(Derived(Supercritical)).input(Input::new(0), 3.0).samples(200).threads(1).keep_samples(true);
    let result = study.monte_carlo().unwrap();
    assert_eq!((result.counts.stable, result.left_nominal_branch), (200, 0));
    for sample in result.all.unwrap() {
        assert!(sample.coordinates.unwrap()[0].abs() < 0.01);
    }
}

#[test]
fn a_report_says_what_first_order_leaves_out() {
    let equal = Study::new(Derived(Pair)).tolerance(DesignVariable::new(2), 0.0);
    let text = equal.first_order().unwrap().to_string();
    assert!(text.contains("mode 2: it has nearly equal neighbours"), "{text}");
    assert!(!text.contains("inf standard deviations"), "{text}");

    let damping = DesignVariable::new(3);
    let plate = Study::new(Derived(Plate)).input(Input::new(0), 1.0).tolerance(damping, 0.01);
    let said = |study: &Study<Derived<Plate>>, words: &str| {
        let first = study.first_order().unwrap().to_string();
        let summary = study.summary().unwrap().to_string();
        assert!(first.contains(words) && summary.contains(words), "{first}{summary}");
    };
    said(&plate, "the vibration neither grows nor decays within rounding");
    let fed = plate.design(damping, -0.01);
    said(&fed, "the vibration grows");
    // Whether or not its growth varies.
    let fixed = (0..4).fold(fed, |study, j| study.tolerance(DesignVariable::new(j), 0.0));
    said(&fixed, "the vibration grows");
    let first = fixed.first_order().unwrap();
    assert_eq!(first.modes[0].distance_to_instability, f64::NEG_INFINITY);
}

/// The standard error matches the scatter of the means of independent runs; for a single run it is its own standard
/// deviation over the square root of the sample count.
#[test]
fn means_scatter_by_their_standard_error() {
    let study = pendulum(3.0, 0.03).samples(50).keep_samples(true);
    let runs = 800;
    let (mut means, mut errors) = (Vec::new(), 0.0);
    for stream in 0..runs {
        let run = study.clone().stream(stream).monte_carlo().unwrap();
        let mode = run.modes[0].as_ref().unwrap();
        let values: Vec<f64> = run.all.unwrap().iter().map(|sample| sample.frequencies[0].unwrap()).collect();
        let mean = values.iter().sum::<f64>() / 50.0;
        let squares: f64 = values.iter().map(|value| (value - mean).powi(2)).sum();
        close(mode.standard_error.unwrap(), (squares / 49.0 / 50.0).sqrt(), 1e-12);
        means.push(mode.mean);
        errors += mode.standard_error.unwrap().powi(2);
    }
    let count = runs as f64;
    let centre = means.iter().sum::<f64>() / count;
    let scatter: f64 = means.iter().map(|mean| (mean - centre).powi(2)).sum::<f64>() / (count - 1.0);
    // Four standard errors of a variance.
    close(scatter / (errors / count), 1.0, 4.0 * (2.0 / count).sqrt());
}

/// At rest each coordinate of the plate is a separate damped oscillator: the distance to `|s|^2 = k / m = 0` is
/// `k / sigma(k)`.
#[test]
fn a_damped_mode_loses_its_stiffness_where_its_spring_does() {
    let sigma = 0.1;
    let study = (0..4).fold(Study::new(Derived(Plate)), |study, k| study.tolerance(DesignVariable::new(k), 0.0));
    let study =
        study.sigma_level(1.0).tolerance(DesignVariable::new(1), sigma).tolerance(DesignVariable::new(2), sigma);
    for damping in [0.0, 0.5, 3.0] {
        let study = study.clone().design(DesignVariable::new(3), damping).family(Family::General);
        let first = study.first_order().unwrap();
        for (mode, k) in first.modes.iter().zip([40.0, 60.0]) {
            close(mode.distance_to_critical, k / sigma, 1e-9);
        }
        close(first.distance_to_critical, 40.0 / sigma, 1e-9);
    }
}
