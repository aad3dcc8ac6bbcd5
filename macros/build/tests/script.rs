//! The output of a build script to cargo, and the files it leaves.
//!
//! A build script gets its folder from the environment and ends the process, so each test runs this program again as a
//! build script.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::env;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

const RIGHT: &str = "/// A bar.
pub mechanism Pendulum {
    design l = 1 m;
    gravity 9.81 m/s^2 along -z;
    body bar: rod(mass: 3 kg, length: l, along: -z);
    joint theta: revolute(y) from ground to bar;
}
";

/// A nonexistent unit and, further on, an undeclared name.
const WRONG: &str = "mechanism Pendulum {
    design l = 1 mmm;
    gravity 9.81 m/s^2 along -z;
    /* µ */ body bar: rod(mass: 3 kg, length: ll, along: -z);
    joint theta: revolute(y) from ground to bar;
}
";

/// Runs as the build script when a test starts this program as one.
#[test]
fn script() {
    let Ok(declaration) = env::var("DECLARATION") else {
        return;
    };
    match env::var("HEADER") {
        #[cfg(feature = "c")]
        Ok(header) => eigentol_build::compile_for_c(declaration, header),
        _ => eigentol_build::compile(declaration),
    }
}

/// A folder with a declaration.
fn folder(name: &str, text: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(folder.join("out")).unwrap();
    fs::write(folder.join("pendulum.mechanism"), text).unwrap();
    folder
}

fn run(folder: &Path, variables: &[(&str, &str)]) -> Output {
    let mut command = Command::new(env::current_exe().unwrap());
    command.args(["--exact", "script", "--nocapture"]);
    command.current_dir(folder).envs(variables.iter().copied());
    command.output().unwrap()
}

/// The lines addressed to cargo.
fn said(output: &Output) -> Vec<String> {
    let text = String::from_utf8(output.stdout.clone()).unwrap();
    let lines = text.lines().filter_map(|line| Some(&line[line.find("cargo::")?..]));
    lines.map(str::to_owned).collect()
}

const HERE: [(&str, &str); 2] = [("DECLARATION", "pendulum.mechanism"), ("OUT_DIR", "out")];

#[test]
fn code_is_left_where_cargo_wants_it() {
    let folder = folder("code", RIGHT);
    let output = run(&folder, &HERE);
    assert!(output.status.success(), "{output:?}");
    assert_eq!(said(&output), ["cargo::rerun-if-changed=pendulum.mechanism"]);
    let code = fs::read_to_string(folder.join("out/pendulum.rs")).unwrap();
    assert!(code.contains("pub struct Pendulum"), "{code}");
    assert!(!code.contains("unsafe"), "{code}");
    // rustc takes the square of a line's length
    assert!(code.lines().all(|line| line.len() < 500), "{code}");
}

#[test]
fn all_mistakes_are_told_with_their_places() {
    let folder = folder("mistakes", WRONG);
    let output = run(&folder, &HERE);
    assert_eq!(output.status.code(), Some(1));
    assert_eq!(
        said(&output),
        [
            "cargo::rerun-if-changed=pendulum.mechanism",
            "cargo::error=pendulum.mechanism:2:18: unknown unit `mmm`",
            "cargo::error=help: did you mean `mm`?",
            "cargo::error=pendulum.mechanism:4:47: unknown name `ll`",
            "cargo::error=help: did you mean `l`?",
        ]
    );
    assert!(!folder.join("out/pendulum.rs").exists());
}

#[test]
fn text_that_is_no_tokens_has_a_place_too() {
    let folder = folder("brackets", "mechanism Pendulum {\n    gravity (1;\n}\n");
    let output = run(&folder, &HERE);
    assert_eq!(output.status.code(), Some(1));
    let said = said(&output);
    assert!(said[1].starts_with("cargo::error=pendulum.mechanism:"), "{said:?}");
    assert_eq!(said[2], "cargo::error=help: brackets and quotes come in pairs");
}

/// The error for a declaration, given environment variables.
fn refused(name: &str, variables: &[(&str, &str)]) -> String {
    let output = run(&folder(name, RIGHT), variables);
    assert_eq!(output.status.code(), Some(1));
    said(&output).pop().unwrap()
}

#[test]
fn files_that_are_not_there_are_named() {
    let missing = refused("missing", &[("DECLARATION", "rotor.mechanism"), ("OUT_DIR", "out")]);
    let start = "cargo::error=cannot read rotor.mechanism: ";
    assert!(missing.starts_with(start), "{missing}");
    assert!(missing.ends_with("relative to the folder of Cargo.toml"), "{missing}");
    let no_file = refused("no_file", &[("DECLARATION", ".."), ("OUT_DIR", "out")]);
    assert!(no_file.contains("`..` is not the path of a file"), "{no_file}");
    let unwritable = refused("unwritable", &[("DECLARATION", "pendulum.mechanism"), ("OUT_DIR", "pendulum.mechanism")]);
    let start = "cargo::error=cannot write pendulum.mechanism/pendulum.rs: ";
    assert!(unwritable.starts_with(start), "{unwritable}");
}

#[test]
fn outside_of_a_build_script_that_is_said() {
    let output = Command::new(env::current_exe().unwrap())
        .args(["--exact", "script", "--nocapture"])
        .current_dir(folder("outside", RIGHT))
        .env("DECLARATION", "pendulum.mechanism")
        .env_remove("OUT_DIR")
        .output()
        .unwrap();
    assert_eq!(output.status.code(), Some(1));
    let last = said(&output).pop().unwrap();
    assert!(last.contains("OUT_DIR is not set"), "{last}");
}

#[cfg(feature = "c")]
mod for_c {
    use super::*;

    const WITH_HEADER: [(&str, &str); 3] = [HERE[0], HERE[1], ("HEADER", "include/pendulum.h")];

    #[test]
    fn a_header_is_written_once() {
        let folder = folder("header", RIGHT);
        assert!(run(&folder, &WITH_HEADER).status.success());
        let header = folder.join("include/pendulum.h");
        let text = fs::read_to_string(&header).unwrap();
        assert!(text.contains("#ifndef PENDULUM_H"), "{text}");
        assert!(text.contains("int32_t pendulum_residual(const double *q,"), "{text}");
        assert!(text.contains("#define PENDULUM_DESIGN_l 0"), "{text}");
        // a correct file is left untouched, so that code that includes it is not rebuilt
        let written = fs::metadata(&header).unwrap().modified().unwrap();
        let output = run(&folder, &WITH_HEADER);
        assert_eq!(fs::metadata(&header).unwrap().modified().unwrap(), written);
        assert_eq!(said(&output)[1], "cargo::rerun-if-changed=include/pendulum.h");
        // a different file is corrected
        fs::write(&header, "old").unwrap();
        assert!(run(&folder, &WITH_HEADER).status.success());
        assert_eq!(fs::read_to_string(&header).unwrap(), text);
    }

    #[test]
    fn mistakes_leave_the_header_alone() {
        let folder = folder("old_header", WRONG);
        fs::create_dir(folder.join("include")).unwrap();
        fs::write(folder.join("include/pendulum.h"), "old").unwrap();
        let output = run(&folder, &WITH_HEADER);
        assert_eq!(output.status.code(), Some(1));
        assert!(said(&output)[2].contains("pendulum.mechanism:2:18: unknown unit"), "{output:?}");
        assert_eq!(fs::read_to_string(folder.join("include/pendulum.h")).unwrap(), "old");
    }

    #[test]
    fn a_header_that_cannot_be_written_is_named() {
        let folder = folder("nowhere", RIGHT);
        let output = run(&folder, &[HERE[0], HERE[1], ("HEADER", "pendulum.mechanism/pendulum.h")]);
        assert_eq!(output.status.code(), Some(1));
        let last = said(&output).pop().unwrap();
        assert!(last.starts_with("cargo::error=cannot write pendulum.mechanism/pendulum.h: "), "{last}");
    }

    #[test]
    fn names_that_c_cannot_spell_are_refused() {
        for name in ["Läufer", "_2d"] {
            let folder = folder("names", &RIGHT.replace("Pendulum", name));
            let output = run(&folder, &WITH_HEADER);
            assert_eq!(output.status.code(), Some(1));
            let said = said(&output);
            let expected = format!("cargo::error=pendulum.mechanism:2:15: `{name}` cannot be spelt in C");
            assert_eq!(said[2], expected);
            assert!(said[3].starts_with("cargo::error=help: a name for C begins"), "{said:?}");
            // without C functions the name is valid
            assert!(run(&folder, &HERE).status.success());
        }
    }

    #[test]
    fn documentation_cannot_end_a_comment_of_c() {
        let text = RIGHT.replace("    design l", "    /// Ratio */ of lengths.\n    design l");
        let folder = folder("comment", &text);
        assert!(run(&folder, &WITH_HEADER).status.success());
        let header = fs::read_to_string(folder.join("include/pendulum.h")).unwrap();
        assert!(header.contains("Ratio * / of lengths."), "{header}");
    }
}
