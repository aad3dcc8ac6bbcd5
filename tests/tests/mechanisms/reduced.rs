//! Small mechanisms for which the mass matrix was once wrong (`truth/robots/minimal`): successive hinges about one
//! axis, carrying something that is not on a seat or leans out of the plane; and nearly right angles.

use std::fs;
use std::path::Path;

use eigentol_compiler::compile;
use eigentol_compiler::mechanics::Limits;
use eigentol_consistency::check::check;
use eigentol_consistency::subject::Subject;
use eigentol_oracle::Oracle;
use eigentol_oracle::kernels::Kernels;
use eigentol_tests::to_oracle_model::to_oracle_model;

/// Tolerance relative to the largest entry.
const TOLERANCE: f64 = 1e-13;

const REDUCED: [&str; 10] =
    ["RR_cyl", "RR_on_R", "RR_planar", "RR_screw", "crane", "cyl", "minimal", "prec", "uni", "zyy"];

fn text(name: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("truth/robots/minimal/{name}.mech"));
    let text = fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    // a rod that turns about its own axis moves no mass, which the compiler now detects and reports
    match name {
        "RR_cyl" => text.replace(
            "body b2: rod(mass: 1 kg, length: 1 m, along: x)",
            "body b2: box(mass: 1 kg, size: [1, 0.2, 0.1] m, center: [0.5, 0, 0] m)",
        ),
        _ => text,
    }
}

fn assert_close(what: &str, values: &[f64], expected: &[f64]) {
    let size = expected.iter().fold(0.0_f64, |size, x| size.max(x.abs()));
    for (k, (one, other)) in values.iter().zip(expected).enumerate() {
        let error = (one - other).abs();
        assert!(error <= TOLERANCE * size, "{what}[{k}] is {one:e}, not {other:e}");
    }
}

/// Mass, damping and stiffness at a state.
fn linear(text: &str, q: &[f64]) -> Vec<Vec<f64>> {
    let compiled = compile(text.parse().expect("tokens"), Limits::NONE).unwrap_or_else(|mistakes| panic!("{mistakes}"));
    let design: Vec<f64> = compiled.mechanism.design.iter().map(|one| one.nominal).collect();
    let found = compiled.program.evaluate("linear", &[q, &[], &design]);
    found.expect("a kernel")
}

#[test]
fn reduced_cases_are_those_of_the_oracle() {
    for name in REDUCED.into_iter().chain(["yyP"]) {
        let text = text(name);
        let compiled = compile(text.parse().expect("tokens"), Limits::NONE)
            .unwrap_or_else(|mistakes| panic!("{name}: {mistakes}"));
        let design: Vec<f64> = compiled.mechanism.design.iter().map(|one| one.nominal).collect();
        let (model, speeds) = to_oracle_model(&compiled.mechanism, &[], &design);
        let oracle = Oracle::new(&model);
        let subject = Subject::new(&text, Limits::NONE).unwrap_or_else(|all| panic!("{all:?}"));
        for seed in 0..5 {
            let state = subject.state(seed);
            let q = &state.at[0];
            let [mass, right] = Kernels::motion(&oracle, &state.velocity, [q, &speeds, &[]]);
            let expected = Kernels::linear(&oracle, [q, &speeds, &[]]);
            let evaluate =
                |kernel: &str, arguments: &[&[f64]]| compiled.program.evaluate(kernel, arguments).expect("a kernel");
            let found = evaluate("linear", &[q, &[], &design]);
            assert_close(&format!("{name}: mass"), &found[0], &expected.mass);
            assert_close(&format!("{name}: stiffness"), &found[2], &expected.stiffness);
            let found = evaluate("motion", &[&state.velocity, q, &[], &design]);
            assert_close(&format!("{name}: mass of motion"), &found[0], &mass);
            assert_close(&format!("{name}: force of motion"), &found[1], &right);
            let moving: [&[f64]; 5] = [&state.acceleration, &state.velocity, q, &[], &design];
            let found = evaluate("motion_linear", &moving);
            assert_close(&format!("{name}: mass along a motion"), &found[0], &mass);
        }
    }
}

/// The same for the gripper whose fingers mimic each other.
#[test]
fn reduced_cases_are_consistent() {
    for name in REDUCED.into_iter().chain(["yyP", "mimic"]) {
        let subject = Subject::new(&text(name), Limits::NONE).unwrap_or_else(|all| panic!("{all:?}"));
        for seed in 0..20 {
            let outcome = check(&subject, &subject.state(seed));
            assert!(outcome.differences.is_empty(), "{name}: {:#?}", outcome.differences);
        }
    }
}

/// Three unit rods of 1 kg in line, the last on a slider or a screw: about the first hinge each contributes 1/12 about
/// its centre plus its distance squared, with distances 1/2, 3/2 and 5/2: 9 in all.
#[test]
fn a_slider_behind_two_hinges_has_its_mass() {
    let screw = text("RR_screw");
    let slider = screw
        .replace("screw(x, lead: 1 m)", "prismatic(x)")
        .replace("on: q2, stiffness: 1 N*m/rad", "on: q2, stiffness: 1 N/m");
    let inertia: f64 = [0.5_f64, 1.5, 2.5].map(|distance| 1.0 / 12.0 + distance.powi(2)).iter().sum();
    for text in [screw, slider] {
        let found = linear(&text, &[0.0; 3]);
        assert_close(&text, &found[0][..1], &[inertia]);
    }
}

/// A mass beside a hinge that follows another one, both on a turntable: `M[yaw][pitch] = -cos(pitch)`.
#[test]
fn a_leaning_mass_behind_two_hinges_loads_the_turntable() {
    for pitch in [0.0_f64, 0.4, -1.1, 2.0] {
        let found = linear(&text("minimal"), &[0.7, pitch, 0.3]);
        // unit sphere of 1 kg, centre 1 m to the side along y: position in the turntable (sin pitch, 1, cos pitch)
        let own = 0.4;
        let yaw = own + pitch.sin().powi(2) + 1.0;
        let both = [yaw, -pitch.cos(), 0.0];
        assert_close("row of the turntable", &found[0][..3], &both);
        assert_close("pitch", &found[0][4..5], &[own + 1.0]);
    }
}
