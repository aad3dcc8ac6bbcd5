//! Figures written alongside answers.

use std::fs;
use std::path::Path;

use crate::program::{answer, folder, pendulum, run};

#[test]
fn every_command_draws_its_figure_beside_the_same_answer() {
    let folder = folder("figures");
    let sweep = ["--sweep", "omega=4..8rad/s", "--start", "theta=60deg"];
    let rotating = "rotating_pendulum.mechanism";
    let campbell = ["campbell", rotating, "--points", "5"];
    let branches = ["branches", rotating];
    let shaken = shaken(&folder);
    for (name, arguments, words) in [
        ("modes", pendulum("modes", &[]), "mode shapes"),
        ("tolerance", pendulum("tolerance", &[]), "share in the variance"),
        ("campbell", [&campbell[..], &sweep].concat(), "Campbell diagram"),
        ("branches", [&branches[..], &sweep].concat(), "angle [rad]"),
        (
            "response",
            vec!["response", &shaken, "--sweep", "omega=60..140rad/s", "--points", "9", "--bands", "--samples", "100"],
            "shake under u",
        ),
    ] {
        let path = folder.join(format!("{name}.svg"));
        let place = path.display().to_string();
        let drawn = answer(&[&arguments[..], &["--figure", &place]].concat());
        assert_eq!(drawn, answer(&arguments), "{name}");
        let text = fs::read_to_string(path).unwrap();
        assert!(text.starts_with("<svg") && text.contains(words), "{name}");
        assert!(!text.contains("NaN"), "{name}");
    }
}

/// The file of a machine with two outputs that an unbalance shakes.
fn shaken(folder: &Path) -> String {
    let path = folder.join("shaken.mechanism");
    let text = "mechanism Shaken { input omega: rad/s; design k = 40 kN/m +/- 5%; body plate: massless;
        body disk: cylinder(mass: 4 kg, radius: 0.1 m, length: 0.02 m, axis: z);
        joint x: prismatic(x) from ground to plate;
        joint spin: revolute(z) from plate to disk, driven at omega;
        force spring: spring(on: x, stiffness: k); force damper: damper(on: x, damping: 30 N*s/m);
        unbalance u: on disk, amount: 20 g*mm; output shake = x; output twice = 2 * x; }";
    fs::write(&path, text).unwrap();
    path.display().to_string()
}

#[test]
fn a_bode_plot_is_of_the_vibration_asked_for() {
    let folder = folder("bode");
    let file = shaken(&folder);
    let path = folder.join("bode.svg").display().to_string();
    let figure = ["--figure", &path, "--of", "twice under u"];
    let sweep = ["--sweep", "omega=60..140rad/s", "--points", "5"];
    answer(&[&["response", &file][..], &sweep, &figure].concat());
    let text = fs::read_to_string(&path).unwrap();
    assert!(text.contains("twice under u") && text.contains("half power"));
    answer(&[&["response", &file][..], &sweep, &figure, &["--polar"]].concat());
    let text = fs::read_to_string(&path).unwrap();
    assert!(text.contains("polar plot of twice under u") && text.contains("omega = 60"));
    let still = run(&[&["response", &file, "--set", "omega=100rad/s"][..], &figure].concat());
    assert_eq!(still.code, 2);
    assert!(still.err.contains("--sweep"), "{}", still.err);
    let wrong = ["--figure", &path, "--of", "thrice"];
    let wrong = run(&[&["response", &file][..], &sweep, &wrong].concat());
    assert!(wrong.code == 2 && wrong.err.contains("twice"), "{}", wrong.err);
}

#[test]
fn a_requirement_limits_a_peak() {
    let file = shaken(&folder("peak_required"));
    let at = ["probability", &file, "--set", "omega=60rad/s"];
    let along = "along omega=60..140rad/s";
    let height = format!("vibration shake under u {along} <= 0.1 mm");
    let place = format!("peak shake {along} away from omega by 60%");
    let both = ["--require", &height, "--require", &place];
    let text = run(&[&at[..], &both].concat()).out;
    for words in ["greatest shake under u along omega", "omega at the peak of shake under u"] {
        assert!(text.contains(words), "{text}");
    }
    let wrong = run(&[&at[..], &["--require", "peak shake under u <= 1 rad/s"]].concat());
    assert!(wrong.code == 2 && wrong.err.contains("peak shake along"), "{}", wrong.err);
}

#[test]
fn an_orbit_is_drawn_at_one_operating_point() {
    let folder = folder("orbit");
    let file = shaken(&folder);
    let path = folder.join("orbit.svg").display().to_string();
    let at = ["response", &file, "--set", "omega=100rad/s"];
    let drawn = |pair| [&at[..], &["--figure", &path, "--orbit", pair]].concat();
    assert_eq!(answer(&drawn("shake,twice under u")), answer(&at));
    let text = fs::read_to_string(&path).unwrap();
    assert!(text.contains("orbit of shake and twice") && text.contains("a straight line"));
    let same = drawn("shake, twice");
    answer(&same);
    assert_eq!(fs::read_to_string(&path).unwrap(), text);
    let report = ["report", at[1], at[2], at[3], "--samples", "20"];
    let report = answer(&[&report[..], &["--orbit", "shake,twice"]].concat());
    assert!(report.contains("orbit of shake and twice"));
    for (wrong, word) in [
        (drawn("shake"), "--orbit shake,lift"),
        (drawn("shake,twise"), "twice"),
        ([&same[..], &["--sweep", "omega=60..140rad/s"]].concat(), "one operating point"),
        ([&at[..], &["--orbit", "shake,twice"]].concat(), "--figure"),
    ] {
        let wrong = run(&wrong);
        assert!(wrong.code == 2 && wrong.err.contains(word), "{}", wrong.err);
    }
}

#[test]
fn the_ending_says_whether_it_is_a_picture() {
    let folder = folder("figure_forms");
    let path = folder.join("modes.png");
    let place = path.display().to_string();
    answer(&pendulum("modes", &["--figure", &place]));
    assert!(fs::read(path).unwrap().starts_with(b"\x89PNG"));
    // Before any work: the declaration is not even read.
    let other = run(&["modes", "missing.mechanism", "--figure", "modes.pdf"]);
    assert_eq!(other.code, 2);
    assert!(other.err.contains("`.svg` or `.png`"), "{}", other.err);
    let missing = folder.join("missing").join("modes.svg").display().to_string();
    let other = run(&["modes", "missing.mechanism", "--figure", &missing]);
    assert_eq!(other.code, 3);
}

#[test]
fn nothing_to_draw_is_said() {
    let path = folder("no_figure").join("tolerance.svg");
    let place = path.display().to_string();
    let none = run(&pendulum("tolerance", &["--tol", "l=0%", "--figure", &place]));
    assert_eq!(none.code, 1);
    assert!(none.err.contains("nothing to draw"), "{}", none.err);
    assert!(!path.exists());
}

#[test]
fn figures_call_modes_and_units_what_the_user_calls_them() {
    let folder = folder("figure_words");
    let draw = |name: &str, more: &[&str]| {
        let path = folder.join(name);
        let place = path.display().to_string();
        let sweep = ["--sweep", "speed=2000..4000rpm", "--points", "3"];
        let figure = ["--figure", &place];
        answer(&[&["campbell", "jeffcott_rotor.mechanism"], &sweep[..], &figure, more].concat());
        fs::read_to_string(path).unwrap()
    };
    let plain = draw("plain.svg", &[]);
    assert!(plain.contains("Hz") && !plain.contains("bounce"));
    let names = ["--mode-names", "bounce, pitch", "--frequency-unit", "rad/s"];
    let named = draw("named.svg", &names);
    for word in ["bounce", "pitch", "mode 3", "rad/s"] {
        assert!(named.contains(word), "{word}");
    }
    assert!(!named.contains("[Hz]"));
    let study = folder.join("study.toml");
    let text = "mode_names = [\"bounce\", \"pitch\"]\nfrequency_unit = \"rad/s\"\n";
    fs::write(&study, text).unwrap();
    let study = study.display().to_string();
    assert_eq!(draw("study.svg", &["--study", &study]), named);
    let modes = pendulum("modes", &["--mode-names", "swing"]);
    assert!(run(&modes).err.contains("--figure"));
}
