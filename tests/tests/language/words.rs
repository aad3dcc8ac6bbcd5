//! Words of requirements and values as people write them, and declarations with other values.

use eigentol::forced::Measure;
use eigentol::peaks::PeakQuantity;
use eigentol::requirement::Requirement;
use eigentol::response::{Response, Vibration};
use eigentol::sweep::{Condition, Line, Range};
use eigentol::{Excitation, Input, Output, Quantity, Study};
use eigentol_compiler::{compile_text, mechanics::Limits};
use eigentol_interpreter::{Interpreted, requirement, response, rewritten, with_unit_of};

#[test]
fn what_shares_a_line_is_written_only_where_all_agree() {
    let text = "mechanism Pair {
        input tilt: deg;
        design m[0..2] = 2 kg +/- 1%; design k = 8 N/m +0.1 -0.2 N/m;
        body b[0..2]: rod(mass: 1 kg, length: 1 m, along: x);
        for i in 0..2 { joint x[i]: prismatic([cos(tilt), 0, 0]) from ground to b[i];
            force f[i]: spring(on: x[i], stiffness: k * m[i] / 1 kg); }
    }";
    let compilation = compile_text(text, Limits::default()).unwrap();
    let machine = Interpreted::new(&compilation);
    let written = |values: &[(&str, &str)], tolerances: &[(&str, &str)]| {
        let map = |all: &[(&str, &str)]| all.iter().map(|(a, b)| ((*a).to_owned(), (*b).to_owned())).collect();
        rewritten(text, &compilation.ast, machine.description(), &map(values), &map(tolerances))
    };
    let (one, unsaid) = written(&[("m[1]", "3 kg"), ("k", "9 N/m")], &[]);
    assert!(one.contains("design m[0..2] = 2 kg +/- 1%; design k = 9 N/m +0.1 -0.2 N/m;"), "{one}");
    assert_eq!(unsaid, ["m[1]"]);
    let (all, unsaid) = written(&[("m[..]", "3 kg")], &[("tilt", "0.5 deg uniform"), ("m[..]", "one of [2, 3] kg")]);
    assert!(all.contains("design m[0..2] = 3 kg one of [2, 3] kg;"), "{all}");
    assert!(all.contains("input tilt: deg +/- 0.5 deg uniform;"), "{all}");
    assert!(unsaid.is_empty());
    let again = compile_text(&all, Limits::default()).unwrap();
    assert_eq!(Interpreted::new(&again).description().design[1].nominal, 3.0);
}

#[test]
fn the_low_end_takes_the_unit_of_the_high_end() {
    for (low, high, expected) in [
        ("0", "6000rpm", "0 rpm"),
        ("-1e3", "1.5e3 rad/s", "-1e3 rad/s"),
        ("10Hz", "6000rpm", "10Hz"),
        ("1", "2", "1 "),
        ("1", "rpm", "1 rpm"),
    ] {
        assert_eq!(with_unit_of(low, high), expected);
    }
}

fn shaken() -> Study<Interpreted> {
    let text = "mechanism Shaken {
        input load: N; input speed: rad/s;
        body block: point(mass: 2 kg);
        joint x: prismatic(x) from ground to block;
        force shaft: spring(on: x, stiffness: 800 N/m);
        force gust: harmonic(on: x, force: load, frequency: speed);
        force blow: harmonic(on: x, force: load, frequency: 2 * speed);
        output twice = 2 * x; output place = x;
    }";
    Study::new(Interpreted::from_text(text).expect("a mechanism"))
}

/// Words for a response, with what they mean and the unit of its limits.
fn said(pick: &mut dyn FnMut(usize) -> usize) -> (String, Response, &'static str) {
    let (low, high) = (1.0 + pick(9) as f64, 20.0 + pick(9) as f64);
    let range = Range::new(Input::new(1), low, high);
    let along = format!("speed={low}..{high}rad/s");
    let (number, order) = (pick(3), 1.0 + pick(4) as f64 / 2.0);
    let (name, output) = [("twice", 0), ("place", 1)][pick(2)];
    let (under, excitation) = [("gust", 0), ("blow", 1)][pick(2)];
    let (word, measure, unit) = [
        ("displacement", Measure::Displacement, "m"),
        ("velocity", Measure::Velocity, "m/s"),
        ("acceleration", Measure::Acceleration, "m/s^2"),
    ][pick(3)];
    let mut clauses = [format!("under {under}"), format!("as {word}"), format!("along {along}")];
    let vibration = Vibration::new(Output::new(output), Excitation::<eigentol::Any>::new(excitation)).measure(measure);
    let crossing = |condition| Response::Crossing { mode: number, condition, range };
    let mode = |quantity| Response::Mode { mode: number, quantity };
    let peak = |quantity| Response::Peak { vibration, range, quantity };
    let number = number + 1;
    match pick(9) {
        0 => (format!("frequency {number}"), mode(Quantity::Frequency), "rad/s"),
        1 if pick(2) == 0 => (format!("log_decrement {number}"), mode(Quantity::LogDecrement), ""),
        1 => (format!("damping_ratio {number}"), mode(Quantity::DampingRatio), ""),
        2 => (format!("growth {number}"), mode(Quantity::Growth), "1/s"),
        3 => (name.to_owned(), Response::Output(Output::new(output)), "m"),
        4 => (format!("critical {along}"), Response::Critical(range), "rad/s"),
        5 => {
            let line = Condition::Line(Line::from(order));
            (format!("resonance {number} {along} order {order}"), crossing(line), "rad/s")
        }
        6 => (format!("flutter {number} {along}"), crossing(Condition::FlutterOnset), "rad/s"),
        7 => {
            let text = format!("vibration {name} {} {}", clauses[0], clauses[1]);
            (text, Response::Vibration(vibration), unit)
        }
        _ => {
            // Clauses stand in any order.
            clauses.rotate_left(pick(3));
            let (what, of, unit) =
                [("vibration", PeakQuantity::Height, unit), ("peak", PeakQuantity::Place, "rad/s")][pick(2)];
            (format!("{what} {name} {}", clauses.join(" ")), peak(of), unit)
        }
    }
}

#[test]
fn limits_are_as_the_standards_state_them() {
    let study = shaken().input(Input::new(1), 100.0);
    let limit = |text: &str| match requirement(&study, text) {
        Ok(Requirement::Within { high, .. }) => high,
        other => panic!("{text}: {other:?}"),
    };
    let close = |a: f64, b: f64| assert!((a - b).abs() < 1e-12 * b, "{a} {b}");
    close(limit("velocity place under gust <= 4.5 mm/s rms"), 4.5e-3 * 2.0_f64.sqrt());
    close(limit("vibration place under gust <= 60 um p-p"), 30e-6);
    close(limit("vibration place under gust <= 60 um peak to peak"), 30e-6);
    // API 617: 25.4 um times the root of 12,000 rpm over the speed, peak to peak.
    let api = 25.4e-6 * (12_000.0 * std::f64::consts::PI / 30.0 / 100.0).sqrt();
    close(limit("vibration place under gust <= 25.4 um * sqrt(12000 rpm / speed) p-p"), 0.5 * api);
    assert!(requirement(&study, "place <= 3 mm p-p").is_err(), "an output at rest has no peaks");
    let along = "peak place under gust along speed=1..9rad/s <= 2 * speed";
    let refused = requirement(&study, along).unwrap_err().to_string();
    assert!(refused.contains("`speed` varies in this range"), "{refused}");
}

/// Every form with every limit, put together at random: what is read is what was meant.
#[test]
fn random_requirements_arrive_as_written() {
    let study = shaken();
    let mut state = 7_u64;
    let mut pick = |count: usize| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as usize % count
    };
    for _ in 0..500 {
        let (words, meant, unit) = said(&mut pick);
        assert_eq!(response(&study, &words).expect(&words), meant, "{words}");
        let (low, high) = (pick(100) as f64 / 8.0, 20.0 + pick(100) as f64);
        let open = f64::INFINITY;
        let (limit, expected) = match pick(5) {
            0 => (format!(">= {low} {unit}"), Requirement::Within { response: meant, low, high: open }),
            1 => (format!("<={high} {unit}"), Requirement::Within { response: meant, low: -open, high }),
            2 => (format!("within {low}..{high} {unit}"), Requirement::Within { response: meant, low, high }),
            3 => (format!("outside {low}..{high} {unit}"), Requirement::Outside { response: meant, low, high }),
            _ => {
                let (order, fraction, input) = (1.0 + pick(3) as f64, 0.125, Input::new(1));
                let away = Requirement::Away { response: meant, input, order, fraction };
                (format!("away from {order} speed by 12.5%"), away)
            }
        };
        let text = format!("{words} {limit}");
        assert_eq!(requirement(&study, &text).expect(&text), expected, "{text}");
        // A word too many, or too few, is no requirement.
        assert!(requirement(&study, &format!("the {text} now")).is_err(), "{text}");
        assert!(requirement(&study, &words).is_err(), "{words}");
    }
}
