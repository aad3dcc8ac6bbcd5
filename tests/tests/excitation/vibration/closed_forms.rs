//! Declared machines against closed forms in 70 digits: a Jeffcott rotor with an unbalance, and a pendulum on a shaken
//! turntable (`tests/truth/forced`).

use eigentol::forced::Measure;
use eigentol::response::Vibration;
use eigentol::{Complex, Excitation, Output, Study};
use eigentol_interpreter::Interpreted;
use serde_json::Value;

const JEFFCOTT: &str = "mechanism Jeffcott {
    input Omega: rad/s;
    design m = 12 kg;
    design k = 1.9e6 N/m;
    design c = 310 N*s/m;
    design e = 4e-5 m;
    body carriage: massless;
    body shuttle: massless;
    body disk: rigid(mass: m, inertia: [0.1, 0.1, 0.2] kg*m^2);
    joint x: prismatic(x) from ground to carriage;
    joint y: prismatic(y) from carriage to shuttle;
    joint spin: revolute(z) from shuttle to disk, driven at Omega;
    every displacement: spring_damper(stiffness: k, damping: c);
    unbalance u: on disk, eccentricity: e;
    output wx = x;
    output wy = y;
}";

const TURNTABLE: &str = "mechanism Turntable {
    input w: rad/s;
    design m = 1.3 kg;
    design l = 0.45 m;
    design c = 0.02 N*m*s/rad;
    design g = 9.81 m/s^2;
    design Omega = 8 rad/s;
    design a = 2e-3 m;
    gravity g along -z;
    body lift: massless;
    body table: massless;
    body rod: rod(mass: m, length: l, along: -z);
    joint heave: prismatic(z) from ground to lift, shaken(amplitude: a, frequency: w);
    joint spin: revolute(z) from lift to table, driven at Omega;
    joint theta: revolute(y) from table to rod;
    force hinge: damper(on: theta, damping: c);
    point tip: rod at [0, 0, -l];
    output angle = theta;
    output height = position(tip).z;
}";

fn truth(name: &str) -> Value {
    let path = format!("{}/truth/forced/{name}.json", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(path).expect("a file");
    serde_json::from_str(&text).expect("JSON")
}

fn numbers(of: &Value) -> Vec<f64> {
    let list = of.as_array().expect("a list").iter();
    list.map(|x| x.as_f64().expect("a number")).collect()
}

fn close(name: &str, value: f64, exact: f64, size: f64, tolerance: f64) {
    let error = (value - exact).abs() / exact.abs().max(size);
    assert!(error < tolerance, "{name}: {value} {exact}, {error:e}");
}

/// A variable of a study: an input or a design variable.
fn place(study: &Study<Interpreted>, name: &str) -> (usize, bool) {
    match study.find_input(name) {
        Ok(input) => (input.index(), true),
        Err(_) => (study.find_design(name).expect("a variable").index(), false),
    }
}

/// Compares an amplitude, a modulus and a phase, with derivatives by every variable, at one value of the input.
fn compare(
    machine: &Interpreted,
    (input, value): (&str, f64),
    (output, place_of): (usize, [usize; 4]),
    values: &[f64],
    derivatives: &Value,
) {
    let study = Study::new(machine.clone());
    let input = study.find_input(input).expect("an input");
    let study = study.input(input, value).guess(eigentol::Coordinate::new(0), 0.5);
    let all = study.forced_curvature().expect("vibrates");
    let (output, measure) = (Output::new(output), Measure::Displacement);
    let y = all.first.response.harmonics[0].amplitude(output, measure).expect("an output");
    let four = |y: Complex| [y.re, y.im, y.norm(), y.arg()];
    let expected = place_of.map(|k| values[k]);
    for (k, (found, exact)) in four(y).into_iter().zip(expected).enumerate() {
        close(&format!("value {k} at {value}"), found, exact, 1e-3 * expected[2], 1e-12);
    }
    let (complex, modulus, phase) = (
        all.first.complex(0, output, measure).expect("slopes"),
        all.first.modulus(0, output, measure).expect("slopes"),
        all.first.phase(0, output, measure).expect("slopes"),
    );
    let seconds = (
        all.complex(0, output, measure).expect("curvature"),
        all.modulus(0, output, measure).expect("curvature"),
        all.phase(0, output, measure).expect("curvature"),
    );
    for (name, exact) in derivatives.as_object().expect("by variable") {
        let (first, second) = (numbers(&exact["first"]), numbers(&exact["second"]));
        let (k, of_input) = place(&study, name);
        let pick = |by_input: &eigentol::Vector, by_design: &eigentol::Vector| match of_input {
            true => by_input[k],
            false => by_design[k],
        };
        let dy = match of_input {
            true => complex.by_input[k],
            false => complex.by_design[k],
        };
        let found =
            [dy.re, dy.im, pick(&modulus.by_input, &modulus.by_design), pick(&phase.by_input, &phase.by_design)];
        // What a change of the variable by its own size would do.
        let variable = match of_input {
            true => study.input_values()[k],
            false => study.design_values()[k],
        };
        let sizes = [expected[2], expected[2], expected[2], 1.0].map(|x| x / variable);
        for (j, found) in found.into_iter().enumerate() {
            let name = format!("{name} {j} at {value}");
            close(&name, found, first[place_of[j]], 0.01 * sizes[j], 1e-10);
        }
        let of = |by: &eigentol::second_order::SecondDerivatives<f64>| match of_input {
            true => by.by_input[k][k],
            false => by.by_design[k][k],
        };
        let ddy = match of_input {
            true => seconds.0.by_input[k][k],
            false => seconds.0.by_design[k][k],
        };
        let found = [ddy.re, ddy.im, of(&seconds.1), of(&seconds.2)];
        for (j, found) in found.into_iter().enumerate() {
            let name = format!("{name} twice {j} at {value}");
            let size = 0.01 * sizes[j] / variable;
            close(&name, found, second[place_of[j]], size, 1e-8);
        }
    }
}

#[test]
fn an_unbalanced_rotor_vibrates_as_its_closed_form() {
    let truth = truth("jeffcott");
    let machine = Interpreted::from_text(JEFFCOTT).expect("a declaration");
    for case in truth["cases"].as_array().expect("cases") {
        let speed = case["Omega"].as_f64().expect("a speed");
        let values = numbers(&case["re_im_amplitude_phase"]);
        compare(&machine, ("Omega", speed), (0, [0, 1, 2, 3]), &values, &case["derivatives"]);
    }
}

#[test]
fn the_peak_of_an_unbalanced_rotor_is_that_of_its_closed_form() {
    let truth = truth("jeffcott");
    let study = Study::new(Interpreted::from_text(JEFFCOTT).expect("a declaration"));
    let speed = study.find_input("Omega").expect("an input");
    let vibration = Vibration::new::<Interpreted>(Output::new(0), Excitation::new(0));
    let found = study.peaks(vibration, speed, 100.0, 900.0).expect("peaks");
    assert_eq!(found.peaks.len(), 1);
    let peak = &found.peaks[0];
    let [before, after] = peak.half_power.each_ref().map(|half| half.place().expect("inside"));
    let factor = peak.amplification.as_ref().expect("both sides");
    let values = numbers(&truth["peak"]["values"]);
    for (k, own) in [&peak.place, &peak.height, before, after, factor].into_iter().enumerate() {
        close(&format!("{k}"), own.value, values[k], 0.0, 1e-9);
        for (name, exact) in truth["peak"]["derivatives"].as_object().expect("by variable") {
            let j = study.find_design(name).expect("a variable").index();
            let exact = numbers(&exact["first"])[k];
            let size = 1e-3 * own.value / study.design_values()[j];
            close(&format!("{k} by {name}"), own.by_design[j], exact, size, 1e-7);
        }
    }
}

#[test]
fn a_shaken_pendulum_vibrates_as_its_closed_form() {
    let truth = truth("pendulum");
    let machine = Interpreted::from_text(TURNTABLE).expect("a declaration");
    for case in truth["cases"].as_array().expect("cases") {
        let values = numbers(&case["values"]);
        let w = case["w"].as_f64().expect("a frequency");
        compare(&machine, ("w", w), (0, [2, 3, 4, 5]), &values, &case["derivatives"]);
    }
}
