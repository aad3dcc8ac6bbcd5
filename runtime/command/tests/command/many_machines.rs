//! The examples for many machines, run unchanged.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use crate::program::{PENDULUM, SPINNING, answer, examples, folder, pendulum};

const SAMPLES: [&str; 4] = ["--samples", "2000", "--seed", "7"];

/// A script in its folder of examples, run with the built command on the path.
fn script(name: &str, folder: &Path) -> Command {
    let program = Path::new(env!("CARGO_BIN_EXE_eigentol"));
    let own = program.parent().unwrap().to_owned();
    let others = std::env::var_os("PATH").unwrap_or_default();
    let path = std::env::join_paths(std::iter::once(own).chain(std::env::split_paths(&others)));
    let mut command = Command::new("bash");
    command.arg(examples().join("many_machines").join(name)).current_dir(folder).env("PATH", path.unwrap());
    command
}

fn has(program: &str) -> bool {
    Command::new(program).arg("--version").output().is_ok()
}

/// The path of the declaration, usable from any folder.
fn mechanism() -> PathBuf {
    examples().join(PENDULUM).canonicalize().unwrap()
}

fn text(output: Output) -> String {
    let errors = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.success(), "{errors}");
    String::from_utf8(output.stdout).unwrap()
}

#[test]
fn tasks_of_a_slurm_array_make_one_run() {
    if !has("bash") {
        return println!("skipped, the script for Slurm is not run: there is no bash");
    }
    let parts = folder("slurm");
    for task in 1..=3 {
        let mut one = script("slurm.sh", &parts);
        one.arg(mechanism()).args(SPINNING).args(SAMPLES);
        one.env("SLURM_ARRAY_TASK_ID", task.to_string());
        one.env("SLURM_ARRAY_TASK_COUNT", "3");
        assert_eq!(text(one.output().unwrap()), "");
    }
    let files = [2, 3, 1].map(|task| parts.join(format!("part-{task}.json")));
    let files = files.map(|file| file.display().to_string());
    let files: Vec<&str> = files.iter().map(String::as_str).collect();
    let merged = answer(&[&["merge"], &files[..]].concat());
    assert_eq!(merged, answer(&pendulum("sample", &SAMPLES)));
}

#[test]
fn processes_of_gnu_parallel_make_one_run() {
    if !has("bash") || !has("parallel") {
        return println!("skipped, the script for GNU parallel is not run: there is none");
    }
    let mut all = script("parallel.sh", &folder("parallel"));
    all.arg(mechanism()).arg("5").args(SPINNING).args(SAMPLES);
    let merged = text(all.output().unwrap());
    assert_eq!(merged, answer(&pendulum("sample", &SAMPLES)));
}
