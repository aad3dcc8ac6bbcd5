//! Against closed forms in 70 digits (`tests/truth/forced`, computed by ball arithmetic): values, first and second
//! derivatives of a rotor with unbalance, and of a pendulum on a shaken turntable, whose equilibrium shifts.

use std::fs;
use std::path::Path;

use eigentol::equilibrium::equilibrium;
use eigentol::forced::{ForcedCurvature, Measure, second_derivatives};
use eigentol::second_order::SecondDerivatives;
use eigentol::sensitivity::Slopes;
use eigentol::{Output, Policy};
use serde_json::Value;

use super::models::{Jeffcott, Shaken};
use crate::common::derived::Derived;

pub(super) fn truth(name: &str) -> Value {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../truth/forced");
    let text = fs::read_to_string(path.join(name).with_extension("json")).unwrap();
    serde_json::from_str(&text).unwrap()
}

pub(super) fn numbers(value: &Value) -> Vec<f64> {
    let list = value.as_array().unwrap();
    list.iter().map(|x| x.as_f64().unwrap()).collect()
}

/// Compares with derivatives by one variable; what is zero in the closed form is zero beside `scale`.
#[track_caller]
pub(super) fn near(value: f64, expected: f64, tolerance: f64, scale: f64) {
    let size = if expected.abs() < 1e-25 { scale } else { expected.abs() };
    assert!(
        (value - expected).abs() <= tolerance * size,
        "{value:e} is not {expected:e}: {:e}",
        (value - expected).abs() / size
    );
}

/// Re, Im, modulus and phase of an output, their first and their second derivatives by one variable.
struct Found {
    values: [f64; 4],
    first: [f64; 4],
    second: [f64; 4],
}

/// By input `Ok(k)` or design variable `Err(k)`.
fn found(of: &ForcedCurvature, output: Output, by: Result<usize, usize>) -> Found {
    let measure = Measure::Displacement;
    let y = of.first.response.harmonics[0].amplitude(output, measure).unwrap();
    let slope = |slopes: &Slopes<f64>| match by {
        Ok(k) => slopes.by_input[k],
        Err(k) => slopes.by_design[k],
    };
    let bend = |second_derivatives: &SecondDerivatives<f64>| match by {
        Ok(k) => second_derivatives.by_input[k][k],
        Err(k) => second_derivatives.by_design[k][k],
    };
    let dy = of.first.complex(0, output, measure).unwrap();
    let dy = match by {
        Ok(k) => dy.by_input[k],
        Err(k) => dy.by_design[k],
    };
    let ddy = of.complex(0, output, measure).unwrap();
    let ddy = match by {
        Ok(k) => ddy.by_input[k][k],
        Err(k) => ddy.by_design[k][k],
    };
    let (modulus, phase) = (of.first.modulus(0, output, measure).unwrap(), of.first.phase(0, output, measure).unwrap());
    Found {
        values: [y.re, y.im, y.norm(), y.arg()],
        first: [dy.re, dy.im, slope(&modulus), slope(&phase)],
        second: [
            ddy.re,
            ddy.im,
            bend(&of.modulus(0, output, measure).unwrap()),
            bend(&of.phase(0, output, measure).unwrap()),
        ],
    }
}

#[test]
fn jeffcott_rotor() {
    let model = Derived(Jeffcott);
    let truth = truth("jeffcott");
    let design = [12.0, 1.9e6, 310.0, 4e-5];
    let variables = [Err(0), Err(1), Err(2), Err(3), Ok(0)];
    for case in truth["cases"].as_array().unwrap() {
        let speed = case["Omega"].as_f64().unwrap();
        let at = equilibrium(&model, &[speed], &design, &[0.0; 2], Policy::default()).unwrap();
        let of = second_derivatives(&model, &at).unwrap();
        assert!(of.asymmetry < 1e-11, "{:e}", of.asymmetry);
        let expected = numbers(&case["re_im_amplitude_phase"]);
        for (name, by) in ["m", "k", "c", "e", "Omega"].into_iter().zip(variables) {
            let own = found(&of, Output::new(0), by);
            let slopes = &case["derivatives"][name];
            let (first, second) = (numbers(&slopes["first"]), numbers(&slopes["second"]));
            let size = match by {
                Ok(_) => speed,
                Err(k) => design[k],
            };
            for i in 0..4 {
                let scale = expected[i].abs() / size;
                near(own.values[i], expected[i], 1e-12, 0.0);
                near(own.first[i], first[i], 1e-10, scale);
                near(own.second[i], second[i], 1e-8, scale / size);
            }
        }
        // The orbit is a circle: `y` follows `x` by a quarter of a turn.
        let harmonic = &of.first.response.harmonics[0];
        let [x, y] = [0, 1].map(|o| harmonic.outputs[o].unwrap());
        assert!((y + x * eigentol::Complex::I).norm() < 1e-15 * x.norm());
    }
}

#[test]
fn shaken_pendulum() {
    let model = Derived(Shaken);
    let truth = truth("pendulum");
    let design = [1.3, 0.45, 0.02, 9.81, 0.002];
    let variables =
        [("m", Err(0)), ("l", Err(1)), ("c", Err(2)), ("g", Err(3)), ("Omega", Ok(0)), ("a", Err(4)), ("w", Ok(1))];
    for case in truth["cases"].as_array().unwrap() {
        let inputs = [8.0, case["w"].as_f64().unwrap()];
        let at = equilibrium(&model, &inputs, &design, &[1.0], Policy::default()).unwrap();
        let of = second_derivatives(&model, &at).unwrap();
        let values = numbers(&case["values"]);
        near(at.coordinates[0], values[0], 1e-12, 0.0);
        for (name, by) in variables {
            let slopes = &case["derivatives"][name];
            let (first, second) = (numbers(&slopes["first"]), numbers(&slopes["second"]));
            let size = match by {
                Ok(k) => inputs[k],
                Err(k) => design[k],
            };
            let [angle, tip] = [0, 1].map(|o| found(&of, Output::new(o), by));
            // The file has Re, Im, modulus and phase of the angle, then the modulus of the height of the tip.
            for (k, (own, i)) in [(&angle, 0), (&angle, 1), (&angle, 2), (&angle, 3), (&tip, 2)].into_iter().enumerate()
            {
                let scale = values[2 + k].abs() / size;
                near(own.values[i], values[2 + k], 1e-12, 0.0);
                near(own.first[i], first[2 + k], 1e-10, scale);
                near(own.second[i], second[2 + k], 1e-8, scale / size);
            }
            if let Some(wrong) = case["amplitude_derivative_with_frozen_equilibrium_WRONG"].get(name) {
                let wrong = numbers(&wrong["first"])[0];
                assert!((angle.first[2] - wrong).abs() > 1e-3 * wrong.abs());
            }
        }
    }
}
