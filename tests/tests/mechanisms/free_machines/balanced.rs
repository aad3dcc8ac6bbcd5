//! Machines that nothing holds, under loads that balance up to rounding: trim is an equilibrium, whatever the decimals.

use eigentol::{Coordinate, Error, Input, Stability, Study};
use eigentol_interpreter::Interpreted;
use eigentol_statistics::random::RandomNumbers;

fn study(text: &str) -> Study<Interpreted> {
    Study::new(Interpreted::from_text(text).unwrap_or_else(|error| panic!("{error}\n{text}")))
}

/// A balloon with a basket on a spring, and lift as a share of the weight.
fn balloon([balloon, basket, stiffness]: [f64; 3]) -> String {
    format!(
        "mechanism Balloon {{
            input share: 1; design g = 9.81 m/s^2; design m = {balloon} kg; design n = {basket} kg;
            gravity [0, 0, -1] * g;
            body envelope: point(mass: m); body basket: point(mass: n);
            joint z: prismatic(z) from ground to envelope; joint y: prismatic(z) from envelope to basket;
            force rope: spring(on: y, stiffness: {stiffness} N/m);
            point top: envelope;
            force lift: load(at: top, force: [0, 0, 1] * g * (m + n) * share); }}"
    )
}

#[test]
fn lift_that_equals_weight() {
    let mut random = RandomNumbers::new(1, 0);
    for _ in 0..60 {
        let mut decimals = |most: f64| (most * (1.0 + 99.0 * random.fraction())).round() / 100.0;
        let [m, n, k] = [decimals(10.0), decimals(10.0), decimals(100.0)];
        let text = balloon([m, n, k]);
        let study = study(&text).input(Input::new(0), 1.0);
        let state = study.equilibrium().unwrap_or_else(|error| panic!("{error}\n{text}"));
        assert_eq!(state.stability, Stability::Neutral { zero: 1 }, "{text}");
        let sag = -n * 9.81 / k;
        assert!((state.coordinates[1] - sag).abs() < 1e-12 * sag.abs(), "{text}");
        let modes = study.modes().expect("modes");
        let expected = (k / m + k / n).sqrt();
        let frequency = modes.modes[1].s.im;
        assert!((frequency / expected - 1.0).abs() < 1e-12, "{frequency} {expected}");
    }
}

/// A body with flexible arms whose tips are pulled up by the weight of all: it may stand anywhere and face anywhere.
fn drone(mass: f64) -> String {
    let arm = |name: &str, along: &str, sign: &str| {
        format!(
            "body {name}: beam(length: 0.2 m, along: {along}, up: z, mass_per_length: 0.1 kg/m,
                stiffness_y: 1 N*m^2, bending_y: 3);
            joint root_{name}: fixed from hub to {name} at [{sign}0.15, 0, 0] m;
            point tip_{name}: {name} at tip;
            force lift_{name}: load(at: tip_{name}, force: [0, 0, 1] * (m + 0.04 kg) * g / 2);"
        )
    };
    format!(
        "mechanism Drone {{
            design m = {mass:.2} kg; design g = 9.81 m/s^2;
            gravity [0, 0, -1] * g;
            body hub: box(mass: m, size: [0.3, 0.3, 0.05] m);
            joint fly: free(px: x, py: y, pz: z, a: x, b: y, c: z) from ground to hub;
            {} {} }}",
        arm("right", "x", ""),
        arm("left", "-x", "-")
    )
}

/// Rounding that resists a motion along which nothing depends on the place is no stiffness: the search does not run away
/// along it, and its mode is free.
#[test]
fn machines_float_where_they_are() {
    for k in 0..8_u32 {
        let text = drone(1.0 + 0.07 * f64::from(k));
        let study = study(&text);
        let state = study.equilibrium().unwrap_or_else(|error| panic!("{error}\n{text}"));
        assert_eq!(state.stability, Stability::Neutral { zero: 4 }, "{text}");
        let far = state.coordinates.iter().all(|value| value.abs() < 2.0);
        assert!(far, "{:?}\n{text}", state.coordinates);
        let there = [(0, 3.0), (1, -2.0), (5, 0.7)].into_iter();
        let there = there.fold(study.clone(), |study, (unknown, value)| study.start(Coordinate::new(unknown), value));
        let [here, there] = [&study, &there].map(|study| {
            let modes = study.modes().unwrap_or_else(|error| panic!("{error}\n{text}"));
            modes.frequencies()
        });
        for (k, (here, there)) in here.iter().zip(&there).enumerate() {
            match (here, there) {
                (Some(here), Some(there)) => {
                    assert!((here / there - 1.0).abs() < 1e-9, "{here} {there}\n{text}");
                }
                _ => assert!(here.is_none() && there.is_none() && k < 4, "{text}"),
            }
        }
    }
}

/// However little is missing beyond rounding, nothing balances it.
#[test]
fn lift_that_is_not_weight() {
    for share in [1.0 - 1e-13, 1.0 + 1e-9, 0.5] {
        let study = study(&balloon([2.3, 1.7, 40.0])).input(Input::new(0), share);
        let failure = study.equilibrium().expect_err("no balance");
        assert!(matches!(failure, Error::NoEquilibrium { .. }), "{failure}");
    }
}
