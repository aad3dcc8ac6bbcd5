//! Machines that nothing holds, under loads that balance up to rounding: trim is an equilibrium, whatever the decimals.

use eigentol::{Error, Input, Stability, Study};
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
    for _ in 0..300 {
        let mut decimals = |most: f64| (most * (1.0 + 99.0 * random.fraction())).round() / 100.0;
        let [m, n, k] = [decimals(10.0), decimals(10.0), decimals(100.0)];
        let text = balloon([m, n, k]);
        let study = study(&text).input(Input::new(0), 1.0);
        let state = study
            .equilibrium()
            .unwrap_or_else(|error| panic!("{error}\n{text}"));
        assert_eq!(state.stability, Stability::Neutral { zero: 1 }, "{text}");
        let sag = -n * 9.81 / k;
        assert!(
            (state.coordinates[1] - sag).abs() < 1e-12 * sag.abs(),
            "{text}"
        );
        let modes = study.modes().expect("modes");
        let expected = (k / m + k / n).sqrt();
        let frequency = modes.modes[1].s.im;
        assert!(
            (frequency / expected - 1.0).abs() < 1e-12,
            "{frequency} {expected}"
        );
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

/// Loads whose decimals add up to nothing, written one by one and spread along a beam.
#[test]
fn loads_that_cancel() {
    let mut random = RandomNumbers::new(2, 0);
    for _ in 0..40 {
        let mut decimals = || (1.0 + 98.0 * random.fraction()).round() / 10.0;
        let (a, b) = (decimals(), decimals());
        let sum = format!("{:.1}", a + b);
        let text = format!(
            "mechanism Pulled {{ input p: N; body a: point(mass: 1 kg); body b: point(mass: 1 kg);
             joint x: prismatic(x) from ground to a; joint y: prismatic(x) from a to b;
             force s: spring(on: y, stiffness: 10 N/m); point t: a;
             force f: load(at: t, force: [{a}, 0, 0] * p); force g: load(at: t, force: [{b}, 0, 0] * p);
             force h: load(at: t, force: [-{sum}, 0, 0] * p); }}"
        );
        for load in [1.0, 0.3, 700.0] {
            let study = study(&text).input(Input::new(0), load);
            let state = study
                .equilibrium()
                .unwrap_or_else(|error| panic!("{error}\n{text}"));
            assert_eq!(state.stability, Stability::Neutral { zero: 1 }, "{text}");
        }
    }
    for bending in 1..9 {
        let text = format!(
            "mechanism Pushed {{ input p: N;
             body b: beam(length: 1 m, along: x, up: z, mass_per_length: 1 kg/m, stiffness_y: 100 N*m^2, bending_y: {bending});
             joint c: prismatic(x) from ground to b; point t: b at tip;
             force f: load(at: t, force: [-1, 0, 0] * p);
             force g: distributed(on: b, force: [1, 0, 0] * p / (1 m)); }}"
        );
        let study = study(&text).input(Input::new(0), 1.0);
        let state = study
            .equilibrium()
            .unwrap_or_else(|error| panic!("{error}\n{text}"));
        assert_eq!(state.stability, Stability::Neutral { zero: 1 }, "{text}");
    }
}
