//! Robots imported from URDF files.

use std::fs;
use std::path::{Path, PathBuf};

use eigentol_urdf::{Base, Options, Resistance};

use crate::program::{Run, file, folder, run, run_with_input};

/// The folder of third-party robots.
fn robots() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/truth/urdf")
}

/// The library's declarations are checked against Pinocchio's numbers; the command prints the same text.
#[test]
fn the_command_prints_what_the_library_gives() {
    let (mut count, mut imported) = (0, 0);
    for robot in fs::read_dir(robots()).unwrap() {
        let path = robot.unwrap().path();
        if path.extension().is_none_or(|extension| extension != "urdf") {
            continue;
        }
        count += 1;
        let text = fs::read_to_string(&path).unwrap();
        let name = path.display().to_string();
        for (arguments, options) in [
            (&[][..], Options::default()),
            (&["--base", "floating"], Options::default().base(Base::Floating)),
            (&["--joints", "free"], Options::default().resistance(Resistance::KernelsOnly)),
            (&["--joints", "driven", "--no-damping"], Options::default().resistance(Resistance::Drives).damping(false)),
        ] {
            let found = run(&[&["import", &name, "--quiet"], arguments].concat());
            match eigentol_urdf::import(&text, &options) {
                Ok(robot) => {
                    assert_eq!((found.code, found.err.as_str()), (0, ""), "{name} {arguments:?}");
                    assert_eq!(found.out, robot.declaration, "{name} {arguments:?}");
                    imported += 1;
                }
                Err(error) => {
                    assert_eq!((found.code, found.out.as_str()), (3, ""), "{name} {arguments:?}");
                    let reason = error.mistakes[0].reason.to_string();
                    assert!(found.err.contains(&reason), "{reason}: {}", found.err);
                }
            }
        }
    }
    assert!(count >= 3 && imported >= 3 * count, "{count} {imported}");
}

#[test]
fn an_imported_robot_can_be_studied() {
    let panda = robots().join("panda.urdf").display().to_string();
    let Run { code, out, err } = run(&["import", &panda, "--stiffness", "3 kN*m/rad"]);
    assert_eq!(code, 0, "{err}");
    assert!(err.starts_with("note: ") && err.contains("has no meaning in a mechanism"), "{err}");
    let modes = run_with_input(&["modes", "-"], &out);
    assert_eq!(modes.code, 0, "{}", modes.err);
    assert!(modes.out.contains("panda_joint7") && modes.out.contains("equilibrium, stable"));
    // A robot's modes fit on one page: no column for each joint, no fingers that tremble by 1e-18 m.
    assert!(modes.out.contains("largest components are shown"));
    assert!(modes.out.lines().all(|line| line.len() <= 150) && modes.out.lines().count() < 40);
    assert!(!modes.out.contains("e-1"), "{}", modes.out);
}

#[test]
fn what_cannot_be_imported_is_drawn() {
    let text = "<robot name=\"a\">\n  <link name=\"base\"/>\n  <link name=\"bar\"/>\n  \
                <joint name=\"j\" type=\"contnuous\"><parent link=\"base\"/><child link=\"bar\"/></joint>\n</robot>\n";
    let path = file(&folder("urdf"), "wrong.urdf", text);
    let run = run(&["import", &path]);
    assert_eq!((run.code, run.out.as_str()), (3, ""));
    for part in
        ["error: `contnuous` is not a type of joint", "wrong.urdf:4:3", "did you mean `continuous`?", "has 1 mistake"]
    {
        assert!(run.err.contains(part), "{part}: {}", run.err);
    }
    for end in (0..text.trim_end().len()).step_by(17) {
        let run = run_with_input(&["import", "-"], &text[..end]);
        assert_eq!((run.code, run.out.as_str()), (3, ""), "{end}");
        assert!(run.err.starts_with("error: ") && !run.err.contains("panicked"), "{}", run.err);
    }
}

#[test]
fn a_wrong_stiffness_is_refused() {
    let panda = robots().join("panda.urdf").display().to_string();
    let run = run(&["import", &panda, "--linear-stiffness", "3 kN"]);
    assert_eq!((run.code, run.out.as_str()), (2, ""));
    assert!(run.err.contains("`linear-stiffness` must be a stiffness"), "{}", run.err);
}
