//! Robots imported from URDF files, rotors from files of ROSS.

use std::f64::consts::PI;
use std::fs;
use std::path::{Path, PathBuf};

use eigentol_tables::{Table, Values};
use eigentol_urdf::{Base, Options, Resistance};
use serde_json::Value;

use crate::program::{Run, file, folder, run, run_with_input};
use crate::streams::documented;

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

/// What ROSS gives for the rotor with forty elements in place of each.
#[test]
fn a_rotor_of_ross_is_the_same_here() {
    let ross = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/truth/ross");
    let numbers: Value = serde_json::from_str(&fs::read_to_string(ross.join("stepped_numbers.json")).unwrap()).unwrap();
    let list = |of: &str| -> Vec<f64> { numbers[of].as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect() };
    let close = |found: f64, of: f64, within: f64| assert!((found / of - 1.0).abs() < within, "{found} {of}");
    let [toml, json] = ["stepped.toml", "stepped.json"].map(|file| {
        let run = run(&["import", &ross.join(file).display().to_string()]);
        assert_eq!(run.code, 0, "{}", run.err);
        assert!(run.err.contains("unbalance") && run.err.contains("lines: [bending"), "{}", run.err);
        run.out
    });
    assert_eq!(toml, json);
    let unbalance = "    unbalance u: on disk_0, amount: 1e-4 kg*m;\n    point middle: rotor at station 2;
    output across = position(middle).y;\n    output up = position(middle).z;\n}";
    let declaration = format!("{}{unbalance}", toml.trim_end().trim_end_matches('}'));
    let path = file(&folder("ross"), "stepped.mechanism", &declaration);

    let modes = documented(&["modes", &path, "--set", "speed=500rad/s"], "modes");
    let (found, damping) = (numbers_of(&modes, "frequency"), numbers_of(&modes, "damping ratio"));
    for (k, (omega, decrement)) in list("omega").into_iter().zip(list("decrement")).enumerate() {
        close(found[k], omega, 1e-5);
        close(2.0 * PI * damping[k] / (1.0 - damping[k].powi(2)).sqrt(), decrement, 1e-4);
    }
    for (k, speed) in ["speed=500rad/s", "speed=1000rad/s"].into_iter().enumerate() {
        let response = documented(&["response", &path, "--set", speed], "forced response");
        let amplitudes = numbers_of(&response, "amplitude");
        let last = amplitudes.len() - 2;
        close(amplitudes[last], list("across")[k], 1e-5);
        close(amplitudes[last + 1], list("up")[k], 1e-5);
    }
}

fn numbers_of(table: &Table, column: &str) -> Vec<f64> {
    let column = table.columns.iter().find(|of| of.name == column).unwrap();
    let Values::Numbers(numbers) = &column.values else { panic!("{}", column.name) };
    numbers.iter().copied().flatten().collect()
}

#[test]
fn what_is_wrong_with_a_rotor_of_ross_is_named() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/truth/ross/stepped.toml");
    let text = fs::read_to_string(path).unwrap();
    for (old, new, message) in [
        ("n = 6", "n = 9", "`DiskElement_Disk 1` is at node 9, which is off the shaft"),
        ("n = 2", "n = 20", "no shaft element begins at node 2, but one at node 3"),
        ("idl = 0.0\n", "", "`ShaftElement_Shaft Element 0` has no number `idl`"),
        ("odl = 0.05\n", "odl = \"a\"\n", "`ShaftElement_Shaft Element 1` has no number `odl`"),
        ("frequency = [ 0.0, 500.0, 1000.0,]", "frequency = [1.0]", "has not as many values as `frequency`"),
        ("kxx = [", "kxx = 7 [", "TOML parse error"),
        ("L = 0.25", "L = 0.2", "is not as long as"),
        ("n = 1\nscale_factor = 1\n", "n = 1\nn_link = 8\n", "stands on another node"),
        ("G_s = ", "G = ", "has no number `G_s`"),
    ] {
        assert!(text.contains(old), "{old}");
        let run = run_with_input(&["import", "-"], &text.replacen(old, new, 1));
        assert_eq!((run.code, run.out.as_str()), (2, ""), "{new}");
        assert!(run.err.contains(message), "{message}: {}", run.err);
    }
    for end in (600..text.len()).step_by(97) {
        let run = run_with_input(&["import", "-"], &text[..end]);
        assert!(run.code == 2 || !run.out.is_empty(), "{end}: {}", run.err);
    }
}
