//! Events along the speed, as found by the library, and their derivatives by the parameters.

use eigentol::sweep::EventTolerance;
use eigentol::{Behaviour, Error, Mechanism, Stability, Study};
use eigentol_oracle::truth::Truth;
use eigentol_tests::wheels::{CirclingTrailer, TowedCaster, WhippleBicycle};

use super::common::{close, close_real_slopes, design_names, truth};

/// Checks an event: its speed, its derivatives, and the resulting standard deviation.
fn check_event<M: Mechanism>(study: &Study<M>, event_tolerance: &EventTolerance, expected: &Truth) {
    let speed = expected.get("speed").number();
    let what = format!("{} at {speed}", study.description().name);
    close(event_tolerance.value, speed, 0.0, &what);
    let spread = event_tolerance.spread.as_ref().expect("a spread");
    let names = design_names::<M>();
    let by = expected.get("by_design");
    let by: Vec<f64> = names.iter().map(|name| by.get(name).number()).collect();
    close_real_slopes(&spread.by_design, &by, study.design_values(), &names, &what);
    let shares = by.iter().zip(study.description().design.iter());
    let variance: f64 = shares.map(|(slope, info)| (slope * info.tolerance.upper / 3.0).powi(2)).sum();
    close(spread.sigma, variance.sqrt(), 0.0, &what);
}

#[test]
fn weave_speed() {
    let weave = truth("bicycle").get("events").get("weave");
    let study = Study::<WhippleBicycle>::new(WhippleBicycle);
    let found = study.flutter_onsets(WhippleBicycle::v, 1.0, 10.0).expect("onsets");
    assert_eq!(found.len(), 1);
    let published = truth("bicycle").get("published").get("weave").number();
    close(found[0].value, published, 0.0, "weave speed");
    let frequency = found[0].modes.modes[found[0].mode].s.im;
    close(frequency, weave.get("frequency").number(), 0.0, "weave frequency");
    let spreads = study.flutter_onset_tolerances(WhippleBicycle::v, 1.0, 10.0).expect("spreads");
    check_event(&study, &spreads[0], &weave);
}

#[test]
fn capsize_speed() {
    let capsize = truth("bicycle").get("events").get("capsize");
    let study = Study::<WhippleBicycle>::new(WhippleBicycle);
    let found = study.critical_state(WhippleBicycle::v, 5.0, 8.0).expect("a critical speed");
    let published = truth("bicycle").get("published").get("capsize").number();
    close(found.value, published, 0.0, "capsize speed");
    let spread = study.critical_tolerance(WhippleBicycle::v, 5.0, 8.0).expect("a spread");
    check_event(&study, &spread, &capsize);
}

/// Between the two speeds the bicycle is self-stable; below them it weaves, above them it capsizes.
#[test]
fn stability_of_the_bicycle() {
    let study = Study::<WhippleBicycle>::new(WhippleBicycle);
    let at = |speed: f64| {
        let study = study.clone().input(WhippleBicycle::v, speed);
        let state = study.equilibrium().expect("rolling straight ahead");
        assert_eq!(study.modes().expect("modes").stable(), state.stability.holds());
        state.stability
    };
    assert_eq!(at(3.0), Stability::Flutter { growing: 1 });
    assert!(!at(4.29).holds() && at(4.295).holds());
    assert!(at(5.0).holds());
    assert!(at(6.02).holds());
    assert!(matches!(at(6.03), Stability::Divergent { .. }), "{:?}", at(6.03));
    assert!(matches!(at(0.0), Stability::Divergent { .. }), "{:?}", at(0.0));
}

/// The caster shimmies between two speeds.
#[test]
fn shimmy_speeds() {
    let onsets = truth("caster").get("onsets").list();
    let study = Study::<TowedCaster>::new(TowedCaster);
    let found = study.flutter_onset_tolerances(TowedCaster::v, 0.5, 12.0).expect("onsets");
    assert_eq!(found.len(), 2);
    for (found, expected) in found.iter().zip(&onsets) {
        check_event(&study, found, expected);
    }
    for (speed, grows) in [(1.0, false), (4.0, true), (9.0, false)] {
        let modes = study.clone().input(TowedCaster::v, speed).modes().expect("modes");
        let shimmy = modes.modes.iter().find(|mode| mode.s.im > 1.0).expect("shimmy");
        assert_eq!(matches!(shimmy.behaviour, Behaviour::Flutter(_)), grows, "{speed}");
    }
}

/// On a circle smaller than its length the trailer has no steady motion; at exactly that radius its last one folds.
#[test]
fn the_trailer_jackknifes() {
    let study = Study::<CirclingTrailer>::new(CirclingTrailer).input(CirclingTrailer::speed, 0.8);
    let small = study.clone().input(CirclingTrailer::radius, 2.9);
    assert!(matches!(small.equilibrium(), Err(Error::NoEquilibrium { .. })));
    let start = study.input(CirclingTrailer::radius, 4.0).start(CirclingTrailer::swing, -0.8);
    let found = start.branches(CirclingTrailer::radius, 2.5, 6.0).expect("branches");
    let specials = found.branches.iter().flat_map(|branch| &branch.special);
    let folds: Vec<f64> = specials.map(|point| point.value).collect();
    assert!(!folds.is_empty(), "no fold");
    for fold in folds {
        close(fold, 3.0, 0.0, "fold");
    }
}
