//! Along the speed: folds and resonances with their derivatives and standard deviations, and sweeps from rest through
//! the points of the file.

use eigentol::branches::SpecialKind;
use eigentol::sweep::Condition;
use eigentol::sweep::EventTolerance;
use eigentol::{Input, Mechanism};
use eigentol_oracle::truth::Truth;
use eigentol_tests::loops::{FiveBar, FourBar, Governor, SliderCrank};

use super::common::{Case, assert_close, assert_near, complex};
use super::study::study;

fn check_spread(case: &Case, event: &Truth, event_tolerance: &EventTolerance, what: &str) {
    let value = event.get("value").number();
    assert_close(event_tolerance.value, value, 0.0, what);
    let spread = event_tolerance.spread.as_ref().expect("a spread");
    for (j, variable) in case.variables[..case.design.len()].iter().enumerate() {
        let expected = event.get("by").get(variable).number();
        let scale = 1e-2 * value / case.design[j].abs();
        let what = format!("{what} by {variable}");
        assert_close(spread.by_design[j], expected, scale, &what);
    }
    assert_close(spread.sigma, event.get("sigma").number(), 0.0, what);
}

/// Returns the number of events found.
fn check_events<M: Mechanism>(machine: M, name: &'static str) -> usize {
    let case = Case::new(name);
    let events = case.truth.get("events").list();
    let rest = &case.points()[0];
    let study = study(machine, &case, rest);
    let speed = Input::new(0);
    for event in &events {
        let value = event.get("value").number();
        let (low, high) = (0.9 * value, 1.05 * value);
        let what = format!("{name}: {} at {value}", event.get("kind").text());
        if event.get("kind").text() == "fold" {
            let state = study.critical_state(speed, 0.0, high).unwrap_or_else(|error| panic!("{what}: {error}"));
            assert_eq!(state.kind, SpecialKind::Fold, "{what}");
            for (i, unknown) in study.description().coordinates.iter().enumerate() {
                if let Some(expected) = event.get("coordinates").find(&unknown.name) {
                    // A double root keeps only half the digits, but not along the branch.
                    let off = state.equilibrium.coordinates[i] - expected.number();
                    assert!(off.abs() < 1e-6, "{what}: {} off by {off:e}", unknown.name);
                }
            }
            let found = study.critical_tolerance(speed, 0.0, high).expect("a fold");
            check_spread(&case, event, &found, &what);
            continue;
        }
        let line = event.get("line").number();
        let crossings = study.crossings(speed, low, high, line).unwrap_or_else(|error| panic!("{what}: {error}"));
        assert_eq!(crossings.len(), 1, "{what}");
        assert!(matches!(crossings[0].condition, Condition::Line(_)));
        let mode = &crossings[0].modes.modes[crossings[0].mode];
        assert_near(mode.s, complex(&event.get("s")), 0.0, &what);
        let found = study.crossing_tolerances(speed, low, high, line).expect("a crossing");
        check_spread(&case, event, &found[0], &what);
    }
    events.len()
}

#[test]
fn folds_and_resonances() {
    let found = [
        check_events(Governor, "governor"),
        check_events(SliderCrank, "slider_crank"),
        check_events(FiveBar, "five_bar"),
        check_events(FourBar, "four_bar_open"),
    ];
    assert_eq!(found, [1, 2, 2, 1]);
}

/// Sweeps from rest to the last point of the file in a hundred steps: the assembly mode is kept, and the modes keep
/// their labels.
fn check_sweep<M: Mechanism>(machine: M, name: &'static str) {
    let case = Case::new(name);
    let points = case.points();
    let last = points.last().expect("a point").input;
    let speeds: Vec<f64> = (0..=100).map(|k| last * f64::from(k) / 100.0).collect();
    let sweep = study(machine, &case, &points[0]).sweep(Input::new(0), &speeds).expect("a sweep");
    assert!(sweep.critical.is_empty(), "{name}");
    let modes = |at: usize| sweep.points[at].modes.as_ref().expect("modes");
    let labels: Vec<usize> = modes(0).modes.iter().map(|mode| mode.label).collect();
    for (at, speed) in speeds.iter().enumerate() {
        let derived: Vec<usize> = modes(at).modes.iter().map(|mode| mode.label).collect();
        assert_eq!(derived, labels, "{name} at {speed}");
    }
    let end = &points[points.len() - 1];
    for truth in end.modes() {
        let s = complex(&truth.get("s"));
        let found = modes(100).modes.iter().map(|mode| mode.s);
        let nearest = found.min_by(|a, b| (a - s).norm().total_cmp(&(b - s).norm()));
        assert_near(nearest.expect("modes"), s, 0.0, &end.what);
    }
}

#[test]
fn sweeps_keep_the_assembly_mode() {
    check_sweep(Governor, "governor");
    check_sweep(SliderCrank, "slider_crank");
    check_sweep(FiveBar, "five_bar");
    check_sweep(FourBar, "four_bar_open");
    check_sweep(FourBar, "four_bar_crossed");
}
