use std::path::Path;

use eigentol::Study;
use eigentol_interpreter::Interpreted;
use serde_json::Value;

/// The reference values of one machine.
pub(crate) fn truth(name: &str) -> Value {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("truth/practice/{name}.json"));
    let text = std::fs::read_to_string(path).expect("reference values");
    serde_json::from_str(&text).expect("JSON")
}

pub(crate) fn number(value: &Value) -> f64 {
    value.as_f64().expect("a number")
}

pub(crate) fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().expect("a list").iter().map(number).collect()
}

/// Declares the parameters of a machine as design variables.
pub(crate) fn designs(truth: &Value, units: &[(&str, &str)]) -> String {
    let parameters = truth["parameters"].as_object().expect("parameters");
    let line = |(name, value): (&String, &Value)| {
        let unit = units.iter().find(|(known, _)| known == name).map_or("", |(_, unit)| unit);
        format!("design {name}_ = {} {unit};\n", number(value))
    };
    parameters.iter().map(line).collect()
}

pub(crate) fn machine(text: &str) -> Interpreted {
    match Interpreted::from_text(text) {
        Ok(machine) => machine,
        Err(error) => panic!("{error}\n{text}"),
    }
}

pub(crate) fn study(text: &str) -> Study<Interpreted> {
    Study::new(machine(text))
}

/// The frequencies of the modes that oscillate.
pub(crate) fn frequencies(study: &Study<Interpreted>) -> Vec<f64> {
    let modes = study.modes().expect("modes");
    modes.frequencies().into_iter().flatten().collect()
}

#[track_caller]
pub(crate) fn close(value: f64, expected: f64, tolerance: f64, what: &str) {
    let scale = expected.abs().max(1e-3);
    assert!(
        (value - expected).abs() <= tolerance * scale,
        "{what}: {value} instead of {expected}, relative error {:.2e}",
        (value - expected).abs() / scale
    );
}
