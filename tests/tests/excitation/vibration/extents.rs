//! Semi-axes of orbits, sums and root mean squares over excitations, and vibrations over limits that follow the speed: against
//! the closed form of a disk on two springs, differentiated by differences.

use eigentol::forced::Extent;
use eigentol::requirement::Requirement;
use eigentol::response::{Response, Responses, Vibration};
use eigentol::{DesignVariable, Error, Excitation, Input, Output, Study};
use eigentol_interpreter::{Interpreted, requirement, requirements, response, vibration};

const MACHINE: &str = "mechanism Plane {
    input speed: rad/s;
    design m = 12 kg +/- 0.1%;
    design kx = 1.9e6 N/m +/- 0.1%;
    design ky = 2.6e6 N/m +/- 0.1%;
    design c = 310 N*s/m +/- 0.1%;
    design e = 0.04 mm +/- 0.1%;
    design push = 3 N +/- 0.1%;
    body carriage: massless;
    body shuttle: massless;
    body disk: disk(mass: m, radius: 0.2 m, axis: z);
    joint x: prismatic(x) from ground to carriage;
    joint y: prismatic(y) from carriage to shuttle;
    joint spin: revolute(z) from shuttle to disk, driven at speed;
    force shaft_x: spring(on: x, stiffness: kx);
    force oil_x: damper(on: x, damping: c);
    force shaft_y: spring(on: y, stiffness: ky);
    force oil_y: damper(on: y, damping: c);
    unbalance u: on disk, eccentricity: e;
    force gust: harmonic(on: x, force: push, frequency: 2.5 * speed);
    output side = x; output up = y;
}";

/// The value of an extent at a speed and a design, from squares of lengths in place of parts that turn.
fn exact(text: &str, w: f64, design: &[f64]) -> f64 {
    let &[m, kx, ky, c, e, push] = design else { panic!("six variables") };
    // Square of the dynamic stiffness at a frequency, and its real and imaginary part.
    let stiffness = |k: f64, w: f64| [k - m * w * w, c * w];
    let square = |k, w| stiffness(k, w).map(|x| x * x).iter().sum::<f64>();
    let force = m * e * w * w;
    let (x, y) = (force * force / square(kx, w), force * force / square(ky, w));
    let gust = push * push / square(kx, 2.5 * w);
    // X^2 + Y^2 with Y late by a quarter of a turn: 1 / Dx^2 - 1 / Dy^2, as (Dy - Dx) (Dy + Dx) / (Dx Dy)^2.
    let ([ax, b], [ay, _]) = (stiffness(kx, w), stiffness(ky, w));
    let sum = (ax + ay).hypot(2.0 * b) * (ay - ax).abs() * force * force / (square(kx, w) * square(ky, w));
    match text {
        "major(side, up) under u" => ((x + y + sum) / 2.0).sqrt(),
        // The area of the ellipse over the other axis: a difference would lose digits.
        "minor(side, up) under u" => {
            let area = (ax * ay + b * b).abs() * force * force / (square(kx, w) * square(ky, w));
            area / ((x + y + sum) / 2.0).sqrt()
        }
        "side under all" => x.sqrt() + gust.sqrt(),
        "side under all as rms" => ((x + gust) / 2.0).sqrt(),
        "side under u over its limit" => x.sqrt() / limit(w),
        "velocity side under u over its limit" => w * x.sqrt() / limit(w),
        _ => panic!("{text}"),
    }
}

/// 25.4 um times the root of 12,000 rpm over the speed, m.
fn limit(w: f64) -> f64 {
    25.4e-6 * (12_000.0 * core::f64::consts::PI / 30.0 / w).sqrt()
}

const TEXTS: [&str; 4] =
    ["major(side, up) under u", "minor(side, up) under u", "side under all", "side under all as rms"];

fn study(speed: f64) -> Study<Interpreted> {
    let machine = Interpreted::from_text(MACHINE).expect("a declaration");
    Study::new(machine).input(Input::new(0), speed)
}

fn named(study: &Study<Interpreted>, text: &str) -> Vibration {
    vibration(study, text).expect(text)
}

fn at(study: Study<Interpreted>, design: &[f64]) -> Study<Interpreted> {
    let each = design.iter().enumerate();
    each.fold(study, |study, (k, value)| study.design(DesignVariable::new(k), *value))
}

/// The first derivative of a function along a variable, by differences of fourth order.
fn slope(f: &dyn Fn(f64) -> f64, at: f64, step: f64) -> f64 {
    let h = step * at;
    (8.0 * (f(at + h) - f(at - h)) - (f(at + 2.0 * h) - f(at - 2.0 * h))) / (12.0 * h)
}

fn designs() -> Vec<Vec<f64>> {
    let nominal = [12.0, 1.9e6, 2.6e6, 310.0, 4e-5, 3.0];
    let mut state = 3_u64;
    let mut pick = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        0.7 + 0.6 * (state >> 33) as f64 / (1_u64 << 31) as f64
    };
    let random = (0..6).map(|_| nominal.iter().map(|value| value * pick()).collect());
    [nominal.to_vec()].into_iter().chain(random).collect()
}

fn close(found: f64, expected: f64, size: f64, tolerance: f64, name: &str) {
    assert!((found - expected).abs() <= tolerance * expected.abs().max(size), "{name}: {found} {expected}");
}

#[test]
fn values_and_both_derivatives_are_exact() {
    for design in designs() {
        for speed in [130.0, 410.0, 600.0] {
            let study = at(study(speed), &design);
            for text in TEXTS {
                let own = named(&study, text);
                let state = study.equilibrium().expect("a state");
                let all = own.quadratic(study.mechanism(), &state).expect("derivatives").expect("smooth");
                let ((value, first), second) = all;
                close(value, exact(text, speed, &design), 0.0, 1e-11, text);
                assert_eq!(own.of(&study.forced_response().expect("a response")), Some(value));
                let moved = |i: usize, by: f64| {
                    let mut moved = design.clone();
                    moved[i] = by;
                    moved
                };
                for i in 0..design.len() {
                    let name = format!("{text} by {i}");
                    let along = |x: f64| exact(text, speed, &moved(i, x));
                    let size = 1e-3 * value / design[i];
                    close(first.by_design[i], slope(&along, design[i], 2e-4), size, 1e-7, &name);
                    for j in 0..design.len() {
                        let inner = |x: f64, y: f64| {
                            let mut both = moved(i, x);
                            both[j] = y;
                            exact(text, speed, &both)
                        };
                        let by_j = |x: f64| slope(&|y| inner(x, y), design[j], 2e-3);
                        let expected = match i == j {
                            // A step away, the inner derivative would be along the outer variable itself.
                            true => slope(&|x| slope(&along, x, 2e-3), design[i], 2e-3),
                            false => slope(&by_j, design[i], 2e-3),
                        };
                        let size = 1e-2 * value / (design[i] * design[j]);
                        close(second.by_design[i][j], expected, size, 1e-4, &format!("{name} and {j}"));
                    }
                }
                let along = |w: f64| exact(text, w, &design);
                close(first.by_input[0], slope(&along, speed, 2e-4), 1e-3 * value / speed, 1e-6, text);
            }
        }
    }
}

#[test]
fn peaks_are_where_the_closed_form_is_greatest() {
    for design in designs() {
        let study = at(study(300.0), &design);
        for text in ["major(side, up) under u", "side under all", "side under all as rms"] {
            let found = study.peaks(named(&study, text), Input::new(0), 100.0, 700.0).expect("peaks");
            let curve = |w: f64| exact(text, w, &design);
            let grid: Vec<f64> = (0..=60_000).map(|k| 100.0 + 0.01 * f64::from(k)).collect();
            let tops: Vec<f64> = (grid.windows(3))
                .filter(|w| curve(w[1]) > curve(w[0]) && curve(w[1]) >= curve(w[2]))
                .map(|w| golden(&curve, w[0], w[2]))
                .collect();
            assert_eq!(found.peaks.len(), tops.len(), "{text} {tops:?}");
            for (peak, top) in found.peaks.iter().zip(tops) {
                close(peak.place.value, top, 0.0, 1e-7, text);
                close(peak.height.value, curve(top), 0.0, 1e-10, text);
                assert_eq!(peak.phase, None);
                for (i, own) in design.iter().enumerate() {
                    let along = |x: f64| {
                        let mut moved = design.clone();
                        moved[i] = x;
                        exact(text, top, &moved)
                    };
                    let size = 1e-2 * curve(top) / own;
                    close(peak.height.by_design[i], slope(&along, *own, 1e-4), size, 1e-5, text);
                }
            }
        }
    }
}

/// The place of the greatest value between two.
fn golden(f: &dyn Fn(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    let ratio = (5.0_f64.sqrt() - 1.0) / 2.0;
    for _ in 0..60 {
        let [a, b] = [high - ratio * (high - low), low + ratio * (high - low)];
        if f(a) > f(b) { high = b } else { low = a }
    }
    0.5 * (low + high)
}

#[test]
fn spreads_are_those_of_the_derivatives() {
    let study = study(380.0).samples(4000);
    let wanted = TEXTS.map(|text| named(&study, text));
    let found = study.vibration_spread(&wanted).expect("spreads");
    for (text, spread) in TEXTS.iter().zip(&found.spreads) {
        let design = study.design_values();
        let squares = design.iter().enumerate().map(|(i, own)| {
            let along = |x: f64| {
                let mut moved = design.to_vec();
                moved[i] = x;
                exact(text, 380.0, &moved)
            };
            (slope(&along, *own, 1e-3) * own * 1e-3 / 3.0).powi(2)
        });
        let sigma = spread.as_ref().and_then(|spread| spread.sigma.as_ref()).expect("a sigma").value;
        close(sigma, squares.sum::<f64>().sqrt(), 0.0, 0.05, text);
    }
}

/// A response at the nominal design of a study.
fn value(study: &Study<Interpreted>, wanted: Response) -> f64 {
    let (state, modes) = (study.equilibrium().expect("a state"), study.modes().expect("modes"));
    let all = Responses::new(study.mechanism(), &state, &modes, vec![wanted]).expect("responses");
    all.at(&mut all.workspace(), &state.design).expect("a realisation").values[0].expect("a value")
}

#[test]
fn limits_that_follow_the_speed_hold_along_it() {
    let study = study(300.0);
    let api = "25.4 um * sqrt(12000 rpm / speed)";
    for (text, name) in [
        ("vibration side under u along speed=100..700rad/s", "side under u over its limit"),
        ("velocity side under u along speed=100..700rad/s", "velocity side under u over its limit"),
    ] {
        let api = if text.starts_with("velocity") { format!("1 1/s * {api}") } else { api.to_owned() };
        for (suffix, factor) in [("", 1.0), (" p-p", 2.0), (" rms", 0.5_f64.sqrt())] {
            let wanted = requirement(&study, &format!("{text} <= {api}{suffix}")).expect(text);
            let Requirement::Within { response: own, high: 1.0, .. } = wanted else { panic!("{wanted:?}") };
            let design = study.design_values();
            let greatest = (0..600_000).map(|k| exact(name, 100.0 + 0.001 * f64::from(k), design));
            close(value(&study, own), factor * greatest.fold(0.0, f64::max), 0.0, 1e-7, text);
            assert!(wanted.text(study.description()).contains("side under u over its limit"));
        }
    }
    for wrong in [
        "vibration side under u along speed=100..700rad/s <= 1 mm - 1 um * speed / 1 rad/s",
        "vibration side under all along speed=100..700rad/s <= 25.4 um * sqrt(12000 rpm / speed)",
        "peak side under u along speed=100..700rad/s <= 2 * speed",
    ] {
        let refused = requirement(&study, wrong).expect_err(wrong).to_string();
        assert!(refused.contains("`speed` varies in this range"), "{refused}");
    }
}

#[test]
fn words_say_what_is_meant() {
    let study = study(300.0);
    let design = study.design_values();
    let (rms, sum) = ("side under all as rms", "side under all");
    for (text, meant, high) in [
        ("vibration side under all <= 3 mm rms", rms, 3e-3),
        ("vibration side under all as rms <= 3 mm", rms, 3e-3),
        ("vibration side under all as rms <= 3 mm rms", rms, 3e-3),
        ("vibration side under all <= 3 mm p-p", sum, 1.5e-3),
        ("vibration major(side, up) under u <= 40 um p-p", TEXTS[0], 20e-6),
        ("vibration minor( side,up ) under u <= 40 um", TEXTS[1], 40e-6),
    ] {
        let Ok(Requirement::Within { response: own, high: limit, .. }) = requirement(&study, text) else {
            panic!("{text}")
        };
        close(limit, high, 0.0, 1e-12, text);
        close(value(&study, own), exact(meant, 300.0, design), 0.0, 1e-11, text);
    }
    let both = "max(vibration major(side, up) under u, vibration side under gust) <= 3 mm";
    assert_eq!(requirements(&study, both).expect("two").len(), 2);
    for wrong in [
        "vibration major(side) under u <= 1 mm",
        "vibration major(side, up) under all <= 1 mm",
        "vibration side under u as rms <= 1 mm",
        "vibration side under all as rms <= 1 mm p-p",
        "vibration major(side, down) under u <= 1 mm",
    ] {
        assert!(requirement(&study, wrong).is_err(), "{wrong}");
    }
}

#[test]
fn a_band_may_be_stated_about_the_nominal_value() {
    let study = study(300.0);
    for (text, middle, share) in [
        ("frequency 1 within 1%", (1.9e6_f64 / 12.0).sqrt(), 0.01),
        ("frequency 1 within 400 rad/s +/- 2%", 400.0, 0.02),
        ("frequency 1 within 400 rad/s +/- 4 rad/s", 400.0, 0.01),
        (
            "vibration side under u within 5%",
            exact("side under u over its limit", 300.0, study.design_values()) * limit(300.0),
            0.05,
        ),
    ] {
        let Ok(Requirement::Within { low, high, .. }) = requirement(&study, text) else { panic!("{text}") };
        // The frequency is a damped one.
        close(low, middle * (1.0 - share), 0.0, 2e-3, text);
        close(high, middle * (1.0 + share), 0.0, 2e-3, text);
    }
}

/// A variable that turns a circle into an ellipse moves its semi-axes whichever way it goes: no derivative; one that
/// changes both springs has one.
#[test]
fn a_circle_has_the_derivatives_that_exist() {
    let shared = MACHINE.replace("design ky = 2.6e6 N/m +/- 0.1%;", "").replace("stiffness: ky", "stiffness: kx");
    let shared = Study::new(Interpreted::from_text(&shared).expect("a declaration")).input(Input::new(0), 300.0);
    let split = study(300.0).design(DesignVariable::new(2), 1.9e6);
    for text in ["major(side, up) under u", "minor(side, up) under u"] {
        let slopes = named(&shared, text).slopes(&shared.forced_sensitivities().expect("derivatives"));
        let slopes = slopes.expect("smooth").by_design;
        let along = |k: f64| 12.0 * 4e-5 * 9e4 / (k - 12.0 * 9e4).hypot(310.0 * 300.0);
        close(slopes[1], slope(&along, 1.9e6, 1e-3), 0.0, 1e-7, text);
        assert_eq!(named(&split, text).slopes(&split.forced_sensitivities().expect("derivatives")), None);
        let value = named(&split, text).of(&split.forced_response().expect("a response")).expect("an axis");
        close(value, along(1.9e6), 0.0, 1e-10, text);
    }
}

/// What moves on a straight line has no shorter axis; one that a variable would make has no derivative.
#[test]
fn a_straight_line_has_the_derivatives_that_exist() {
    let straight = MACHINE.replace("stiffness: ky", "stiffness: kx").replace("output up = y;", "output up = 2 * x;");
    let still = Study::new(Interpreted::from_text(&straight).expect("a declaration")).input(Input::new(0), 300.0);
    let slopes = named(&still, "minor(side, up) under u").slopes(&still.forced_sensitivities().expect("derivatives"));
    assert!(slopes.expect("smooth").iter().all(|slope| slope == 0.0));
    let bent = straight
        .replace("design push", "design share = 0; design push")
        .replace("output up = 2 * x;", "output up = 2 * x + share * y;");
    let bent = Study::new(Interpreted::from_text(&bent).expect("a declaration")).input(Input::new(0), 300.0);
    let own = named(&bent, "minor(side, up) under u");
    assert_eq!(own.slopes(&bent.forced_sensitivities().expect("derivatives")), None);
    let value = own.of(&bent.forced_response().expect("a response")).expect("an axis");
    assert!(value < 1e-12 * named(&bent, "side under u").of(&bent.forced_response().expect("a response")).unwrap());
}

/// Peaks of a circle are where they are, and state no derivatives that they do not have.
#[test]
fn a_peak_of_a_circle_has_no_derivatives() {
    let split = study(300.0).design(DesignVariable::new(2), 1.9e6);
    let found = split.peaks(named(&split, "major(side, up) under u"), Input::new(0), 100.0, 700.0).expect("peaks");
    let [peak] = &found.peaks[..] else { panic!("one peak: {found}") };
    // As of one output: both axes are its amplitude.
    let alone = split.peaks(named(&split, "side under u"), Input::new(0), 100.0, 700.0).expect("peaks");
    close(peak.place.value, alone.peaks[0].place.value, 0.0, 1e-8, "place");
    close(peak.height.value, alone.peaks[0].height.value, 0.0, 1e-10, "height");
    for moving in [&peak.place, &peak.frequency, &peak.height] {
        assert!(moving.by_design.is_empty() && moving.spread.is_none(), "{found}");
    }
    let text = found.to_string();
    assert!(text.contains("a circle into an ellipse") && !text.contains("NaN"), "{text}");
}

/// Beside a peak of one tone another may be louder: the width is that of the peak's own.
#[test]
fn the_width_of_a_peak_is_of_one_tone() {
    for design in designs() {
        let study = at(study(300.0), &design);
        let found = study.peaks(named(&study, "side under all"), Input::new(0), 100.0, 700.0).expect("peaks");
        for peak in &found.peaks {
            let [Some(before), Some(after)] = peak.half_power.each_ref().map(|half| half.place()) else { continue };
            let factor = peak.place.value / (after.value - before.value);
            close(peak.amplification.as_ref().expect("a factor").value, factor, 0.0, 1e-9, "amplification");
        }
    }
}

#[test]
fn handles_of_another_mechanism_are_refused() {
    let study = study(300.0);
    let own = Vibration::new::<Interpreted>(Output::new(0), Excitation::new(0));
    for wrong in [own.extent(Extent::Major(Output::new(7))), own.extent(Extent::Minor(Output::new(2)))] {
        let refused = study.peaks(wrong, Input::new(0), 100.0, 700.0);
        assert!(matches!(refused, Err(Error::UnknownHandle { .. })), "{refused:?}");
    }
    assert!(response(&study, "vibration major(side, up) under u along speed=100..700rad/s").is_ok());
}
