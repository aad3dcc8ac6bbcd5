//! Machines by strangers (`tests/truth/strangers`): what they expect, computed outside the project or published, in the
//! table or the text of the command.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use serde::Deserialize;

use crate::program::{Run, run};

#[derive(Deserialize)]
struct Case {
    name: String,
    file: String,
    command: String,
    #[serde(default)]
    arguments: Vec<String>,
    /// Expected numbers of columns of the table.
    #[serde(default)]
    columns: BTreeMap<String, Vec<f64>>,
    /// Expected words of a line of the text, separated by `&`.
    #[serde(default)]
    text: Vec<String>,
    /// Words that no line of the text has.
    #[serde(default)]
    absent: Vec<String>,
    /// Smaller numbers are left out.
    #[serde(default)]
    ignore: f64,
    /// The numbers are among those of the column, in any order.
    #[serde(default)]
    among: bool,
    /// The numbers are the first of the column.
    #[serde(default)]
    first: bool,
    /// The 95 % interval of the table holds them.
    #[serde(default)]
    inside: bool,
    #[serde(default)]
    relative: f64,
}

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/truth/strangers")
}

fn column(table: &str, name: &str) -> Result<Vec<f64>, String> {
    let mut rows = table.lines().filter(|line| !line.starts_with('#'));
    let head: Vec<&str> = rows.next().unwrap_or("").split(',').collect();
    let place = head.iter().position(|x| x.trim_matches('"') == name);
    let place = place.ok_or_else(|| format!("no column {name} among {head:?}"))?;
    let numbers = rows.filter_map(|row| row.split(',').nth(place)?.parse().ok());
    Ok(numbers.collect())
}

impl Case {
    fn run(&self, more: &[&str]) -> Run {
        let file = folder().join(&self.file);
        let mut arguments = vec![self.command.clone(), file.display().to_string()];
        arguments.extend(self.arguments.iter().cloned());
        arguments.extend(more.iter().map(|x| (*x).to_owned()));
        run(&arguments.iter().map(String::as_str).collect::<Vec<_>>())
    }

    fn check(&self) -> Result<(), String> {
        if !self.columns.is_empty() {
            let run = self.run(&["--csv"]);
            for (name, expected) in &self.columns {
                column(&run.out, name)
                    .map(|found| found.into_iter().filter(|x| x.abs() >= self.ignore).collect())
                    .and_then(|found: Vec<f64>| self.compare(&found, expected))
                    .and_then(|()| self.hold(&run.out, expected))
                    .map_err(|what| format!("{name}: {what}\n{}{}", run.out, run.err))?;
            }
        }
        if !self.text.is_empty() || !self.absent.is_empty() {
            let run = self.run(&[]);
            for word in &self.absent {
                if run.out.is_empty() || run.out.contains(word) {
                    return Err(format!("{word}\n{}{}", run.out, run.err));
                }
            }
            for words in &self.text {
                let has = |line: &str| words.split('&').all(|word| line.contains(word));
                if !run.out.lines().any(has) {
                    return Err(format!("no line with {words}\n{}{}", run.out, run.err));
                }
            }
        }
        Ok(())
    }

    fn hold(&self, table: &str, expected: &[f64]) -> Result<(), String> {
        if !self.inside {
            return Ok(());
        }
        let (low, high) = (column(table, "95 % from")?, column(table, "95 % to")?);
        let mut ends = low.iter().zip(&high).zip(expected);
        match ends.all(|((low, high), x)| (low..=high).contains(&x)) {
            true => Ok(()),
            false => Err(format!("{expected:?} not in {low:?} to {high:?}")),
        }
    }

    fn compare(&self, values: &[f64], expected: &[f64]) -> Result<(), String> {
        let near = |a: f64, b: f64| (a - b).abs() <= self.relative * b.abs();
        let right = if self.among {
            expected.iter().all(|x| values.iter().any(|other| near(*other, *x)))
        } else {
            let all = values.len() == expected.len() || self.first && values.len() > expected.len();
            all && values.iter().zip(expected).all(|(a, b)| near(*a, *b))
        };
        match right {
            true => Ok(()),
            false => Err(format!("{values:?}, not {expected:?}")),
        }
    }
}

#[test]
fn machines_of_strangers_give_what_they_expect() {
    let cases = std::fs::read_to_string(folder().join("cases.json")).unwrap();
    let cases: Vec<Case> = serde_json::from_str(&cases).unwrap();
    let failed: Vec<String> =
        (cases.iter()).filter_map(|case| Some(format!("{}: {}", case.name, case.check().err()?))).collect();
    assert!(failed.is_empty(), "{}", failed.join("\n\n"));
}

fn declared(name: &str, text: &str, arguments: &[&str]) -> String {
    let folder = crate::program::folder(name);
    let file = crate::program::file(&folder, "it.mechanism", text);
    let run = run(&[&[arguments[0], &file], &arguments[1..]].concat());
    assert!(run.err.is_empty(), "{}", run.err);
    run.out
}

/// A rod that may spin inside a stiff leg has a free motion, not a frequency of rounding.
#[test]
fn a_rod_that_spins_freely_in_a_stiff_leg_is_free() {
    let text = "mechanism Leg {
        body leg: cylinder(mass: 5 kg, radius: 5 cm, length: 0.5 m, axis: [1, 2, 2]);
        body rod: cylinder(mass: 1 kg, radius: 1 cm, length: 0.5 m, axis: [1, 2, 2]);
        joint hip: universal(a: x, b: y) from ground to leg;
        joint spin: revolute([1, 2, 2]) from leg to rod;
        force ka: spring(on: a, stiffness: 1e9 N*m/rad); force kb: spring(on: b, stiffness: 1e9 N*m/rad); }";
    let out = declared("free_rod", text, &["modes"]);
    let rows: Vec<&str> = out.lines().filter(|line| line.contains("free")).collect();
    assert_eq!(rows.len(), 2, "{out}");
    assert!(rows[0].trim_start().starts_with("1 "), "{out}");
    assert!(rows[1].contains("neutral (one free direction)"), "{out}");
}

/// Modes that are equal by symmetry in every design are not called mixed.
#[test]
fn modes_equal_by_symmetry_share_a_spread() {
    let text = "mechanism Stalk {
        design k = 1e3 N*m/rad +/- 5%; design m = 5 kg +/- 1%;
        body stalk: rigid(mass: m, inertia: [0.1, 0.1, 0.02] kg*m^2, center: [0, 0, 0.5 m]);
        joint hip: universal(a: x, b: y) from ground to stalk;
        force ka: spring(on: a, stiffness: k); force kb: spring(on: b, stiffness: k); }";
    let out = declared("stalk", text, &["tolerance"]);
    assert!(out.contains("no tolerance splits modes 1 and 2"), "{out}");
    assert!(out.contains("modes 1 and 2 are equal in every design"), "{out}");
    assert!(!out.contains("standard deviations apart"), "{out}");
}

/// A rod that goes round at twice the input on a shaft without torque; the shaft and its speed are free.
const CONICAL: &str = "mechanism Conical {
    input w: rad/s; design l = 0.8 m; gravity 9.81 m/s^2 along -z;
    body shaft: rigid(mass: 1 kg, inertia: [0.1, 0.1, 0.1] kg*m^2);
    body bar: rod(mass: 1 kg, length: l, along: -z);
    joint spin: revolute(z) from ground to shaft, coasting;
    joint tilt: revolute(y) from shaft to bar;
    steady spin = 2 * w; }";

/// A free motion is named once, not by numbers that it does not have.
#[test]
fn free_modes_are_named_once() {
    let arguments = ["sensitivities", "--set", "w=4rad/s", "--start", "tilt=0.9rad"];
    let out = declared("free_once", CONICAL, &arguments);
    assert!(out.contains("Mode 1 is free"), "{out}");
    assert!(!out.contains("growth1"), "{out}");
    assert!(!out.contains("No derivative"), "{out}");
}

/// Ends of branches are named by their values, whatever the direction.
#[test]
fn ends_of_branches_have_the_names_of_their_values() {
    let text = "mechanism Line { input u: N; body p: point(mass: 1 kg);
        joint x: prismatic(x) from ground to p; force s: spring(on: x, stiffness: 9 N/m);
        force f: generalized(on: x, value: u); }";
    for (range, words) in [
        ("u=0..2N", "low end of the range to high end of the range"),
        ("u=2..0N", "high end of the range to low end of the range"),
    ] {
        let out = declared("line_ends", text, &["branches", "--sweep", range]);
        assert!(out.contains(words), "{out}");
    }
}

/// Modes are numbered as their frequencies say, whatever their damping; motions without one come first. Equal frequencies
/// are in the order of `|s|`.
#[test]
fn modes_are_sorted_as_their_numbers_say() {
    // Frequency and growth of each mode of two oscillators, of which the second is damped.
    let modes = |damping: f64, stiffness: f64| -> Vec<[f64; 2]> {
        let text = format!(
            "mechanism Damped {{ body p: point(mass: 1 kg); body q: point(mass: 1 kg);
             joint x: prismatic(x) from ground to p; joint y: prismatic(x) from ground to q;
             force kx: spring(on: x, stiffness: 101633 N/m); force ky: spring(on: y, stiffness: {stiffness} N/m);
             force dy: damper(on: y, damping: {damping} N*s/m); }}"
        );
        let out = declared(&format!("damped_{damping}_{stiffness}"), &text, &["modes"]);
        let cells = |row: &str| -> Vec<String> { row.split_whitespace().map(str::to_owned).collect() };
        let rows = out.lines().skip(2).map(cells);
        let numbered = rows.take_while(|row| row.first().is_some_and(|cell| cell.len() == 1));
        let number = |cell: &String| cell.parse().unwrap_or(0.0);
        numbered.map(|row| [number(&row[1]), number(&row[3])]).collect()
    };
    let close = |values: Vec<[f64; 2]>, expected: &[[f64; 2]]| {
        assert_eq!(values.len(), expected.len(), "{values:?}");
        for (found, expected) in values.iter().flatten().zip(expected.iter().flatten()) {
            let error = (found - expected).abs();
            assert!(error <= 1e-3 * expected.abs(), "{found} {expected}");
        }
    };
    let undamped = [101_633_f64.sqrt(), 0.0];
    let damped = |c: f64, k: f64| [(k - 0.25 * c * c).sqrt(), -0.5 * c];
    close(modes(1.0, 103_000.0), &[undamped, damped(1.0, 103_000.0)]);
    close(modes(90.0, 103_000.0), &[damped(90.0, 103_000.0), undamped]);
    close(modes(90.0, 103_658.0), &[undamped, damped(90.0, 103_658.0)]);
    let root = (350.0_f64.powi(2) - 103_000.0).sqrt();
    close(modes(700.0, 103_000.0), &[[0.0, root - 350.0], [0.0, -root - 350.0], undamped]);
}

/// The standard normal distribution, by Simpson's rule.
pub(crate) fn normal(z: f64) -> f64 {
    let panels = 20_000;
    let step = z / f64::from(panels);
    let density = |z: f64| (-0.5 * z * z).exp() / (2.0 * std::f64::consts::PI).sqrt();
    let weight = |k: i32| match k {
        0 => 1.0,
        k if k == panels => 1.0,
        k => f64::from(2 + 2 * (k % 2)),
    };
    let value = |k: i32| weight(k) * density(f64::from(k) * step);
    0.5 + (0..=panels).map(value).sum::<f64>() * step / 3.0
}

/// A sleeping top that was asked to stay falls where `C^2 w^2 < 4 A m g l`.
#[test]
fn probability_that_a_sleeping_top_falls() {
    for (name, spin) in [("driven", "driven at w;"), ("coasting", "coasting; steady spin = w;")] {
        let text = format!(
            "mechanism Top {{ input w: rad/s; design C = 6e-4 kg*m^2 +/- 6%; gravity 9.81 m/s^2 along -z;
             body shaft: massless;
             body top: rigid(mass: 0.3 kg, inertia: [2e-3 kg*m^2, 2e-3 kg*m^2, C], center: [0, 0, 5 cm]);
             joint tilt: universal(a: x, b: y) from ground to shaft;
             joint spin: revolute(z) from shaft to top, {spin} }}"
        );
        let least = (4.0 * (2e-3 + 0.3 * 0.0025) * 0.3 * 9.81 * 0.05_f64).sqrt() / 68.0;
        let expected = normal((least / 6e-4 - 1.0) / 0.02);
        let arguments = ["probability", "--set", "w=68rad/s", "--stay", "--require", "stable", "--csv"];
        let out = declared(&format!("top_{name}"), &text, &arguments);
        let found = column(&out, "probability of failure").unwrap()[0];
        assert!((found / expected - 1.0).abs() < 0.01, "{expected}\n{out}");
    }
}

/// The first event is that at the lowest value, in whichever direction the range is written; limits are printed in the
/// unit in which they are given.
#[test]
fn first_events_and_units_of_limits() {
    let text = "mechanism Band { input u: rad/s; design c = 10 rad/s +/- 3%; body p: point(mass: 1 kg);
        joint x: prismatic(x) from ground to p; force s: spring(on: x, stiffness: 900 N/m);
        force f: generalized(on: x, value: -(0.1 kg*s/rad^2) * (u - c) * (u - 20 rad/s) * rate(x)); }";
    let expected = normal((9.9 - 10.0) / 0.1);
    for range in ["u=0..30rad/s", "u=30..0rad/s"] {
        let wanted = format!("flutter 1 {range} >= 9.9 rad/s");
        let arguments = ["probability", "--set", "u=1rad/s", "--require", &wanted, "--csv"];
        let out = declared("band", text, &arguments);
        let found = column(&out, "probability of failure").unwrap()[0];
        assert!((found / expected - 1.0).abs() < 0.01, "{expected}\n{out}");
    }
    for (limit, words) in [
        ("frequency 1 >= 4.5 Hz", "frequency 1 at least 4.5 Hz"),
        ("frequency 1 >= 28 rad/s", "frequency 1 at least 28 rad/s"),
        ("frequency 1 outside 1..2 Hz", "frequency 1 outside 1 Hz to 2 Hz"),
    ] {
        let arguments = ["probability", "--set", "u=1rad/s", "--require", limit];
        let out = declared("band_unit", text, &arguments);
        assert!(out.contains(words), "{out}");
    }
}

/// Electrostatic pull-in across two micrometres: `V^2 = 8 k g^3 / (27 eps A)` at `x = g / 3`, and nothing beyond.
#[test]
fn pull_in_across_two_micrometres() {
    let text = "mechanism PullIn { input v: 1; body plate: point(mass: 1e-9 kg);
        joint x: prismatic(x) from ground to plate; force leaf: spring(on: x, stiffness: 1 N/m);
        force field: generalized(on: x, value: (8.8541878128e-12 N) * (1e-8 m^2) * v^2 / (2 * (2 um - x)^2)); }";
    let out = declared("pull_in", text, &["branches", "--sweep", "v=0..20"]);
    let snap = (8.0 * 8e-18 / (27.0 * 8.8541878128e-20_f64)).sqrt();
    let fold = out.lines().find(|line| line.trim_start().starts_with("fold"));
    let fold: Vec<&str> = fold.unwrap().split_whitespace().collect();
    let near = |text: &str, value: f64| (text.parse::<f64>().unwrap() / value - 1.0).abs() < 1e-5;
    assert!(near(fold[1], snap), "{out}");
    assert!(near(fold[fold.len() - 1], 2e-6 / 3.0), "{out}");
    let folder = crate::program::folder("pull_in_beyond");
    let file = crate::program::file(&folder, "it.mechanism", text);
    let beyond = run(&["modes", &file, "--set", "v=12"]);
    assert!(beyond.code != 0, "{}", beyond.out);
    assert!(beyond.err.contains("grows without bound"), "{}", beyond.err);
}
