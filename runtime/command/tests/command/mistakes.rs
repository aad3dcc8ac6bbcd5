//! Every mistake gives a message that says what to do, and its exit code.

use std::fs;

use crate::program::{PENDULUM, Run, examples, file, folder, pendulum, run, run_with_input, swept};

/// A run that fails with this exit code and message and prints no answer.
#[track_caller]
pub(crate) fn refused(arguments: &[&str], expected: i32, parts: &[&str]) {
    let Run { code, out, err } = run(arguments);
    assert_eq!((code, out.as_str()), (expected, ""), "{arguments:?}: {err}");
    for part in parts {
        assert!(err.contains(part), "{arguments:?}: `{part}` is not in\n{err}");
    }
    assert!(!err.contains("panicked"), "{err}");
}

#[test]
fn a_declaration_with_mistakes_is_drawn() {
    let text = "mechanism A {\n    gravity 9.81 m/s^2 along -z;\n    body µbar: rod(mass: 3 kgg, length: 1 m, along: -z);\n    \
                joint t: revolut(y) from ground to µbar;\n}\n";
    let Run { code, out, err } = run_with_input(&["check", "-"], text);
    assert_eq!((code, out.as_str()), (3, ""));
    let expected = "\
error: unknown unit `kgg`
 --> standard input:3:28
  |
3 |     body µbar: rod(mass: 3 kgg, length: 1 m, along: -z);
  |                            ^^^
  |
  = help: did you mean `kg`?

error: unknown joint `revolut`
 --> standard input:4:14
  |
4 |     joint t: revolut(y) from ground to µbar;
  |              ^^^^^^^
  |
  = help: did you mean `revolute`?

error: `standard input` has 2 mistakes
";
    assert_eq!(err, expected);
}

#[test]
fn unused_design_variables_are_warned_of() {
    let text = "mechanism A {\n    design l = 1 m;\n    /// of the bar\n    design µ_bar = 5 cm +/- 1 mm;\n    design _depth = 5 cm;\n    \
                gravity 9.81 m/s^2 along -z;\n    body bar: rod(mass: 3 kg, length: l, along: -z);\n    \
                joint t: revolute(y) from ground to bar;\n}\n";
    let declared = "standard input: mechanism `A`, 1 coordinate, 0 inputs, 3 design variables, 0 outputs\n";
    let Run { code, out, err } = run_with_input(&["check", "-"], text);
    assert_eq!((code, out.as_str()), (0, declared));
    let expected = "\
warning: unused variable: `µ_bar`
 --> standard input:4:12
  |
4 |     design µ_bar = 5 cm +/- 1 mm;
  |            ^^^^^
  |
  = help: if this is intentional, prefix it with an underscore: `_µ_bar`

";
    assert_eq!(err, expected);
    for (attributes, expected) in [
        ("#[allow(unused_variables)]", ""),
        ("#[allow(dead_code, unused)]", ""),
        ("#[allow(dead_code)]", expected),
        ("#[warn(unused_variables)] #[allow(unused, reason = \"later\")]", ""),
        ("#[allow(unused)] #[warn(unused_variables)]", expected),
    ] {
        let run = run_with_input(&["check", "-"], &format!("{attributes} {text}"));
        assert_eq!((run.code, run.err.as_str()), (0, expected), "{attributes}");
    }
}

/// A speed that drives nothing is as useless as a length of nothing.
#[test]
fn inputs_that_nothing_uses_are_warned_of() {
    let text = "mechanism A { input speed: rpm; input _later: N; body bar: rod(mass: 3 kg, length: 1 m, along: -z);
        joint t: revolute(y) from ground to bar; }";
    let Run { code, err, .. } = run_with_input(&["check", "-"], text);
    assert!(code == 0 && err.contains("unused variable: `speed`") && !err.contains("`_later`"), "{err}");
    let used = run_with_input(&["check", "-"], &text.replace("ground to bar", "ground to bar, driven at speed"));
    assert!(!used.err.contains("unused variable: `speed`"), "{}", used.err);
}

/// What a section by numbers says of its extent against what it says of its stiffness.
#[test]
fn stiffness_in_the_wrong_plane_is_warned_of() {
    let warning = |attribute: &str, section: &str| {
        let text = format!(
            "{attribute}mechanism A {{
    body arm: beam(length: 1 m, along: x, up: z, section: section(mass: 1 kg/m, {section}), bending: 3, torsion: 0);
    joint clamp: fixed from ground to arm;
    point mid: arm at 0.5 length;
    force pull: load(at: mid, force: [0, 0, 1] N);
}}
"
        );
        let run = run_with_input(&["check", "-"], &text);
        assert_eq!(run.code, 0, "{}", run.err);
        run.err
    };
    let wide = "width: 40 mm, height: 10 mm";
    let expected = "\
warning: `arm` is stiffer about y, although its width is greater than its height
 --> standard input:2:10
  |
2 |     body arm: beam(length: 1 m, along: x, up: z, section: section(mass: 1 kg/m, EIy: 9 N*m^2, EIz: 2 N*m^2, width: 40 mm, height: 10 ...
  |          ^^^
  |
  = help: bending about y moves the beam along `up`: its stiffness takes the height to the third power. Exchange the stiffnesses, or write \
`#[allow(deprecated)]` above the mechanism if they are meant

";
    let wrong = format!("EIy: 9 N*m^2, EIz: 2 N*m^2, {wide}");
    assert_eq!(warning("", &wrong), expected);
    assert_eq!(warning("#[allow(deprecated)] ", &wrong), "");
    let said = [
        (
            "EIy: 2 N*m^2, EIz: 9 N*m^2, width: 40 mm, height: 50 mm",
            "`arm` is stiffer about z, although its height is greater than its width",
        ),
        (
            "EIy: 2 N*m^2, EIz: 9 N*m^2, inertia_y: 3 g*m, inertia_z: 2 g*m",
            "`arm` is stiffer about z, although `inertia_y` is greater than `inertia_z`",
        ),
    ];
    for (section, message) in said {
        assert!(warning("", section).contains(message), "{section}");
    }
    let right = [
        format!("EIy: 2 N*m^2, EIz: 9 N*m^2, {wide}"),
        "EIy: 2 N*m^2, EIz: 9 N*m^2, inertia_y: 2 g*m, inertia_z: 3 g*m".to_owned(),
        format!("EIy: 2 N*m^2, EIz: 2 N*m^2, {wide}"),
        "EIy: 9 N*m^2, EIz: 2 N*m^2, width: 20 mm, height: 20 mm".to_owned(),
        "EIy: 9 N*m^2, EIz: 2 N*m^2".to_owned(),
    ];
    for section in right {
        assert_eq!(warning("", &section), "", "{section}");
    }
}

/// What turns on a shaft that stands still, and a seat elsewhere than the journal.
#[test]
fn a_shaft_that_seems_not_to_be_meant_is_warned_of() {
    let said = |attribute: &str, spinning: &str, driven: &str, seat: &str| {
        let text = format!(
            "{attribute}mechanism A {{ input omega: rad/s;
    body rotor: shaft(along: x, up: z, length: 2 m, mass_per_length: 40 kg/m, stiffness: 1 MN*m^2, shear: 0){spinning};
    body wheel: rigid(mass: 40 kg, inertia: [0.8, 0.45, 0.45] kg*m^2);
    joint turns: revolute(x) from rotor at tip to wheel{driven};
    point left: ground; point a: rotor at root; point right: ground at {seat}; point b: rotor at tip;
    force film_a: bushing(from: left, to: a, stiffness: [0, 1, 1] MN/m);
    force film_b: bushing(from: right, to: b, stiffness: [0, 1, 1] MN/m);
}}
"
        );
        let run = run_with_input(&["check", "-"], &text);
        assert_eq!(run.code, 0, "{}", run.err);
        run.err
    };
    let warning = |attribute: &str, spinning: &str, seat: &str| said(attribute, spinning, ", driven at omega", seat);
    let (spins, there) = (" spinning at omega", "[2 m, 0, 0]");
    let held = said("", "", ", driven at 0 rad/s", there);
    assert!(!held.contains("does not spin"), "{held}");
    assert_eq!(warning("", spins, there), "");
    assert_eq!(warning("", spins, "[2010 mm, 0, 0]"), "");
    let stands = warning("", "", there);
    assert!(stands.contains("`rotor` does not spin, although `turns` turns what stands on it"), "{stands}");
    let astray = warning("", spins, "[2.4 m, 0, 0]");
    assert!(
        astray.contains("one end of `film_b` is 0.400 m away from the station of `rotor` that it holds"),
        "{astray}"
    );
    assert_eq!(warning("#[allow(deprecated)] ", "", "[2.4 m, 0, 0]"), "");
}

/// A truncated declaration gives a message and no panic, wherever it is cut off.
#[test]
fn a_truncated_declaration_is_refused_wherever_it_ends() {
    let text = fs::read_to_string(examples().join(PENDULUM)).unwrap();
    let body = text.trim_end();
    for end in (0..body.len()).step_by(23) {
        let run = run_with_input(&["check", "-"], &body[..end]);
        assert_eq!((run.code, run.out.as_str()), (3, ""), "{end}");
        assert!(run.err.starts_with("error: "), "{end}: {}", run.err);
        assert!(!run.err.contains("panicked"), "{end}: {}", run.err);
    }
}

#[test]
fn files_that_cannot_be_read() {
    let missing = ["cannot read `missing.mechanism`: No such file"];
    refused(&["modes", "missing.mechanism"], 3, &missing);
    refused(&["check", PENDULUM.trim_end_matches("pendulum.mechanism")], 3, &["cannot read"]);
    refused(&["check", "."], 3, &["cannot read `.`"]);
    refused(&["modes", "--study", "missing.toml"], 3, &["cannot read `missing.toml`"]);
    let folder = folder("unreadable");
    fs::write(folder.join("binary.mechanism"), [0xff, 0xfe, 0]).unwrap();
    let binary = folder.join("binary.mechanism").display().to_string();
    refused(&["check", &binary], 3, &["cannot read", "UTF-8"]);
}

#[test]
fn names_that_do_not_exist_offer_the_nearest() {
    let unknown = ["has no input or design variable `omeag`", "did you mean `omega`?"];
    refused(&["modes", PENDULUM, "--set", "omeag=5rad/s"], 2, &unknown);
    let start = ["has no coordinate `thta`", "did you mean `theta`?"];
    refused(&["modes", PENDULUM, "--start", "thta=1rad"], 2, &start);
    let sweep = ["has no input `l`", "it has `omega`"];
    refused(&["branches", PENDULUM, "--sweep", "l=0..1m"], 2, &sweep);
    let table = ["the answer has no table `mods`", "did you mean `modes`?"];
    refused(&pendulum("modes", &["--csv", "--table", "mods"]), 2, &table);
    let result = ["the answer has no result `shapes`", "there are `modes`, `equilibrium`"];
    refused(&pendulum("modes", &["--json", "--result", "shapes"]), 2, &result);
    refused(&["mods"], 2, &["unrecognized subcommand", "'modes'"]);
}

#[test]
fn values_with_wrong_units() {
    for (value, parts) in [
        ("omega=5", &["set omega=5: `5` has no unit"][..]),
        ("omega=5 m", &["`omega` must be an angular speed", "this is a length"]),
        ("omega=5 rmp", &["unknown unit `rmp`", "did you mean `rpm`?"]),
        ("omega=fast", &["unknown name `fast`"]),
        ("omega=(5 rpm", &["brackets and quotes come in pairs"]),
        ("omega", &["write a name, `=` and a value"]),
        ("=5 rpm", &["write a name, `=` and a value"]),
        ("l=1e999 m", &["outside the range"]),
        ("l=1 m +/- 3%", &["without a tolerance"]),
        ("m=-1 kg", &["mass of bar", "positive"]),
    ] {
        let code = if value.starts_with("m=") { 1 } else { 2 };
        refused(&["modes", PENDULUM, "--set", value], code, parts);
    }
    for count in ["many", "1.5", "-3", "1e99"] {
        let arguments = ["--samples", count];
        refused(&pendulum("sample", &arguments), 2, &[if count == "-3" { "-3" } else { "`1e4`" }]);
    }
    for (tolerance, part) in [
        ("l=3 kg", "this tolerance must be a length"),
        ("l=3% unifrom", "did you mean `uniform`?"),
        ("l=-1% +1%", "the upper limit stands first"),
        ("l=3", "`3` has no unit"),
        ("l=one of [1, 2] kg", "must be a length"),
        ("l=one of 1 m", "write `one of [1.9, 2.0, 2.1] mm`"),
    ] {
        refused(&pendulum("tolerance", &["--tol", tolerance]), 2, &[part]);
    }
}

#[test]
fn sweeps_that_make_no_sense() {
    for (sweep, part) in [
        ("omega", "`omega` is not a range"),
        ("omega=0-8rad/s", "is not a range"),
        ("omega=0..8", "has no unit"),
        ("omega=0..8m", "this is a length"),
        ("omega=1rad/s..1rad/s", "ends must differ"),
        ("omega=..8rad/s", "write `omega=0..8rad/s`"),
        ("omega=4rad/s..", "has no end"),
    ] {
        refused(&["branches", PENDULUM, "--sweep", sweep], 2, &[part]);
    }
    refused(&["branches", PENDULUM], 2, &["no input to sweep", "--sweep speed=0..6000rpm"]);
    let sweep = ["--sweep", "omega=0..8rad/s", "--points"];
    for points in ["0", "1"] {
        refused(&[&["campbell", PENDULUM], &sweep[..], &[points]].concat(), 2, &["no sweep"]);
    }
    let many = [&["campbell", PENDULUM], &sweep[..], &["1e12", "--csv"]].concat();
    refused(&many, 2, &["1000000000000 points", "divide the range"]);
}

/// What no input gives is said, and what `check` knows of an equilibrium is not forgotten.
#[test]
fn inputs_that_nothing_gives() {
    let folder = folder("not_given");
    let loaded = file(
        &folder,
        "loaded.mechanism",
        "mechanism Loaded { input pull: N; body b: point(mass: 1 kg); joint q: prismatic(x) from ground to b;
            force k: generalized(on: q, value: pull - 3 N); }",
    );
    let why = "the loads along `q` balance for some values of the inputs only";
    let checked = run(&["check", &loaded]);
    assert!(checked.out.contains(why), "{}", checked.out);
    refused(&["modes", &loaded], 1, &["`pull` was not given: 0 N", "no equilibrium found", why]);
    let given = run(&["modes", &loaded, "--set", "pull=3N"]);
    assert!(!given.err.contains("not given"), "{}", given.err);
    let shaken = file(
        &folder,
        "shaken.mechanism",
        "mechanism Shaken { input speed: rpm; body b: point(mass: 1 kg); body table: massless;
            body disk: disk(mass: 1 kg, radius: 10 cm, axis: z);
            joint spin: revolute(z) from ground to disk, driven at speed;
            joint base: prismatic(x) from ground to table, shaken(velocity: 1 mm/s, order: 1 of spin);
            joint q: prismatic(x) from table to b; force k: spring(on: q, stiffness: 1 N/m); output x = q; }",
    );
    refused(&["response", &shaken], 1, &["`speed` was not given: 0 rpm", "excitation `base`"]);
}

/// Brackets and comments are marked where they begin, numbers and robots have an end.
#[test]
fn what_never_ends() {
    for (text, message) in [
        ("mechanism A { body b: rod(mass: 3 kg;\n }", "this `(` is never closed\n --> standard input:1:26"),
        ("mechanism A {\n /* b }", "this `/*` is never closed\n --> standard input:2:2"),
        (
            &format!("mechanism A {{ let a = 3{} }}", "0".repeat(5_000)),
            "this number has 5001 characters; 400 are the most",
        ),
    ] {
        let Run { code, err, .. } = run_with_input(&["check", "-"], text);
        assert!(code == 3 && err.contains(message), "{message}: {err}");
    }
    let folder = folder("many_mistakes");
    let many: String = (0..60).map(|k| format!("let a{k} = b{k};\n")).collect();
    let many = file(&folder, "many.mechanism", &format!("mechanism A {{\n{many}}}"));
    refused(&["check", &many], 3, &["These are the first 50 mistakes.", "61 mistakes"]);
    let links: String = (0..20_000).map(|k| format!("<link name=\"l{k}\"/>")).collect();
    let robot = file(&folder, "many.urdf", &format!("<robot name=\"r\">{links}</robot>"));
    refused(&["import", &robot], 3, &["20000 links and joints"]);
}

/// The heading under which a result is printed names it too.
#[test]
fn results_by_their_headings() {
    for question in ["modes", "sensitivities", "tolerance"] {
        let text = run(&pendulum(question, &[])).out;
        let headings = text.lines().filter(|line| line.starts_with("RotatingPendulum at"));
        let headings: Vec<&str> = headings.collect();
        assert!(headings.len() > 1, "{text}");
        for heading in headings {
            let found = run(&pendulum(question, &["--result", heading]));
            assert!(found.out.starts_with(heading), "{heading}: {}", found.err);
        }
    }
}

#[test]
fn study_files_with_mistakes() {
    let folder = folder("wrong_studies");
    for (name, text, code, parts) in [
        ("key", "mechanisn = \"a\"", 3, &["not a valid study file", "unknown field `mechanisn`", "expected"][..]),
        ("toml", "[set\nomega = 1", 3, &["not a valid study file", "line 1"]),
        ("type", "samples = \"many\"", 3, &["not a valid study file", "expected usize"]),
        ("correlation", "correlation = [[\"l\", \"m\"]]", 3, &["`correlation = [[\"l\", \"k\", 0.5]]`"]),
        ("none", "", 2, &["no mechanism is given"]),
        ("file", "mechanism = \"missing.mechanism\"", 3, &["cannot read", "missing.mechanism"]),
    ] {
        let path = file(&folder, name, text);
        refused(&["modes", "--study", &path], code, parts);
    }
    let allocate = |text: &str, parts: &[&str]| {
        let path = file(&folder, "allocation", text);
        refused(&["allocate", PENDULUM, "--study", &path], 2, parts);
    };
    allocate("", &["nothing is required"]);
    let choose = "[[choose]]\ntolerance = \"l\"\nleast = \"1 mm\"\nmost = \"9 mm\"\ncost = { factor = 1.0 }\n";
    let with = |require: &str| format!("failure = 0.1\nrequire = [{require:?}]\n{choose}");
    allocate(&with("frequency 1"), &["`frequency 1` is not a requirement"]);
    allocate(&with("frequency 1 >= 1 m"), &["frequency 1 >= 1 m", "this is a length"]);
    allocate(&with("angel <= 1.0"), &["did you mean `angle`?"]);
    let many = format!("failure = [0.1, 0.2]\nrequire = [\"stable\"]\n{choose}");
    allocate(&many, &["`failure` has 2 numbers for 1 requirement"]);
    let path = file(&folder, "tables", &format!("[[require]]\nmode = 1\nat_least = 1.0\n{choose}"));
    let parts = ["a requirement is a text: `require = [\"frequency 1 >= 20 Hz\"]`"];
    refused(&["allocate", PENDULUM, "--study", &path], 3, &parts);
}

#[test]
fn requirements_in_words() {
    refused(&pendulum("probability", &[]), 2, &["nothing is required", "--require", "`require = [..]`"]);
    for (text, parts) in [
        ("frequency 1", &["`frequency 1` is not a requirement", "frequency 1 >= 20 Hz"][..]),
        ("frequency one >= 4 rad/s", &["`frequency one` is not a response"]),
        ("frequency 1 outside 4 rad/s", &["is not a requirement"]),
        ("the frequency 1 >= 4 rad/s", &["`the frequency 1` is not a response"]),
        ("frequency 1 away from omega", &["`omega` is no multiple of an input"]),
        ("vibration angle under >= 1 rad", &["is not a vibration"]),
        ("angle outside 1.. deg", &["angle outside"]),
        ("flutter 1 omega=0..8rad/s order 2 >= 1 rad/s", &["is not a response"]),
        ("frequency 0 >= 4 rad/s", &["counted from 1"]),
        ("frequency 2 >= 4 rad/s", &["mode 2"]),
        ("frequency 1 >= 4", &["has no unit"]),
        ("frequency 1 >= 4 m", &["this is a length"]),
        ("angel <= 5 deg", &["did you mean `angle`?"]),
        ("critical omega >= 3 rad/s", &["`omega` is not a range"]),
        ("stable >= 1", &["no output `stable`"]),
    ] {
        refused(&pendulum("probability", &["--require", text]), 2, parts);
    }
    let exact = ["--require", "stable", "--tol", "l=0%"];
    refused(&pendulum("probability", &exact), 2, &["no tolerance is declared"]);
}

#[test]
fn no_equilibrium_is_an_answer() {
    // The upward force is at most 9 N, the weight 9.81 N.
    let heavy = "mechanism Heavy { gravity 9.81 m/s^2 along -z; body block: point(mass: 1 kg);
        joint x: prismatic(z) from ground to block;
        force push: generalized(on: x, value: 9 N - (1 N/m^2) * x^2); }";
    let run = run_with_input(&["modes", "-"], heavy);
    assert_eq!((run.code, run.out.as_str()), (1, ""));
    assert!(run.err.starts_with("error: no equilibrium found"), "{}", run.err);
}

#[test]
fn colours_only_where_they_are_wanted() {
    let bad = ["modes", "missing.mechanism", "--color"];
    let with = |when: &str| run(&[&bad[..], &[when]].concat()).err;
    assert!(with("always").contains("\u{1b}["));
    assert!(!with("never").contains('\u{1b}') && !with("auto").contains('\u{1b}'));
    let usage = |when: &str| run(&["mods", when]).err;
    assert!(usage("--color=always").contains("\u{1b}["));
    assert!(!usage("--color=never").contains('\u{1b}'));
}

/// Brackets in brackets overflow no stack, wherever they are written.
#[test]
fn brackets_are_nested_only_so_deep() {
    let nested = |depth: usize, value: &str| format!("{}{value}{}", "(".repeat(depth), ")".repeat(depth));
    let folder = folder("nested");
    let parts = ["this expression is too large", "name parts of it with `let`"];
    for depth in [100, 10_000, 40_000, 60_000] {
        let value = nested(depth, "1 m");
        let text = format!("mechanism A {{\n    design l = {value};\n}}\n");
        let path = file(&folder, "nested.mechanism", &text);
        refused(&["check", &path], 3, &parts);
        refused(&["modes", PENDULUM, "--set", &format!("l={value}")], 2, &parts);
        let start = format!("theta={}", nested(depth, "1 rad"));
        refused(&["modes", PENDULUM, "--start", &start], 2, &parts);
        refused(&["tolerance", PENDULUM, "--tol", &format!("l={value}")], 2, &parts);
        let study = file(&folder, "nested.toml", &format!("[set]\nl = \"{value}\"\n"));
        refused(&["modes", PENDULUM, "--study", &study], 2, &parts);
    }
    // The message does not repeat all of it.
    let value = format!("l={}", nested(10_000, "1 m"));
    let message = run(&["modes", PENDULUM, "--set", &value]).err;
    assert!(message.contains("set l=(((") && message.len() < 300, "{message}");
    let brackets = "[".repeat(60_000);
    let run = run_with_input(&["check", "-"], &format!("// {brackets}\nmechanism A {{ }}"));
    assert!(!run.err.contains("too large") && run.code == 3, "{}", run.err);
}

#[test]
fn orders_that_cross_no_mode() {
    let folder = folder("orders");
    let speeds = ["--sweep", "omega=4..8rad/s", "--points", "2"];
    fn along<'a>(speeds: &[&'a str], more: &[&'a str]) -> Vec<&'a str> {
        [&["campbell", PENDULUM], speeds, more].concat()
    }
    let wrong = ["nan", "inf", "1e400", "0", "-0", "-1", "1,-2"];
    for order in wrong {
        let given = ["--order", order];
        refused(&along(&speeds, &given), 2, &["crosses no mode", "order 1"]);
        let report = folder.join("report.html").display().to_string();
        let report = ["report", PENDULUM, "-o", &report];
        let given = [&report[..], &speeds, &given].concat();
        refused(&given, 2, &["crosses no mode"]);
        assert!(!folder.join("report.html").exists());
    }
    for order in ["nan", "inf", "0", "-1.5"] {
        let study = file(&folder, "orders.toml", &format!("orders = [1, {order}]"));
        refused(&along(&speeds, &["--study", &study]), 2, &["crosses no mode"]);
        let allocation = format!(
            "require = [\"resonance 1 omega=4..8rad/s order {order} >= 1 rad/s\"]\nfailure = 0.1\n\
             [[choose]]\nnominal = \"l\"\nleast = \"1 m\"\nmost = \"2 m\"\n"
        );
        let study = file(&folder, "allocation.toml", &allocation);
        let parts = ["crosses no mode"];
        refused(&["allocate", PENDULUM, "--study", &study], 2, &parts);
    }
    let pushed =
        "mechanism A { input push: N; body block: point(mass: 1 kg); joint x: prismatic(x) from ground to block;
        force s: spring(on: x, stiffness: 9 N/m); force f: generalized(on: x, value: push); }";
    let pushed = file(&folder, "pushed.mechanism", pushed);
    let campbell = ["campbell", &pushed, "--sweep", "push=0..1N"];
    let parts = ["a multiple of a speed of rotation or a frequency, and `push` is in N"];
    refused(&[&campbell[..], &["--order", "1"]].concat(), 2, &parts);
    let report = ["report", PENDULUM, "-o", "none.html", "--order", "1"];
    refused(&report, 2, &["no input to sweep is given for `--order`"]);
}

#[test]
fn a_sweep_sets_its_input_alone() {
    for question in ["campbell", "sweep", "branches"] {
        let along = pendulum(question, &["--sweep", "omega=4..8rad/s"]);
        refused(&along, 2, &["the sweep sets `omega`", "leave one of them out"]);
    }
}

#[test]
fn counts_and_levels_that_make_no_sense() {
    for level in ["0", "-1", "nan", "inf"] {
        for question in ["modes", "sensitivities", "tolerance", "sample"] {
            let given = pendulum(question, &["--sigma-level", level]);
            refused(&given, 2, &["sigma level", "positive and finite"]);
        }
    }
    let folder = folder("levels");
    let study = file(&folder, "level.toml", "sigma_level = 0");
    refused(&pendulum("modes", &["--study", &study]), 2, &["sigma level"]);
    let study = file(&folder, "samples.toml", "samples = 0");
    let report = folder.join("report.html").display().to_string();
    for more in [["--samples", "0"], ["--study", &study]] {
        refused(&pendulum("sample", &more), 2, &["at least 1"]);
        let place = ["-o", &report];
        refused(&pendulum("report", &[&place[..], &more].concat()), 2, &["at least 1"]);
    }
    let choose =
        "require = [\"stable\"]\nfailure = 0.1\n[[choose]]\nnominal = \"l\"\nleast = \"1 m\"\nmost = \"2 m\"\n";
    let study = file(&folder, "choose.toml", choose);
    let none = ["--study", &study, "--samples", "0"];
    refused(&pendulum("allocate", &none), 2, &["at least 1"]);
    for (option, part) in [
        ("--samples", "write a whole number: `10000` or `1e4`"),
        ("--seed", "write a whole number that is not negative: `7`"),
        ("--stream", "write a whole number that is not negative"),
        ("--threads", "write a whole number that is not negative"),
    ] {
        refused(&pendulum("sample", &[option, "-5"]), 2, &[part]);
    }
    let points = ["--sweep", "omega=4..8rad/s", "--points", "-5"];
    refused(&swept("campbell", &points), 2, &["write a whole number"]);
}

/// A tolerance on the command line or in a study file is checked like a declared one, with the same words.
#[test]
fn tolerances_whose_ends_are_impossible() {
    let folder = folder("impossible");
    let words = [
        "within the tolerance of `l`, the length of `bar` is -2 m; it must be positive",
        "narrow the tolerance, or change the nominal value",
    ];
    let declared = fs::read_to_string(examples().join(PENDULUM)).unwrap();
    let start = declared.find("design l").unwrap();
    let end = start + declared[start..].find(';').unwrap();
    let wide = format!("{}design l = 1 m +/- 300%{}", &declared[..start], &declared[end..]);
    refused(&["check", &file(&folder, "wide", &wide)], 3, &words);
    for given in ["300%", "3 m", "+1 -3 m uniform", "one of [-2, 1] m"] {
        let option = format!("l={given}");
        refused(&pendulum("tolerance", &["--tol", &option]), 2, &words);
        let study = file(&folder, "study", &format!("[tolerance]\nl = \"{given}\"\n"));
        refused(&pendulum("modes", &["--study", &study]), 2, &words);
    }
    // About the value that is set, not the declared one.
    let shorter = ["--tol", "l=0.7m", "--set", "l=0.5m"];
    refused(&pendulum("modes", &shorter), 2, &["the length of `bar` is -0.2 m"]);
    let wider = ["--tol", "l=1.5m", "--set", "l=2m"];
    assert_eq!(run(&pendulum("modes", &wider)).code, 0);
    let zero = "mechanism A { design x0 = 0 m; design k = 9 N/m; body b: point(mass: 1 kg);
        joint x: prismatic(x) from ground to b; force s: spring(on: x, stiffness: k, rest: x0); }";
    let zero = file(&folder, "zero", zero);
    let parts = ["a percentage of a nominal value of zero is zero"];
    refused(&["tolerance", &zero, "--tol", "x0=1%"], 2, &parts);
}

/// A figure and an answer do not share a file, and a text is no picture.
#[test]
fn answers_and_figures_that_overwrite_each_other() {
    let folder = folder("overwritten");
    let place = |name: &str| folder.join(name).display().to_string();
    let (one, other) = (place("a.svg"), place("./a.svg"));
    for figure in [&one, &other] {
        let both = ["--json", "-o", &one, "--figure", figure];
        refused(&pendulum("modes", &both), 2, &["the answer and its figure", "files of their own"]);
    }
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink("a.svg", folder.join("link.json")).unwrap();
        let both = ["-o", &place("link.json"), "--figure", &one];
        refused(&pendulum("modes", &both), 2, &["the answer and its figure"]);
    }
    for name in ["answer.svg", "answer.png"] {
        let file = place(name);
        refused(&pendulum("modes", &["-o", &file]), 2, &["is a picture", "`--figure FILE`"]);
        assert!(!folder.join(name).exists());
    }
    assert!(!folder.join("a.svg").exists());
}

/// More names than modes are a mistake; modes without a name keep their number.
#[test]
fn names_of_modes_that_do_not_exist() {
    let folder = folder("mode_names");
    let figure = folder.join("modes.svg");
    let place = figure.display().to_string();
    let with = ["--figure", &place, "--mode-names"];
    let parts = ["2 names of modes are given, and there is 1 mode", "leave out `pitch`"];
    let two = [&with[..], &["swing,pitch"]].concat();
    refused(&pendulum("modes", &two), 2, &parts);
    refused(&pendulum("tolerance", &two), 2, &parts);
    let speeds = ["--sweep", "omega=4..8rad/s", "--points", "3"];
    refused(&swept("campbell", &[&two[..], &speeds].concat()), 2, &parts);
    let study = file(&folder, "names.toml", "mode_names = [\"swing\", \"pitch\"]");
    refused(&pendulum("modes", &["--figure", &place, "--study", &study]), 2, &parts);
    assert!(!figure.exists());
    // The names in a study file are for the questions that draw modes.
    assert_eq!(run(&pendulum("modes", &["--study", &study])).code, 0);
    let html = folder.join("report.html").display().to_string();
    let report = ["-o", &html, "--samples", "10", "--mode-names", "swing,pitch"];
    refused(&pendulum("report", &report), 2, &parts);
    let rotor = ["modes", "jeffcott_rotor.mechanism", "--set", "speed=1000rpm"];
    let fewer = [&rotor[..], &with, &["first,second"]].concat();
    assert_eq!(run(&fewer).code, 0);
    let drawn = fs::read_to_string(&figure).unwrap();
    assert!(drawn.contains("second") && drawn.contains("mode 3"), "{drawn}");
}

#[test]
fn numbers_with_digits_on_one_side_of_the_point() {
    for value in ["omega=5.rad/s", "omega=.5rad/s", "omega=-.5 rad/s"] {
        let parts = ["write digits on both sides of the point: `5.0`, `0.5`"];
        refused(&["modes", PENDULUM, "--set", value], 2, &parts);
    }
}

/// Messages of the library name no function of Rust, and count modes from 1.
#[test]
fn a_defective_pair_in_plain_words() {
    let folder = folder("defective");
    let text = "mechanism Crit { design k = 400 N/m +/- 5%; design m = 4 kg; design c = 80 N*s/m +/- 5%; body b: point(mass: m);
        joint x: prismatic(x) from ground to b; force s: spring(on: x, stiffness: k); force d: damper(on: x, damping: c); }";
    let path = file(&folder, "crit.mechanism", text);
    let run = run(&["sensitivities", &path]);
    assert!(run.out.contains("of a defective eigenvalue have none"), "{}", run.out);
    assert!(!run.out.contains('_') && !run.err.contains('_'), "{}{}", run.out, run.err);
}

#[test]
fn a_state_reads_well_in_a_sentence() {
    let folder = folder("states");
    let text = "mechanism Follower { input p: N; body a: rod(mass: 2 kg, length: 1 m, along: z); body b: rod(mass: 1 kg, length: 1 m, along: z);
        joint x: revolute(y) from ground to a; joint y: revolute(y) from a to b at [0, 0, 1 m];
        force s: spring(on: x, stiffness: 10 N*m/rad); force t: spring(on: y, stiffness: 10 N*m/rad);
        force f: follower(at: end, force: [0 N, 0 N, -p]); point end: b at [0, 0, 1 m]; }";
    let path = file(&folder, "follower.mechanism", text);
    let run = run(&["modes", &path, "--set", "p=30N"]);
    let flutter = "no: the equilibrium is unstable (flutter: one growing oscillation)\n";
    assert_eq!((run.code, run.err.as_str()), (1, flutter));
}

/// The frequencies are answered all the same.
#[test]
fn an_output_without_a_value_is_named() {
    let text = "mechanism A { design l = 1 m +/- 3%; gravity 9.81 m/s^2 along -z;\n\
                body bar: rod(mass: 3 kg, length: l, along: -z); joint t: revolute(y) from ground to bar;\n\
                output fine = t; output inverse = 1 / t; }\n";
    let Run { code, out, err } = run_with_input(&["tolerance", "-"], text);
    assert_eq!(code, 1);
    assert!(out.contains("what tolerances do to the frequencies"), "{out}");
    let expected = "error: output `inverse` has no finite value at q = [0.0]: it divides by zero, or leaves the domain of a \
                    function\n";
    assert_eq!(err, expected);
}
