//! A beam read from text, compared with reference values.

use eigentol::{Input, Study};
use eigentol_interpreter::Interpreted;
use serde_json::Value;

/// A file of reference values.
pub(crate) fn truth(text: &str) -> Value {
    serde_json::from_str(text).expect("reference values")
}

pub(crate) fn numbers(value: &Value) -> Vec<f64> {
    let list = value.as_array().expect("a list").iter();
    list.map(|number| number.as_f64().expect("a number")).collect()
}

/// A parameter of a case.
pub(crate) fn parameter(case: &Value, name: &str) -> f64 {
    case["parameters"][name].as_f64().unwrap_or(0.0)
}

/// `design NAME = VALUE UNIT;` for each parameter.
pub(crate) fn design(case: &Value, parameters: &[(&str, &str)]) -> String {
    let each = parameters.iter().map(|(name, unit)| {
        let value = parameter(case, name);
        format!("design {name} = {value} {unit};")
    });
    each.collect()
}

/// The largest errors that are allowed, mode by mode: of frequencies, of first and of second derivatives, relative.
pub(crate) struct Bars<'a> {
    pub(crate) values: &'a [f64],
    pub(crate) first: &'a [f64],
    pub(crate) second: &'a [f64],
}

/// A machine read from text.
pub(crate) fn machine(text: &str) -> Interpreted {
    Interpreted::from_text(text).unwrap_or_else(|mistakes| panic!("{text}\n{mistakes:?}"))
}

/// A machine at one speed, if it has a speed.
pub(crate) fn study(text: &str, speed: Option<f64>) -> Study<Interpreted> {
    let study = Study::new(machine(text));
    match speed {
        Some(speed) => study.input(Input::new(0), speed),
        None => study,
    }
}

pub(crate) fn frequencies(study: &Study<Interpreted>) -> Vec<f64> {
    let modes = study.modes().expect("modes");
    modes.frequencies().into_iter().flatten().collect()
}

pub(crate) fn assert_alike(values: &[f64], expected: &[f64], bar: f64) {
    assert_eq!(values.len(), expected.len());
    for (found, expected) in values.iter().zip(expected) {
        let scale = expected.abs().max(1e-12);
        assert!((found - expected).abs() < bar * scale, "{found} {expected}");
    }
}

fn close(value: f64, expected: f64, scale: f64, bar: f64, what: &str) {
    let error = (value - expected).abs() / scale.abs();
    assert!(error <= bar, "{what}: {value} instead of {expected}, {error:.1e} > {bar:.0e}");
}

/// Compares frequencies, and if the case has them, first and second derivatives by its design variables.
pub(crate) fn compare(what: &str, study: &Study<Interpreted>, case: &Value, frequencies: &[f64], bars: &Bars<'_>) {
    let modes = study.modes().unwrap_or_else(|error| panic!("{what}: {error}"));
    let values: Vec<f64> = modes.frequencies().into_iter().flatten().collect();
    for (k, (&bar, &expected)) in bars.values.iter().zip(frequencies).enumerate() {
        close(values[k], expected, expected, bar, &format!("{what}, mode {k}"));
    }
    let names: Vec<String> = (study.description().design.iter()).map(|variable| variable.name.to_string()).collect();
    let sensitivities = study.sensitivities().expect("derivatives");
    let derivatives = &case["derivatives"];
    for (j, name) in names.iter().enumerate() {
        let Some(first) = derivatives[name.as_str()].get("first") else {
            continue;
        };
        let expected = numbers(first);
        let offset = expected.len() - frequencies.len().min(expected.len());
        let expected = &expected[offset..];
        for (k, &bar) in bars.first.iter().enumerate() {
            let slopes = sensitivities.modes[k].frequency().expect("a frequency");
            let what = format!("{what}, d mode {k} / d {name}");
            // a derivative that is small by cancellation is compared with the frequency over the parameter
            let usual = frequencies[k] / parameter(case, name).abs().max(1e-9);
            let scale = expected[k].abs().max(1e-3 * usual.min(1e6));
            close(slopes.by_design[j], expected[k], scale, bar, &what);
        }
    }
    for (k, &bar) in bars.second.iter().enumerate() {
        let curvature = study.mode_curvature(k).expect("second derivatives");
        for (j, name) in names.iter().enumerate() {
            let Some(second) = derivatives[name.as_str()].get("second") else {
                continue;
            };
            // lambda = omega^2, lambda'' = 2 omega'^2 + 2 omega omega''
            let slope = sensitivities.modes[k].frequency().expect("a frequency").by_design[j];
            let lambda = curvature.lambda.by_design[j][j];
            let found = (0.5 * lambda - slope * slope) / frequencies[k];
            let expected = numbers(second)[k];
            let usual = frequencies[k] / parameter(case, name).powi(2).max(1e-9);
            let scale = expected.abs().max(1e-3 * usual.min(1e9));
            close(found, expected, scale, bar, &format!("{what}, d2 mode {k} / d {name}2"));
        }
    }
}
