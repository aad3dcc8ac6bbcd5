//! Reports.

use std::fs;

use crate::program::{PENDULUM, answer, file, folder, pendulum, run};

#[test]
fn a_report_is_one_file_with_the_declaration_and_what_was_asked() {
    let path = folder("report").join("pendulum.html");
    let path = path.to_str().unwrap();
    let more = [
        "--tol",
        "l=10%",
        "--sweep",
        "omega=0..8rad/s",
        "--points",
        "17",
        "--order",
        "1",
        "--samples",
        "200",
        "--seed",
        "7",
        "--title",
        "A bar & a shaft",
        "--mode-names",
        "swing",
        "--frequency-unit",
        "Hz",
        "--output",
        path,
    ];
    let done = run(&pendulum("report", &more));
    assert_eq!((done.code, done.out.as_str(), done.err.as_str()), (0, "", ""));
    let html = fs::read_to_string(path).unwrap();
    for wanted in [
        "<h1>A bar &amp; a shaft</h1>",
        "RotatingPendulum at omega = 5 rad/s",
        "Monte Carlo (200 samples, seed 7)",
        "Campbell diagram",
        "Swing at 0.",
        "pub mechanism RotatingPendulum {",
    ] {
        assert!(html.contains(wanted), "{wanted}");
    }
}

#[test]
fn without_a_file_it_goes_to_standard_output() {
    let done = run(&pendulum("report", &["--samples", "10"]));
    assert_eq!(done.code, 0);
    assert!(done.out.starts_with("<!doctype html>") && done.out.ends_with("</html>\n"));
    assert!(done.out.contains("No sweep was asked for."));
}

#[test]
fn an_unstable_equilibrium_is_reported_and_is_no() {
    let text = "mechanism UpsideDown { design m = 1 kg; gravity 9.81 m/s^2 along -z;
        body bar: rod(mass: m, length: 1 m, along: z); input push: N;
        joint t: prismatic(x) from ground to bar;
        force tip: spring(on: t, stiffness: -100 N/m); }";
    let folder = folder("unstable_report");
    let text = file(&folder, "upside_down.mechanism", text);
    let path = folder.join("report.html");
    let done = run(&["report", &text, "--output", path.to_str().unwrap()]);
    assert_eq!(done.code, 1, "{}", done.err);
    let html = fs::read_to_string(path).unwrap();
    assert!(
        html.contains("The equilibrium is unstable in one direction (divergence)") || html.contains("No equilibrium")
    );
}

#[test]
fn mistakes_leave_no_file() {
    let path = folder("report_mistakes").join("report.html");
    let path = path.to_str().unwrap();
    for (more, code) in [
        (&["--sweep", "speed=0..8rad/s"][..], 2),
        (&["--sweep", "omega=0..8"], 2),
        (&["--output", "/no/such/folder/report.html"], 3),
    ] {
        let arguments = [&["report", PENDULUM, "--output", path], more].concat();
        let done = match more[0] {
            "--output" => run(&[&["report", PENDULUM], more].concat()),
            _ => run(&arguments),
        };
        assert_eq!(done.code, code, "{more:?} {}", done.err);
    }
    assert!(fs::metadata(path).is_err());
}

#[test]
fn a_rigid_motion_in_a_sentence() {
    let folder = folder("rigid");
    let text = "mechanism Two { body a: point(mass: 1 kg); body b: point(mass: 2 kg);
        joint x: prismatic(x) from ground to a; joint y: prismatic(x) from ground to b;
        force s: generalized(on: x, value: (9 N/m) * (y - x)); force t: generalized(on: y, value: (9 N/m) * (x - y)); }";
    let path = file(&folder, "two.mechanism", text);
    let place = folder.join("two.html");
    answer(&["report", &path, "-o", &place.display().to_string()]);
    let html = fs::read_to_string(place).unwrap();
    assert!(html.contains("does not oscillate: it is a motion that nothing resists, wherever the mechanism stands."));
}
