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
    /// The numbers are among those of the column, in any order.
    #[serde(default)]
    among: bool,
    /// The numbers are the first of the column.
    #[serde(default)]
    first: bool,
    #[serde(default)]
    relative: f64,
}

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/truth/strangers")
}

fn column(table: &str, name: &str) -> Result<Vec<f64>, String> {
    let mut rows = table.lines().filter(|line| !line.starts_with('#'));
    let head: Vec<&str> = rows.next().unwrap_or("").split(',').collect();
    let place = head.iter().position(|own| own.trim_matches('"') == name);
    let place = place.ok_or_else(|| format!("no column {name} among {head:?}"))?;
    let numbers = rows.filter_map(|row| row.split(',').nth(place)?.parse().ok());
    Ok(numbers.collect())
}

impl Case {
    fn run(&self, more: &[&str]) -> Run {
        let file = folder().join(&self.file);
        let mut arguments = vec![self.command.clone(), file.display().to_string()];
        arguments.extend(self.arguments.iter().cloned());
        arguments.extend(more.iter().map(|own| (*own).to_owned()));
        run(&arguments.iter().map(String::as_str).collect::<Vec<_>>())
    }

    fn check(&self) -> Result<(), String> {
        if !self.columns.is_empty() {
            let run = self.run(&["--csv"]);
            for (name, expected) in &self.columns {
                column(&run.out, name)
                    .and_then(|found| self.compare(&found, expected))
                    .map_err(|what| format!("{name}: {what}\n{}{}", run.out, run.err))?;
            }
        }
        if !self.text.is_empty() {
            let run = self.run(&[]);
            for words in &self.text {
                let has = |line: &str| words.split('&').all(|word| line.contains(word));
                if !run.out.lines().any(has) {
                    return Err(format!("no line with {words}\n{}{}", run.out, run.err));
                }
            }
        }
        Ok(())
    }

    fn compare(&self, found: &[f64], expected: &[f64]) -> Result<(), String> {
        let near = |a: f64, b: f64| (a - b).abs() <= self.relative * b.abs();
        let right = if self.among {
            expected
                .iter()
                .all(|own| found.iter().any(|other| near(*other, *own)))
        } else {
            let all = found.len() == expected.len() || self.first && found.len() > expected.len();
            all && found.iter().zip(expected).all(|(a, b)| near(*a, *b))
        };
        match right {
            true => Ok(()),
            false => Err(format!("{found:?}, not {expected:?}")),
        }
    }
}

#[test]
fn machines_of_strangers_give_what_they_expect() {
    let cases = std::fs::read_to_string(folder().join("cases.json")).unwrap();
    let cases: Vec<Case> = serde_json::from_str(&cases).unwrap();
    let failed: Vec<String> = (cases.iter())
        .filter_map(|case| Some(format!("{}: {}", case.name, case.check().err()?)))
        .collect();
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
    assert!(
        out.contains("modes 1 and 2 are equal in every design"),
        "{out}"
    );
    assert!(!out.contains("standard deviations apart"), "{out}");
}
