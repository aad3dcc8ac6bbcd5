//! The examples from the paper and the textbook: each runs, and its numbers are those of closed forms, of equations written
//! by hand and of the publications.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::error::Error;
use std::io::Write;

#[path = "../first/main.rs"]
#[allow(dead_code, unreachable_pub)]
mod first;
#[path = "programs/jeffcott.rs"]
mod jeffcott;
#[path = "../jeffcott_rotor.rs"]
#[allow(dead_code, unreachable_pub)]
mod jeffcott_rotor;
#[path = "programs/pendulums.rs"]
mod pendulums;
#[path = "../rotating_double_pendulum.rs"]
#[allow(dead_code, unreachable_pub, clippy::duplicate_mod)]
mod rotating_double_pendulum;
#[path = "../rotating_pendulum.rs"]
#[allow(dead_code, unreachable_pub, clippy::duplicate_mod)]
mod rotating_pendulum;
#[path = "programs/whipple.rs"]
mod whipple;
#[path = "../whipple_bicycle.rs"]
#[allow(dead_code, unreachable_pub)]
mod whipple_bicycle;

type Run = fn(&mut dyn Write) -> Result<(), Box<dyn Error>>;

/// What an example prints.
fn printed(run: Run) -> String {
    let mut out = Vec::new();
    run(&mut out).unwrap();
    let text = String::from_utf8(out).unwrap();
    println!("{text}");
    assert!(!text.contains("NaN") && !text.contains("inf"));
    text
}

/// Requires every word in a text.
#[track_caller]
fn shows(text: &str, words: &[&str]) {
    for word in words {
        assert!(text.contains(word), "no `{word}`");
    }
}

#[track_caller]
fn near(what: &str, value: f64, expected: f64, tolerance: f64) {
    let error = (value - expected).abs() / expected.abs();
    assert!(error <= tolerance, "{what}: {value:e} is not {expected:e}");
}
