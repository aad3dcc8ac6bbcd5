//! Values of any size: nothing panics or hangs, and every reported result is valid.

use eigentol::equilibrium::equilibrium;
use eigentol::kernels::Kernels;
use eigentol::tolerance::Tolerances;
use eigentol::{Coordinate, DesignVariable, Input, Policy, Study};
use eigentol_interpreter::Interpreted;
use eigentol_tests::corpus::declarations;
use proptest::prelude::*;
use proptest::test_runner::{RngSeed, TestRunner};

use super::sound::{assert_answers, assert_numbers};

/// Values up to `10^powers`, zero, and ordinary numbers, so that every depth of the code is reached.
pub(crate) fn sized(powers: f64) -> impl Strategy<Value = f64> {
    prop_oneof![
        1 => Just(0.0),
        3 => (-powers..powers, any::<bool>())
            .prop_map(|(power, negative)| 10f64.powf(power) * if negative { -1.0 } else { 1.0 }),
        6 => -10.0..10.0_f64,
    ]
}

/// Like [`sized`], but mostly positive.
pub(crate) fn design(powers: f64) -> impl Strategy<Value = f64> {
    prop_oneof![
        1 => sized(powers),
        3 => (-powers..powers).prop_map(|power| 10f64.powf(power)),
        16 => 1e-3..1e3_f64,
    ]
}

fn ask(machine: &Interpreted, [u, b, start, widths]: [&[f64]; 4]) {
    let sizes = machine.sizes();
    let (u, b) = (&u[..sizes.inputs], &b[..sizes.design]);
    let (start, widths) = (&start[..sizes.coordinates], &widths[..sizes.design]);
    let usual = Tolerances::declared(machine.description()).expect("declared");
    let tolerances = Tolerances::new(widths, 3.0, None).unwrap_or(usual.clone());
    for policy in [Policy::Stable, Policy::Nearest] {
        if let Ok(state) = equilibrium(machine, u, b, start, policy) {
            assert_answers(machine, &state, &tolerances);
        }
    }
    let mut study = Study::new(machine.clone()).samples(8).threads(1).steps(4).keep_samples(true);
    for (j, &value) in u.iter().enumerate() {
        study = study.input(Input::new(j), value);
    }
    for (i, &value) in start.iter().enumerate() {
        study = study.start(Coordinate::new(i), value);
    }
    for j in 0..sizes.design {
        study = study.design(DesignVariable::new(j), b[j]).tolerance(DesignVariable::new(j), widths[j]);
    }
    if let Ok(run) = study.monte_carlo() {
        assert_eq!(run.counts.total(), 8);
        for sample in run.all.iter().flatten() {
            assert_numbers(sample.coordinates.iter().flatten(), "sample");
            let s = sample.eigenvalues.iter().flatten();
            assert_numbers(s.flat_map(|s| [s.re, s.im]), "sample");
            assert_numbers(sample.frequencies.iter().flatten().copied(), "sample");
        }
        for found in run.modes.iter().flatten() {
            let spread = [found.sigma, found.standard_error];
            assert_numbers(spread.into_iter().flatten().chain([found.mean]), "moments");
        }
    }
    if sizes.inputs > 0 {
        let (low, high) = (start[0], u[0]);
        if let Ok(critical) = study.critical_state(Input::new(0), low, high) {
            assert_numbers([critical.value], "critical");
            assert_numbers(critical.equilibrium.coordinates, "critical");
        }
        for crossing in study.crossings(Input::new(0), low, high, 1.0).into_iter().flatten() {
            assert_numbers([crossing.value], "crossing");
        }
        for point in study.sweep(Input::new(0), &[low, high]).into_iter().flatten() {
            if let Ok(state) = point.equilibrium {
                assert_answers(machine, &state, &usual);
            }
        }
    }
}

fn list(strategy: impl Strategy<Value = f64>) -> impl Strategy<Value = Vec<f64>> {
    prop::collection::vec(strategy, 8)
}

/// Small mechanisms of every kind.
const NAMES: [&str; 6] =
    ["rotating_pendulum", "rotating_double_pendulum", "sliders_on_plate", "governor", "gimbal", "turntable_slider"];

fn read(name: &str) -> Interpreted {
    let declaration = declarations().into_iter().find(|(known, _)| *known == name);
    Interpreted::from_text(declaration.expect("a machine of the corpus").1).expect("a declaration")
}

/// Puts questions to one of the six with values of these kinds, `cases` times; the same cases every time.
pub(crate) fn ask_often(
    cases: u32,
    u: impl Strategy<Value = f64>,
    b: impl Strategy<Value = f64>,
    start: impl Strategy<Value = f64>,
    widths: impl Strategy<Value = f64>,
) {
    let config =
        ProptestConfig { cases, failure_persistence: None, rng_seed: RngSeed::Fixed(20), ..ProptestConfig::default() };
    let machines = NAMES.map(read);
    let values = (0..NAMES.len(), list(u), list(b), list(start), list(widths));
    let asked = TestRunner::new(config).run(&values, |(which, u, b, start, widths)| {
        ask(&machines[which], [&u, &b, &start, &widths]);
        Ok(())
    });
    asked.unwrap_or_else(|fault| panic!("{fault}"));
}

/// Twenty orders of magnitude in either direction, with starts of a million: products of several values stay finite.
fn values_of_any_size(cases: u32) {
    ask_often(cases, sized(20.0), design(20.0), sized(6.0), design(20.0));
}

#[test]
fn any_size() {
    values_of_any_size(120);
}

#[test]
#[ignore = "a quarter of a minute"]
fn any_size_many_times() {
    values_of_any_size(2000);
}
