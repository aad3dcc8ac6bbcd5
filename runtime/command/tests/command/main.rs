//! The command as a user runs it.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod beams;
mod declarations;
mod figures;
mod first_minutes;
mod import;
#[cfg(target_os = "linux")]
mod interrupt;
#[cfg(unix)]
mod many_machines;
mod mistakes;
mod newcomer;
mod outputs;
mod parts;
mod probability;
mod program;
mod readme;
mod reports;
mod rust_examples;
mod serve;
mod starter;
mod strangers;
mod streams;
mod subcommands;
mod users;
mod vibration;
mod walkthrough;
