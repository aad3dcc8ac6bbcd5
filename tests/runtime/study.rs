//! The public interface: values in and out, relative tolerances, standard deviations of critical speeds and resonances,
//! random streams.

mod kept;
mod operating_point;

use crate::common::close;
use crate::common::pendulum::Pendulum;
use eigentol::sweep::Condition;
use eigentol::sweep::Event;
use eigentol::tolerance::Tolerances;
use eigentol::{Coordinate, DesignVariable, Error, Input, Study};

const OMEGA: Input<Pendulum> = Input::new(0);
const THETA: Coordinate<Pendulum> = Coordinate::new(0);
const MASS: DesignVariable<Pendulum> = DesignVariable::new(0);
const LENGTH: DesignVariable<Pendulum> = DesignVariable::new(1);

fn study() -> Study<Pendulum> {
    Study::new(Pendulum)
}

#[test]
fn what_was_set_can_be_read() {
    let study = study().input(OMEGA, 3.0).design(LENGTH, 2.0).start(THETA, 0.5);
    assert_eq!(study.input_values(), &[3.0]);
    assert_eq!(study.design_values()[LENGTH.index()], 2.0);
    assert_eq!(study.start_values(), &[0.5]);
}

#[test]
fn a_relative_tolerance_follows_its_variable() {
    let width = |study: Study<Pendulum>| study.tolerances().unwrap().half_widths()[LENGTH.index()];
    let before = study().relative_tolerance(LENGTH, 0.03).design(LENGTH, 2.0);
    let after = study().design(LENGTH, 2.0).relative_tolerance(LENGTH, 0.03);
    assert_eq!([width(before.clone()), width(after)], [0.06; 2]);
    assert_eq!(width(before.tolerance(LENGTH, 0.5)), 0.5);
    for fraction in [-0.1, f64::NAN, f64::INFINITY] {
        let refused = study().relative_tolerance(LENGTH, fraction).tolerances();
        assert!(matches!(refused, Err(Error::Setting { .. })), "{fraction}");
    }
    let unknown = study().relative_tolerance(DesignVariable::new(2), 0.1);
    assert!(matches!(unknown.tolerances(), Err(Error::UnknownHandle { .. })));
}

#[test]
fn sigma_counts_correlation() {
    let slopes = [3.0, -4.0];
    let sigma = |rho: f64| {
        let correlation = [[1.0, rho], [rho, 1.0]];
        let tolerances = Tolerances::new([0.6, 0.3], 3.0, Some(correlation.into())).unwrap();
        tolerances.sigma(&slopes)
    };
    let independent = Tolerances::new([0.6, 0.3], 3.0, None).unwrap();
    close(independent.sigma(&slopes), 0.52_f64.sqrt(), 1e-15);
    close(sigma(0.0), 0.52_f64.sqrt(), 1e-15);
    close(sigma(0.5), 0.28_f64.sqrt(), 1e-14);
    close(sigma(1.0), 0.2, 1e-14);
    // Out of the range of a double only if the result is.
    let wide = Tolerances::new([3e200, 3e200], 3.0, None).unwrap();
    close(wide.sigma(&[3e-200, 4e-200]), 5.0, 1e-14);
    close(wide.sigma(&[3e100, 4e100]), 5e300, 1e-14);
    assert_eq!(wide.sigma(&[1e200, 0.0]), f64::INFINITY);
    assert_eq!(wide.sigma(&[0.0, 0.0]), 0.0);
    assert!(wide.sigma(&[f64::NAN, 0.0]).is_nan());
    let tiny_level = Tolerances::new([1e10, 0.0], 1e-300, None);
    assert!(matches!(tiny_level, Err(Error::Setting { .. })));
}

/// `omega_c^2 = 3 g / (2 l)`, and so `domega_c/dl = -omega_c / (2 l)`.
#[test]
fn the_critical_speed_has_a_spread() {
    let study = study().tolerance(MASS, 0.0).relative_tolerance(LENGTH, 0.03).sigma_level(2.0);
    let found = study.critical_tolerance(OMEGA, 0.0, 6.0).unwrap();
    let (speed, l) = (found.value, study.design_values()[LENGTH.index()]);
    assert_eq!(found.event, Event::Critical);
    close(speed, (1.5 * 9.81 / l).sqrt(), 1e-12);
    let spread = found.spread.clone().unwrap();
    close(spread.by_design[LENGTH.index()], -0.5 * speed / l, 1e-9);
    close(spread.sigma, 0.5 * speed * 0.015, 1e-9);
    close(spread.band, 0.5 * speed * 0.03, 1e-9);
    assert_eq!(found.sigma(), Some(spread.sigma));
    assert_eq!(spread.variance_shares[LENGTH.index()], 1.0);
    let text = found.to_string();
    for part in ["critical at", "+/-", "2 sigma", "100.0 %"] {
        assert!(text.contains(part), "{part}: {text}");
    }
}

/// Hanging: `omega_1^2 = 3 g / (2 l) - omega^2`, which equals `omega^2` at half the squared critical speed.
#[test]
fn a_resonance_has_a_spread() {
    let study = study().relative_tolerance(LENGTH, 0.03);
    let found = study.crossing_tolerances(OMEGA, 0.5, 3.5, 1.0).unwrap();
    let [crossing] = found.as_slice() else { panic!("{found:?}") };
    let Event::Crossing { mode, condition, s, whirl } = crossing.event else { panic!("{crossing:?}") };
    assert_eq!(mode, 0);
    assert_eq!(condition, Condition::Line(1.0.into()));
    close(s.im, crossing.value, 1e-12);
    // One coordinate moves along a line.
    assert_eq!(whirl.map(|whirl| whirl.sense()), None);
    let l = study.design_values()[LENGTH.index()];
    close(crossing.value, (0.75 * 9.81 / l).sqrt(), 1e-12);
    close(crossing.sigma().unwrap(), 0.5 * crossing.value * 0.01, 1e-9);
    assert!(crossing.to_string().contains("frequency 1 crosses 1x"));
}

#[test]
fn streams_are_independent_and_the_same_on_any_number_of_threads() {
    let run = |stream: u64, threads: usize| {
        let study = study().input(OMEGA, 2.0).relative_tolerance(LENGTH, 0.03);
        let study = study.seed(7).stream(stream).samples(1000);
        study.threads(threads).keep_samples(true).monte_carlo()
    };
    let first = run(0, 1).unwrap();
    let last = run(u64::MAX, 1).unwrap();
    for threads in [2, 3, 2, 0] {
        assert_eq!(run(0, threads).unwrap(), first);
        assert_eq!(run(u64::MAX, threads).unwrap(), last);
    }
    let lengths = |run: &eigentol::MonteCarlo| -> Vec<f64> {
        let all = run.all.as_deref().unwrap();
        all.iter().map(|sample| sample.design[LENGTH.index()]).collect()
    };
    let (a, b) = (lengths(&first), lengths(&last));
    assert!(a.iter().zip(&b).all(|(a, b)| a != b));
    let l = 1.0;
    let product: f64 = a.iter().zip(&b).map(|(a, b)| (a - l) * (b - l)).sum();
    // 1000 samples leave a correlation of 0.03; the standard deviation is 0.01.
    assert!((product / 1000.0 / 1e-4).abs() < 0.12, "{product}");
}
