//! Sweeps of an input, and where something happens along them.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod common;

use common::chain::DOUBLE;
use common::close;
use common::derived::Derived;
use common::models::Spring;
use common::pendulum::Pendulum;
use eigentol::equilibrium::{Range, critical_state, crossings, sweep};
use eigentol::{Error, Input, Policy};

const BAR: [f64; 2] = [3.0, 1.0];
const BARS: [f64; 4] = [1.0, 1.0, 3.0, 3.0];

#[test]
fn sweep_goes_on_past_failures_and_along_the_stable_branch() {
    let values = [2.0, 3.0, f64::NAN, 3.8, 3.9, 5.0];
    let points = sweep(
        &Pendulum,
        &[0.0],
        &BAR,
        &[1.047],
        Policy::Stable,
        Input(0),
        &values,
    )
    .unwrap();
    assert_eq!(points.len(), values.len());
    assert!(matches!(
        points[2].equilibrium,
        Err(Error::NotFinite { .. })
    ));
    let last = points[5].modes.as_ref().unwrap().modes[0]
        .frequency()
        .unwrap();
    close(last, 4.042_122_091_179_335, 1e-13);
    let foreign = sweep(
        &Pendulum,
        &[0.0],
        &BAR,
        &[0.0],
        Policy::Stable,
        Input(3),
        &values,
    );
    assert!(matches!(
        foreign,
        Err(Error::UnknownHandle { index: 3, .. })
    ));
}

#[test]
fn critical_speeds_and_crossings_match_closed_forms() {
    let range = Range {
        input: Input(0),
        low: 0.1,
        high: 5.0,
        steps: 60,
    };
    let single = critical_state(&Pendulum, &[0.0], &BAR, &[1.047], range).unwrap();
    close(single.value, 3.836_013_555_763_326_5, 1e-12);
    let double = critical_state(&DOUBLE, &[0.0], &BARS, &[1.047, 1.047], range).unwrap();
    close(double.value, 2.680_114_012_253_375_3, 1e-12);
    let below = Range { high: 3.0, ..range };
    let none = critical_state(&Pendulum, &[0.0], &BAR, &[1.0], below);
    assert!(matches!(
        none,
        Err(Error::NotInRange { input: "omega", .. })
    ));

    let met = crossings(&Pendulum, &[0.0], &BAR, &[1.0], Policy::Stable, range, 1.0).unwrap();
    assert_eq!(met.len(), 1);
    close(met[0].value, 2.712_471_198_003_769, 1e-13);
    let met = crossings(
        &DOUBLE,
        &[0.0],
        &BARS,
        &[1.0, 1.0],
        Policy::Stable,
        range,
        1.0,
    )
    .unwrap();
    assert_eq!(met[0].mode, 0);
    assert!((met[0].value - 1.8951).abs() < 5e-5);
}

#[test]
fn a_limit_point_is_found_where_the_branch_ends() {
    // k q - q^3 = 1 loses its lower solution where k = 3 q^2 and 2 q^3 = 1.
    let range = Range {
        input: Input(0),
        low: 4.0,
        high: 1.0,
        steps: 20,
    };
    let design = [1.0, -1.0, 1.0];
    let fold = critical_state(&Derived(Spring), &[0.0], &design, &[0.25], range).unwrap();
    close(fold.value, 3.0 * 0.5f64.powf(2.0 / 3.0), 1e-8);
}
