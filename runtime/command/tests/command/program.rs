//! Helpers that run the built command.

use std::fs;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// The results of a run.
pub(crate) struct Run {
    pub(crate) code: i32,
    pub(crate) out: String,
    pub(crate) err: String,
}

/// The folder of the example declarations.
pub(crate) fn examples() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples")
}

/// The command, run in the folder of the example declarations.
pub(crate) fn command(arguments: &[&str]) -> Command {
    command_in(&examples(), arguments)
}

/// The command, run in a folder.
pub(crate) fn command_in(folder: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_eigentol"));
    command.args(arguments).current_dir(folder);
    command.env_remove("NO_COLOR").env_remove("COLUMNS").stdin(Stdio::null());
    command
}

pub(crate) fn run(arguments: &[&str]) -> Run {
    let output = command(arguments).output().unwrap();
    Run {
        code: output.status.code().unwrap_or(-1),
        out: String::from_utf8(output.stdout).unwrap(),
        err: String::from_utf8(output.stderr).unwrap(),
    }
}

/// Runs with text on standard input.
pub(crate) fn run_with_input(arguments: &[&str], input: &str) -> Run {
    let mut child =
        command(arguments).stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    child.stdin.take().unwrap().write_all(input.as_bytes()).unwrap();
    let output = child.wait_with_output().unwrap();
    Run {
        code: output.status.code().unwrap_or(-1),
        out: String::from_utf8(output.stdout).unwrap(),
        err: String::from_utf8(output.stderr).unwrap(),
    }
}

/// The standard output of a run that must succeed.
pub(crate) fn answer(arguments: &[&str]) -> String {
    let Run { code, out, err } = run(arguments);
    assert_eq!((code, err.as_str()), (0, ""), "{arguments:?}");
    out
}

/// A new empty folder for a test.
pub(crate) fn folder(name: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join("command").join(name);
    let _ = fs::remove_dir_all(&path);
    fs::create_dir_all(&path).unwrap();
    path
}

/// Writes a test file with this content.
pub(crate) fn file(folder: &Path, name: &str, content: &str) -> String {
    let path = folder.join(name);
    fs::write(&path, content).unwrap();
    path.display().to_string()
}

pub(crate) const PENDULUM: &str = "rotating_pendulum.mechanism";
/// An operating point at which the pendulum is swung out.
pub(crate) const SPINNING: [&str; 4] = ["--set", "omega=5rad/s", "--start", "theta=60deg"];

/// A question about the swung-out pendulum along its speed.
pub(crate) fn swept<'a>(question: &'a str, more: &[&'a str]) -> Vec<&'a str> {
    [&[question, PENDULUM], &SPINNING[2..], more].concat()
}

/// A question about the pendulum at that operating point.
pub(crate) fn pendulum<'a>(question: &'a str, more: &[&'a str]) -> Vec<&'a str> {
    [&[question, PENDULUM], &SPINNING[..], more].concat()
}
