//! The starter project builds and runs.

use std::fs;
use std::path::Path;
use std::process::Command;

use crate::program::{folder, run};

#[test]
#[ignore = "builds the library once more, as a project of its own does"]
fn the_starter_project_builds() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let folder = folder("starter");
    let project = folder.join("first-project");
    let library = root.join("runtime").display().to_string();
    let created = run(&["new", &project.display().to_string(), "--path", &library]);
    assert_eq!(created.code, 0, "{}", created.err);

    // It lies inside the folder of a workspace to which it does not belong.
    let around = "[workspace]\nmembers = []\n";
    fs::write(folder.join("Cargo.toml"), around).unwrap();
    // The versions used to build this workspace are available; no others are needed.
    fs::copy(root.join("Cargo.lock"), project.join("Cargo.lock")).unwrap();
    let output = Command::new(env!("CARGO"))
        .args(["run", "--offline", "--quiet"])
        .current_dir(&project)
        .env("CARGO_TARGET_DIR", Path::new(env!("CARGO_TARGET_TMPDIR")).join("starter"))
        .output()
        .unwrap();
    let err = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{err}");
    let out = String::from_utf8_lossy(&output.stdout);
    assert!(out.contains("4.04212"), "{out}");
    assert!(out.contains("probability of failure"), "{out}");
    let checked = run(&["check", &project.join("pendulum.mechanism").display().to_string()]);
    assert_eq!(checked.code, 0, "{}", checked.err);

    let again = run(&["new", &project.display().to_string()]);
    assert_eq!(again.code, 3);
    assert!(again.err.contains("exists already"), "{}", again.err);
}

#[test]
fn the_published_version_is_the_default() {
    let project = folder("published").join("rotor_2");
    let created = run(&["new", &project.display().to_string()]);
    assert_eq!(created.code, 0, "{}", created.err);
    let manifest = fs::read_to_string(project.join("Cargo.toml")).unwrap();
    let version = env!("CARGO_PKG_VERSION");
    assert!(manifest.contains("name = \"rotor_2\"\n"), "{manifest}");
    assert!(manifest.contains(&format!("eigentol = \"{version}\"\n")), "{manifest}");
}

#[test]
fn names_that_no_package_can_have() {
    for name in ["1st", "a b", "..", "-x/..", "é"] {
        let run = run(&["new", "--", name]);
        assert_eq!(run.code, 2, "{name}");
        assert!(run.err.contains("is not a valid package name"), "{}", run.err);
    }
    for (name, why) in [
        ("build", "cargo keeps this name"),
        ("deps", "cargo keeps this name"),
        ("fn", "a keyword of Rust"),
        ("self", "a keyword of Rust"),
        ("test", "a library has this name"),
        ("eigentol", "a library has this name"),
        ("con", "Windows keeps this name"),
    ] {
        let place = folder("reserved").join(name);
        let run = run(&["new", &place.display().to_string()]);
        assert_eq!(run.code, 2, "{name}");
        for part in ["is not a valid package name", why, &format!("`{name}-study`")] {
            assert!(run.err.contains(part), "{}", run.err);
        }
        assert!(!place.exists());
    }
    let run = run(&["new", "fine", "--path", "/missing/folder"]);
    assert_eq!(run.code, 3);
    assert!(run.err.contains("cannot read `/missing/folder`"), "{}", run.err);
}
