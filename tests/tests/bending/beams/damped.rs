//! Material that lags behind its strain: forced vibration, and shafts that spin in bearings.

use eigentol::{Complex, Input, Output, Study, forced::Measure};
use eigentol_interpreter::Interpreted;

use crate::beams::compared::{design, numbers, parameter, study, truth};

fn near(value: f64, expected: f64, scale: f64, bar: f64, what: &str) {
    let error = (value - expected).abs() / scale;
    assert!(error < bar, "{what}: {value} instead of {expected}, {error:.1e}");
}

/// Tip displacement and root moment under a harmonic force at the tip, with first derivatives.
#[test]
fn a_cantilever_shaken_at_its_tip() {
    let file = truth(include_str!("../../../truth/flexible/F13_cantilever_forced.json"));
    let parameters = [("L", "m"), ("EI", "N*m^2"), ("rhoA", "kg/m"), ("eta", "s"), ("F", "N")];
    for case in file["cases"].as_array().expect("cases") {
        let frequency = case["w"].as_f64().expect("a frequency");
        let text = format!(
            "mechanism Shaken {{
                {} design w = {frequency} rad/s;
                body bar: beam(length: L, along: x, up: z, mass_per_length: rhoA, stiffness_y: EI, bending_y: 10,
                    lag: eta);
                joint clamp: fixed from ground to bar;
                point end_of_it: bar at tip;
                force shake: harmonic(at: end_of_it, force: [0, 0, F], frequency: w);
                point start: bar at root;
                output tip = position(end_of_it).z;
                output root = reaction_moment(clamp).y;
                output strained = moment(start).y;
            }}",
            design(&file, &parameters)
        );
        // the moment of the strain converges more slowly than that of the forces
        let study: Study<Interpreted> = study(&text, None);
        let all = study.forced_sensitivities().expect("a response");
        let values = numbers(&case["values"]);
        let names: Vec<String> = study.description().design.iter().map(|value| value.name.to_string()).collect();
        let outputs: [Complex; 3] = [0, 1, 2].map(|k| all.response.harmonics[0].outputs[k].expect("an amplitude"));
        let [_, forces, strain] = outputs;
        assert!((forces.norm() - strain.norm()).abs() < 1e-5 * forces.norm(), "{forces} {strain}");
        assert!((forces / strain).im.abs() < 1e-5, "{forces} {strain}");
        for (k, sign) in [(0, 1.0), (1, 1.0)] {
            let expected = Complex::new(values[3 * k], values[3 * k + 1]) * sign;
            let output = outputs[k];
            let what = format!("w {frequency}, output {k}");
            near(output.re, expected.re, expected.norm(), 1e-9, &what);
            near(output.im, expected.im, expected.norm(), 1e-9, &what);
            let slopes = all.complex(0, Output::new(k), Measure::Displacement).expect("derivatives");
            for (j, name) in names.iter().enumerate() {
                let Some(first) = case["derivatives"][name.as_str()].get("first") else {
                    continue;
                };
                let first = numbers(first);
                let expected = Complex::new(first[3 * k], first[3 * k + 1]) * sign;
                let scale = expected.norm().max(1e-3 * output.norm() / parameter(&file, name).abs().max(1e-9));
                near(slopes.by_design[j].re, expected.re, scale, 1e-8, &format!("{what} by {name}"));
                near(slopes.by_design[j].im, expected.im, scale, 1e-8, &format!("{what} by {name}"));
            }
        }
    }
}

/// A round shaft in two bearings whose material lags: forward and backward whirl, and their derivatives.
#[test]
fn a_shaft_with_internal_damping() {
    let file = truth(include_str!("../../../truth/flexible/F8_internal_damping.json"));
    let parameters = [("L", "m"), ("EI", "N*m^2"), ("rhoA", "kg/m"), ("rhoI", "kg*m"), ("c", "N*s/m^2"), ("eta", "s")];
    let text = format!(
        "mechanism Shaft {{
            input omega: rad/s; {}
            body shaft: beam(length: L, along: x, up: z, mass_per_length: rhoA, stiffness_y: EI, stiffness_z: EI,
                inertia_y: rhoI, inertia_z: rhoI, bending: 8, lag: eta) spinning at omega;
            joint left: universal(about_y: y, about_z: z) from ground to shaft;
            point end_of_it: shaft at tip;
            point right: ground at [L, 0, 0];
            constraint bearing: coincident(from: right, to: end_of_it, along: [y, z]);
            force air: distributed(on: shaft, damping: c);
        }}",
        design(&file, &parameters)
    );
    let study = study(&text, Some(parameter(&file, "Omega")));
    let modes = study.modes().expect("modes");
    let sensitivities = study.sensitivities().expect("derivatives");
    let names: Vec<String> = study.description().design.iter().map(|value| value.name.to_string()).collect();
    let tolerances = study.clone().flutter_onset_tolerances(Input::new(0), 0.0, 1000.0).expect("onsets");
    let [onset] = &tolerances[..] else { panic!("{tolerances:?}") };
    let [speed, _] = numbers(&file["onset_speed_and_whirl"])[..] else { panic!("a speed") };
    assert!((onset.value / speed - 1.0).abs() < 7e-11, "{onset:?}");
    let spread = onset.spread.as_ref().expect("a derivative");
    for (name, own) in names.iter().zip(&spread.by_design) {
        let expected = numbers(&file["onset_derivatives"][name.as_str()]["first"])[0];
        assert!((own / expected - 1.0).abs() < 5e-10, "{name}: {own} {expected}");
    }
    let listed = numbers(&file["eigenvalues_re_im_twice"]);
    for (k, pair) in listed.chunks_exact(2).enumerate() {
        let expected = Complex::new(pair[0], pair[1].abs());
        let mode = modes.modes.iter().position(|mode| (mode.s - expected).norm() < 0.1);
        let mode = mode.unwrap_or_else(|| panic!("no mode near {expected}"));
        let found = modes.modes[mode].s;
        assert!((found - expected).norm() < 1e-9 * expected.norm(), "{found} {expected}");
        let slopes = sensitivities.modes[mode].s().expect("derivatives");
        for (j, name) in names.iter().enumerate() {
            let first = numbers(&file["derivatives"][name.as_str()]["first"]);
            let expected = Complex::new(first[2 * k], first[2 * k + 1] * pair[1].signum());
            let scale = expected.norm();
            let error = (slopes.by_design[j] - expected).norm();
            assert!(error < 1e-7 * scale, "{name}: {} {expected}", slopes.by_design[j]);
        }
    }
}
