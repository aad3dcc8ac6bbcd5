//! Input that a first-time user of the command types, and the answers.

use std::fs;

use crate::mistakes::refused;
use crate::program::{Run, answer, file, folder, pendulum, run, run_with_input};

const ROTOR: &str = "jeffcott_rotor.mechanism";
const PENDULUM: &str = "rotating_pendulum.mechanism";

/// A command-line mistake whose message contains these parts.
#[track_caller]
fn hinted(arguments: &[&str], parts: &[&str]) {
    refused(arguments, 2, parts);
}

#[test]
fn a_number_without_a_unit_is_answered_in_the_unit_of_the_declaration() {
    hinted(&["modes", ROTOR, "--set", "speed=3000"], &["`3000` has no unit", "for example `3000 rpm`"]);
    hinted(&["campbell", ROTOR, "--sweep", "speed=0..6000"], &["for example `6000 rpm`"]);
    hinted(&["tolerance", ROTOR, "--tol", "seal_x=10"], &["for example `10 kN/m`", "or in per cent: `10%`"]);
    hinted(
        &["modes", ROTOR, "--set", "speed=3000 mm"],
        &["`speed` must be an angular speed (rpm), this is a length (m)"],
    );
}

/// A bare number would be taken as radians.
#[test]
fn degrees_are_written() {
    let folder = folder("degrees");
    let text = "mechanism Tilted { input lean: deg; design tilt = 30 deg; gravity 9.81 m/s^2 along -z;
        body bar: rod(mass: 1 kg, length: 1 m, along: -z);
        joint theta: revolute(y) from ground to bar;
        force turned: spring(on: theta, stiffness: 100 N*m/rad, rest: tilt + lean); }";
    let path = file(&folder, "tilted.mechanism", text);
    hinted(&["modes", &path, "--set", "lean=30"], &["for example `30 deg`"]);
    hinted(&["modes", &path, "--set", "tilt=30"], &["for example `30 deg`"]);
    hinted(&["tolerance", &path, "--tol", "tilt=1"], &["for example `1 deg`", "`1%`"]);
    let lean = |value: &str| answer(&["modes", &path, "--json", "--set", value]);
    assert_eq!(lean("lean=0"), lean("lean=0 deg"));
    assert_ne!(lean("lean=1 rad"), lean("lean=1 deg"));
}

#[test]
fn a_value_without_its_option_is_told_which() {
    for (value, option) in [
        ("omega=5rad/s", "'--set omega=5rad/s'"),
        ("omega=0..8rad/s", "'--sweep omega=0..8rad/s'"),
        ("l=3%", "'--tol l=3%'"),
    ] {
        hinted(&["modes", PENDULUM, value], &["unexpected argument", option]);
    }
    hinted(&["modes", PENDULUM, "--omega", "5rad/s"], &["'--set NAME=VALUE'"]);
    hinted(&["modes", PENDULUM, "--set", "omega", "5rad/s"], &["'--set NAME=5rad/s'"]);
    hinted(&["modes", PENDULUM, "--set", "theta=60deg"], &["`theta` is a coordinate", "`--start`"]);
    hinted(&["modes", PENDULUM, "--start", "omega=5rad/s"], &["`omega` is not a coordinate", "`--set omega=...`"]);
    hinted(&["modes", PENDULUM, "--set", "omega=1,5rad/s"], &["unexpected `,`", "`3.5`, not `3,5`"]);
    // The hint does not hide anything else.
    hinted(&["modes", PENDULUM, "--figur", "a.svg"], &["'--figure'"]);
    let run = run(&["modes", "omega=5rad/s"]);
    assert_eq!(run.code, 3);
    assert!(run.err.contains("`--set omega=5rad/s`"), "{}", run.err);
}

#[test]
fn results_have_the_names_of_the_library() {
    let full = answer(&pendulum("tolerance", &["--result", "first-order tolerances"]));
    for name in ["first_order", "first-order", "First_Order_Tolerances"] {
        assert_eq!(answer(&pendulum("tolerance", &["--result", name])), full);
    }
    let wrong = pendulum("tolerance", &["--result", "sumary"]);
    hinted(&wrong, &["did you mean `summary`?", "there are `first-order tolerances`, `summary`, `output tolerances`"]);
}

#[test]
fn a_folder_or_a_misspelt_name_in_place_of_a_file() {
    let folder = folder("nearby");
    let inside = file(&folder, "rotor.mechanism", "mechanism A {}");
    let place = folder.display().to_string();
    for (path, part) in [
        (place.clone(), format!("name a file in it: `{inside}`")),
        (inside.replace("rotor", "rotr"), format!("did you mean `{inside}`?")),
        (inside.replace(".mechanism", ""), format!("did you mean `{inside}`?")),
    ] {
        let run = run(&["check", &path]);
        assert_eq!(run.code, 3);
        assert!(run.err.contains(&part), "{path}: {}", run.err);
    }
    let far = run(&["check", &inside.replace("rotor", "pendulum")]);
    assert!(!far.err.contains("did you mean"), "{}", far.err);
    fs::remove_file(&inside).unwrap();
    let run = run(&["check", &place]);
    assert!(run.err.contains("this is a folder"), "{}", run.err);
}

#[test]
fn signs_that_no_declaration_has() {
    for (text, parts) in [
        ("mechanism A {\n    design m = 3 kg ± 5%;\n}", ["`±` has no meaning here", "write `+/-`"]),
        ("mechanism A {\n    design a = 30°;\n}", ["`°` has no meaning here", "write `deg`"]),
        ("mechanism A {\n    design a = 3 m²;\n}", ["`²` has no meaning here", "write `^2`"]),
        ("mechanism A {\n    input a: m;\n", ["this `{` is never closed", "come in pairs"]),
        ("mechanism! {\n mechanism A {}\n}", ["the mechanism's name", "without `mechanism! { }`"]),
        ("use eigentol::mechanism;", ["found `use`", "without `use`"]),
    ] {
        let run = run_with_input(&["check", "-"], text);
        assert_eq!(run.code, 3);
        for part in parts {
            assert!(run.err.contains(part), "{text}: {}", run.err);
        }
    }
    hinted(&pendulum("tolerance", &["--tol", "l=±5%"]), &["`±` has no meaning here", "write `+/-`"]);
}

#[test]
fn a_pure_number_has_no_unit() {
    let text = "mechanism Scaled { input share: 1; design factor = 2 +/- 3%; gravity 9.81 m/s^2 along -z;
        body bar: rod(mass: 1 kg, length: 1 m, along: -z);
        joint theta: revolute(y) from ground to bar;
        force held: spring(on: theta, stiffness: factor * 10 N*m/rad, rest: 0.1);
        output twice = 2 * factor + share; }";
    let folder = folder("pure");
    let path = file(&folder, "scaled.mechanism", text);
    let set = ["--set", "share=0.5", "--tol", "share=2%"];
    for command in ["tolerance", "sensitivities"] {
        for form in [&[][..], &["--csv"], &["--csv", "--result", "output"]] {
            let out = run(&[&[command, &path], &set[..], form].concat()).out;
            assert!(!out.contains("[1]") && !out.contains("0.5 1"), "{out}");
        }
    }
    let out = answer(&[&["tolerance", &path], &set[..]].concat());
    assert!(out.contains("Scaled at share = 0.5:") && out.contains("twice"), "{out}");
}

#[test]
fn orders_in_one_word() {
    let campbell = |orders: &[&str]| {
        let sweep = ["--sweep", "speed=2000..4000rpm", "--points", "2"];
        answer(&[&["campbell", ROTOR], &sweep[..], orders].concat())
    };
    assert_eq!(campbell(&["--order", "1,2"]), campbell(&["--order", "1", "--order", "2"]));
}

#[test]
fn beyond_the_ends_of_a_curve_in_the_unit_of_the_curve() {
    let text = "mechanism Film { input speed: rpm;
        curve k: [1000, 2000, 3000] rpm -> [5, 6, 6.5] kN/m;
        body shaft: massless; body block: point(mass: 2 kg);
        joint spin: revolute(z) from ground to shaft, driven at speed;
        joint x: prismatic(z) from shaft to block;
        force spring: spring(on: x, stiffness: k(speed)); }";
    let folder = folder("ends");
    let path = file(&folder, "film.mechanism", text);
    let at = |value: &str| run(&["modes", &path, "--set", value]);
    for (value, end, beyond) in [
        ("speed=500rpm", "k begins at 1000 rpm: its argument minus that (rpm) must be", "but is -500\n"),
        ("speed=5000rpm", "k ends at 3000 rpm: that minus its argument (rpm) must be", "but is -2000\n"),
    ] {
        let Run { code, err, .. } = at(value);
        assert_eq!(code, 1);
        assert!(err.contains(end) && err.ends_with(beyond), "{err}");
    }
    assert_eq!(at("speed=1000rpm").code, 0);
}
