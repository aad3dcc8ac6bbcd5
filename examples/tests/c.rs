//! The C example: compiled, linked with the static library, and its numbers compared with those of the solvers.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use eigentol::Study;

#[path = "../rotating_double_pendulum.rs"]
#[allow(dead_code, unreachable_pub)]
mod rotating_double_pendulum;

use rotating_double_pendulum::RotatingDoublePendulum as Pendulum;

const HEADER: &str = "include/double_pendulum.h";

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("c")
}

fn done(command: &mut Command) -> Output {
    let output = command.output().unwrap();
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{command:?}\n{said}");
    output
}

/// Builds the static library with the dependencies of this workspace and returns its path.
fn library() -> PathBuf {
    let lock = Path::new(env!("CARGO_MANIFEST_DIR")).join("../Cargo.lock");
    fs::copy(lock, folder().join("Cargo.lock")).unwrap();
    let target = Path::new(env!("CARGO_TARGET_TMPDIR")).join("c");
    done(Command::new(env!("CARGO")).args(["build", "--release", "--target-dir"]).arg(&target).current_dir(folder()));
    target.join("release/libdouble_pendulum.a")
}

/// Parses the lines `name number unit` printed by the program.
fn numbers(output: &Output) -> BTreeMap<String, f64> {
    let text = String::from_utf8(output.stdout.clone()).unwrap();
    let line = |line: &str| {
        let mut words = line.split(' ');
        let (name, number) = (words.next().unwrap(), words.next().unwrap());
        (name.to_owned(), number.parse().unwrap())
    };
    text.lines().map(line).collect()
}

/// Computes the same numbers from Rust.
fn expected() -> BTreeMap<String, f64> {
    let study = Study::new(Pendulum).input(Pendulum::omega, 5.0).start(Pendulum::theta1, 60f64.to_radians());
    let at = study.equilibrium().unwrap().coordinates;
    let mut numbers = vec![
        ("theta1".to_owned(), at[0]),
        ("theta2".to_owned(), at[1]),
        ("angle2".to_owned(), at[0] + at[1]),
        ("null".to_owned(), 2.0),
    ];
    let frequencies = study.modes().unwrap().frequencies();
    let sensitivities = study.sensitivities().unwrap();
    for (k, (frequency, slopes)) in frequencies.iter().zip(&sensitivities.modes).enumerate() {
        let by_length = slopes.frequency().unwrap().by_design[1];
        numbers.push((format!("frequency{}", k + 1), frequency.unwrap()));
        numbers.push((format!("frequency{}_by_l", k + 1), by_length));
    }
    numbers.into_iter().collect()
}

#[test]
#[ignore = "builds a package of its own, optimised"]
fn the_program_in_c_finds_what_rust_finds() {
    if Command::new("cc").arg("--version").output().is_err() {
        println!("skipped: there is no C compiler, or it is not called `cc`");
        return;
    }
    let committed = fs::read_to_string(folder().join(HEADER)).unwrap();
    let library = library();
    let current = fs::read_to_string(folder().join(HEADER)).unwrap();
    assert_eq!(committed, current, "the build script has written {HEADER} anew: commit it");

    let program = Path::new(env!("CARGO_TARGET_TMPDIR")).join("double_pendulum");
    done(
        Command::new("cc")
            .args(["-std=c99", "-pedantic", "-Wall", "-Wextra", "-Werror", "-O1"])
            .args(["-Iinclude", "main.c"])
            .arg(library)
            .args(["-lm", "-o"])
            .arg(&program)
            .current_dir(folder()),
    );
    let (found, expected) = (numbers(&done(&mut Command::new(program))), expected());
    assert!(found.keys().eq(expected.keys()), "{found:?}");
    for (name, number) in &expected {
        let error = (found[name] - number).abs();
        assert!(error <= 1e-12 * number.abs(), "{name}: {} in C, {number} in Rust", found[name]);
    }
}
