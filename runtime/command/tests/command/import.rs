//! Robots imported from URDF files, rotors from files of ROSS, superelements from files of finite element programs.

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

/// Bearings on supports with masses, and an axial force.
#[test]
fn a_rotor_of_ross_on_supports_is_the_same_here() {
    let ross = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/truth/ross");
    let numbers: Value =
        serde_json::from_str(&fs::read_to_string(ross.join("supports_numbers.json")).unwrap()).unwrap();
    let run = run(&["import", &ross.join("supports.toml").display().to_string()]);
    assert_eq!(run.code, 0, "{}", run.err);
    let path = file(&folder("supports"), "supports.mechanism", &run.out);
    let modes = documented(&["modes", &path, "--set", "speed=300rad/s"], "modes");
    let (found, damping) = (numbers_of(&modes, "frequency"), numbers_of(&modes, "damping ratio"));
    for k in 0..6 {
        let [omega, decrement] = ["omega", "decrement"].map(|of| numbers[of][k].as_f64().unwrap());
        assert!((found[k] / omega - 1.0).abs() < 1e-5, "{} {omega}", found[k]);
        let own = 2.0 * PI * damping[k] / (1.0 - damping[k].powi(2)).sqrt();
        assert!((own / decrement - 1.0).abs() < 1e-4, "{own} {decrement}");
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
        ("n = 2", "n = 20", "begins at node 3, but no shaft element at node 2"),
        ("idl = 0.0\n", "", "`ShaftElement_Shaft Element 0` has no number `idl`"),
        ("odl = 0.05\n", "odl = \"a\"\n", "`ShaftElement_Shaft Element 1` has no number `odl`"),
        ("frequency = [ 0.0, 500.0, 1000.0,]", "frequency = [1.0]", "values of `kxx` for 1 speeds"),
        ("kxx = [", "kxx = 7 [", "expected newline"),
        ("kxx = [", "kxx = [ nan,", "must have finite numbers as its `kxx`"),
        ("kxx = [", "kxx = [ inf,", "must have finite numbers as its `kxx`"),
        ("kxx = [", "kxx = [ \"1e6\",", "must have finite numbers as its `kxx`"),
        ("kyy = [", "kyy = nan\nold = [", "must have finite numbers as its `kyy`"),
        ("axial_force = 0", "axial_force = \"0\"", "must have finite numbers as its `axial_force`"),
        ("n = 1\nscale_factor = 1\n", "n = 1\nn_link = -1\n", "must have a node as its `n_link`"),
        ("L = 0.25", "L = 0.2", "is not as long as"),
        ("n = 1\nscale_factor = 1\n", "n = 1\nn_link = 3\n", "does not link the shaft to a support"),
        ("n = 1\nscale_factor = 1\n", "n = 1\nn_link = 8\n", "node 8 is a support without mass"),
        ("G_s = ", "G = ", "has no number `G_s`"),
    ] {
        assert!(text.contains(old), "{old}");
        let run = run_with_input(&["import", "-"], &text.replacen(old, new, 1));
        assert_eq!((run.code, run.out.as_str()), (3, ""), "{new}");
        assert!(run.err.contains(message), "{message}: {}", run.err);
    }
    let coupled =
        run_with_input(&["import", "-"], &text.replace("ShaftElement_Shaft Element 1\"", "CouplingElement_C\""));
    assert!(coupled.err.contains("`CouplingElement_C` stands between node 1 and the next"), "{}", coupled.err);
    for end in (0..text.len()).step_by(97) {
        let run = run_with_input(&["import", "-"], &text[..end]);
        assert!(run.code == 3 || !run.out.is_empty(), "{end}: {}", run.err);
    }
}

/// Speeds under the name that a `CylindricalBearing` gives them; what acts along the axis.
#[test]
fn other_words_of_ross_are_read() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/truth/ross/stepped.toml");
    let text = fs::read_to_string(path).unwrap();
    let plain = run_with_input(&["import", "-"], &text);
    let other = run_with_input(&["import", "-"], &text.replace("frequency = [", "speed = ["));
    assert_eq!((other.code, &other.out), (0, &plain.out));
    // Element 6 is a layer around element 3.
    let twisted = text.replace("torque = 0", "torque = 5e3");
    let differs = run_with_input(&["import", "-"], &twisted);
    assert!(differs.err.contains("`torque` that differs from element to element is left out"), "{}", differs.err);
    let (before, layer) = twisted.split_at(twisted.find("Element 6\"]").unwrap());
    let same =
        run_with_input(&["import", "-"], &format!("{before}{}", layer.replacen("torque = 5e3", "torque = 0", 1)));
    assert!(same.out.contains(", torque: 5000 N*m)"), "{}", same.out);
    let axial = run_with_input(&["import", "-"], &text.replace("kzz = [ 0,]", "kzz = [ 7.0,]"));
    assert_eq!((axial.code, &axial.out), (0, &plain.out));
    assert!(axial.err.contains("note: the stiffness and damping along the axis of `"), "{}", axial.err);
}

#[test]
fn what_is_of_no_kind_is_told_what_import_reads() {
    for text in ["", "# ROSS", "{}", "[robot]\nlinks = 3\n", "%%MatrixMarket matrix\n"] {
        let run = run_with_input(&["import", "-"], text);
        assert_eq!((run.code, run.out.as_str()), (3, ""), "{text}");
        let message = "this is no URDF, MJCF, rotor of ROSS or superelement, or it is cut off";
        assert!(run.err.contains(message) && run.err.contains("`Rotor.save` of ROSS"), "{}", run.err);
    }
}

/// One superelement in every format, and the script that has written them.
fn superelements() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/truth/superelements")
}

const MATRICES: [&str; 3] = ["mass", "stiffness", "damping"];

/// `inline.json` is in SI, by another hand; the others are in mm, t and s with their rows in another order.
#[test]
fn a_superelement_is_the_same_in_every_format() {
    let target = folder("superelement_formats");
    let read = |name: &str| {
        let output = target.join(format!("{name}.part")).display().to_string();
        let run = run(&["import", &superelements().join(format!("{name}.json")).display().to_string(), "-o", &output]);
        assert_eq!((run.code, run.out.as_str(), run.err.as_str()), (0, "", ""), "{name}");
        let matrices = MATRICES.map(|matrix| fs::read_to_string(target.join(format!("{name}_{matrix}.mtx"))).ok());
        (fs::read_to_string(&output).unwrap().replace(&format!("{name}_"), "casing_"), matrices)
    };
    let (declaration, matrices) = read("inline");
    assert_eq!(
        declaration,
        "/// A superelement from a finite element program.
mechanism Casing {
    // station 1: left node 101
    // station 2: right node 205
    body casing: superelement(mass: \"casing_mass.mtx\", stiffness: \"casing_stiffness.mtx\", \
         damping: \"casing_damping.mtx\", stations: [[0 m, 0 m, 0.1 m], [0.5 m, 0 m, 0.1 m]]);
}
"
        .replace("\\\n         ", "")
    );
    let stiffness = matrices[1].as_deref().unwrap();
    assert!(stiffness.starts_with("%%MatrixMarket matrix coordinate real symmetric\n14 14 28\n1 1 2.5e8\n2 2 1.2e6\n"));
    let mut count = 0;
    for file in fs::read_dir(superelements()).unwrap() {
        let path = file.unwrap().path();
        let name = path.file_stem().unwrap().to_str().unwrap();
        if path.extension().is_none_or(|ending| ending != "json") {
            continue;
        }
        let (other, found) = read(name);
        for (k, matrix) in MATRICES.iter().enumerate() {
            assert!(found[k] == matrices[k] || name == "calculix" && k == 2, "{name}: {matrix}");
        }
        assert_eq!(
            other.replace(
                "casing_stiffness.mtx\", stations",
                "casing_stiffness.mtx\", damping: \"casing_damping.mtx\", stations"
            ),
            declaration
        );
        count += 1;
    }
    assert_eq!(count, 11);
}

/// A copy of the superelements of which one file is another.
fn changed(name: &str, file_name: &str, change: impl Fn(&str) -> String) -> (PathBuf, Run) {
    // One for each test: they run beside each other.
    let test = std::thread::current().name().unwrap_or_default().replace("::", "_");
    let target = folder(&format!("{test}/superelement_changed"));
    for file in fs::read_dir(superelements()).unwrap() {
        let path = file.unwrap().path();
        fs::copy(&path, target.join(path.file_name().unwrap())).unwrap();
    }
    let text = fs::read_to_string(target.join(file_name)).unwrap();
    fs::write(target.join(file_name), change(&text)).unwrap();
    let output = target.join("out.part").display().to_string();
    let run = run(&["import", &target.join(format!("{name}.json")).display().to_string(), "-o", &output]);
    (target, run)
}

#[test]
fn what_is_wrong_with_a_superelement_is_drawn() {
    let mut failed = String::new();
    let mut expect = |name: &str, file: &str, changes: &[(&str, &str, &str, &str)]| {
        for (old, new, place, message) in changes {
            let (target, run) = changed(name, file, |text| {
                assert!(text.contains(old), "{file}: {old}");
                text.replacen(old, new, 1)
            });
            let place = format!("superelement_changed/{place}");
            if (run.code, run.out.as_str()) != (3, "") || !run.err.contains(message) || !run.err.contains(&place) {
                failed += &format!("{file} {new}: {place} {message}\n{}\n", run.err);
            }
            assert!(!target.join("out.part").exists() && !target.join("out_mass.mtx").exists());
        }
    };
    expect(
        "market",
        "market.json",
        &[
            (r#""units""#, r#""unit""#, "market.json:3:", "unknown field `unit`"),
            (r#""mm""#, r#""kg""#, "market.json:3:23", "`kg` is not a unit of length, as `m` is"),
            (
                r#""mass": "t""#,
                r#""mass": "t", "force": "N""#,
                "market.json:3:",
                "give the unit of mass or that of force, not both",
            ),
            (r#""stiffness""#, r#""damping""#, "market.json:8:", "duplicate field `damping`"),
            (r#""stiffness""#, r#""stiff""#, "market.json:7:", "unknown field `stiff`"),
            (r#""damping""#, r#""stiffness""#, "market.json:", "duplicate field `stiffness`"),
            ("[0, 0, 100]", "[0, 100]", "market.json:4:", "invalid length 2"),
            (r#""node": 205"#, r#""node": 101"#, "market.json:4:", "station 1 is at this node already"),
            (r#""node": 205"#, r#""node": "b""#, "market.json:4:", "invalid type: string"),
            (
                r#""node": 205"#,
                r#""node": 206"#,
                "market.json:4:",
                "no matrix has a row of station 2: give a node that was retained",
            ),
            ("[205, 1]", "[205, 2]", "market.json:5:", "direction 2 of node 205 is listed twice"),
            ("[205, 1]", "[205, 7]", "market.json:5:", "node 205 has no direction 7"),
            ("[205, 1], ", "", "market_mass.mtx:1:1", "the mass has 14 rows, and `unknowns` lists 13"),
            ("market_mass", "market_lost", "market.json:6:", "`market_lost.mtx` cannot be read: "),
            (r#""market_mass.mtx""#, r#""/dev/null""#, "market.json:6:", "outside the folder of this file"),
            (
                r#"_mass.mtx""#,
                r#"_mass.mtx", "format": "ansys""#,
                "market.json:6:",
                "is of no format that is known: give its `format`, `matrix_market`",
            ),
            (
                r#""file": "market_mass.mtx""#,
                "",
                "market.json:1:1",
                "give `matrix_market` or `file` of the mass, one of both",
            ),
            ("}\n}", "}", "market.json:", "EOF while parsing an object"),
        ],
    );
    expect(
        "market",
        "market_mass.mtx",
        &[
            ("%%MatrixMarket", "%%Matrix", "market.json:6:", "`market_mass.mtx` is of no format that is known"),
            ("\n1 1 ", "\n1 1 x", "market_mass.mtx:", "is not a number"),
            ("\n2 2 ", "\n1 1 ", "market_mass.mtx:5:1", "row 1, column 1 has an entry in line 4 already"),
        ],
    );
    expect(
        "inline",
        "inline.json",
        &[
            ("14 14 28", "14 14 29", "inline.json:", "column 14 of it: the file ends after 28 of 29 entries"),
            (
                r#""14 14 28""#,
                r#""15 15 28""#,
                "inline.json:1:1",
                "the stiffness has 15 rows, and the mass 14: give matrices of one order",
            ),
            (r#""name": "left""#, r#""name": "left", "colour": 1"#, "inline.json:", "unknown field `colour`"),
            ("\"position\": [\n", "\"place\": [\n", "inline.json:", "unknown field `place`"),
        ],
    );
    expect(
        "harwell",
        "harwell_stiffness.matrix",
        &[
            ("RSA", "RSE", "harwell_stiffness.matrix:3:1", "must be of type RSA or RUA: real and assembled"),
            (
                "(8I10)  ",
                "(banana)",
                "harwell_stiffness.matrix:4:1",
                "`(banana)` is not a format such as `(1P,5E16.8)`",
            ),
            (
                "            14            14",
                "          9999          9999",
                "harwell_stiffness.matrix:3:",
                "from 1 to 4096 rows, not 9999",
            ),
            (
                "         1         2",
                "         2         2",
                "harwell_stiffness.matrix:5:",
                "a column begins where the one before it ends",
            ),
        ],
    );
    expect(
        "abaqus",
        "abaqus_stiffness.mtx",
        &[
            (
                "205,1,205,1,",
                "205,7,205,1,",
                "abaqus_stiffness.mtx:",
                "a direction is 1 to 6, or 0 of what has none, not 7",
            ),
            (
                "205,1,205,1,",
                "205,1,205,1,5\n205,1,205,1,",
                "abaqus_stiffness.mtx:",
                "the entry of direction 1 of node 205 and direction 1 of node 205 is listed twice",
            ),
            ("205,1,205,1,", "205,1,205,", "abaqus_stiffness.mtx:", "a line of 4 words, where others have 5"),
            (
                "** \n",
                "*MATRIX INPUT, NAME=K, SCALE FACTOR=2\n",
                "abaqus_stiffness.mtx:1:1",
                "this keyword is not read",
            ),
        ],
    );
    expect(
        "substructure",
        "substructure.mtx",
        &[
            (
                "TYPE=MASS",
                "TYPE=LOAD",
                "substructure.mtx:1:1",
                "there is not one matrix that must be the mass, the file has `STIFFNESS`, `LOAD`",
            ),
            (
                "** 101",
                "** 101, 102",
                "substructure.mtx:",
                "the lower triangle of 20 rows has 210 entries, but 105 follow",
            ),
            ("ELEMENT NODES", "NODES", "substructure.mtx:", "position of a node"),
        ],
    );
    expect(
        "substructure",
        "substructure.json",
        &[(
            "viscousdamping",
            "damping",
            "substructure.mtx:1:1",
            "there is not one matrix `damping`, the file has `STIFFNESS`",
        )],
    );
    expect(
        "calculix",
        "calculix.dof",
        &[
            ("205.1\n", "205\n", "calculix.dof:2:1", "a line has a node and a direction, as in `12.3`"),
            ("205.1\n", "", "calculix.mas:", "the matrix ends after 14 rows, the `.dof` file has 13"),
        ],
    );
    expect(
        "nastran",
        "nastran.pch",
        &[
            (
                "MAAX           0       6       2",
                "MAAX           0       6       3",
                "nastran.pch:",
                "must be real: of type 1 or 2",
            ),
            (
                "MAAX           0       6       2",
                "MAAX           0       9       2",
                "nastran.pch:",
                "must be square: of form 1, or 6 if it is symmetric",
            ),
            ("MAAX           0", "MAAX           1", "nastran.pch:", "`MAAX` must have one header, before its columns"),
        ],
    );
    expect(
        "op4",
        "casing.op4",
        &[
            (
                "      14      14       6       2KGG",
                "      14      13       6       2KGG",
                "casing.op4:",
                "it has 13 rows and 14 columns",
            ),
            (
                "      14      14       6       2KGG",
                "      14      14       6       3KGG",
                "casing.op4:",
                "must be real",
            ),
            (
                "KGG ",
                "QGG ",
                "casing.op4:1:1",
                "there is not one matrix that must be the stiffness, the file has `PHG`, `QGG`, `MGG`",
            ),
        ],
    );
    assert!(failed.is_empty(), "{failed}");
}

/// What `check` would say of the declaration is said of the matrix in the description.
#[test]
fn a_superelement_that_cannot_be_used_is_not_imported() {
    for (file, old, new, place, message) in [
        ("market.json", "[0, 0, 100]", "[0, 7, 100]", ":7:25", "this stiffness resists a motion about"),
        ("market.json", "\"position\": [500, 0, 100]", "\"position\": [5, 0, 1]", ":7:25", "resists a motion about"),
        ("market_stiffness.mtx", "\n1 1 ", "\n1 1 -", ":7:25", "is not positive"),
        ("market_mass.mtx", "\n1 1 ", "\n1 1 -", ":6:20", "the mass"),
    ] {
        let (target, run) = changed("market", file, |text| text.replacen(old, new, 1));
        assert_eq!((run.code, run.out.as_str()), (3, ""), "{new}: {}", run.err);
        assert!(run.err.contains(message) && run.err.contains(&format!("market.json{place}")), "{}", run.err);
        assert!(!target.join("out.part").exists() && !target.join("out_mass.mtx").exists());
    }
}

/// As fields of eight characters have them: negative numbers have one digit less.
#[test]
fn a_superelement_of_few_digits_is_one() {
    let rounded = |text: &str, digits: usize| -> String {
        let (head, rest) = text.split_at(text.match_indices('\n').nth(2).unwrap().0);
        let entry = |line: &str| {
            let [row, column, value] = line.split_whitespace().collect::<Vec<_>>()[..] else { return line.to_owned() };
            let value: f64 = value.parse().unwrap();
            format!("{row} {column} {:.*e}", digits - usize::from(value < 0.0), 1.234_567_8 * value)
        };
        head.to_owned() + &rest.lines().map(entry).collect::<Vec<_>>().join("\n") + "\n"
    };
    let (target, run) = changed("market", "market_stiffness.mtx", |text| rounded(text, 4));
    assert_eq!((run.code, run.err.contains("note: the stiffness has 5 digits: ")), (0, true), "{}", run.err);
    let matrix = fs::read_to_string(target.join("out_stiffness.mtx")).unwrap();
    let digits = |line: &str| line.rsplit(' ').next().unwrap().split('e').next().unwrap().replace(['.', '-'], "").len();
    assert!(matrix.lines().skip(2).all(|line| digits(line) <= 5), "{matrix}");
}

/// Formats that say how much they have are refused wherever they are cut off, others within a line.
#[test]
fn a_superelement_that_is_cut_off_is_refused() {
    for (name, file, counts) in [
        ("market", "market_mass.mtx", true),
        ("harwell", "harwell_mass.matrix", true),
        ("op4", "casing.op4", true),
        ("big", "big.op4", true),
        ("substructure", "substructure.mtx", true),
        ("calculix", "calculix.sti", true),
        ("abaqus", "abaqus_mass.mtx", false),
        ("nastran", "nastran.pch", false),
        ("market", "market.json", true),
    ] {
        let length = fs::metadata(superelements().join(file)).unwrap().len() as usize;
        for end in (0..length - 3).step_by(length / 7) {
            let (_, run) = changed(name, file, |text| text[..end].to_owned());
            let is_line = fs::read_to_string(superelements().join(file)).unwrap()[..end].ends_with('\n');
            assert!(run.code == 3 || !counts && is_line, "{file} {end}: {}", run.err);
            assert!(!run.err.contains("panicked"), "{}", run.err);
        }
    }
    let (_, run) =
        changed("market", "market_mass.mtx", |text| text.lines().take(20).collect::<Vec<_>>().join("\n") + "\n");
    assert!(
        run.err.contains("market_mass.mtx:20:") && run.err.contains("the file ends after 17 of 32 entries"),
        "{}",
        run.err
    );
}

/// Millimetres, newtons and seconds are millimetres, tonnes and seconds.
#[test]
fn a_superelement_in_newtons_is_the_same() {
    let expected = changed("market", "market.json", str::to_owned).0;
    let expected = fs::read_to_string(expected.join("out_stiffness.mtx")).unwrap();
    let (found, run) = changed("market", "market.json", |text| text.replace("\"mass\": \"t\"", "\"force\": \"N\""));
    assert_eq!(run.code, 0, "{}", run.err);
    assert_eq!(fs::read_to_string(found.join("out_stiffness.mtx")).unwrap(), expected);
}

#[test]
fn motions_that_the_files_of_a_superelement_lack_are_zero() {
    let unknowns = "[[1, 1], [1, 2], [1, 3]]";
    let solid = |matrix: &str| {
        format!("{{\"matrix_market\": \"%%MatrixMarket matrix array real symmetric\\n3 3\\n{matrix}\"}}")
    };
    let text = format!(
        "{{\"superelement\": \"2nd foot\", \"stations\": [{{\"node\": 1, \"position\": [0, 0, 0]}}], \"unknowns\": {unknowns},
        \"held\": \"inside\", \"mass\": {}, \"stiffness\": {}}}",
        solid("1 0 0 1 0 1"),
        solid("5 -2 0 6 0 7")
    );
    let target = folder("superelement_solid");
    let output = target.join("foot.part").display().to_string();
    let path = file(&target, "foot.json", &text);
    let found = run(&["import", &path, "--output", &output, "--name", "Foot"]);
    assert_eq!(found.code, 0, "{}", found.err);
    assert_eq!(found.err, "note: station 1 has 3 of its 6 motions in the files: the rows of the others are zero\n");
    assert_eq!(
        fs::read_to_string(target.join("foot_stiffness.mtx")).unwrap(),
        "%%MatrixMarket matrix coordinate real symmetric\n6 6 4\n1 1 5e0\n2 1 -2e0\n2 2 6e0\n3 3 7e0\n"
    );
    let declaration = fs::read_to_string(&output).unwrap();
    assert!(declaration.contains("held: inside, stations: ["), "{declaration}");
    assert!(declaration.contains("mechanism Foot {") && declaration.contains("body part_2nd_foot: "), "{declaration}");
    // Again, over what is there.
    assert_eq!(run(&["import", &path, "--output", &output, "--quiet"]).err, "");
}

/// As spreadsheets and editors write it before a text.
#[test]
fn a_byte_order_mark_is_no_part_of_a_text() {
    for file in ["market.json", "market_mass.mtx"] {
        let (_, run) = changed("market", file, |text| format!("\u{feff}{text}"));
        assert_eq!((run.code, run.err.as_str()), (0, ""), "{file}");
    }
    let target = folder("marks");
    let part = "\u{feff}part Seat { port at; point seat: ground; }\n";
    file(&target, "seat.part", part);
    file(&target, "rotor.csv", "\u{feff}length [mm], outer [mm]\n400, 30\n");
    let text =
        "\u{feff}mechanism Rotor { input speed: rpm; material steel: density 7850 kg/m^3, modulus 210 GPa, poisson 0.3;
        body rotor: shaft(along: x, up: z, material: steel, sections: \"rotor.csv\") spinning at speed; }
        include \"seat.part\";";
    let run = run(&["check", &file(&target, "rotor.mechanism", text)]);
    assert_eq!(run.code, 0, "{}", run.err);
}

#[test]
fn a_superelement_needs_a_place_for_its_matrices() {
    let market = superelements().join("market.json").display().to_string();
    for arguments in [&["import", &market][..], &["import", &market, "-o", "/dev/null"]] {
        let run = run(arguments);
        assert_eq!((run.code, run.out.as_str()), (2, ""));
        assert!(run.err.contains("a superelement has matrices beside it: give --output"), "{}", run.err);
    }
    // A matrix that is read is not replaced.
    let target = folder("superelement_place");
    for file in ["market.json", "market_mass.mtx", "market_stiffness.mtx", "market_damping.mtx"] {
        fs::copy(superelements().join(file), target.join(file)).unwrap();
    }
    let path = target.join("market.json").display().to_string();
    for output in ["market.part", "market.json"] {
        let run = run(&["import", &path, "-o", &target.join(output).display().to_string()]);
        assert_eq!((run.code, run.out.as_str()), (2, ""));
        assert!(run.err.contains("is read, and would be replaced"), "{}", run.err);
    }
    assert_eq!(
        fs::read(target.join("market_mass.mtx")).unwrap(),
        fs::read(superelements().join("market_mass.mtx")).unwrap()
    );
    let nowhere = run(&["import", &path, "-o", &target.join("none/casing.part").display().to_string()]);
    assert!(nowhere.code == 3 && nowhere.err.contains("cannot write"), "{}", nowhere.err);
}
