//! Forced vibration: what its requirements, options and tables refuse or say.

use std::path::Path;

use crate::program::{answer, file, folder, run};

/// A rotor that an unbalance shakes, a length and an angle.
fn rotor(folder: &Path) -> String {
    let text = "mechanism Rotor {
        input omega: rad/s; design k = 100 kN/m +/- 5%; design c = 60 N*s/m +/- 20%;
        body frame: massless; body hub: massless;
        body disk: cylinder(mass: 10 kg, radius: 0.1 m, length: 0.02 m, axis: z);
        joint x: prismatic(x) from ground to frame;
        joint tilt: revolute(y) from frame to hub;
        joint turn: revolute(z) from hub to disk at [0, 0, 0.1 m], driven at omega;
        force across: spring(on: x, stiffness: k); force back: spring(on: tilt, stiffness: k * 0.05 m^2);
        force oil: damper(on: x, damping: c); force air: damper(on: tilt, damping: c * 0.05 m^2);
        unbalance u: on disk, amount: 20 g*mm;
        output shake = x; output lean = tilt; }";
    file(folder, "rotor.mechanism", text)
}

/// A response that no design has is no probability of zero: the reason is that of the response itself.
#[test]
fn a_requirement_whose_response_no_design_has_is_refused() {
    let file = rotor(&folder("untold"));
    let reason = "excitation `u` has the frequency zero";
    let response = run(&["response", &file]);
    assert!(response.err.contains(reason), "{}", response.err);
    for (wanted, reason) in [
        ("vibration shake under u <= 1 mm", reason),
        ("critical omega=1..5rad/s >= 2 rad/s", "no critical value in the range 1 to 5 rad/s"),
        ("flutter 1 omega=1..5rad/s >= 2 rad/s", "no onset of flutter in the range"),
        ("resonance 1 omega=1..5rad/s >= 2 rad/s", "no crossing in the range"),
        ("peak shake along omega=1..5rad/s >= 2 rad/s", "no peak in the range"),
    ] {
        // Only samples: lines would take many searches.
        let few = ["--tol", "k=one of [99, 101] kN/m", "--samples", "64"];
        let found = run(&[&["probability", &file, "--require", wanted], &few[..]].concat());
        assert_eq!((found.code, &*found.out), (1, ""), "{wanted}: {}", found.err);
        assert!(found.err.contains("requirement 1 cannot be judged"), "{}", found.err);
        assert!(found.err.contains(reason), "{wanted}: {}", found.err);
    }
    let found = run(&["probability", &file, "--require", "vibration shake under u <= 1 mm"]);
    assert!(found.code == 1 && found.err.contains(reason), "{}", found.err);
    let moving = ["probability", &file, "--set", "omega=0rad/s", "--tol", "omega=1rad/s"];
    let wanted = ["--require", "vibration shake under u <= 1 mm"];
    let text = answer(&[&moving[..], &wanted].concat());
    assert!(!text.contains("lack the response"), "{text}");
}

#[test]
fn an_upper_limit_of_a_size_is_positive() {
    let file = rotor(&folder("sizes"));
    let at = ["probability", &file, "--set", "omega=50rad/s", "--require"];
    for wanted in [
        "vibration shake under u <= 0 mm",
        "vibration shake under u <= -1 mm",
        "vibration shake along omega=20..200rad/s <= 0 mm",
        "vibration shake outside -1..0 mm",
        "frequency 1 <= 0 Hz",
    ] {
        let found = run(&[&at[..], &[wanted]].concat());
        if wanted.contains("outside") {
            assert_eq!(found.code, 0, "{}", found.err);
            continue;
        }
        assert_eq!((found.code, &*found.out), (2, ""), "{wanted}: {}", found.err);
        assert!(found.err.contains("must be positive"), "{}", found.err);
    }
    answer(&[&at[..], &["vibration shake within 0..1 mm"]].concat());
}

#[test]
fn options_without_effect_are_refused() {
    let file = rotor(&folder("options"));
    let sweep = ["--sweep", "omega=20..200rad/s"];
    for (more, word) in [
        (&["--peaks"][..], "no input to sweep is given for `--peaks`"),
        (&["--points", "5"], "no input to sweep is given for `--points`"),
        (&["--bands", "--checked", "5"], "no input to sweep is given for `--checked`"),
        (&["--of", "shake"], "--bands|--peaks|--figure"),
        (&["--samples", "9"], "--bands"),
        (&[sweep[0], sweep[1], "--peaks", "--points", "5"], "--points"),
        (&[sweep[0], sweep[1], "--set", "omega=9rad/s"], "has no effect"),
    ] {
        let found = run(&[&["response", &file][..], more].concat());
        assert_eq!((found.code, &*found.out), (2, ""), "{more:?}: {}", found.err);
        assert!(found.err.contains(word), "{more:?}: {}", found.err);
    }
    let report = run(&["report", &file, "--points", "5"]);
    assert!(report.code == 2 && report.err.contains("`--points`"), "{}", report.err);
}

/// Peaks of all vibrations are one table, which names the vibration of each.
#[test]
fn peaks_name_their_vibration() {
    let file = rotor(&folder("peaks"));
    let at = ["response", &file, "--sweep", "omega=20..200rad/s", "--peaks"];
    let operating = ["--operating", "omega=110..120rad/s"];
    let table = answer(&[&at[..], &["--csv"]].concat());
    let rows: Vec<&str> = table.lines().collect();
    assert!(rows[0].starts_with("vibration,omega [rad/s]") && rows[0].contains("unit,height,"));
    for (vibration, unit) in [("shake under u", "m"), ("lean under u", "rad")] {
        let own = |row: &&&str| row.starts_with(vibration) && row.contains(&format!(",{unit},"));
        assert!(rows.iter().any(|row| own(&row)), "{table}");
    }
    for (more, start) in [
        (&["--table", "derivatives"][..], "vibration,peak,"),
        (&["--result", "separation", operating[0], operating[1]], "vibration,omega"),
    ] {
        let table = answer(&[&at[..], &["--csv"], more].concat());
        assert!(table.starts_with(start) && table.contains("lean under u"), "{table}");
    }
    let json = answer(&[&at[..], &["--json"]].concat());
    assert!(json.contains("shake under u") && json.contains("lean under u"));
    let text = answer(&[&at[..], &operating].concat());
    assert!(text.contains("separation margins of lean under u"), "{text}");
}

/// Vibrations in which no machine stays are said to be so, and are no success.
#[test]
fn unstable_vibrations() {
    let folder = folder("unstable");
    let text = "mechanism Rocking {
        input speed: rad/s; design push = 4 N*s/m;
        body a: point(mass: 2 kg); body b: massless;
        joint x: prismatic(x) from ground to b; joint y: prismatic(y) from b to a;
        force k: spring(on: x, stiffness: 50 N/m); force d: damper(on: x, damping: 0.5 N*s/m);
        force l: spring(on: y, stiffness: 90 N/m);
        force e: damper(on: y, damping: 0.5 N*s/m - push * (speed / (10 rad/s))^2);
        force h: harmonic(on: x, force: 1 N, frequency: speed);
        force i: harmonic(on: y, force: 1 N, frequency: 2 * speed);
        output shake = x; output sway = y; }";
    let file = file(&folder, "rocking.mechanism", text);
    let response = |range: &str, more: &[&str]| run(&[&["response", &file, "--sweep", range], more].concat());
    let some = response("speed=1..9rad/s", &["--points", "9"]);
    assert_eq!(some.code, 0, "{}", some.err);
    assert!(
        some.out.contains("6 of 9 points are unstable, the first at speed = 4.00000 rad/s: no machine stays there"),
        "{}",
        some.out
    );
    let all = response("speed=4..9rad/s", &["--points", "3"]);
    assert_eq!(all.code, 1, "{}", all.out);
    assert!(all.err.contains("every state in the range is unstable"), "{}", all.err);
    let peaks = response("speed=2..9rad/s", &["--peaks", "--of", "shake under h"]);
    assert_eq!(peaks.code, 1, "{}", peaks.out);
    assert!(peaks.err.contains("every peak is unstable"), "{}", peaks.err);
    assert!(peaks.out.contains("Unstable at speed = 4.99"), "{}", peaks.out);
    // Both harmonics have a row at each speed: the excitation tells them apart.
    for excitation in ["h", "i"] {
        let rows = some.out.lines().filter(|row| row.split_whitespace().nth(1) == Some(excitation));
        assert_eq!(rows.count(), 18, "{}", some.out);
    }
}

/// A mass that a damper alone holds vibrates, although its place has no derivatives: `f / |-m w^2 + i w c|`.
#[test]
fn amplitudes_without_derivatives() {
    let folder = folder("limp");
    let text = "mechanism Limp {
        input k: N/m; body a: point(mass: 1 kg); joint x: prismatic(x) from ground to a;
        force s: spring(on: x, stiffness: k); force d: damper(on: x, damping: 0.1 N*s/m);
        force h: harmonic(on: x, force: 1 N, frequency: 2 rad/s); output shake = x; }";
    let file = file(&folder, "limp.mechanism", text);
    let found = run(&["response", &file, "--set", "k=0N/m"]);
    assert_eq!(found.code, 0, "{}", found.err);
    assert!(found.err.contains("the amplitudes have no derivatives"), "{}", found.err);
    assert!(found.out.contains("0.249688"), "{}", found.out);
}

/// Excitations that act together have one name in results, by which they are found.
#[test]
fn excitations_that_act_together_are_named_as_printed() {
    let folder = folder("together");
    let text = std::fs::read_to_string(rotor(&folder)).unwrap();
    let second = "unbalance v: on disk, amount: 5 g*mm; output lean";
    let file = file(&folder, "together.mechanism", &text.replace("output lean", second));
    let sweep = ["response", &file, "--sweep", "omega=20..200rad/s", "--peaks", "--of"];
    let printed = answer(&[&sweep[..], &["shake under u, v"]].concat());
    assert!(printed.contains("shake under u, v"), "{printed}");
    assert_eq!(printed, answer(&[&sweep[..], &["shake under v"]].concat()));
    let unknown = run(&[&sweep[..], &["shake under u, w"]].concat());
    assert!(unknown.code == 2 && unknown.err.contains("`w`"), "{}", unknown.err);
}

/// The length of a vector has no derivative where it is zero: the error names the output.
#[test]
fn an_output_without_a_derivative_is_named() {
    let folder = folder("unsmooth");
    let text = std::fs::read_to_string(rotor(&folder)).unwrap();
    let text = text.replace("output lean", "point p: hub; output far = norm(position(p)); output lean");
    let file = file(&folder, "unsmooth.mechanism", &text);
    let sweep = ["--sweep", "omega=20..200rad/s"];
    let at_point = run(&["response", &file, "--set", "omega=50rad/s"]);
    assert_eq!(at_point.code, 0, "{}", at_point.err);
    let why = "the amplitudes have no derivatives: output `far` has a value here but no derivative";
    assert!(at_point.err.contains(why), "{}", at_point.err);
    let shaken = at_point.out.lines().any(|row| row.contains("shake  m ") || row.contains("shake   m "));
    assert!(shaken && !at_point.out.contains("derivative by"), "{}", at_point.out);
    let bands = run(&["response", &file, "--set", "omega=50rad/s", "--bands"]).out;
    let row = |name: &str| {
        let mut rows = bands.lines().filter(|row| row.contains(name));
        rows.next().expect("a row").to_owned()
    };
    assert!(row("far under u").contains("no value"), "{bands}");
    assert!(!row("shake under u").contains("no value"), "{bands}");
    for of in ["shake", "far"] {
        let found = run(&["response", &file, sweep[0], sweep[1], "--peaks", "--of", of]);
        assert_eq!(found.code, 1, "{of}: {}", found.err);
        assert!(found.err.contains("output `far` has a value here but no derivative"), "{}", found.err);
    }
    let at = ["probability", &file, "--set", "omega=50rad/s", "--require"];
    let far = run(&[&at[..], &["vibration far <= 1 mm"]].concat());
    assert!(far.code == 1 && far.err.contains("output `far` has a value"), "{}", far.err);
}
