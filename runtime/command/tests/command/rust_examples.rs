//! The command's numbers against those of the compiled examples.

use eigentol::kernels::SummaryKernels;
use eigentol::{InDeclaredUnit, Mechanism, Study};
use serde_json::Value;

use crate::program::answer;

#[path = "../../../../examples/jeffcott_rotor.rs"]
#[allow(dead_code, unreachable_pub)]
mod jeffcott_rotor;
#[path = "../../../../examples/rotating_double_pendulum.rs"]
#[allow(dead_code, unreachable_pub, clippy::duplicate_mod)]
mod rotating_double_pendulum;
#[path = "../../../../examples/rotating_pendulum.rs"]
#[allow(dead_code, unreachable_pub, clippy::duplicate_mod)]
mod rotating_pendulum;
#[path = "../../../../examples/whipple_bicycle.rs"]
#[allow(dead_code, unreachable_pub)]
mod whipple_bicycle;

use jeffcott_rotor::JeffcottRotor;
use rotating_double_pendulum::{IndependentBars, RotatingDoublePendulum};
use rotating_pendulum::RotatingPendulum;
use whipple_bicycle::WhippleBicycle;

/// The document that a question gives, run in the folder of the declarations.
fn document(question: &[&str], more: &[&str]) -> Value {
    let document: Value = serde_json::from_str(&answer(&[question, &["--json"], more].concat())).unwrap();
    assert_eq!(document["format"], "eigentol");
    document
}

/// A numeric column of the first table.
fn column(document: &Value, name: &str) -> Vec<Option<f64>> {
    let columns = document["tables"][0]["columns"].as_array().unwrap();
    let column = columns.iter().find(|column| column["name"] == name);
    let values = column.unwrap_or_else(|| panic!("no column `{name}`"))["values"].as_array().unwrap();
    values.iter().map(Value::as_f64).collect()
}

/// Requires equality to 1e-12 of the largest value.
#[track_caller]
fn same(values: &[Option<f64>], expected: &[Option<f64>], what: &str) {
    assert_eq!(values.len(), expected.len(), "{what}");
    assert!(expected.iter().flatten().count() > 0, "{what}: nothing to compare");
    let size = expected.iter().flatten().fold(0.0, |most: f64, value| most.max(value.abs()));
    for (k, pair) in values.iter().zip(expected).enumerate() {
        match pair {
            (Some(a), Some(b)) => {
                assert!((a - b).abs() <= 1e-12 * size, "{what} {k}: {a:e} and {b:e}");
            }
            (None, None) => {}
            _ => panic!("{what} {k}: {pair:?}"),
        }
    }
}

/// Modes, equilibrium, sensitivities and standard deviations at one point.
fn compare<M: SummaryKernels>(study: &Study<M>, point: &[&str]) {
    let ask = |command: &str, more: &[&str]| document(&[&[command], point].concat(), more);
    let equilibrium = study.equilibrium().unwrap();
    let modes = &study.modes().unwrap().modes;
    let d = study.description();

    let found = ask("modes", &[]);
    let of = |pick: &dyn Fn(&eigentol::Mode) -> Option<f64>| modes.iter().map(pick).collect::<Vec<_>>();
    same(&column(&found, "Re s"), &of(&|mode| Some(mode.s.re)), "Re s");
    same(&column(&found, "Im s"), &of(&|mode| Some(mode.s.im)), "Im s");
    if modes.iter().any(|mode| mode.frequency().is_some()) {
        same(&column(&found, "frequency"), &of(&|mode| mode.frequency()), "frequency");
    }

    let found = ask("modes", &["--result", "equilibrium"]);
    let state = &equilibrium.coordinates;
    let values: Vec<_> = d.coordinates.iter().map(|info| column(&found, &info.name)[0]).collect();
    let expected: Vec<_> = state.iter().map(|&value| Some(value)).collect();
    same(&values, &expected, "equilibrium");

    let spreads = study.first_order().unwrap();
    let found = ask("tolerance", &[]);
    let expected: Vec<_> = (spreads.modes.iter()).map(|mode| mode.frequency().map(|spread| spread.sigma)).collect();
    same(&column(&found, "sigma of frequency"), &expected, "sigma of frequency");
}

#[test]
fn the_single_pendulum() {
    let study = Study::new(RotatingPendulum)
        .input(RotatingPendulum::omega, 5.0)
        .start(RotatingPendulum::theta, 60f64.to_radians());
    let point = ["rotating_pendulum.mechanism", "--set", "omega=5rad/s", "--start", "theta=60deg"];
    compare(&study, &point);
}

#[test]
fn the_double_pendulum() {
    type Pendulum = RotatingDoublePendulum;
    let study =
        Study::new(RotatingDoublePendulum).input(Pendulum::omega, 5.0).start(Pendulum::theta1, 60f64.to_radians());
    let point = ["rotating_double_pendulum.mechanism", "--set", "omega=5rad/s", "--start", "theta1=60deg"];
    compare(&study, &point);
}

#[test]
fn the_independent_bars() {
    type Bars = IndependentBars;
    let study = Study::new(IndependentBars).input(Bars::omega, 5.0).start(Bars::theta1, 60f64.to_radians());
    let point = ["independent_bars.mechanism", "--set", "omega=5rad/s", "--start", "theta1=60deg"];
    compare(&study, &point);
}

#[test]
fn the_rotor() {
    let study = Study::new(JeffcottRotor).input(JeffcottRotor::speed, InDeclaredUnit(3000.0));
    compare(&study, &["jeffcott_rotor.mechanism", "--set", "speed=3000rpm"]);
}

#[test]
fn the_bicycle() {
    let study = Study::new(WhippleBicycle).input(WhippleBicycle::v, 5.0);
    compare(&study, &["whipple_bicycle.mechanism", "--set", "v=5m/s"]);
}

/// The rotor along its speed, with all its events.
#[test]
fn the_rotor_along_its_speed() {
    let rpm = |value: f64| InDeclaredUnit(value);
    let speeds: Vec<_> = (0..7).map(|k| rpm(1000.0 * f64::from(k))).collect();
    let study = Study::new(JeffcottRotor);
    let expected = study.campbell(JeffcottRotor::speed, &speeds, &[1.0, 2.0]).unwrap();
    let sweep = ["--sweep", "speed=0..6000rpm", "--points", "7", "--order", "1", "--order", "2"];
    let value = document(&[&["campbell", "jeffcott_rotor.mechanism"], &sweep[..]].concat(), &[]);
    let frequencies: Vec<Option<f64>> = (expected.points.iter())
        .flat_map(|point| point.modes.as_ref().unwrap())
        .map(|mode| mode.behaviour.frequency())
        .collect();
    same(&column(&value, "frequency"), &frequencies, "frequency");
    let unit = &JeffcottRotor::DESCRIPTION.inputs[0].unit;
    let events = value["tables"].as_array().unwrap().iter().skip(1).flat_map(|table| {
        let columns = table["columns"].as_array().unwrap();
        let speeds = columns.iter().find(|column| column["name"] == "speed");
        let speeds = speeds.unwrap()["values"].as_array().unwrap();
        speeds.iter().map(Value::as_f64).collect::<Vec<_>>()
    });
    let all = expected.crossings.iter().chain(&expected.critical).chain(&expected.flutter_onsets);
    let all: Vec<_> = all.map(|event| Some(unit.from_si(event.value))).collect();
    same(&events.collect::<Vec<_>>(), &all, "events");
}
