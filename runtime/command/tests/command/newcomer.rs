//! A newcomer's first hour, with only the README and the first chapter of the guide: clone, commands, an edited
//! tolerance, a new mechanism, a Rust project.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::program::command_in;
use crate::walkthrough::{Part, parts, walked, words};

/// A shared build folder for these tests, so that the newcomer need not rebuild existing packages.
fn target() -> (PathBuf, bool) {
    let profile = Path::new(env!("CARGO_BIN_EXE_eigentol")).parent().unwrap();
    (profile.parent().unwrap().to_owned(), profile.ends_with("release"))
}

fn succeed(command: &mut Command) -> String {
    let output = command.output().unwrap();
    let err = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{err}\n{command:?}");
    String::from_utf8(output.stdout).unwrap()
}

/// Runs cargo in a folder.
fn cargo(folder: &Path, arguments: &[&str]) -> String {
    let (target, release) = target();
    let mut command = Command::new(env!("CARGO"));
    command.args(arguments).args(["--quiet", "--offline"]);
    if release {
        command.arg("--release");
    }
    succeed(command.current_dir(folder).env("CARGO_TARGET_DIR", target))
}

/// A copy of the committed files; `None` if git or the history is missing.
fn clone(to: &Path) -> Option<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let clone = to.join("eigentol");
    let mut git = Command::new("git");
    git.args(["clone", "--quiet", "--depth", "1"])
        .arg(format!("file://{}", root.canonicalize().unwrap().display()))
        .arg(&clone);
    let cloned = git.output().is_ok_and(|output| output.status.success());
    cloned.then_some(clone)
}

/// Runs the commands of a page in a folder and compares their output with the page.
fn follow(page: &Path, folder: &Path) {
    let text = fs::read_to_string(page).unwrap();
    assert_eq!(walked(&text, folder), text, "{}", page.display());
}

#[test]
#[ignore = "builds everything once more, in a clone"]
fn a_newcomer_gets_from_a_clone_to_his_own_rotor() {
    let folder = std::env::temp_dir().join(format!("eigentol-newcomer-{}", std::process::id()));
    fs::create_dir_all(&folder).unwrap();
    let Some(clone) = clone(&folder) else {
        println!("skipped: there is no git, or no history");
        return;
    };

    // `cargo install` with the packages of this build.
    let readme = fs::read_to_string(clone.join("README.md")).unwrap();
    let install = "cargo install --locked --path runtime/command\n";
    assert!(parts(&readme).contains(&Part::Shell(install)));
    cargo(&clone, &["build", "--package", "eigentol-cli"]);
    follow(&clone.join("README.md"), &clone);

    let chapter = clone.join("runtime/guide/src/first_steps.md");
    follow(&chapter, &folder);
    let own = fs::read_to_string(folder.join("pendulum.mechanism")).unwrap();
    assert!(own.contains("+/- 1%"), "the tolerance was edited");
    let report = fs::read_to_string(folder.join("fan.html")).unwrap();
    assert!(report.starts_with("<!doctype html>") && report.contains("Fan"));

    let text = fs::read_to_string(&chapter).unwrap();
    let mut output = String::new();
    for part in parts(&text) {
        match part {
            Part::Shell(commands) if commands != install => {
                for line in commands.lines() {
                    let words = words(line.strip_prefix("eigentol ").unwrap());
                    let words: Vec<&str> = words.iter().map(String::as_str).collect();
                    succeed(&mut command_in(&folder, &words));
                }
            }
            Part::Program(file, program) => {
                let project = folder.join("fan");
                fs::write(project.join(file), program).unwrap();
                // The versions already available; no others are needed.
                fs::copy(clone.join("Cargo.lock"), project.join("Cargo.lock")).unwrap();
                output = cargo(&project, &["run"]);
            }
            _ => {}
        }
    }
    assert!(output.contains("2316") && output.contains("2933"), "{output}");
    fs::remove_dir_all(&folder).unwrap();
}
